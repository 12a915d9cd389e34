"""The class: many submissions in, results, pages and marks out. Students get none of this folder.

In layers, each importing from those before it alone:

- `names`, `roster`, `owners`: who is in the class, and whose a result is
- `intake`: submissions as people and LMSs put them together
- `adjustments`, `book`, `marks`: what is kept of a class, and what becomes of it for the LMS
- `similarity`: how alike submissions are
- `fingerprint`, `executor`, `cluster`, `batch`: grading many, on this machine or on others
- `dashboard`, then `grading`: a page of the class; all of it from start to end
- `feedback`, `course_check`: pages on their way back, and what would go wrong before any of it
- `nbgrader`, `gradescope`: the same within other systems
- `commands`: on the command line
"""
