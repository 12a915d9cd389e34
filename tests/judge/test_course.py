"""Read a course file, follow its settings in every package, and report its mistakes."""

import importlib
import io
import json
import re
import shutil
import zipfile
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import msgspec
import pytest
from command_line import run_grader
from conftest import KIT
from hypothesis import given, settings
from hypothesis import strategies as st
from rich.console import Console
from whole_bank import bank

from grader.bank.members import list_members
from grader.bank.verify import grade_member, shared_worker, verify
from grader.classroom.adjustments import load_adjustments
from grader.classroom.batch import Run
from grader.classroom.book import Book, Outcome, make_table
from grader.classroom.fingerprint import make_key
from grader.classroom.gradescope import write_autograder
from grader.classroom.gradescope.autograder import Settings
from grader.classroom.marks import load_marking
from grader.cli.hand_in import PROGRAMS
from grader.errors import Stop
from grader.intake.found import Intake, Work
from grader.judge.course import FULL, Course, Late, WrongCourse, read_course, spread_points
from grader.judge.grade import grade
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.rubric import load_rubric
from grader.judge.task import Options, shipped_reference
from grader.judge.wording import withhold_reasons
from grader.release.build import build, build_wrong_members
from grader.release.handed_out import make_students_tree, write_tree
from grader.release.handouts import make_handouts
from grader.release.nbgrader_course import make_course
from grader.release.notebooks import has_task, make_notebooks
from grader.release.pages import make_anchor
from grader.report.sinks.gradescope import write_gradescope
from grader.source.regions import regions_in

COURSES = {path.stem: read_course(path) for path in (KIT / "tests" / "courses").glob("*.toml")}
CHEAP = "integrators"
EACH = [
    pytest.param(course, id=name, marks=[pytest.mark.soak] if name != CHEAP else [])
    for name, course in COURSES.items()
]


def grade_course(path: Path, course: Course) -> Result:
    return grade(path, Options(shipped_reference(), course=course), shared_worker())


# ---------------------------------------------------------------- valid files


def test_the_shipped_course_and_an_empty_file_are_all_there_is(tmp_path: Path):
    (tmp_path / "course.toml").touch()
    assert read_course(tmp_path / "course.toml").rubric == load_rubric() == FULL.rubric
    shipped = read_course(KIT / "course.toml")
    assert (shipped.rubric, shipped.out_of, shipped.given_todos) == (FULL.rubric, 100, [])
    assert (shipped.bonus, shipped.due, shipped.visible) == ("apart", None, None)


@pytest.mark.parametrize(
    ("written", "due"),
    [
        ("2027-05-04", "2027-05-04T23:59:59-12:00"),
        ("2027-05-04T18:00:00", "2027-05-04T18:00:00-12:00"),
        ("2027-05-04T18:00:00+02:00", "2027-05-04T18:00:00+02:00"),
    ],
)
def test_a_date_without_a_zone_ends_with_the_last_time_zone(tmp_path: Path, written: str, due: str):
    (tmp_path / "course.toml").write_text(f"due = {written}\n")
    assert read_course(tmp_path / "course.toml").due == datetime.fromisoformat(due)


@settings(max_examples=30)
@given(st.lists(st.integers(1, 9), min_size=1, max_size=12), st.integers(1, 60))
def test_points_are_spread_in_whole_numbers(weights: list[int], points: int):
    shares = spread_points(points, weights)
    assert sum(shares) == points and min(shares) >= 0
    assert 0 not in shares or points < len(weights)
    assert spread_points(sum(weights), weights) == weights
    assert spread_points(7, [9, 1, 1]) == [5, 1, 1]  # by the largest remainder, and none is 0


def test_todos_have_the_order_of_the_rubric_and_points_add_up():
    course = Course(todos=("8c", "1", "B2", "4"), points={"1": 20, "8c": 1})
    todos = {todo.id: todo.max_points for todo in course.rubric.todos}
    usual = {todo.id: todo.max_points for todo in load_rubric().todos}
    assert [*todos.items()] == [("1", 20), ("4", usual["4"]), ("8c", 1), ("B2", usual["B2"])]
    assert course.rubric.max_points == 20 + usual["4"] + 1


