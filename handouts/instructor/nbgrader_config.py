"""nbgrader's settings for a course folder; `python -m grader nbgrader course` copies it there.

What each setting is for, and what goes wrong without it, is in nbgrader.md.
"""

from pathlib import Path

ASSIGNMENT = "physics-engine"
SECONDS = 60  # of one cell, at most

c = get_config()  # noqa: F821  nbgrader provides it

c.CourseDirectory.course_id = "physics"
c.CourseDirectory.root = str(Path.cwd())  # run nbgrader's commands in the course folder

# nbgrader's own default is `solution`, the name of a folder that must not be written to.
c.CourseDirectory.solution_directory = "solved"

# The release asks for the student's words in one place and does not stop a notebook there.
c.ClearSolutions.code_stub = {"python": "# Write your code here."}
c.ClearSolutions.text_stub = "*Write your answer here.*"

# Students keep their own Python files: the source's are as they got them.
source = Path.cwd() / "source" / ASSIGNMENT
c.Autograde.exclude_overwriting = {
    ASSIGNMENT: [
        path.relative_to(source).as_posix()
        for path in sorted(source.rglob("*"))
        if path.is_file() and path.suffix != ".ipynb"
    ]
}

# A test that a student deleted comes back and is graded.
c.OverwriteCells.add_missing_cells = True

# A loop without end stops after SECONDS; the cell counts as failed, the next one runs.
c.ExecutePreprocessor.timeout = SECONDS
c.ExecutePreprocessor.interrupt_on_timeout = True
c.Execute.raise_on_iopub_timeout = False  # even if the loop cannot be interrupted
c.Execute.error_on_timeout = {
    "ename": "TimeLimit",
    "evalue": f"this cell ran for more than {SECONDS} s and was stopped",
    "traceback": [f"This cell ran for more than {SECONDS} s and was stopped: 0 points for it."],
}

# A warning, or a print to stderr, in a graded cell would cost all its points.
c.IgnorePattern.enabled = True
c.IgnorePattern.pattern = r"(?s)."

# A flood of output stays out of the feedback.
c.LimitOutput.max_lines = 200
