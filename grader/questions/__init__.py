"""Ask students about their own programs; the judge computes each answer in two ways.

`sheet.py` makes the sheet of one student from three kinds of questions: `numbers.py` with its
cases, `films.py` and `reasons.py`. Sheets become pages or Moodle XML, and `marking.py` marks
answers on paper. Students' copies of the grader lack the closed forms.
"""
