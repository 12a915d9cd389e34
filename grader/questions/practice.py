"""Practise at home: a release has recorded numbers instead of the code that computes them.

The cases of *predict a number* are closed forms, some of which would give away a TODO. So a release
draws some of each, computes the answers by closed form and by the solution, and writes them to
`practice.json` beside the copy of the checks. The kit itself has no such file.
"""

import random

import msgspec
from msgspec import Struct

from grader.judge.course import Asked
from grader.judge.rubric import CHECKS
from grader.questions.program import CannotAsk, Program
from grader.questions.question import Question

FILE = "practice.json"


class Cases(Struct, frozen=True):
    """Some questions of one maker, with their answers."""

    name: str
    todos: tuple[str, ...]
    slot: int
    questions: tuple[Question, ...]

    def ask(self, program: Program, seed: str, points: int) -> Question:
        """Choose a question by the seed; raises CannotAsk if none exists."""
        if not self.questions:
            raise CannotAsk("this release has no case of it")
        chosen = random.Random(f"{seed}/{self.name}").choice(self.questions)
        return msgspec.structs.replace(chosen, points=points)


class Practice(Struct, frozen=True):
    """A release's practice: what the course asks, and the numbers."""

    asked: Asked
    given: frozenset[str]  # the TODOs that the course hands out done
    cases: tuple[Cases, ...]


def load_practice() -> Practice | None:
    """Load the practice of this copy of the checks; None in the kit."""
    path = CHECKS / FILE
    return msgspec.json.decode(path.read_bytes(), type=Practice) if path.is_file() else None
