"""Name the line in which one small change corrects a TODO, in a student's own checks."""

import difflib
from pathlib import Path

import pytest
from conftest import KIT, HandIn
from whole_bank import bank

from grader.bank.members import Member
from grader.bank.verify import shared_worker
from grader.judge.explain.one_change import KINDS, Mend, find_mend, make_variants, put_into
from grader.judge.grade import grade
from grader.judge.result import TodoResult
from grader.judge.task import Options
from grader.source.regions import read_source, regions_in

SOLVER = "mini_engine/solver.py"
SPIN = "total += cross(rb, axis) ** 2 * b.inv_inertia"
SLIP = "total += cross(rb, axis) ** 2 * (a.inv_inertia if a.omega > b.omega else b.inv_inertia)"
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


def checked(folder: Path, todo: str, trusted: bool = True) -> TodoResult:
    options = Options(only=frozenset({todo}), trusted=trusted, mends=True)
    (result,) = grade(folder, options, shared_worker()).todos
    return result


def slip(hand_in: HandIn) -> Path:
    """Hand in the solution with the other body's inertia where that body spins faster."""
    folder = hand_in("solution")
    path = folder / SOLVER
    path.write_text(path.read_text("utf-8").replace(SPIN, SLIP), encoding="utf-8")
    return folder


def test_the_line_is_told_to_who_checks_their_own_work_and_marks_stay(hand_in: HandIn):
    folder = slip(hand_in)
    line = 1 + read_source(folder / SOLVER).split("\n").index(f"    {SLIP}")
    own, graded = checked(folder, "2").checks, checked(folder, "2", trusted=False).checks
    failed = [check for check in own if check.failed]
    assert failed
    for check in failed:
        assert check.where is not None and (check.where.file, check.where.line) == (SOLVER, line)
        assert f"Without a part of line {line}, this passes: look there." in check.meaning
        assert "b.inv_inertia" not in check.meaning, "where, and not what"
    assert [check.points for check in own] == [check.points for check in graded]
    assert not any("look there" in check.meaning for check in graded)


def tell_line(member: Member, tree: Path) -> tuple[int | None, set[int]]:
    """Return the line that the report names, and the lines that differ from the solution."""
    member.build(KIT, tree)
    (todo,) = member.todos
    told = [c for c in checked(tree, todo).checks if "look there" in c.meaning and c.where]
    if not told or told[0].where is None:
        return None, set()
    where = told[0].where
    ours, right = (read_source(root / where.file).split("\n") for root in (tree, KIT / "solution"))
    blocks = difflib.SequenceMatcher(None, ours, right, False).get_opcodes()
    changed = {
        line
        for tag, i, j, _, _ in blocks
        if tag != "equal"
        for line in range(i + (i < j), max(i, j) + 1 + (i == j))
    }
    return where.line, changed


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
def test_no_line_is_told_but_one_that_is_wrong(member: Member, tmp_path: Path):
    line, changed = tell_line(member, tmp_path / "tree")
    if member.name in FEW:
        assert line is not None
    assert line is None or line in changed or member.name == ELSEWHERE


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
