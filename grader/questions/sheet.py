"""The sheet of one student: the same kinds for everybody, about TODOs that are right in theirs."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Protocol, TypeVar

from grader.judge.course import Asked
from grader.judge.failures import Broke, NotYet
from grader.questions.films import film_question
from grader.questions.lines import line_question, line_questions
from grader.questions.program import Program, Unlike
from grader.questions.question import Question, Sheet
from grader.questions.reasons import reason_question, reasons_for
from grader.text import clean

SLOTS = (1, 3, 5, 2, 4, 6)  # contacts, time, integrators: a sheet begins with one of each
Ask = tuple[str, Callable[[], Question]]  # what a question is called, and how it is made


class Asks(Protocol):
    """What asks for a number: a maker of the kit, or the cases that a release has of it."""

    @property
    def name(self) -> str: ...
    @property
    def todos(self) -> tuple[str, ...]: ...
    @property
    def slot(self) -> int: ...
    def ask(self, program: Program, seed: str, points: int) -> Question: ...


Each = TypeVar("Each", bound=Asks)


def sheet_of(
    program: Program, student: str, seed: str, asked: Asked, makers: Sequence[Asks]
) -> Sheet:
    """The questions to a student. The same program and seed always give the same ones."""
    own = f"{seed}/{student}"
    dropped: list[str] = []
    found: list[Question] = []
    numbers = numbers_to_ask(program, own, asked, makers)
    found += made(numbers, asked.number, dropped)
    found += made(films_to_ask(program, own, asked), asked.film, dropped)
    found += made(lines_to_ask(program, own, asked), asked.line, dropped)
    missing = asked.number + asked.film + asked.line - len(found)
    found += made(numbers, missing, dropped)  # where there is no film to ask about, a number
    lines = {todo for each in found if each.kind == "line" for todo in each.todos}
    found += made(reasons_to_ask(program, asked, lines), asked.why, dropped)
    return Sheet(student, seed, tuple(found), tuple(dropped))


def made(asks: Iterator[Ask], count: int, dropped: list[str]) -> list[Question]:
    """The first `count` questions that may be asked; the others are noted."""
    found: list[Question] = []
    while len(found) < count and (each := next(asks, None)):
        name, ask = each
        try:
            found.append(ask())
        except Exception as error:
            dropped.append(f"{name}: {why_not(error)}")
    return found


def why_not(error: Exception) -> str:
    """Why a question is not asked; raises what has nothing to do with the program."""
    match error:
        case Unlike():
            return str(error)
        case NotYet() | Broke():
            return f"their program gave {clean(error.got)}"
        case ArithmeticError() | ValueError() | IndexError() | RecursionError():
            return f"it could not be worked out ({type(error).__name__})"
    raise error


def numbers_to_ask(
    program: Program, seed: str, asked: Asked, makers: Sequence[Asks]
) -> Iterator[Ask]:
    for each in in_turn(makers, program):
        yield each.name, partial(each.ask, program, seed, asked.worth("number"))


def films_to_ask(program: Program, seed: str, asked: Asked) -> Iterator[Ask]:
    for number in range(asked.film):
        own = f"{seed}/{number}"
        yield "films", partial(film_question, program, own, asked.worth("film"))


def lines_to_ask(program: Program, seed: str, asked: Asked) -> Iterator[Ask]:
    for todo in line_questions(program):
        yield (
            f"line of TODO {todo}",
            partial(line_question, todo, program, seed, asked.worth("line")),
        )


def reasons_to_ask(program: Program, asked: Asked, lines: set[str]) -> Iterator[Ask]:
    """Last about the function whose lines a sheet shows already."""
    for each in sorted(reasons_for(program), key=lambda each: each.todo in lines):
        yield each.name, partial(reason_question, each, program, asked.worth("why"))


def in_turn(makers: Iterable[Each], program: Program) -> Iterator[Each]:
    """Those whose TODOs are all right: the first of each slot, then the second of each.

    One about TODOs that have had their turn waits for all the others: no sheet asks the same twice
    as long as there is something else. What a course hands out done may take part in a question,
    and is not what it is about.
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