def test_the_whole_program_has_the_checks_of_its_programs():
    course = COURSES["without-pymunk"]
    whole = next(todo for todo in course.rubric.todos if todo.id == "whole")
    assert whole.max_points == next(t.max_points for t in load_rubric().todos if t.id == "whole")
    assert {check.module or whole.module for check in whole.checks} == {"mini_engine"}
    few = next(t for t in Course(todos=("6", "whole")).rubric.todos if t.id == "whole")
    assert {need for check in few.checks for need in check.needs} == {"6"}
    stages = next(check for check in few.checks if check.id.startswith("a_step_keeps"))
    assert stages.guard, "its TODOs are given: alone it is worth nothing"


def test_bonus_tasks_are_left_out_or_added():
    assert not any(todo.bonus for todo in Course(bonus="left out").rubric.todos)
    assert [Course(bonus=5).count_bonus(points, 100) for points in (0, 4, 9)] == [0, 4, 5]
    fills = Course(bonus="fill up")
    assert [fills.count_bonus(9, points) for points in (80, 95, 100)] == [9, 5, 0]
    assert fills.most == fills.rubric.max_points == 100
    assert Course().count_bonus(9, 0) == 0


# ---------------------------------------------------------------- mistakes in the file

WRONG = {
    "todos = []": "todos = [] must name TODOs",
    'todos = ["99"]': "there is no TODO '99'",
    "todos = [4]": "todos = [4] must name TODOs in quotes",
    'todos = ["1", "1"]': "1 is listed 2 times",
    'todos = ["B1", "whole"]': "add one of TODO 1 to 8c",
    'todos = ["8a", "whole"]': 'leave "whole" out',
    "points = [1]": "must be a table",
    "points = { 99 = 3 }": "99 is no TODO",
    'todos = ["1"]\npoints = { 4 = 3 }': "4 is not among the todos",
    "points = { 4 = 0 }": "4 = 0 must be a whole number",
    "points = { 4 = true }": "4 = True must be a whole number",
    "[points]\nout_of = 20": "out_of stands below [points]",
    "out_of = 0": "out_of = 0 must be a number above 0",
    'bonus = "some"': "bonus = 'some' must be",
    'due = "tomorrow"': "must be a date without quotes",
    "due = 2027-05-04T12:00:00Z\nvisible = 2027-05-03T12:00:00Z": "is before due",
    "due = 2027-05-04\nvisible = 2027-05-04": "is before due",  # its end, and its beginning
    "late = { per_week = 5 }": "late = {'per_week': 5} must be a table",
    "late = { per_day = 5, mercy = 1 }": "there is no key mercy",
    'late = { per_day = "5" }': 'or a share as "10%"',
    "late = { cap = 500 }": "late: cap = 500 is more than the 100 points that there are: write",
    'late = { per_day = 5, at_most = "150%" }': "at_most = '150%' must be a whole number, 0",
    "late = { grace = 5 }": "must be a table",
    "[late]\nper_day = 5\ndue = 2027-05-04T12:00:00Z": "write it above that line",
    "colour = 1": "there is no key colour; there are title, todos",
    "title = 3": "title = 3 is no title",
    "title =": "is no TOML",
}


@pytest.mark.parametrize("text", WRONG)
def test_a_mistake_in_a_course_is_one_sentence_with_the_file(text: str, tmp_path: Path):
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(WrongCourse) as wrong:
        read_course(path)
    said = str(wrong.value)
    assert str(path) in said and WRONG[text] in said and "\n" not in said


