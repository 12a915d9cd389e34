"""Make the practice file of a release: answered cases of *predict a number*."""

import msgspec

from grader.judge.course import Course
from grader.judge.task import KIT, Options, shipped_reference
from grader.questions.cases import MAKERS
from grader.questions.practice import Cases, Practice
from grader.questions.program import CannotAsk, Program, open_program
from grader.questions.question import Question
from grader.questions.sheet import Asks, take_turns

EACH = 12  # cases of a maker
SEED = "practice at home"  # used by no sheet, since seeds of sheets are numbers


def make_practice(course: Course) -> bytes:
    """Return the practice file of a course; the same kit makes the same file."""
    options = Options(shipped_reference(), trusted=True, course=course)
    with open_program(KIT / "solution", options) as program:
        cases = tuple(draw_cases(each, program) for each in take_turns(MAKERS, program))
        practice = Practice(course.questions, program.given, cases)
    return msgspec.json.encode(practice, order="sorted")


def draw_cases(maker: Asks, program: Program) -> Cases:
    """Draw different questions of one kind, by its maker."""
    found: dict[str, Question] = {}
    for number in range(EACH):
        try:
            question = maker.ask(program, f"{SEED}/{number}", 1)
        except CannotAsk:
            continue
        found[question.text] = question
    return Cases(maker.name, maker.todos, maker.slot, tuple(found.values()))
