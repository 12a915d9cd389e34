"""Test that the bridge writes the grader's marks into nbgrader's gradebook."""

import shutil
import warnings

import msgspec
import pytest

from grader.classroom.marks import ENGINE
from grader.classroom.nbgrader.gradebook import fill_gradebook, read_results, write_comment
from grader.classroom.nbgrader.submissions import ASSIGNMENT
from grader.errors import Stop
from grader.judge.result import CheckResult, Result, TodoResult, Where

POINTS = {"4": 10, "5": 8, "8a": 2}
SOAK = pytest.mark.soak  # `make test` installs no nbgrader


def check(points=0, got="nothing", **more):
    return CheckResult("c", "Friction vanishes", "unit", "not yet", points, 3, got=got, **more)


def todo(name, points, **more):
    checks = [] if points == POINTS.get(name) else [check(**more)]
    return TodoResult(name, "t", "not yet", points, POINTS.get(name, 5), None, checks)


def result(*todos, name="anna"):
    total = sum(each.points for each in todos)
    return Result(1, name, total, 20, 0, ["processes"], list(todos))


# ---------------------------------------------------------------- without nbgrader


def test_reasons_are_indented_so_that_nothing_in_them_is_markup():
    text = write_comment(todo("4", 7, got="<script>alert(1)</script>\n# title\x1b[31m"))
    assert "<script>" in text and "\x1b" not in text
    assert all(line.startswith("    ") for line in text.splitlines())
    assert "# title" not in [line.strip() for line in text.splitlines()]


def test_reasons_name_the_place_and_leave_passed_checks_out():
    passed = msgspec.structs.replace(check(3), state="passed", title="Passed already")
    failed = check(0, got="199.6 px/s", where=Where("mini_engine/solver.py", 58))
    text = write_comment(TodoResult("4", "t", "not yet", 7, 10, None, [passed, failed]))
    assert "not yet: 7 / 10" in text and "mini_engine/solver.py:58" in text
    assert "199.6 px/s" in text and "Passed already" not in text


def test_results_are_named_by_their_files_and_rubbish_is_a_sentence(tmp_path):
    (tmp_path / "anna.json").write_bytes(msgspec.json.encode(result(todo("4", 10), name="x")))
    (tmp_path / "ben.json").write_text("[1, 2", encoding="utf-8")
    (tmp_path / "cleo.json").write_text('{"points": "100"}', encoding="utf-8")
    (tmp_path / "notes.txt").touch()
    found = dict(read_results([tmp_path]))
    assert found["anna"].points == 10
    assert "ben.json is no result of the grader" in found["ben"]
    assert "cleo.json is no result of the grader" in found["cleo"]
    assert set(found) == {"anna", "ben", "cleo"}


# ---------------------------------------------------------------- with nbgrader's gradebook


@pytest.fixture(scope="module")
def gradebook(tmp_path_factory):
    """Make a gradebook with three cells for the engine, a quiz, and two submissions."""
    api = pytest.importorskip(
        "nbgrader.api", reason="needs the extra `notebooks`, which `make soak` installs"
    )
    path = tmp_path_factory.mktemp("gradebook") / "gradebook.db"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(api, "get_alembic_version", lambda: "head")  # a process, for one number
        with api.Gradebook(f"sqlite:///{path}") as book:
            fill_in(book)
    return path


def fill_in(book):
    book.add_assignment(ASSIGNMENT)
    book.add_notebook(ENGINE, ASSIGNMENT)
    for name, points in POINTS.items():
        details = {"max_score": points, "cell_type": "markdown"}
        book.add_task_cell(f"todo-{name}", ENGINE, ASSIGNMENT, **details)
    book.add_notebook("quiz", ASSIGNMENT)
    book.add_grade_cell("quiz-1", "quiz", ASSIGNMENT, max_score=1, cell_type="code")
    for name in ("anna", "ben"):
        book.add_student(name)
        book.add_submission(ASSIGNMENT, name)


@pytest.fixture
def course(gradebook, tmp_path):
    shutil.copyfile(gradebook, tmp_path / "gradebook.db")
    return tmp_path


def marks(course, student):
    import nbgrader.api as api

    with api.Gradebook(f"sqlite:///{course}/gradebook.db") as book:
        notebook = book.find_submission_notebook(ENGINE, ASSIGNMENT, student)
        comments = {c.name: c.comment for c in notebook.comments}
        return {
            grade.name: (grade.score, grade.needs_manual_grade, comments[grade.name])
            for grade in notebook.grades
        }