def test_a_course_that_is_not_there_or_no_text_is_refused(tmp_path: Path):
    with pytest.raises(WrongCourse, match="there is no course at"):
        read_course(tmp_path / "none.toml")
    (tmp_path / "bytes.toml").write_bytes(b'title = "\xff"')
    with pytest.raises(WrongCourse, match="is no TOML"):
        read_course(tmp_path / "bytes.toml")


def test_the_course_comes_from_the_environment_as_make_gives_it(tmp_path: Path):
    words = ["grade", str(KIT / "starter"), "--json", str(tmp_path / "r.json")]
    done = run_grader(*words, env={"COURSE_FILE": str(KIT / "tests" / "courses" / f"{CHEAP}.toml")})
    assert done.exit_code == 1
    result = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))
    assert (result["points"], result["max_points"]) == (0, 40)
    assert [todo["id"] for todo in result["todos"]] == ["8a", "8b", "8c"]


# ---------------------------------------------------------------- marks


@pytest.mark.parametrize("course", EACH)
def test_the_solution_earns_all_and_what_is_handed_out_nothing(course: Course, tmp_path: Path):
    write_tree(make_students_tree(KIT, course), tmp_path / "handed-out")
    most = course.rubric.max_points
    full = grade_course(KIT / "solution", course)
    assert (full.points, full.max_points) == (most, most)
    assert full.bonus == sum(todo.max_points for todo in course.rubric.todos if todo.bonus)
    assert [todo.id for todo in full.todos] == [todo.id for todo in course.rubric.todos]
    for tree in (KIT / "starter", tmp_path / "handed-out"):
        nothing = grade_course(tree, course)
        assert (nothing.points, nothing.bonus, nothing.max_points) == (0, 0, most)
        assert {todo.state for todo in nothing.todos} == {"not started"}


@pytest.mark.soak
def test_a_stub_of_what_is_given_takes_nothing_from_the_whole_program(hand_in):
    """The starter of another course, with only this course's TODOs done."""
    course = Course(todos=("6", "whole"))
    most = course.rubric.max_points
    done = {"mini_engine__game_loop_py": (KIT / "solution/mini_engine/game_loop.py").read_text()}
    result = grade_course(hand_in("starter", **done), course)
    assert (result.points, result.max_points) == (most, most)


def test_the_points_of_the_class_follow_from_the_course():
    outcome = Outcome("ann", points=30, max_points=40, todos={"8a": 10, "8b": 20, "B1": 4})
    found = Work("ann", (), handed_in=datetime(2027, 5, 6, tzinfo=UTC))
    due = datetime(2027, 5, 5, tzinfo=UTC)
    course = Course(todos=("8a", "8b", "8c", "B1"), bonus=3, due=due)
    run = Run(Intake([found]), Book(Path("x")), "", load_adjustments(None, course), course)
    run.record("graded", found, outcome)
    assert (run.outcomes[0].final, run.outcomes[0].reasons) == (33, ["bonus: +3", "1 day late: 0"])
    head = make_table(run.outcomes, course).splitlines()[0]
    assert head.endswith("trouble,notes,group,8a,8b,8c,B1")


def test_a_decision_goes_before_the_courses_rules_line_by_line(tmp_path: Path):
    due = datetime(2027, 5, 5, tzinfo=UTC)
    course = Course(due=due, late=Late(10, 50, cap=80))
    assert load_adjustments(None, course).late == Late(10, 50, cap=80, due=due)

    def read_late(text: str) -> Late | None:
        (tmp_path / "adjustments.toml").write_text(text, encoding="utf-8")
        return load_adjustments(tmp_path / "adjustments.toml", course).late

    later = due + timedelta(days=2)
    moved = read_late("[late]\ndue = 2027-05-07T00:00:00Z")
    assert moved == Late(10, 50, cap=80, due=later)
    assert read_late('[late]\nper_day = "5%"\ngrace = 9') == Late("5%", 50, 9, cap=80, due=due)
    assert read_late("[late]\nper_day = 0") == Late(0, 50, cap=80, due=due)
    assert read_late('zone = "Europe/Berlin"') == Late(10, 50, cap=80, due=due)


