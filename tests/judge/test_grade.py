"""Grade one submission: marks and reasons, the same each time."""

import json
import re
import shutil
import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest
from mixed_trees import mix_trees
from whole_bank import bank

from grader.bank.members import Entry, Member
from grader.bank.mutants import regions_of
from grader.bank.verify import shared_worker
from grader.judge import running
from grader.judge.grade import grade
from grader.judge.result import Result
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT, Options, shipped_reference
from grader.report.files import as_json
from grader.source.regions import python_files, read_source, regions_in

WITH_REFERENCE = Options(shipped_reference())
SOAK = pytest.mark.soak
Graded = Callable[[tuple[str, ...]], Result]
ONLY = {todo: Options(shipped_reference(), only=frozenset({todo})) for todo in "15"}


def grade_tree(submission: Path, options: Options = WITH_REFERENCE) -> Result:
    """Grade by a worker that all tests share, which saves half a second."""
    return grade(submission, options, shared_worker())


def state(result: Result, todo: str) -> str:
    return next(each.state for each in result.todos if each.id == todo)


def points(result: Result, todo: str) -> int:
    return next(each.points for each in result.todos if each.id == todo)


# ---------------------------------------------------------------- marks


def test_the_solution_earns_everything(solution: Result, solution_graded: Graded):
    expected, marks = (
        [(check.id, check.state, check.points) for todo in each.todos for check in todo.checks]
        for each in (solution, solution_graded(()))
    )
    assert marks == expected
    bonus = sum(todo.max_points for todo in load_rubric().todos if todo.bonus)
    assert (solution.points, solution.max_points, solution.bonus) == (100, 100, bonus)
    assert {todo.state for todo in solution.todos} == {"passed"}


def test_the_starter_earns_nothing(starter: Result):
    assert (starter.points, starter.bonus) == (0, 0)
    assert {check.points for todo in starter.todos for check in todo.checks} == {0}
    assert {todo.state for todo in starter.todos} == {"not started"}


@pytest.mark.parametrize("todos", [("8b",), pytest.param((), marks=SOAK)])
def test_the_solution_needs_no_reference(solution_graded: Graded, todos: tuple[str, ...]):
    alone = grade_tree(KIT / "solution", Options(reference=None, only=frozenset(todos))).todos
    assert alone == solution_graded(todos).todos


def test_every_region_is_in_the_rubric_once_and_bonus_tasks_come_last():
    todos = load_rubric().todos
    assert sorted(todo.id for todo in todos if todo.function) == sorted(regions_of("solution"))
    assert [todo.bonus for todo in todos] == sorted(todo.bonus for todo in todos)


def test_every_check_has_a_title_a_student_can_read(solution: Result):
    titles = [check.title for todo in solution.todos for check in todo.checks]
    assert all(10 < len(title) <= 80 and not re.search("[a-z]_[a-z]", title) for title in titles), (
        titles
    )


# ---------------------------------------------------------------- always the same


@pytest.mark.soak
@pytest.mark.parametrize("todos", [("8b",), pytest.param((), marks=SOAK)])
def test_the_portable_worker_gives_the_same_json(solution_graded: Graded, todos: tuple[str, ...]):
    options = Options(shipped_reference(), only=frozenset(todos), spawn=True)
    assert grade(KIT / "solution", options).todos == solution_graded(todos).todos


@pytest.mark.parametrize(
    "chosen",
    [
        ("8b-half-is-missing-in-x",),
        pytest.param(("3-only-pulls", "8b-half-is-missing-in-x", "8-helpers-inside"), marks=SOAK),
        pytest.param(("1-inside-normalises-zero", "3-only-pulls"), marks=SOAK),
    ],
)
def test_earlier_grades_change_nothing(tmp_path: Path, chosen: tuple[str, ...]):
    """A property asks what others have passed, without drawing it anew."""
    members = [each for each in bank() if each.name in chosen and each.form == "package"]
    assert len(members) == len(chosen)
    results: list[list[bytes]] = [[], []]
    running.passed_before.clear()
    for again in results:
        for member in members:
            only = Options(shipped_reference(), only=member.todos)
            folder = tmp_path / member.name
            if not folder.exists():
                member.build(folder)
            again.append(as_json(grade_tree(folder, only)))
        touched = frozenset().union(*(member.todos for member in members))
        options = Options(shipped_reference(), only=touched)
        assert grade_tree(KIT / "solution", options).has_full_marks
        assert running.passed_before
    assert results[0] == results[1]


# ---------------------------------------------------------------- what is handed in