def points(course, student):
    return {name: mark[0] for name, mark in marks(course, student).items()}


@SOAK
def test_points_arrive_and_a_second_time_changes_nothing(course):
    handed = [("anna", result(todo("4", 7), todo("5", 8), todo("8a", 0)))]
    first = list(fill_gradebook(course, handed))
    assert (first[0].student, first[0].points, first[0].max_points) == ("anna", 15, 20)
    assert points(course, "anna") == {"todo-4": 7, "todo-5": 8, "todo-8a": 0}
    before = marks(course, "anna")
    assert not any(waits for _, waits, _ in before.values())
    assert list(fill_gradebook(course, handed)) == first[:1] and marks(course, "anna") == before


@SOAK
@pytest.mark.parametrize(
    ("given", "points_in_all", "named"),
    [
        ({"4": 11}, 10, ["todo-5"]),  # at most what the cell is worth; a missing TODO has 0
        ({"4": -3}, 0, ["todo-5"]),
        ({"4": 10, "6": 5, "B1": 4}, 10, ["todo-6"]),  # a bonus is no part of the sum
    ],
)
def test_points_are_those_of_the_cells(course, given, points_in_all, named):
    todos = [todo(name, got) for name, got in given.items()]
    (done,) = [
        each
        for each in fill_gradebook(course, [("anna", result(*todos))])
        if not isinstance(each, str)
    ]
    assert sum(points(course, "anna").values()) == done.points == points_in_all
    notes = " ".join(done.notes)
    assert all(name in notes for name in named) and "todo-B1" not in notes


@SOAK
def test_without_a_result_the_engine_has_0_points_until_there_is_one(course):
    said = list(fill_gradebook(course, [("anna", result(todo("4", 10)))]))
    assert points(course, "ben") == {"todo-4": 0, "todo-5": 0, "todo-8a": 0}
    assert any(isinstance(each, str) and each.startswith("ben:") for each in said)
    list(fill_gradebook(course, [("ben", result(todo("4", 9)))]))
    assert points(course, "ben")["todo-4"] == 9 and points(course, "anna")["todo-4"] == 10


@SOAK
def test_a_mark_given_by_hand_stays_and_counts(course):
    import nbgrader.api as api

    list(fill_gradebook(course, [("anna", result(todo("4", 3)))]))
    with api.Gradebook(f"sqlite:///{course}/gradebook.db") as book:
        grade = book.find_grade("todo-4", ENGINE, ASSIGNMENT, "anna")
        grade.manual_score, grade.needs_manual_grade = 6, False
        book.db.commit()
    done = list(fill_gradebook(course, [("anna", result(todo("4", 3)))]))
    assert marks(course, "anna")["todo-4"][:2] == (6, False)
    assert any("by hand" in note for note in done[0].notes)
    list(fill_gradebook(course, [("anna", result(todo("4", 9)))]))
    assert marks(course, "anna")["todo-4"][:2] == (6, True), "a person should look again"


@SOAK
def test_a_stranger_and_a_broken_result_stop_nobody(course):
    ten = result(todo("4", 10))
    handed = [("mallory", ten), ("ben", "ben.json is no result"), ("anna", ten)]
    stranger, broken, anna, *_ = fill_gradebook(course, handed)
    assert "mallory" in stranger and broken == "ben.json is no result" and anna.points == 10


@SOAK
def test_python_files_without_notebooks_count_too_without_a_librarys_warning(course):
    (course / "submitted" / "cleo" / ASSIGNMENT).mkdir(parents=True)
    with warnings.catch_warnings(action="error"):
        list(fill_gradebook(course, [("cleo", result(todo("4", 10)))]))
    assert points(course, "cleo")["todo-4"] == 10
    import nbgrader.api as api

    with api.Gradebook(f"sqlite:///{course}/gradebook.db") as book:
        submission = book.find_submission(ASSIGNMENT, "cleo")
        assert submission.score == 10 and not submission.needs_manual_grade


@SOAK
def test_without_a_gradebook_or_a_notebook_it_says_what_to_run(course, tmp_path_factory):
    import nbgrader.api as api

    with pytest.raises(Stop, match="generate_assignment"):
        list(fill_gradebook(tmp_path_factory.mktemp("empty"), []))
    with api.Gradebook(f"sqlite:///{course}/gradebook.db") as book:
        book.remove_assignment(ASSIGNMENT)
    with pytest.raises(Stop, match="knows no notebook engine"):
        list(fill_gradebook(course, []))