def test_the_courses_due_date_can_be_extended(tmp_path: Path):
    due = datetime(2027, 5, 5, tzinfo=UTC)
    path = tmp_path / "adjustments.toml"
    decision = "[[adjust]]\nstudent = 'ann'\nreason = 'ill'\ndue = 2027-05-0{}T00:00:00Z\n"
    found = Work("ann", (), handed_in=due + timedelta(days=3))
    path.write_text(decision.format(8), encoding="utf-8")
    course = Course(due=due, late=Late("10%"))
    assert load_adjustments(path, course).decide(found, 80).points == 80
    assert load_adjustments(None, course).decide(found, 80).points == 80 - 24
    with pytest.raises(Stop, match="has a due to extend"):
        load_adjustments(path)
    path.write_text(decision.format(4), encoding="utf-8")
    with pytest.raises(Stop, match="is before the others'"):
        load_adjustments(path, course)


def test_a_bonus_by_hand_counts_as_the_course_counts_a_bonus(tmp_path: Path):
    path = tmp_path / "adjustments.toml"
    path.write_text("[[adjust]]\nstudent = 'ann'\nreason = 'shown'\nbonus = 4\n")
    outcome = Outcome("ann", points=30, max_points=40, todos={"8a": 30, "B1": 2})
    finals = []
    for bonus in ("apart", "left out", 5, 50):
        course = Course(bonus=bonus)
        run = Run(Intake([]), Book(Path("x")), "", load_adjustments(path, course), course)
        run.record("graded", Work("ann", ()), outcome)
        finals.append((run.outcomes[0].final, run.outcomes[0].bonus))
    assert finals == [(30, 6), (30, 6), (35, 6), (36, 6)]


def test_points_by_hand_replace_points_and_bonus(tmp_path: Path):
    path = tmp_path / "adjustments.toml"
    path.write_text("[[adjust]]\nstudent = 'ann'\nreason = 'seen'\npoints = 101\n")
    with pytest.raises(Stop, match="more than the 100"):
        load_adjustments(path)
    course = Course(bonus=3, todos=("8a", "8b", "B1"), points={"8a": 50, "8b": 49})
    run = Run(Intake([]), Book(Path("x")), "", load_adjustments(path, course), course)
    run.record("graded", Work("ann", ()), Outcome("ann", todos={"B1": 9}, max_points=99))
    run.record("not graded", Work("ben", ()), Outcome("ben", "broken"))
    run.record_absent(["ann"])
    assert [(each.mark, each.reasons) for each in run.scale_by_hand(run.outcomes)] == [
        (101, ["seen: set to 101"]),
        (None, []),
        (101, ["seen: set to 101"]),
    ]
    assert [each.max_points for each in run.scale_by_hand(run.outcomes)] == [99, 0, 99]


def test_gradebooks_scale_to_what_the_course_says(tmp_path: Path):
    course = COURSES["without-pymunk"]
    settings = KIT / "handouts" / "instructor" / "marks.toml"
    marking = load_marking(settings, course)
    assert (marking.title, marking.total) == ("Engine and integrators", 20)
    assert load_marking(settings, read_course(KIT / "course.toml")).total == 100
    (tmp_path / "marks.toml").write_text('title = "x"\ntotal = 7\n[shares]\nengine = 1')
    own = load_marking(tmp_path / "marks.toml", course)
    assert (own.title, own.total) == ("x", 7)


def test_gradescope_has_the_courses_score():
    result = Result(1, "ann", 47, 94, 7, [], [])
    told = json.loads(write_gradescope(result, COURSES["without-pymunk"]))
    assert told["score"] == round((47 + 5) * 20 / 94, 2)
    assert told["output"].endswith("11.06 of 20")
    assert json.loads(write_gradescope(result))["score"] == 47


