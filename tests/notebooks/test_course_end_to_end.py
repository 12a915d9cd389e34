"""Grade a course of eight students with nbgrader's own command line.

Needs nbgrader beside the grader; takes some minutes.
"""

import csv
import json
import shutil

import pytest
from command_line import run_grader, run_in_class
from handed_in import (
    NAMES,
    RELEASED,
    SOURCE,
    answers,
    fill_answers,
    hand_in,
    kind,
    read,
    replace_in,
    run,
    source,
    write,
)

from grader.classroom.marks import ENGINE
from grader.classroom.nbgrader.submissions import ASSIGNMENT, collect_submissions
from grader.judge.grade import grade
from grader.judge.task import Options, shipped_reference
from grader.release import nbgrader_course as courses

pytestmark = pytest.mark.soak
SECONDS = 8  # of a cell, instead of the minute in the settings
NOISE = """\
import os
import sys
import warnings

print("debug", file=sys.stderr)
warnings.warn("careful", stacklevel=1)
os.write(2, b"straight to the descriptor")
"""
LOOP = "while True:\n    pass\n"
STUBBORN = """\
import time
while True:
    try:
        time.sleep(1)
    except BaseException:
        pass
"""


def edit(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1
    path.write_text(text.replace(old, new), encoding="utf-8")


def with_noise(notebook, cell_id, before):
    """Write noise to stderr into the function of an answer."""
    text = next(source(cell) for cell in notebook["cells"] if cell["id"] == cell_id)
    noise = "".join(f"    {line}\n" for line in NOISE.splitlines() if line)
    assert text.count(before) == 1
    return replace_in(notebook, cell_id, text.replace(before, noise + before))


def without_cell(notebook, cell_id):
    notebook["cells"] = [cell for cell in notebook["cells"] if cell["id"] != cell_id]
    return notebook


def make_class(folder):
    """Make the class.

    anna: complete. ben: untouched. chen: TODO 4 is wrong, and much goes to stderr.
    dora: a loop in a notebook, a test deleted, a wrong answer. emil: a loop when integrators.py
    is imported. farid: no notebooks. gus: a loop that cannot be interrupted.
    hana: a broken notebook.
    """
    hand_in(folder / "anna", "solution", answers())
    hand_in(folder / "ben", "starter", {n: read(RELEASED / f"{n}.ipynb") for n in NAMES})

    noisy = answers()
    with_noise(noisy["integrators"], "answer-8a", "    v = v + accel(x) * dt")
    with_noise(noisy["accuracy"], "answer-stretch", "    joint = world.joints[0]")
    hand_in(folder / "chen", "solution", noisy)
    solver = folder / "chen" / "mini_engine" / "solver.py"
    part = "c.jt + max(-limit, min(limit, total - c.jt))"  # loses 8 of the 10 points of TODO 4
    edit(solver, "max(-limit, min(limit, total))", part)
    edit(solver, "import math\n", f"import math\n{NOISE}")

    looping = answers()
    replace_in(looping["integrators"], "answer-8a", LOOP)
    without_cell(looping["integrators"], "one-step-8b")
    without_cell(looping["quiz"], "quiz-2")
    replace_in(looping["quiz"], "answer-3", 'answer_3 = "a"')
    hand_in(folder / "dora", "solution", looping)

    hand_in(folder / "emil", "solution", answers())
    edit(folder / "emil" / "integrators.py", "import math\n", f"import math\n\n{LOOP}")

    hand_in(folder / "farid", "solution", {})

    stubborn = answers()
    replace_in(stubborn["quiz"], "answer-8", STUBBORN)
    hand_in(folder / "gus", "solution", stubborn)

    hand_in(folder / "hana", "solution", answers())
    (folder / "hana" / "notebooks" / "quiz.ipynb").write_text("{ not json", encoding="utf-8")
    return folder


def bridge(course, *results):
    how = results or ["--jobs", "1"]
    return run_grader("nbgrader", "bridge", "--folder", course, *how)


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """Make the course up to the marks in the gradebook, once for all tests."""
    pytest.importorskip(
        "nbgrader.api", reason="needs the extra `notebooks`, which `make soak` installs"
    )
    top = tmp_path_factory.mktemp("course")
    made = courses.make_course(top / "course")
    assert "quiz.ipynb" in made
    edit(top / "course" / "nbgrader_config.py", "SECONDS = 60", f"SECONDS = {SECONDS}")
    generated = run(top / "course", "generate_assignment", ASSIGNMENT)
    assert generated.returncode == 0, generated.stderr[-2000:]
    taken = list(collect_submissions(make_class(top / "class"), top / "course"))
    assert all(each.taken for each in taken) and len(taken) == 8
    graded = run(top / "course", "autograde", ASSIGNMENT)
    assert "'physics-engine' for student 'hana'" in graded.stderr
    assert graded.stderr.count("There was an error processing assignment '") == 1
    done = bridge(top / "course")
    assert done.exit_code == 0, done.output
    return top / "course"


def gradebook(course):
    """Return the grades and comments of all submissions."""
    import nbgrader.api as api

    with api.Gradebook(f"sqlite:///{course}/gradebook.db") as book:
        return {
            submission.student.id: {
                notebook.name: {
                    "grades": {
                        grade.name: (grade.score, grade.max_score, grade.needs_manual_grade)
                        for grade in notebook.grades
                    },
                    "comments": {each.name: each.comment for each in notebook.comments},
                }
                for notebook in submission.notebooks
            }
            for submission in book.assignment_submissions(ASSIGNMENT)
        }


@pytest.fixture(scope="module")
def book(course):
    return gradebook(course)


def list_lost_cells(book, student, notebook):
    """Return the automatically graded cells without full points."""
    grades = book[student][notebook]["grades"].items()
    return {name for name, (score, most, waits) in grades if score != most and not waits}


# ---------------------------------------------------------------- the release


def test_the_release_is_what_the_starter_holds(course):
    release = course / "release" / ASSIGNMENT
    for name in NAMES:
        ours, theirs = read(RELEASED / f"{name}.ipynb"), read(release / f"{name}.ipynb")
        pairs = zip(ours["cells"], theirs["cells"], strict=True)
        assert all((source(a), a["metadata"]) == (source(b), b["metadata"]) for a, b in pairs)


# ---------------------------------------------------------------- marks


def test_the_gradebook_holds_the_marks_of_the_grader(course, book):
    paths = sorted((course.parent / "class").iterdir())
    options = Options(shipped_reference())
    expected = {
        path.name: {f"todo-{todo.id}": todo.points for todo in grade(path, options).main_todos}
        for path in paths
    }
    found = {
        student: {name: mark[0] for name, mark in notebooks[ENGINE]["grades"].items()}
        for student, notebooks in book.items()
    }
    assert found == expected
    assert all(sum(found[name].values()) == 100 for name in ("anna", "farid", "hana"))
    assert sum(found["ben"].values()) == 0
    assert {name for name, points in found["chen"].items() if points == 0 or name == "todo-4"} == {
        "todo-4"
    }


def test_every_answer_of_the_solution_gets_its_points(book):
    for name in NAMES:
        assert list_lost_cells(book, "anna", name) == set()
    waiting = {
        cell for part in book["anna"].values() for cell, mark in part["grades"].items() if mark[2]
    }
    assert waiting == {"plot", "reading", "journal-step", "journal-choice", "journal-library"}


def test_the_untouched_release_gets_nothing_and_waits_for_nobody(book):
    for part in book["ben"].values():
        for score, _, waits in part["grades"].values():
            assert score == 0 and not waits


def test_noise_costs_nothing(book):
    for name in ("integrators", "accuracy", "quiz"):
        assert list_lost_cells(book, "chen", name) == set()
    # the whole runs with a right version of TODO 4
    assert list_lost_cells(book, "chen", ENGINE) == {"todo-4"}


def test_a_loop_in_a_notebook_costs_its_own_part_and_says_why(course, book):
    assert list_lost_cells(book, "dora", "integrators") == {"one-step-8a", "swing-8a"}
    text = (course / "autograded" / "dora" / ASSIGNMENT / "integrators.ipynb").read_text("utf-8")
    assert f"ran for more than {SECONDS} s and was stopped" in text
    assert (
        list_lost_cells(book, "dora", "accuracy") == set() == list_lost_cells(book, "dora", ENGINE)
    )


def test_a_deleted_test_comes_back_and_a_wrong_answer_is_wrong(book):
    assert list_lost_cells(book, "dora", "quiz") == {"quiz-3"}
    assert book["dora"]["integrators"]["grades"]["one-step-8b"][0] == 1


def test_a_loop_in_a_python_file_costs_what_imports_it(book):
    tests = {c["id"] for c in read(SOURCE / "accuracy.ipynb")["cells"] if kind(c) == "grade+locked"}
    assert list_lost_cells(book, "emil", "accuracy") == tests
    assert list_lost_cells(book, "emil", ENGINE) == {"todo-8a", "todo-8b", "todo-8c"}
    assert (
        list_lost_cells(book, "emil", "quiz")
        == list_lost_cells(book, "emil", "integrators")
        == set()
    )


def test_a_loop_that_cannot_be_interrupted_costs_what_comes_after_it(book):
    assert list_lost_cells(book, "gus", "quiz") == {"quiz-8"}
    assert all(list_lost_cells(book, "gus", name) == set() for name in NAMES if name != "quiz")


def test_a_broken_notebook_costs_nobody_the_engine(book):
    assert list_lost_cells(book, "hana", ENGINE) == set()


def test_without_notebooks_the_engine_counts_alone(book):
    for name, part in book["farid"].items():
        full = name == ENGINE
        assert all((s == m) == full and not waits for s, m, waits in part["grades"].values())


# ---------------------------------------------------------------- once more


def test_a_second_autograde_and_bridge_change_nothing(course, book):
    for student in ("anna", "chen"):
        again = run(course, "autograde", ASSIGNMENT, "--student", student, "--force")
        assert again.returncode == 0, again.stderr[-2000:]
    between = gradebook(course)
    for student in book:
        assert between[student][ENGINE]["grades"] == book[student][ENGINE]["grades"]
    done = bridge(course, course / "results")
    assert done.exit_code == 0, done.output
    assert gradebook(course) == book
    done = bridge(course, course / "results")
    assert done.exit_code == 0 and gradebook(course) == book


# ---------------------------------------------------------------- out again


def test_feedback_gives_the_reasons(course):
    done = run(course, "generate_feedback", ASSIGNMENT, "--force")
    assert done.returncode == 0, done.stderr[-2000:]
    folder = course / "feedback" / "chen" / ASSIGNMENT
    assert sorted(path.stem for path in folder.glob("*.html")) == NAMES
    text = (folder / "engine.html").read_text(encoding="utf-8")
    assert "not yet: 2 / 10" in text and "mini_engine/solver.py:" in text


def test_a_students_words_are_never_markup(course, tmp_path):
    """Bridge a result with a script in its words, on a copy."""
    copy = tmp_path / "copy"
    shutil.copytree(course, copy, ignore=shutil.ignore_patterns("submitted"))
    result = json.loads((course / "results" / "chen.json").read_text(encoding="utf-8"))
    wrong = next(todo for todo in result["todos"] if todo["id"] == "4")
    wrong["checks"][0]["got"] = "</code></pre><script>alert(1)</script>"
    (tmp_path / "chen.json").write_text(json.dumps(result), encoding="utf-8")
    assert bridge(copy, tmp_path / "chen.json").exit_code == 0
    one = ("--student", "chen", "--notebook", "engine", "--force")
    assert run(copy, "generate_feedback", ASSIGNMENT, *one).returncode == 0
    page = (copy / "feedback" / "chen" / ASSIGNMENT / "engine.html").read_text(encoding="utf-8")
    assert "&lt;script&gt;alert(1)" in page and "<script>alert(1)" not in page


def test_marks_go_out_for_the_class_list(course, tmp_path):
    done = run(course, "export", "--to", str(tmp_path / "grades.csv"))
    assert done.returncode == 0, done.stderr[-2000:]
    exported = list(csv.DictReader((tmp_path / "grades.csv").open(encoding="utf-8")))
    raw = {row["student_id"]: float(row["score"]) for row in exported}
    assert raw["anna"] == 100 + 6 + 8 + 8 and raw["ben"] == 0

    listed = tmp_path / "class.csv"
    listed.write_text(
        "Student,ID,SIS Login ID,Section\n"
        '"Ångström, Anna",1,anna,A\nBen,2,ben,A\nFarid,3,farid,A\nZoe,4,zoe,A\n',
        encoding="utf-8",
    )
    lines = {"roster": listed, "nbgrader": course}
    done = run_in_class(tmp_path, "marks", **lines)
    assert done.exit_code == 1 and "anna: no mark yet" in done.output
    done = run_in_class(tmp_path, "marks", "--so-far", **lines)
    words = " ".join(done.output.split())
    assert done.exit_code == 1 and "zoe: no mark, since work without an owner may be" in words
    marks = {"Ångström, Anna": "88.0", "Ben": "0.0", "Farid": "70.0"}
    assert read_marks(tmp_path) == marks | {"Zoe": ""}
    done = run_in_class(tmp_path, "marks", "--so-far", "--others-known", **lines)
    assert done.exit_code == 0, done.output
    assert read_marks(tmp_path) == marks | {"Zoe": "0"}


def read_marks(folder):
    rows = list(csv.reader((folder / "marks.csv").open(encoding="utf-8", newline="")))
    return {row[0]: row[-1] for row in rows[1:]}


def test_the_gradebook_learns_the_names_of_the_class(course, tmp_path):
    import nbgrader.api as api

    shutil.copytree(course, tmp_path / "copy", ignore=shutil.ignore_patterns("autograded"))
    listed = tmp_path / "class.csv"
    listed.write_text("First name,Last name,Email address\nÅsa,Öberg,Anna@x.example\n", "utf-8")
    command = ["roster", str(listed), "--folder", str(tmp_path / "copy")]
    assert run_grader("nbgrader", *command).exit_code == 0
    with api.Gradebook(f"sqlite:///{tmp_path}/copy/gradebook.db") as book:
        anna = book.find_student("anna")
        assert (anna.first_name, anna.last_name) == ("Åsa", "Öberg")


def test_a_changed_submission_is_taken_in_and_graded_anew(course, tmp_path):
    """Hand in ben's work again with the solution's quiz, on a copy."""
    copy = tmp_path / "copy"
    shutil.copytree(course, copy)
    again = tmp_path / "class"
    notebooks = {name: read(RELEASED / f"{name}.ipynb") for name in NAMES}
    folder = hand_in(again / "ben", "starter", notebooks)
    write(folder / "notebooks" / "quiz.ipynb", fill_answers("quiz"))
    taken = list(collect_submissions(again, copy))
    assert [each.words for each in taken] == ["5 notebooks"]
    again = run(copy, "autograde", ASSIGNMENT, "--student", "ben")  # no --force
    assert again.returncode == 0, again.stderr[-2000:]
    grades = gradebook(copy)["ben"]
    assert list_lost_cells(gradebook(copy), "ben", "quiz") == set()
    assert all(mark[0] == 0 for mark in grades["integrators"]["grades"].values())
