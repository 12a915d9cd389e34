"""Ask each student about their own program, with answers that the judge computes in two ways.

`sheet.py` makes the sheet of one student from three kinds of questions: `numbers.py` with its
cases, `films.py` and `reasons.py`. Sheets go to pages and to Moodle, and `marking.py` marks answers
on paper. Students' copies of the grader go without the closed forms.
"""