def test_todos_decide_what_is_graded_again_and_the_title_does_not():
    options = Options(course=COURSES[CHEAP])
    assert make_key(options) != make_key(Options())
    named = replace(options, course=Course("x", COURSES[CHEAP].todos, COURSES[CHEAP].points))
    assert make_key(named) == make_key(options)


def test_reasons_of_hidden_checks_are_shown_from_the_courses_day_on():
    day = datetime(2027, 5, 11, tzinfo=UTC)
    course = Course(visible=day)
    todo = course.rubric.todos[0]
    checks = [
        CheckResult(each.id, "x", each.kind, "not yet", 0, each.points, "r", "e", "g", "m")
        for each in todo.checks
    ]
    one = TodoResult("1", "x", "not yet", 0, 16, None, checks)
    result = Result(1, "ann", 0, 16, 0, [], [one])
    assert withhold_reasons(result, course, day) == result == withhold_reasons(result, FULL)
    before = withhold_reasons(result, course, day - timedelta(seconds=1)).todos[0]
    hidden = {each.id for each in todo.checks if each.hidden}
    assert hidden
    for check, full in zip(before.checks, checks, strict=True):
        if check.id in hidden:
            words = ("", "", "shown from 11 May 2027 00:00 (UTC) on", "")
            assert (check.ran, check.expected, check.got, check.meaning) == words
            assert (check.state, check.points) == (full.state, full.points)
        else:
            assert check == full


# ---------------------------------------------------------------- students' files


@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_todos_that_are_left_out_come_solved_with_a_line_that_says_so(course: Course):
    files = make_students_tree(KIT, course)
    texts = {name: files[name].decode() for name in files if name.endswith(".py")}
    left = {region.id for text in texts.values() for region in regions_in(text)}
    assert left == {todo.id for todo in course.rubric.todos if todo.function}
    for todo in course.given_todos:
        (text,) = (text for text in texts.values() if f"what TODO {todo.id} asks for" in text)
        assert not re.search(rf"# (END )?TODO {todo.id}\b", text)
        compile(text, todo.id, "exec")


@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_no_page_names_a_program_that_is_left_out(course: Course):
    pages = make_handouts(KIT / "handouts", course)
    readme = make_students_tree(KIT, course)["README.md"].decode()
    for module in {todo.module for todo in load_rubric().todos} - set(course.modules):
        for page in (pages["lab-sheet.md"], pages.get("bonus.md", ""), readme):
            assert not re.search(rf"(?<!/){module}(\.py|`)", page)
    assert ("bonus.md" in pages) == any(todo.bonus for todo in course.rubric.todos)


TODOS = [todo.id for todo in load_rubric().todos if todo.function]
MEASURED = ("effects.md",)  # is about measurements of the whole lab


@pytest.mark.parametrize(
    "todo", [pytest.param(t, marks=() if t in TODOS[::6] else pytest.mark.soak) for t in TODOS]
)
def test_the_pages_of_a_course_of_one_task_name_no_other(todo: str):
    """With one bonus task there is a page for it, without some of the linked sections."""
    course = Course(todos=tuple(dict.fromkeys(("1", todo))))
    texts = make_handouts(KIT / "handouts", course)
    others = "|".join({each.id for each in course.given_todos if each.bonus})
    for name, text in texts.items():
        for _, page, at in re.findall(r"(?<!!)\[([^\]]+)\]\(([\w-]+\.md)?#([\w-]+)\)", text):
            there = texts[page or name]
            headings = {
                make_anchor(re.sub("[`*]", "", h)) for h in re.findall(r"(?m)^#+ (.*)$", there)
            }
            assert at in headings | set(re.findall(r'id="([\w-]+)"', there)), f"{name}: #{at}"
        if name not in MEASURED:
            assert not re.findall(rf"(?<![\w.#-])(?:{others})(?![\w-])", text), name