@pytest.mark.parametrize(
    ("reference", "todos"),
    [
        (shipped_reference(), ["5"]),
        pytest.param(
            shipped_reference(), [*"12346", "7a", "7b", "7c", "7d", "8a", "8b", "8c"], marks=SOAK
        ),
        pytest.param(None, [*"123456", "7a", "7b", "7c", "7d", "8a", "8b", "8c"], marks=SOAK),
    ],
    ids=["with the reference", "with it, the others", "without"],
)
def test_one_finished_todo_earns_its_own_points(
    tmp_path: Path, reference: Path | None, todos: list[str]
):
    """Each TODO of the solution, put alone into the starter, earns all of its points.

    In the whole it earns what needs no other TODO, and nothing in any other TODO.
    """
    for todo in todos:
        folder = mix_trees(tmp_path / f"only-{todo}", "starter", "solution", {todo})
        result = grade_tree(folder, Options(reference))
        assert {each.id for each in result.todos if each.points} - {"whole"} == {todo}
        assert state(result, todo) == "passed"
        (whole,) = [each for each in result.todos if each.id == "whole"]
        assert {check.id for check in whole.checks if check.points} == earned_in_the_whole(todo)


def earned_in_the_whole(todo: str) -> set[str]:
    """Return the checks of the whole that need no other TODO; guards alone earn nothing."""
    (whole,) = [each for each in load_rubric().todos if each.id == "whole"]
    free = [check for check in whole.checks if set(check.needs) <= {todo}]
    return set() if all(check.guard for check in free) else {check.id for check in free}


@pytest.mark.parametrize(
    ("todos", "asked"), [("5", "35"), pytest.param("123456", "123456", marks=SOAK)]
)
def test_an_unfinished_todo_of_a_single_file_costs_its_own_points(
    tmp_path: Path, todos: str, asked: str
):
    engine = Options(shipped_reference(), only=frozenset(asked))
    unfinished = tmp_path / "unfinished.py"
    for id, stub in [pair for todo in todos for pair in stubs_of(todo)]:
        text = f"# TODO {id}: to be done\n{stub}\n# END TODO {id}\n"
        unfinished.write_text(text, encoding="utf-8")
        folder = tmp_path / f"all-but-{id}"
        shutil.rmtree(folder, ignore_errors=True)
        Member("wrong", id, "package", Entry(transform="one-file"), unfinished).build(folder)
        result = grade_tree(folder, engine)
        assert {each.id for each in result.todos if each.state != "passed"} == {id}
        assert points(result, id) == 0


def stubs_of(todo: str) -> list[tuple[str, str]]:
    """Return a TODO with code that raises, and with the starter's stub."""
    (lines,) = (
        region.lines
        for path in python_files(KIT / "starter")
        for region in regions_in(read_source(path))
        if region.id == todo
    )
    return [(todo, "raise NotImplementedError"), (todo, textwrap.dedent("\n".join(lines)))]


def test_without_a_reference_the_whole_waits(hand_in):
    region = "    # TODO 5: damp by a rate per second\n    pass\n    # END TODO 5\n"
    result = grade_tree(hand_in("starter", extra_py=region), Options(None))
    assert state(result, "whole") in ("waiting", "not started")


# ---------------------------------------------------------------- the words of a failed check


def test_a_failed_check_says_what_ran_what_was_expected_and_what_came_out(hand_in):
    source = (KIT / "solution" / "mini_engine" / "world.py").read_text(encoding="utf-8")
    wrong = source.replace("math.exp(-self.linear_damping * dt)", "1 - 0.01")
    wrong = wrong.replace("math.exp(-self.angular_damping * dt)", "1 - 0.01")
    assert wrong.count("1 - 0.01") == 2
    result = grade_tree(hand_in("solution", mini_engine__world_py=wrong), ONLY["5"])
    (todo,) = [each for each in result.todos if each.id == "5"]
    check = todo.checks[0]
    assert check.ran == "one ball, no gravity, linear_damping = 0.5, for one second"
    assert check.expected == "60.65% of its speed left at every step size (e^-0.5)"
    assert check.got == "54.72% at 1/60 s, 29.94% at 1/120 s, 8.96% at 1/240 s"
    assert todo.misconception == "the-same-share-every-step"
    assert check.meaning.startswith("Every step loses 1 %")
    assert check.where is not None and check.where.file == "mini_engine/world.py"


# ---------------------------------------------------------------- the contract's JSON


def test_the_json_has_the_form_of_the_contract(solution: Result):
    document = json.loads(as_json(solution))
    assert list(document) == [
        *("schema", "submission", "points", "max_points", "bonus", "isolation", "todos")
    ]
    assert document["schema"] == 1 and document["submission"] == "solution"
    todo = document["todos"][0]
    assert list(todo) == [
        *("id", "title", "state", "points", "max_points", "misconception", "checks")
    ]
    assert list(todo["checks"][0]) == [
        *("id", "title", "kind", "state", "points", "max_points"),
        *("ran", "expected", "got", "meaning", "where", "replay"),
    ]
