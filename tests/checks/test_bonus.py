"""Test that bonus tasks are graded like all others, and count in no sum."""

import base64
import io
import json
import shutil
from pathlib import Path

import msgspec
import pytest
from mixed_trees import mix_trees
from rich.console import Console

from grader.bank.verify import shared_worker
from grader.classroom.book import make_outcome
from grader.classroom.dashboard import Entry, count_rates
from grader.classroom.grading import tabulate_class, tabulate_rates
from grader.judge.course import FULL
from grader.judge.grade import grade
from grader.judge.result import Result
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wording import total
from grader.release.notebooks import make_engine_notebook
from grader.report.files import as_json
from grader.report.sinks.classroom50 import NEEDED, write_classroom50
from grader.report.sinks.github import write_annotations, write_outputs
from grader.report.sinks.gradescope import write_gradescope
from grader.report.sinks.junit import write_junit
from grader.report.sinks.markdown import write_markdown
from grader.report.terminal import Printer, show_next

WORTH = {todo.id: todo.max_points for todo in load_rubric().todos if todo.bonus}
BONUS = frozenset(WORTH)
RUNNER = dict.fromkeys(NEEDED.values(), "x")  # what Classroom 50 passes for a submission


def grade_tree(folder: Path, only: frozenset[str] = frozenset()) -> Result:
    return grade(folder, Options(shipped_reference(), only=only), shared_worker())


@pytest.fixture(scope="module")
def without_bonus(solution: Result, starter: Result) -> Result:
    """Return full marks with no bonus task started, as the bank's lesson-as-printed gets."""
    todos = [
        mine if mine.bonus else right
        for mine, right in zip(starter.todos, solution.todos, strict=True)
    ]
    return msgspec.structs.replace(solution, bonus=0, todos=todos)


@pytest.fixture(scope="module")
def with_bonus(without_bonus: Result) -> Result:
    """Return full marks, half of the first bonus task and all of the second."""
    first, second = (todo for todo in without_bonus.todos if todo.id in ("B1", "B2"))
    half = [msgspec.structs.replace(each, state="not yet", got="42") for each in first.checks]
    half[0] = msgspec.structs.replace(half[0], state="passed", points=half[0].max_points)
    begun = msgspec.structs.replace(first, state="not yet", points=half[0].points, checks=half)
    passed = [
        msgspec.structs.replace(each, state="passed", points=each.max_points)
        for each in second.checks
    ]
    done = msgspec.structs.replace(second, state="passed", points=second.max_points, checks=passed)
    new = {"B1": begun, "B2": done}
    todos = [new.get(todo.id, todo) for todo in without_bonus.todos]
    earned = begun.points + done.points
    return msgspec.structs.replace(without_bonus, bonus=earned, todos=todos)


# ---------------------------------------------------------------- marks


def test_the_rubric_counts_the_bonus_apart():
    assert load_rubric().max_points == 100 and sum(WORTH.values()) > 0


@pytest.mark.parametrize(
    "some", [frozenset({"B2", "B5"}), pytest.param(BONUS, marks=pytest.mark.soak)], ids=len
)
def test_bonus_tasks_earn_their_points_in_an_unfinished_engine(
    tmp_path: Path, some: frozenset[str]
):
    """The reference replaces all unfinished TODOs."""
    result = grade_tree(mix_trees(tmp_path / "ben", "starter", "solution", BONUS), some)
    worth = {todo: points for todo, points in WORTH.items() if todo in some}
    assert {todo.id: todo.points for todo in result.todos} == worth
    assert (result.points, result.max_points, result.bonus) == (0, 0, sum(worth.values()))


def test_a_picture_that_changes_by_itself_says_nothing_of_the_drawing(tmp_path: Path):
    """A counter on the screen also changes in every frame."""
    folder = mix_trees(tmp_path / "cy", "solution", "starter", frozenset({"B5"}))
    window, loop = (folder / "mini_engine" / each for each in ("bonus/window.py", "game_loop.py"))
    stub = "    # TODO B5: draw between steps\n"
    began = window.read_text().replace(stub, f"{stub}    share = 1.0\n")
    window.write_text(began)
    cleared = "self.screen.fill(BACKGROUND)\n"
    dot = "        self.dot = getattr(self, 'dot', 0) + 1\n"
    dot += "        self.screen.set_at((self.dot % 900, 300), INK)\n"
    loop.write_text(loop.read_text().replace(cleared, cleared + dot))
    (todo,) = grade_tree(folder, frozenset({"B5"})).todos
    assert [check.state for check in todo.checks] == ["not yet", "waiting"] and not todo.points


