"""Name the line in which one small change corrects a TODO, in a student's own checks."""

import difflib
import re
from pathlib import Path

import pytest
from conftest import KIT
from whole_bank import bank

from grader.bank.members import Member
from grader.bank.verify import shared_worker
from grader.judge.explain.one_change import KINDS, Mend, find_mend, make_variants, put_into
from grader.judge.grade import grade
from grader.judge.result import TodoResult
from grader.judge.task import Options
from grader.source.regions import read_source, regions_in

FEW = ("7b-largest-never-turn", "2-inertia-kept-on-the-body", "5-kept-by-dt")
ELSEWHERE = "B4-one-a-step"  # can be corrected in another line as well
LOOP = """
def run(left, step):
    done = 0
    # TODO 1: run whole steps
    while left >= step:
        left -= step
        done += 1
    # END TODO 1
    return done
"""


def grade_todo(folder: Path, todo: str, trusted: bool = True) -> TodoResult:
    options = Options(only=frozenset({todo}), trusted=trusted, mends=True)
    (result,) = grade(folder, options, shared_worker()).todos
    return result


def list_changed(ours: str, right: str) -> set[int]:
    """Return the lines of a text that differ from the right one."""
    texts = [text.split("\n") for text in (ours, right)]
    return {
        line
        for tag, i, j, _, _ in difflib.SequenceMatcher(None, *texts, False).get_opcodes()
        if tag != "equal"
        for line in range(i + (i < j), max(i, j) + 1 + (i == j))
    }


def wrong_members() -> list[Member]:
    members = (each for each in bank() if each.kind == "wrong" and each.form == "package")
    return [each for each in members if len(each.todos) == 1 and "whole" not in each.todos]


@pytest.mark.parametrize(
    "member",
    [
        pytest.param(each, id=each.name, marks=() if each.name in FEW else pytest.mark.soak)
        for each in wrong_members()
    ],
)
def test_a_named_line_is_one_that_is_wrong(member: Member, tmp_path: Path):
    """Students see it in their own checks alone; they see where, and not what. Marks stay."""
    tree = tmp_path / "tree"
    member.build(tree)
    (todo,) = member.todos
    own = grade_todo(tree, todo).checks
    named = [check for check in own if "look there" in check.meaning and check.where]
    if member.name in FEW:
        assert named and named == [check for check in own if check.failed]
        graded = grade_todo(tree, todo, trusted=False).checks
        assert [check.points for check in own] == [check.points for check in graded]
        assert not any("look there" in check.meaning for check in graded)
    for check in named[:1]:
        texts = [read_source(root / check.where.file) for root in (tree, KIT / "solution")]
        line = check.where.line
        assert line in list_changed(*texts) or member.name == ELSEWHERE
        assert re.search(rf"lines? {line}\b.*, this passes: look there\.", check.meaning)
        assert texts[0].split("\n")[line - 1].strip() not in check.meaning


# ---------------------------------------------------------------- the changes


def test_changes_leave_all_else_as_it_is():
    for name in ("joints.py", "game_loop.py"):
        text = read_source(KIT / "solution" / "mini_engine" / name)
        for region in regions_in(text):
            variants = list(make_variants(region, frozenset()))
            assert {each.how for each in variants} <= {how for how, _ in KINDS}
            for each in variants:
                changed = put_into(text, region, each.code)
                compile(changed, name, "exec")
                assert (
                    changed.split("\n")[: region.start + 1] == text.split("\n")[: region.start + 1]
                )
                assert all(1 <= line <= len(region.lines) for line in each.lines)


def try_changes(text: str, is_right: str = "") -> tuple[Mend | None, list[str]]:
    """Return the mend of a text with all these parts, and the texts that were tried."""
    asked: list[str] = []

    def passes(changed: str) -> bool:
        asked.append(changed)
        return bool(is_right) and all(part in changed for part in is_right.split(" & "))

    return find_mend(text, ("run.py", "1", "run"), passes, lambda: True), asked


def test_the_end_of_a_loop_is_not_changed():
    mend, asked = try_changes(LOOP)
    assert mend is None and asked
    assert all("while left >= step:\n        left -= step" in text for text in asked)


@pytest.mark.parametrize(
    ("code", "is_right", "lines"),
    [
        ("done = done + step * 2 / 3", "done = (done + step) * 2 / 3", (7,)),
        (
            "more = step * (left + done / 6)\n        most = done * (step + left / 3)",
            "(left + done) / 6 & (step + left) / 3",
            (7, 8),
        ),
    ],
)
def test_missing_brackets_are_found_in_one_line_and_in_two(
    code: str, is_right: str, lines: tuple[int, ...]
):
    mend, _ = try_changes(LOOP.replace("done += 1", code), is_right)
    assert mend == Mend("run.py", lines, "With brackets elsewhere in")
    assert mend.in_words.startswith("With brackets elsewhere in line 7")


def test_texts_with_values_in_them_stay_python():
    text = LOOP.replace("done += 1", """done += len(f"{left - step:{done}d} of {step!r}")""")
    mend, asked = try_changes(text)
    assert mend is None and asked
    for changed in asked:
        compile(changed, "run.py", "exec")


@pytest.mark.parametrize("code", ["done = " + "+".join(["done"] * 5000), "done += (1"])
def test_no_change_is_tried_in_endless_sums_and_where_python_refuses(code: str):
    assert try_changes(LOOP.replace("done += 1", code)) == (None, [])


def test_no_change_is_tried_without_time():
    about = ("run.py", "1", "run")
    assert find_mend(LOOP, about, lambda text: pytest.fail(text), lambda: False) is None
