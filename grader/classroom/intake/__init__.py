"""Taking a class in: folders, git checkouts and archives, as people or an LMS put them together.

A class is listed first, without reading any submission; each is then packed when its turn comes, so
that a class of any size takes the memory of a few. What cannot be taken is said, never dropped.

`listing` takes a class, by what `blackboard`, `brightspace`, `canvas`, `moodle`, `gradescope`,
`folders` and `loose` know of one form of export each; `packing` reads one submission, `pieces`
finds the lab's files in it, `archives` unpacks.
"""
