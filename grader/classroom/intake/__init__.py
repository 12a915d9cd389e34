"""Taking a class in: folders, git checkouts and zips, as people or an LMS put them together.

A class is listed first, without reading any submission; each is then packed when its turn comes, so
that a class of any size takes the memory of a few. What cannot be taken is said, never dropped.

`listing` takes a class, by what `canvas`, `moodle`, `gradescope`, `folders` and `loose` know of one
form of export each; `packing` reads one submission, `zips` unpacks.
"""
