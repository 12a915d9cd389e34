"""Test that any choice of TODOs can be released with all files that its checks need."""

import ast
import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from command_line import run_grader

from grader.judge.course import Course, faults_between
from grader.judge.rubric import drop_hidden, load_rubric
from grader.judge.task import KIT
from grader.release import build as releases
from grader.release import leaks
from grader.release.build import Refused, prove_cut
from grader.release.handed_out import make_students_tree
from grader.release.handouts import make_handouts
from grader.release.leaks import Secret, find_given_answers, find_hidden_secrets, read_texts
from grader.release.notebooks import make_notebooks
from grader.release.students_copy import cut_checks, cut_course_files
from grader.source.cut import list_defined, list_uses


def draw_courses(count: int, seed: int = 1) -> Iterator[Course]:
    """Draw valid courses of any TODOs, with the bonus in any form."""
    draw = random.Random(seed)
    ids = [todo.id for todo in load_rubric().todos]
    while count:
        todos = tuple(draw.sample(ids, draw.randint(1, len(ids))))
        course = Course(todos=todos, bonus=draw.choice(["apart", "left out", 3]))
        if not any(faults_between(course)):
            count -= 1
            yield course


def find_missing(texts: dict[str, str]) -> list[str]:
    """Return the missing names that the files of checks import from each other."""
    modules = {f"grader.checks.{name[:-3].replace('/', '.')}": name for name in texts}
    every = [*modules, *(f"grader.checks.{name}" for name in ("exact", "pacing", "todo_7.checks"))]
    here = {
        (module, defined_name)
        for module, name in modules.items()
        for node in ast.parse(texts[name]).body
        for defined_name in list_defined(node)
    } | {(module, "") for module in modules}
    return [
        f"{name} takes {part or 'all'} of {module}"
        for name, text in texts.items()
        for module, part in list_uses(text, every)
        if (module, part) not in here
    ]


@pytest.fixture
def known_secrets(secrets: list[Secret], monkeypatch: pytest.MonkeyPatch) -> None:
    """Find the secrets of the full course once."""
    monkeypatch.setattr(leaks, "find_secrets", lambda kit: secrets)


@pytest.mark.parametrize("todos", [("1", "B4"), ("4", "B2"), ("3", "7c", "B2")], ids=",".join)
def test_a_bonus_task_keeps_what_it_takes_from_another_file(todos):
    texts = cut_checks(drop_hidden(Course(todos=todos).rubric))
    assert find_missing(texts) == []
    assert ("todo_7/checks.py" in texts) == ("B4" in todos or "7c" in todos)


def test_what_drawn_courses_import_is_there():
    for course in draw_courses(3):
        assert find_missing(cut_checks(drop_hidden(course.rubric))) == [], course


def test_what_only_other_todos_need_is_no_secret():
    """A line of a helper for TODO 6 is also in the checks of B1, which this course has."""
    secrets = list(find_hidden_secrets(Course(todos=("4", "5", "B1", "B6")).rubric))
    assert secrets and not any("standing_still" in each.what for each in secrets)


def test_the_copy_of_an_odd_course_grades(tmp_path: Path, monkeypatch):
    course = Course(todos=("1", "B4"))
    prove_cut(course, tmp_path)
    (note,) = tmp_path.iterdir()
    monkeypatch.setattr(releases, "prove", lambda *_: pytest.fail("it was proven"))
    prove_cut(course, tmp_path)
    assert list(tmp_path.iterdir()) == [note]


@pytest.mark.usefixtures("known_secrets")
def test_a_course_that_cannot_be_released_is_a_problem_of_it(monkeypatch, tmp_path: Path):
    def refuse(course: Course) -> None:
        raise Refused(f"{len(course.rubric.todos)} TODO gives the starter 1 / 2")

    monkeypatch.setattr(releases, "prove_cut", refuse)
    (tmp_path / "course.toml").write_text('todos = ["8c"]', encoding="utf-8")
    done = run_grader("course-check", "--course", str(tmp_path / "course.toml"))
    assert done.exit_code == 1
    assert "this course cannot be released: 1 TODO gives the starter 1 / 2" in done.output


ODD = ("8c", "3,7c,B2", "8a,7d")
ODDER = ("1,B4", "7b", "6,whole", "2", "4,5,B1,B6", "7a,8b,whole", "5,B3")


@pytest.mark.parametrize(
    "names", [*ODD, *(pytest.param(each, marks=pytest.mark.soak) for each in ODDER)]
)
def test_nothing_asks_for_what_a_course_leaves_out(names: str):
    """Exceptions are pages that say a TODO is given, and the program of effects."""
    course = Course(todos=tuple(names.split(",")))
    left = [todo.id for todo in course.given_todos]
    about = re.compile(
        rf"(?<!what )(?:TODOs? |TODO=|--todo |grader (?:check|hint) )({'|'.join(left)})\b"
    )
    for file, text in write_artefacts(course):
        found = [line for line in text.splitlines() if about.search(line)]
        assert not found, (file, found)


def write_artefacts(course: Course) -> Iterator[tuple[str, str]]:
    """Yield all texts of a course for students and nbgrader, except the checks."""
    files = make_students_tree(KIT, course)
    files |= make_notebooks(KIT / "solution" / "notebooks", course)
    for name, content in files.items():
        yield from read_texts(name, content)
    yield from make_handouts(KIT / "handouts", course).items()
    yield from cut_course_files(course).items()


@pytest.mark.usefixtures("known_secrets")
def test_a_given_todo_that_answers_an_asked_one_is_a_problem():
    (words,) = find_given_answers(KIT, Course(todos=("7d",)))
    assert words.startswith("TODO 6 is given, and has a line that TODO 7d asks for, accumulator +=")


@pytest.mark.soak
def test_an_asked_todo_that_answers_another_is_none():
    assert not list(find_given_answers(KIT, Course(todos=("6", "7d"))))


@pytest.mark.soak
@pytest.mark.parametrize("number", range(200))
def test_each_of_many_courses_can_be_released(number: int, tmp_path: Path):
    (course,) = draw_courses(1, number)
    assert find_missing(cut_checks(drop_hidden(course.rubric))) == []
    prove_cut(course, tmp_path)
