"""Ask each student about their own program, with answers that the judge computes in two ways.

`sheet.py` makes the sheet of one student from the kinds of questions, a file each: `numbers.py`
with its cases, `films.py`, `lines.py`, `reasons.py`. Sheets go to pages, Moodle and notebooks, and
`marking.py` reads the answers. Students' copies of the grader go without the closed forms.
"""
