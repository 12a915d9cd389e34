"""Make the sheet of one student: the same kinds for all, about TODOs that pass."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Protocol

from grader.judge.course import Asked
from grader.judge.failures import Broke, NotYet
from grader.questions.films import ask_films
from grader.questions.program import CannotAsk, Program
from grader.questions.question import Question, Sheet
from grader.questions.reasons import ask_reason, list_reason_todos
from grader.text import clean

SLOTS = (1, 3, 5, 2, 4)  # contacts, time, integrators: a sheet begins with one of each
Ask = tuple[str, Callable[[], Question]]  # the name of a question, and its maker


class Asks(Protocol):
    """A source of a number question: a maker of the kit, or the cases in a release."""

    @property
    def name(self) -> str: ...
    @property
    def todos(self) -> tuple[str, ...]: ...
    @property
    def slot(self) -> int: ...
    def ask(self, program: Program, seed: str, points: int) -> Question: ...


def make_sheet(
    program: Program, student: str, seed: str, asked: Asked, makers: Sequence[Asks]
) -> Sheet:
    """Make a student's questions, the same for the same program and seed."""
    own = f"{seed}/{student}"
    dropped: list[str] = []
    found: list[Question] = []
    numbers = (
        (each.name, partial(each.ask, program, own, asked.worth("number")))
        for each in take_turns(makers, program)
    )
    shown = (
        ("films", partial(ask_films, program, f"{own}/{number}", asked.worth("film")))
        for number in range(asked.film)
    )
    reasons = (
        (f"why of TODO {todo}", partial(ask_reason, todo, program, asked.worth("why")))
        for todo in list_reason_todos(program)
    )
    found += ask_some(numbers, asked.number, dropped)
    found += ask_some(shown, asked.film, dropped)
    missing = asked.number + asked.film - len(found)
    found += ask_some(numbers, missing, dropped)  # a number if there is no film to ask about
    found += ask_some(reasons, asked.why, dropped)
    return Sheet(student, seed, tuple(found), tuple(dropped))


def ask_some(asks: Iterator[Ask], count: int, dropped: list[str]) -> list[Question]:
    """Ask the first `count` questions that may be asked; note the others."""
    found: list[Question] = []
    while len(found) < count and (each := next(asks, None)):
        name, ask = each
        try:
            found.append(ask())
        except Exception as error:
            dropped.append(f"{name}: {explain_refusal(error)}")
    return found


def explain_refusal(error: Exception) -> str:
    """Say why a question is not asked; raise errors that the program did not cause."""
    match error:
        case CannotAsk():
            return str(error)
        case NotYet() | Broke():
            return f"their program gave {clean(error.got)}"
        case ArithmeticError() | ValueError() | IndexError() | RecursionError():
            return f"it could not be worked out ({type(error).__name__})"
    raise error


def take_turns(makers: Iterable[Asks], program: Program) -> Iterator[Asks]:
    """Yield makers whose TODOs pass: first one from each slot, then a second from each.

    A maker whose TODOs were already used comes after all others, so that a sheet repeats a TODO
    only if nothing else is left. No question is about given TODOs alone.
    """
    able = [
        each
        for each in makers
        if program.can_show(each.todos) and program.right.intersection(each.todos)
    ]
    slots = [[each for each in able if each.slot == slot] for slot in SLOTS]
    ranks = range(max(map(len, slots)))
    ordered = [slot[rank] for rank in ranks for slot in slots if rank < len(slot)]
    had: set[str] = set()
    waiting = []
    for each in ordered:
        if had.issuperset(each.todos):
            waiting.append(each)
            continue
        had.update(each.todos)
        yield each
    yield from waiting