@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_the_lab_sheet_has_the_courses_todos_and_points(course: Course):
    sheet = make_handouts(KIT / "handouts", course)["lab-sheet.md"]
    tasks = [todo for todo in course.rubric.main_todos if todo.function]
    rows = re.findall(r"^\| \[(\w+)\]\([^)]*\) \| \d+ \| (\d+) \|", sheet, re.M)
    assert rows == [(todo.id, str(todo.max_points)) for todo in tasks]
    assert re.findall(r"^## TODO (\w+):", sheet, re.M) == [todo.id for todo in tasks]


def test_the_lab_sheet_says_when_and_what_to_hand_in():
    course = Course(todos=("8a", "1"), due=datetime(2027, 5, 4, 23, 59, tzinfo=UTC))
    sheet = make_handouts(KIT / "handouts", course)["lab-sheet.md"]
    assert "**Hand in until 4 May 2027 23:59 (UTC).**" in sheet
    assert "`make hand-in`" in sheet and "`mini_engine` and `integrators.py`," in sheet


def test_hand_in_packs_the_programs_of_the_course(handed_out: Path, tmp_path: Path):
    shutil.copytree(handed_out, tmp_path / "mine")
    (tmp_path / "mine" / "helpers.py").write_text("x = 1\n", encoding="utf-8")
    course = KIT / "tests" / "courses" / f"{CHEAP}.toml"
    words = ("hand-in", tmp_path / "mine", "--no-check", "--out", tmp_path / "c.zip")
    done = run_grader(*words, "--course", course)
    assert done.exit_code == 0, done.output
    with zipfile.ZipFile(tmp_path / "c.zip") as archive:
        assert archive.namelist() == ["helpers.py", "integrators.py", "lab_runtime.py"]
    assert set(PROGRAMS) == {todo.module for todo in load_rubric().todos}


def test_the_sources_of_the_site_follow_the_course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.syspath_prepend(KIT / "handouts")
    sources = importlib.import_module("make_site").sources
    sources(tmp_path, False, COURSES[CHEAP])
    hints = (tmp_path / "docs" / "hints.md").read_text(encoding="utf-8")
    assert re.findall(r"^## TODO (\w+):", hints, re.M) == ["8a", "8b", "8c"]
    menu = re.findall(r": (\S+\.md)$", (tmp_path / "mkdocs.yml").read_text("utf-8"), re.M)
    assert "lab-sheet.md" in menu and "bonus.md" not in menu
    assert {path.name for path in (tmp_path / "docs").glob("*.md")} == set(menu)


def test_the_pages_of_the_full_course_are_as_they_lie_there():
    for name, page in make_handouts(KIT / "handouts", FULL).items():
        text = (KIT / "handouts" / name).read_text(encoding="utf-8")
        plain = re.sub(
            r"<!--% else %-->.*?(?=<!--% endif)|<!--% elif.*?(?=<!--% endif)", "", text, flags=re.S
        )
        plain = re.sub(r"^<!--%.*%-->\n|<!--%.*?%-->|<!--=.*?=-->", "", plain, flags=re.M)
        assert page.split() == plain.split(), name
        assert "<!--%" not in page and "<!--=" not in page


def test_notebooks_ask_what_the_course_has():
    folder = KIT / "solution" / "notebooks"
    every = make_notebooks(folder, FULL)
    assert every == {path.name: path.read_bytes() for path in folder.glob("*.ipynb")}
    engine = make_notebooks(folder, COURSES["engine"])
    assert "integrators.ipynb" not in engine
    cells = json.loads(engine["engine.ipynb"])["cells"]
    assert [cell["id"] for cell in cells] == ["title", *(f"todo-{n}" for n in range(1, 7))]
    few = make_notebooks(folder, COURSES[CHEAP])
    assert {"integrators.ipynb", "accuracy.ipynb"} <= few.keys()
    assert b'"quiz-3"' in few["quiz.ipynb"] and b'"quiz-5"' not in few["quiz.ipynb"]


