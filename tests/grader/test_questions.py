"""Questions about a student's own program: right answers told from wrong ones, alike for all."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from conftest import KIT, HandIn

from grader.judge.course import Asked
from grader.judge.grade import Options, shipped_reference
from grader.judge.result import Result
from grader.maintain.verify import shared_worker
from grader.questions.numbers import drawn, number_question
from grader.questions.program import Program, opened_program
from grader.questions.question import Question, Unreadable, earned, meant
from grader.questions.sheet import MAKERS, in_turn, sheet_of

ALL = frozenset(("1", "2", "3", "4", "5", "6", "7a", "7b", "7c", "7d", "8a", "8b", "8c"))
OPTIONS = Options(shipped_reference(), trusted=True)


@contextmanager
def program_of(folder: Path, result: Result) -> Iterator[Program]:
    """A program that is taken to be right where the result says so."""
    with opened_program(folder, OPTIONS, shared_worker(), result) as program:
        yield program


# ---------------------------------------------------------------- numbers


def test_each_case_is_answered_in_two_ways_and_no_wrong_answer_counts(solution: Result):
    with program_of(KIT / "solution", solution) as program:
        questions = [number_question(each, program, "a seed/ada", 2) for each in MAKERS]
    for question in questions:
        assert earned(question, question.answer) == 2
        assert len(question.wrong) >= 2, question.name
        for wrong in question.wrong:
            assert earned(question, wrong.answer) == 0
            assert meant(question, wrong.answer) == wrong.why


def test_no_two_of_two_hundred_seeds_draw_the_same_numbers():
    chosen = list(in_turn(MAKERS, ALL))[:3]
    sheets = {str([drawn(each, f"{seed}/ada")[0] for each in chosen]) for seed in range(200)}
    names = {str([drawn(each, f"7/student {n}")[0] for each in chosen]) for n in range(200)}
    assert len(sheets) == len(names) == 200


def test_every_todo_right_asks_everybody_alike():
    names = [each.name for each in in_turn(MAKERS, ALL)][:3]
    assert names == ["impulse", "steps", "verlet"]
    assert [each.name for each in in_turn(MAKERS, frozenset({"5", "8a"}))] == [
        "semi-implicit",
        "damping",
    ]


def test_a_program_that_tells_false_numbers_is_not_asked_about_them(
    hand_in: HandIn, solution: Result
):
    text = (KIT / "solution/mini_engine/solver.py").read_text()
    false = text.replace("    c.jn = total\n", "    c.jn = total * 1.05\n")
    assert false != text
    folder = hand_in("solution", mini_engine__solver_py=false)
    with program_of(folder, solution) as program:
        sheet = sheet_of(program, "eve", "1", Asked(film=0, line=0, why=0))
    assert [each.name for each in sheet.questions] == ["steps", "verlet", "friction"]
    (words,) = sheet.dropped
    assert words.startswith("impulse: closed form and their program differ")


# ---------------------------------------------------------------- answers


@pytest.mark.parametrize("answer", ["962", "962 kg px/s", " 9.62e2", "962,1", "+962"])
def test_an_answer_is_read_as_people_write_it(answer: str):
    question = Question("x", "number", ("1",), "", 2, "962", 20.0, "kg px/s")
    assert earned(question, answer) == 2


@pytest.mark.parametrize("answer", ["", "about 900", "1,036", "12 or 13", "--3", "nan"])
def test_what_is_no_number_is_never_counted_as_a_wrong_one(answer: str):
    with pytest.raises(Unreadable):
        earned(Question("x", "number", ("1",), "", 2, "962", 20.0, "kg px/s"), answer)


def test_films_count_one_by_one():
    question = Question("x", "film", ("1",), "", 4, "badc")
    assert [earned(question, each) for each in ("BADC", "b, a, c, d", "abcd")] == [4, 2, 0]
    with pytest.raises(Unreadable):
        earned(question, "bad")
