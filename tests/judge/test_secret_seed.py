"""Grade under a secret seed, where recorded answers earn nothing."""

from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import pytest
from whole_bank import bank

from grader.bank.members import Member
from grader.bank.verify import shared_worker
from grader.judge.grade import grade
from grader.judge.lab import Lab
from grader.judge.result import Result
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall.children import Child, ChildEnded
from grader.judge.wall.connection import Connection, Send
from grader.protocol import Answered, Import, Piece, Record, Request

SOME = frozenset({"8b", "B4"})
ALL = frozenset[str]()
Asked = tuple[bytes, ...]  # all requests to a child so far

encode = msgspec.msgpack.encode
asked: dict[int, list[bytes]] = {}  # by the child


def so_far(child: Child, request: Request | Record) -> Asked:
    if isinstance(request, Import):
        asked[id(child)] = []
    history = asked.setdefault(id(child), [])
    history.append(encode(request))
    return tuple(history)


def answer_by(send: Send, patch: pytest.MonkeyPatch) -> None:
    """Let a function answer all requests of all labs, one by one."""

    def connect(module: str, open_child: Callable[[], Child], pieces: list[Piece]):
        return Connection(module, open_child, pieces, send)

    patch.setattr("grader.judge.lab.Connection", connect)


def grade_solution(seed: int | None, only: frozenset[str]) -> Result:
    options = Options(shipped_reference(), seed=seed, only=only)
    return grade(KIT / "solution", options, shared_worker())


def right_answers(only: frozenset[str], patch: pytest.MonkeyPatch) -> dict[Asked, Answered]:
    """Return the solution's answers to the usual questions."""
    answers: dict[Asked, Answered] = {}

    def ask_and_note(child: Child, request: Request | Record) -> Answered:
        asked_so_far = so_far(child, request)
        answers[asked_so_far] = answered = child.ask(request)
        return answered

    with patch.context() as here:
        answer_by(ask_and_note, here)
        result = grade_solution(None, only)
    assert (result.points, result.bonus) == (result.max_points, bonus_of(result))
    return answers


def bonus_of(result: Result) -> int:
    return sum(todo.max_points for todo in result.todos if todo.id.startswith("B"))


@pytest.mark.parametrize("only", [SOME, pytest.param(ALL, marks=pytest.mark.soak)])
def test_recorded_answers_earn_nothing_under_a_seed(
    only: frozenset[str], monkeypatch: pytest.MonkeyPatch
):
    known = right_answers(only, monkeypatch)

    def by_heart(child: Child, request: Request | Record) -> Answered:
        answered = known.get(so_far(child, request))
        if answered is None:
            raise ChildEnded("nobody has asked that before")
        return answered

    answer_by(by_heart, monkeypatch)
    usual = grade_solution(None, only)
    assert (usual.points, usual.bonus) == (usual.max_points, bonus_of(usual))
    secret = grade_solution(4711, only)
    passed = [each.id for todo in secret.todos for each in todo.checks if each.points]
    assert passed == []


@pytest.mark.parametrize(
    ("seeds", "only"),
    [(range(1, 2), SOME), pytest.param(range(2, 40), ALL, marks=pytest.mark.soak)],
)
def test_right_work_keeps_every_point_under_any_seed(seeds: range, only: frozenset[str]):
    for seed in seeds:
        result = grade_solution(seed, only)
        lost = [c.got for todo in result.todos for c in todo.checks if c.points < c.max_points]
        assert lost == []


# ---------------------------------------------------------------- known mistakes

MISTAKES = (
    *("1-inside-always-leaves-by-the-top", "2-one-term-is-enough", "3-only-pushes"),
    *("4-friction-of-a-only", "5-straight-line-instead-of-exp"),
    *("1-first-two-faces", "1-corner-normal-along-an-axis", "1-depth-at-most-the-box-height"),
    *("1-prefers-the-top", "1-face-by-share-of-the-half", "1-inside-depth-is-the-gap"),
    *("2-cleans-the-axis", "2-heavy-ones-do-not-turn", "2-known-pairs", "2-second-body-forgotten"),
    *("3-moves-only-b", "3-level-or-upright", "3-static-end-first", "3-dead-zone"),
    *("3-impulse-capped", "4-smaller-mu", "4-rests-stay", "4-stops-slow-spins"),
    *("4-fixed-partners-only", "5-kept-by-dt", "5-one-rate-for-both", "5-both-or-none"),
    *("7b-largest-never-turn", "8a-position-first", "8c-three-eighths"),
)
Marks = list[tuple[str, int]]


def marks_under(seed: int | None, member: Member, folder: Path) -> Marks:
    """Return the points of each check of the mistake's TODO."""
    todo = member.name.partition("-")[0]
    options = Options(shipped_reference(), seed=seed, only=frozenset({todo}))
    result = grade(folder, options, shared_worker())
    return [(c.id, c.points) for t in result.todos for c in t.checks if t.id == todo]


@pytest.mark.soak
def test_a_mistake_costs_the_same_under_every_seed(tmp_path: Path):
    known = {each.name: each for each in bank() if each.form == "package"}
    for name in MISTAKES:
        folder = tmp_path / name
        known[name].build(folder)
        usual = marks_under(None, known[name], folder)
        assert any(points for _, points in usual) and not all(points for _, points in usual), name
        for seed in range(1, 11):
            assert marks_under(seed, known[name], folder) == usual, (name, seed)


# ---------------------------------------------------------------- the numbers themselves


@pytest.fixture
def labs() -> Iterator[list[Lab]]:
    yield [Lab("mini_engine", lambda: pytest.fail("a child"), [], secret=s) for s in ("1 a", "1 a")]


def test_without_a_seed_numbers_are_the_usual_ones():
    lab = Lab("mini_engine", lambda: pytest.fail("a child"), [])
    assert [lab.about(3.0), lab.about(0.0, 8.0), lab.whole(5, 2), lab.factor] == [3.0, 0.0, 5, 1.0]


def test_with_one_they_are_others_near_them_and_the_same_each_time(labs: list[Lab]):
    drawn = [[*(lab.about(8.0) for _ in range(200)), lab.about(0.0)] for lab in labs]
    assert drawn[0] == drawn[1]
    assert all(6.0 <= each <= 10.0 and each != 8.0 for each in drawn[0][:-1])
    assert all((64 * each).is_integer() for each in drawn[0])
    assert {labs[0].whole(5, 2) for _ in range(100)} == {3, 4, 6, 7}