def test_a_notebook_asks_for_no_integrator_that_is_given_and_has_it_solved():
    course = Course(todos=("8c",))
    for tree in ("solution", "starter"):
        (cells,) = [
            {cell["id"]: cell for cell in json.loads(content)["cells"]}
            for name, content in make_notebooks(KIT / tree / "notebooks", course).items()
            if name == "integrators.ipynb"
        ]
        assert "about-8a" not in cells and "one-step-8b" not in cells and "swing-8a" not in cells
        graded = [cell for cell in cells.values() if has_task(cell) and is_graded(cell)]
        assert {cell["id"] for cell in graded} == {"one-step-8c", "swing-8c"}
        text = "".join(cells["answer-8b"]["source"])
        assert text.startswith("# Given in this course.\ndef velocity_verlet(")
        assert "a_end = accel(x)" in text and "SOLUTION" not in text
        assert not has_task(cells["answer-8b"]) and has_task(cells["answer-8c"])
    assert "accuracy.ipynb" not in make_notebooks(
        KIT / "solution" / "notebooks", Course(todos=("2",))
    )


def is_graded(cell: dict[str, Any]) -> bool:
    return bool(cell["metadata"]["nbgrader"]["grade"])


def test_an_nbgrader_course_holds_what_the_course_has(tmp_path: Path):
    course = COURSES["engine"]
    files = make_course(tmp_path, taken=course)
    assert "engine.ipynb" in files and "integrators.ipynb" not in files
    shares = load_marking(tmp_path / "marks.toml", course).shares
    assert {f"{name}.ipynb" for name in shares} == {n for n in files if n.endswith(".ipynb")}
    text = (tmp_path / "source" / "physics-engine" / "pymunk_scene.py").read_text(encoding="utf-8")
    assert "what TODO 7a asks for elsewhere is done here" in text


def test_the_gradescope_zip_takes_the_course_along(tmp_path: Path):
    path = tmp_path / "course.zip"
    write_autograder(path, Settings(course=COURSES["without-pymunk"]))
    with zipfile.ZipFile(path) as archive:
        settings = msgspec.json.decode(archive.read("settings.json"), type=Settings)
    assert settings.course == COURSES["without-pymunk"]


# ---------------------------------------------------------------- verify and release


def test_verify_leaves_out_what_the_course_leaves_out():
    engine = [*list_members(COURSES["engine"])]
    assert {"4-clamps-the-increment", "starts-threads"} <= {each.name for each in engine}
    wrong = {each.name for each in engine if each.kind == "wrong"}
    assert {name.partition("-")[0] for name in wrong} == set("123456")
    breaches = [each for each in bank() if each.breach]
    kept = {each.name for each in breaches if each.belongs_to(COURSES["without-pymunk"])}
    assert "whole-one-pass" in kept and "whole-pymunk-bouncy-balls" not in kept


def test_a_member_is_graded_by_the_course():
    course = COURSES[CHEAP]
    every = list_members(course.as_rated)
    verdict = grade_member(next(each for each in every if each.name == "8a-position-first"))
    assert verdict.complaint == "" and verdict.result is not None
    assert {todo.id for todo in verdict.result.todos} <= set(course.todos or ())


@pytest.mark.soak
@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_all_of_a_courses_bank_is_as_it_must(course: Course):
    assert verify(0, "", Console(file=io.StringIO()), course=course).sound


@pytest.mark.soak
@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_the_release_of_a_course_builds(course: Course, tmp_path: Path):
    """The release itself proves that the students' copy gives the solution full marks and the tree
    0."""
    wrong = list(build_wrong_members(tmp_path / "wrong", course))[:3]
    built = build(tmp_path / "work", wrong, course)
    assert [path.suffix for path in sorted(built.iterdir())][-1] == ".zip"
    sheet = (tmp_path / "work" / "physics-engine" / "handouts" / "lab-sheet.html").read_text(
        "utf-8"
    )
    for todo in course.given_todos:
        assert not re.search(rf"TODO[= ]{todo.id}\b", sheet)
