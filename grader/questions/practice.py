"""Practice at home: what a release has of the numbers, in place of the code that works them out.

The cases of *predict a number* are closed forms, some as good as the code of a TODO. So a release
draws some of each, has them answered in two ways, by the closed form and by the solution's run, and
writes them to `practice.json` beside the copy of the checks. The kit itself has no such file.
"""

import random

import msgspec
from msgspec import Struct

from grader.judge.course import Asked
from grader.judge.rubric import CHECKS
from grader.questions.program import Program, Unlike
from grader.questions.question import Question

FILE = "practice.json"


class Cases(Struct, frozen=True):
    """Some questions of one maker, with their answers."""

    name: str
    todos: tuple[str, ...]
    slot: int
    questions: tuple[Question, ...]

    def ask(self, program: Program, seed: str, points: int) -> Question:
        """One of them, as the seed has it; raises Unlike where there is none."""
        if not self.questions:
            raise Unlike("this release has no case of it")
        chosen = random.Random(f"{seed}/{self.name}").choice(self.questions)
        return msgspec.structs.replace(chosen, points=points)


class Practice(Struct, frozen=True):
    """What a release has for practice: what the course asks, and the numbers."""

    asked: Asked
    given: frozenset[str]  # the TODOs that the course hands out done
    cases: tuple[Cases, ...]


def load_practice() -> Practice | None:
    """That of this copy of the checks; None in the kit."""
    path = CHECKS / FILE
    return msgspec.json.decode(path.read_bytes(), type=Practice) if path.is_file() else None
