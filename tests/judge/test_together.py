"""Ask several questions in one message: answers are judged in order, each in its own words."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from one_worker import child_opener

from grader.judge.failures import Broke, NotYet
from grader.judge.lab import Lab
from grader.judge.wall.children import Child

PROGRAM = """
class Counter:
    def __init__(self, start):
        self.total = start
    def add(self, number):
        self.total += number
        return self.total

def double(n):
    print(n)
    if n == 3:
        while True: pass
    if n == 4:
        raise ValueError("four")
    return 2 * n if n != 1 else 7
"""


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[Lab]:
    (tmp_path / "program.py").write_text(PROGRAM, encoding="utf-8")
    with (
        child_opener(tmp_path) as children,
        Lab("program", lambda: children(2), []).opened() as lab,
    ):
        yield lab


@pytest.fixture
def messages(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Note how many questions each message holds."""
    sizes: list[int] = []
    send = Child._send_posted

    def note(child: Child, deadline: float) -> None:
        sizes.append(len(child.posted))
        send(child, deadline)

    monkeypatch.setattr(Child, "_send_posted", note)
    return sizes


def ask_to_double(lab: Lab, n: int) -> None:
    lab.ran(f"double({n})")
    lab.call("double", n, noted=("double", (n,)), then=lambda value: want(lab, value, 2 * n))


def want(lab: Lab, value: object, right: int) -> None:
    lab.want(value == right, f"{right}", f"{value}")


def test_one_message_holds_the_questions_and_the_changes_between_them(
    lab: Lab, messages: list[int]
):
    found: list[object] = []
    counter = lab.make("Counter", 10)
    for number in (1, 2):
        lab.tell(counter, "add", number, then=found.append)
    lab.put(counter, total=100)
    lab.let(counter, "add", 5)
    assert found == []
    assert lab.tell(counter, "add", 1) == 106
    assert found == [11, 13]
    assert messages == [1, 3]  # the import comes first
    assert lab.gets((counter, name) for name in ("total", "total")) == [106, 106]
    assert messages == [1, 3, 2]


def test_a_wrong_answer_counts_although_a_later_one_never_comes(lab: Lab):
    with pytest.raises(NotYet) as failure, lab.settled():
        for n in (0, 1, 3):
            ask_to_double(lab, n)
    assert (failure.value.ran, failure.value.expected, failure.value.got) == ("double(1)", "2", "7")
    assert lab.connection.output == "0\n1\n"
    assert not lab.late


def test_what_is_left_of_a_message_is_dropped(lab: Lab, messages: list[int]):
    with pytest.raises(NotYet), lab.settled():
        for n in (1, 2, 5):
            ask_to_double(lab, n)
    with lab.settled():
        ask_to_double(lab, 6)
    assert messages == [1, 3, 1]
    assert lab.connection.output == "1\n6\n"


def test_an_exception_is_noted_and_a_late_answer_ends_the_check(lab: Lab):
    with pytest.raises(Broke) as failure, lab.settled():
        ask_to_double(lab, 4)
        ask_to_double(lab, 1)
    assert (failure.value.ran, failure.value.got) == ("double(4)", "ValueError: four")
    assert [each.answer for each in lab.observations] == ["ValueError"]
    with pytest.raises(Broke) as failure, lab.settled():
        ask_to_double(lab, 3)
    assert failure.value.late and failure.value.ran == "double(3)"


def test_a_class_must_make_an_object(lab: Lab):
    made = lab.make("double", 2)
    with pytest.raises(NotYet, match="double returned of type int"):
        lab.tell(made, "add", 1)


def test_a_judge_of_an_answer_may_ask_nothing(lab: Lab):
    lab.call("double", 2, then=lambda _: ask_to_double(lab, 5))
    with pytest.raises(RuntimeError):
        lab.settle()