def test_a_program_older_than_the_bonus_tasks_has_not_started_them(tmp_path: Path):
    folder = tmp_path / "old"
    folder.mkdir()
    single = KIT / "tests" / "bank" / "single_file" / "mini_engine.py"
    shutil.copyfile(single, folder / "mini_engine.py")
    result = grade_tree(folder, BONUS)
    assert {todo.state for todo in result.todos} == {"not started"}


def test_only_graded_todos_decide_whether_a_result_is_complete(with_bonus: Result):
    first, second = ([t for t in with_bonus.todos if t.id == name] for name in ("B1", "B2"))
    assert with_bonus.has_full_marks
    assert not msgspec.structs.replace(with_bonus, todos=first).has_full_marks
    assert msgspec.structs.replace(with_bonus, todos=second).has_full_marks


# ---------------------------------------------------------------- reports and sums


def print_result(result: Result) -> str:
    console = Console(width=80, record=True, file=io.StringIO())
    Printer(console).print(result)
    show_next(result, console)
    return console.export_text()


def test_the_terminal_shows_the_bonus_apart(without_bonus: Result, with_bonus: Result):
    assert total(without_bonus) == "100 / 100" and "B1" not in print_result(without_bonus)
    text = print_result(with_bonus)
    half, whole = with_bonus.bonus - WORTH["B2"], WORTH["B2"]
    assert total(with_bonus) == f"100 / 100  and {half + whole} bonus"
    assert f"{half} / {WORTH['B1']} bonus" in text and f"{whole} / {whole} bonus" in text
    assert "B3" not in text
    assert "Next" not in text and max(map(len, text.splitlines())) <= 80


def test_a_check_of_bonus_tasks_names_the_next_one(with_bonus: Result):
    only = [todo for todo in with_bonus.todos if todo.id in ("B1", "B3")]
    text = print_result(
        msgspec.structs.replace(with_bonus, points=0, max_points=0, bonus=1, todos=only)
    )
    assert "Next: TODO B1" in text and "NOT STARTED B3" in text and ": 1 bonus" in text


def test_every_form_adds_up_without_the_bonus(with_bonus: Result):
    for form in (write_classroom50(with_bonus, RUNNER), write_gradescope(with_bonus)):
        made = json.loads(form)
        assert made["score"] == 100
        assert sum(test.get("score", 0) for test in made["tests"]) == 100
        assert sum(test.get("max-score", test.get("max_score", 0)) for test in made["tests"]) == 100
    encoded = write_outputs(with_bonus).partition("result=")[2]
    reported = json.loads(base64.b64decode(encoded))
    assert reported["status"] == "pass" and reported["max_score"] == 100
    assert sum(test["score"] for test in reported["tests"]) == 100
    annotations = write_annotations(with_bonus)
    assert annotations.startswith("::warning ") and "::error" not in annotations


def test_a_bonus_task_that_was_not_begun_is_in_no_report(without_bonus: Result):
    forms = (
        write_gradescope(without_bonus),
        write_junit(without_bonus),
        write_markdown(without_bonus).encode(),
    )
    assert not [form for form in forms if b"TODO B" in form or b"| B" in form]


def test_the_class_book_counts_no_bonus(without_bonus: Result, with_bonus: Result):
    outcomes = [make_outcome("ann", as_json(each), 1.0, "") for each in (without_bonus, with_bonus)]
    assert [(each.points, each.left) for each in outcomes] == [(100, [])] * 2
    assert not [
        cell
        for cell in tabulate_rates(outcomes, FULL).columns[0].cells
        if str(cell).startswith("B")
    ]
    starter = msgspec.structs.replace(
        outcomes[0], left=[todo for todo in outcomes[0].todos if todo not in BONUS]
    )
    assert list(tabulate_class([starter]).columns[2].cells) == ["all"]


def test_a_dashboard_lists_the_bonus_tasks_that_somebody_began(
    without_bonus: Result, with_bonus: Result
):
    entries = [
        Entry(make_outcome(name, as_json(each), 1.0, ""), each)
        for name, each in (("ann", without_bonus), ("ben", with_bonus))
    ]
    listed = [
        [rate.id for rate in count_rates(some) if rate.id in BONUS]
        for some in (entries[:1], entries)
    ]
    assert listed == [[], ["B1", "B2"]]


def test_the_notebook_with_the_marks_is_worth_100():
    cells = make_engine_notebook(load_rubric())["cells"]
    points = [cell["metadata"].get("nbgrader", {}).get("points", 0) for cell in cells]
    assert sum(points) == 100
