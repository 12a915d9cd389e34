"""Test the questions about a student's own program, their sheets and their marks."""

import base64
import math
import re
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from html import unescape
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import msgspec
import pytest
from command_line import run_grader, run_in_class
from conftest import FEW_CASES, KIT, HandIn
from markupsafe import escape
from page_readers import barriers, chromium
from whole_bank import bank

from grader.bank.members import Member
from grader.bank.verify import shared_worker
from grader.judge.course import Asked, WrongCourse, read_course
from grader.judge.failures import Broke
from grader.judge.result import Result
from grader.judge.submission import CannotGrade
from grader.judge.task import Options, shipped_reference
from grader.questions import films, making
from grader.questions import sheet as sheets
from grader.questions.cases import MAKERS
from grader.questions.marking import Marking, mark_answers, read_keys, write_points
from grader.questions.moodle import write_moodle
from grader.questions.page import make_page
from grader.questions.pictures import Film, Look, find_bounds
from grader.questions.practice import Practice
from grader.questions.program import CannotAsk, Program, open_program
from grader.questions.question import (
    Question,
    Sheet,
    Unreadable,
    find_misunderstanding,
    grade_answer,
)
from grader.questions.sheet import ask_some, take_turns
from grader.report.files import write_json, write_whole
from grader.source.regions import python_files, read_source, regions_in

ALL = frozenset(("1", "2", "3", "4", "5", "6", "7a", "7b", "7c", "7d", "8a", "8b", "8c"))
OPTIONS = Options(shipped_reference(), trusted=True)
RIGHT = [each for each in bank() if each.kind == "right" and not each.bonus]


@contextmanager
def program_of(folder: Path, result: Result) -> Iterator[Program]:
    """Open a program with this result."""
    with open_program(folder, OPTIONS, shared_worker(), result) as program:
        yield program


@contextmanager
def changed_program(
    hand_in: HandIn, result: Result, file: str, old: str, new: str
) -> Iterator[Program]:
    """Open the solution with one text of a file of its engine replaced."""
    text = (KIT / "solution/mini_engine" / file).read_text()
    assert old in text
    name = f"mini_engine__{file.replace('.', '_')}"
    with program_of(hand_in("solution", **{name: text.replace(old, new)}), result) as program:
        yield program


def make_sheet(program: Program, student: str, seed: str, asked: Asked) -> Sheet:
    return sheets.make_sheet(program, student, seed, asked, MAKERS)


# ---------------------------------------------------------------- numbers


def program_with(right: Iterable[str], given: Iterable[str] = ()) -> Program:
    """Make a program that is never run."""
    nothing: Any = None
    return Program(nothing, nothing, frozenset(right), frozenset(given))


@pytest.mark.parametrize(
    ("right", "given", "names"),
    [
        (ALL, (), ["impulse", "steps", "verlet"]),
        ({"5", "8a"}, (), ["semi-implicit", "damping"]),
        ({"4"}, ALL - {"4"}, ["friction"]),  # given TODOs count, but get no questions
    ],
)
def test_everybody_with_the_same_todos_is_asked_alike(right, given, names: list[str]):
    found = [each.name for each in take_turns(MAKERS, program_with(right, given))]
    assert found[:3] == names and len(set(found)) == len(found)


def test_what_flies_above_the_scene_is_in_the_picture():
    usual, flies = film_of([-100.0] * 5), film_of([-100.0, 20.0, 20.0, 20.0, 20.0])
    assert find_bounds([usual]) == (0.0, 30.0, 900.0, 560.0)
    assert find_bounds([usual, flies]) == (0.0, -30.0, 900.0, 620.0)


def test_a_program_that_tells_false_numbers_is_not_asked_about_them(
    hand_in: HandIn, solution: Result
):
    false = "    c.jn = total\n", "    c.jn = total * 1.05\n"
    with changed_program(hand_in, solution, "solver.py", *false) as program:
        sheet = make_sheet(program, "eve", "1", Asked(film=0, why=0))
    assert [each.name for each in sheet.questions] == ["steps", "verlet", "friction"]
    (words,) = sheet.dropped
    assert words.startswith("impulse: closed form and their program differ")


# ---------------------------------------------------------------- answers


@pytest.mark.parametrize("answer", ["962", "962 kg px/s", " 9.62e2", "962,1", "+962"])
def test_an_answer_is_read_as_people_write_it(answer: str):
    question = Question("x", "number", ("1",), "", 2, "962", 20.0, "kg px/s")
    assert grade_answer(question, answer) == 2


@pytest.mark.parametrize("answer", ["", "about 900", "1,036", "12 or 13", "--3", "nan"])
def test_what_is_no_number_is_never_counted_as_a_wrong_one(answer: str):
    with pytest.raises(Unreadable):
        grade_answer(Question("x", "number", ("1",), "", 2, "962", 20.0, "kg px/s"), answer)


def test_films_count_one_by_one():
    question = Question("x", "film", ("1",), "", 4, "badc")
    assert [grade_answer(question, each) for each in ("BADC", "b, a, c, d", "abcd")] == [4, 2, 0]
    with pytest.raises(Unreadable):
        grade_answer(question, "bad")


@pytest.mark.parametrize("error", [OverflowError, ZeroDivisionError, RecursionError, IndexError])
def test_numbers_that_make_no_sense_drop_a_question_and_not_the_class(error: type[Exception]):
    def ask() -> Question:
        raise error

    dropped: list[str] = []
    assert ask_some(iter([("it", ask)]), 1, dropped) == []
    assert dropped == [f"it: it could not be worked out ({error.__name__})"]


def test_a_program_whose_scene_breaks_has_a_sheet_all_the_same(hand_in: HandIn, solution: Result):
    breaks = "    world = World()\n", "    raise KeyError('\x1b[2J')\n"
    some = solution.with_todos([todo for todo in solution.todos if todo.id in ("1", "3")])
    with changed_program(hand_in, some, "scenes.py", *breaks) as program:
        sheet = make_sheet(program, "eve", "1", Asked())
    assert [each.name for each in sheet.questions] == ["why-centre-inside", "why-rod-impulse"]
    assert [words.partition(":")[0] for words in sheet.dropped] == ["rod", "films"]
    assert sheet.dropped[0].startswith("rod: their program gave KeyError")
    assert all(words.isprintable() for words in sheet.dropped)


def test_a_program_that_keeps_ending_is_left_alone(hand_in: HandIn, solution: Result):
    leaves = "    world = World()\n", "    __import__('os')._exit(3)\n"
    with changed_program(hand_in, solution, "scenes.py", *leaves) as program:
        for _ in range(4):
            with pytest.raises((CannotAsk, Broke)):
                MAKERS[0].ask(program, "1", 2)
        assert program.own.deaths == 3
        with pytest.raises(CannotAsk, match="too often"):
            MAKERS[0].ask(program, "1", 2)


# ---------------------------------------------------------------- films, lines, reasons


@pytest.fixture(scope="module")
def whole_sheet(solution: Result) -> Sheet:
    """Make the sheet of a student with the solution."""
    with program_of(KIT / "solution", solution) as program:
        return make_sheet(program, "ada", "5", Asked())


def test_a_sheet_has_every_kind_and_the_points_of_the_course(whole_sheet: Sheet):
    kinds = [each.kind for each in whole_sheet.questions]
    assert kinds == ["number"] * 3 + ["film", "why", "why"]
    assert whole_sheet.points == 3 * 2 + 4 + 2 * 3
    assert not whole_sheet.dropped
    for each in whole_sheet.questions:
        assert grade_answer(each, each.answer) == (0 if each.by_hand else each.points)


def test_films_are_different_pictures_that_run_no_script(whole_sheet: Sheet):
    (question,) = (each for each in whole_sheet.questions if each.kind == "film")
    assert sorted(question.answer) == list("abcd")
    assert len({each.svg for each in question.pictures}) == 4
    shapes = {"svg", "g", "rect", "circle", "line", "polyline"}
    allowed = shapes | {"set", "animate", "animateTransform"}
    for each in question.pictures:
        nodes = list(ElementTree.fromstring(each.svg).iter())
        assert {node.tag.rpartition("}")[2] for node in nodes} <= allowed
        kinds = [node.get("type") for node in nodes if node.get("type")]
        assert kinds.count("translate") == kinds.count("rotate") == 9  # eight balls and the bob
        moved = {node.get("attributeName") for node in nodes if node.tag.endswith("}animate")}
        assert moved == {"x1", "y1", "x2", "y2"}


def film_of(heights: Iterable[float], turns: float = 0.0) -> Film:
    """Make a film of a ball at these heights, with this number of turns."""
    ups = list(heights)
    each = 2 * math.pi * turns / (len(ups) - 1)
    rows = [[50.0, -up, 0.0, 0.0, each * row, 0.0] for row, up in enumerate(ups)]
    return Film([Look(10.0, (0.0, 0.0), True, (50.0, 0.0))], rows, 2.0)


def test_a_film_shows_a_change_by_what_the_lesson_lets_one_expect():
    named = {each.name: each for each in films.CHANGES}
    falls = [100.0, 50.0, 0.0, 0.0, 0.0]
    usual, bounces = film_of([*falls[:3], 160.0, 0.0], 3.0), film_of([*falls[:3], 400.0, 0.0], 3.0)
    stays, slides, buzzes = (film_of(falls, turns) for turns in (3.0, 0.0, 6.0))
    assert films.measure_rise(usual) == pytest.approx(1.6)
    assert films.measure_turning(buzzes) == pytest.approx(6.0)

    def can_tell_apart(**shown: Film) -> bool:
        changed = {named[name.replace("_", "-")]: film for name, film in shown.items()}
        return films.can_tell_apart({films.AS_IT_IS: usual} | changed)

    assert can_tell_apart(bouncy=bounces, no_bounce=stays) and not can_tell_apart(bouncy=usual)
    assert can_tell_apart(ice=slides) and not can_tell_apart(ice=film_of(falls, 2.5))
    assert can_tell_apart(no_spin=buzzes) and not can_tell_apart(no_spin=buzzes, ice=buzzes)
    assert not can_tell_apart(bouncy=bounces, all_at_once=bounces), "who could tell these two?"
    lower = film_of([*falls[:3], films.SEEN - 1, 0.0])
    assert films.measure_rise(lower) == 0.0, "a rise along the way down is not seen on paper"


def test_what_is_asked_of_a_line_is_how_the_student_wrote_it(hand_in: HandIn, solution: Result):
    by_hand = (
        "    total = max(-limit, min(limit, total))\n",
        "    if total > limit:\n        total = limit\n"
        "    if total < -limit:\n        total = -limit\n",
    )
    with changed_program(hand_in, solution, "solver.py", *by_hand) as program:
        sheet = make_sheet(program, "bob", "1", Asked(number=0, film=0, why=1))
    (question,) = sheet.questions
    assert (question.name, question.code) == ("why-clamp", "if total > limit:")
    assert question.by_hand and question.points == len(question.rubric)


@pytest.mark.soak
def test_a_program_whose_films_lie_is_not_asked_about_them(
    hand_in: HandIn, solution: Result, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(films, "TRIES", 1)
    move = "            body.pos += body.vel * dt\n"
    lies = move, f"{move}            body.pos.x += 1.5\n"
    with changed_program(hand_in, solution, "world.py", *lies) as program:
        sheet = make_sheet(program, "eve", "1", Asked(number=1, why=0))
    assert [each.kind for each in sheet.questions] == ["number", "number"]
    assert any(words.startswith("films: its film of") for words in sheet.dropped)


# ---------------------------------------------------------------- marking on paper


@pytest.fixture
def handed_back(tmp_path: Path, whole_sheet: Sheet) -> Path:
    """Write the key of one student; return the folder."""
    key = tmp_path / "out" / "keys" / "ada.json"
    write_whole(msgspec.json.encode(whole_sheet), key)
    return tmp_path / "out"


def mark(out: Path, answers: str) -> Marking:
    table = out / "answers.csv"
    table.write_text(answers, encoding="utf-8")
    return mark_answers(table, out / "keys")


def test_answers_on_paper_are_marked_and_none_is_dropped_silently(
    handed_back: Path, whole_sheet: Sheet
):
    key = [each.answer for each in whole_sheet.questions]
    wrong = whole_sheet.questions[0].wrong[0]
    rows = [
        f"ADA,1,{wrong.answer}",
        f"ada,q2,{key[1]}",
        "ada,3,half of it",
        f"ada,4,{key[3].upper()}",
        "ada,5,because,2",
        "bob,1,3",
        "ada,9,3",
        f"ada,2,{key[1]}",
    ]
    found = mark(handed_back, "\n".join(["Student,question,answer,points", *rows]))
    points = [each.points for each in found.marks]
    assert points == [0, 2, None, 4, 2, 0]
    assert found.marks[0].note == wrong.why
    assert found.marks[2].note.startswith("not read: “half of it”")
    assert found.marks[5].note == "no answer"
    assert [note.partition(":")[0] for note in found.notes] == ["line 7", "line 8", "line 9"]
    write_points(found, handed_back)
    totals = (handed_back / "totals.csv").read_text().splitlines()
    assert totals == ["student,points,out of,open", "ada,8,16,1"]
    assert "half of it" in (handed_back / "points.csv").read_text()


def test_what_a_person_marks_waits_for_one(handed_back: Path):
    found = mark(handed_back, "student;question;answer;points\nada;5;x;\nada;6;y;4\n")
    assert [each.points for each in found.marks[4:]] == [None, None]
    assert all("needs manual marking: 0 to 3" in each.note for each in found.marks[4:])


def sheet_of(student: str, full_name: str, *questions: Question) -> Sheet:
    return Sheet(student, "1", questions, full_name=full_name)


ONE = Question("steps", "number", ("6",), "How many?", 2, answer="15")


def test_a_table_may_have_full_names(tmp_path: Path):
    """They are the names on the sheets; two students of one name do not match."""
    twins = [sheet_of("s1", "Ann Lee", ONE), sheet_of("s2", "Ann Lee", ONE)]
    for each in (*twins, sheet_of("s3", "Ben Öz", ONE), sheet_of("s4", "Cem Roe")):
        write_whole(msgspec.json.encode(each), tmp_path / "keys" / f"{each.student}.json")
    rows = ["ben öz,1,15", "Ann Lee,1,15", "Ann Lee (s2),1,15", "Cem Roe,1,3", "Dora,1,3"]
    found = mark(tmp_path, "\n".join(["student,question,answer", *rows]))
    assert [each.points for each in found.marks] == [0, 2, 2]
    assert found.notes == [
        "line 3: 'Ann Lee': write s1 or s2",
        "line 5: Cem Roe has 0 questions, and no '1'",
        "line 6: 'Dora': there is no sheet of that name",
        "no answer of s1 is in the table",  # and Cem has no questions
    ]


def test_the_points_of_a_class_go_into_its_gradebook(tmp_path: Path):
    """Points are out of a whole sheet, for each student alone; without a sheet there are none."""
    four = Question("impulse", "number", ("1",), "How large?", 4, answer="3")
    sheets = [sheet_of("ann", "Ann Lee", ONE, four), sheet_of("ben", "", ONE), sheet_of("cem", "")]
    for each in (*sheets, sheet_of("dora", "", ONE)):
        write_whole(msgspec.json.encode(each), tmp_path / f"lab/questions/keys/{each.student}.json")
    students = [f'"{name}, X",{n},{name},A,G' for n, name in enumerate(["ann", "ben", "cem"])]
    rows = ["Student,ID,SIS Login ID,Section,Group", *students, '"dora, X",9,dora,A,G', ""]
    (tmp_path / "list.csv").write_text("\n".join(rows))
    (tmp_path / "course.toml").write_text('title = "Lab (77)"\n')
    run_grader(
        *("class", "new", str(tmp_path / "lab"), "--roster", str(tmp_path / "list.csv")),
        *("--course", str(tmp_path / "course.toml")),
    )
    table = tmp_path / "answers.csv"
    table.write_text("student,question,answer\nann,1,15\nann,2,5\nben,1,15\n")
    run = run_grader("class", "questions", str(tmp_path / "lab"), "--mark", str(table))
    assert run.exit_code == 1
    assert "2 of 4 marks are in" in run.output and "'Lab questions', out of 16" in run.output
    _, *lines = (tmp_path / "lab" / "questions" / "marks.csv").read_text().splitlines()
    assert [line.rpartition(",")[2] for line in lines] == ["5.3", "16.0", "", ""]


def test_a_formula_in_an_answer_stays_a_text_in_a_spreadsheet(handed_back: Path):
    found = mark(handed_back, "student,question,answer\nada,1,=1+1\nada,2,-3\n")
    write_points(found, handed_back)
    lines = (handed_back / "points.csv").read_text().splitlines()
    assert ",'=1+1," in lines[1]
    assert ",-3," in lines[2]


def test_a_table_without_its_columns_is_refused(handed_back: Path):
    with pytest.raises(CannotGrade, match="no column question"):
        mark(handed_back, "student,answer\nada,3\n")


# ---------------------------------------------------------------- Moodle

# Fields that Moodle's importer reads from each kind of question, and from all.
ALWAYS = {"name", "questiontext", "generalfeedback", "defaultgrade", "penalty", "hidden"}
READ_BY_MOODLE = {
    "numerical": {"answer", "unitgradingtype", "unitpenalty", "unitsleft", "showunits"},
    "matching": {"shuffleanswers", "subquestion"},
    "essay": {
        *("responseformat", "responserequired", "responsefieldlines", "attachments"),
        *("attachmentsrequired", "graderinfo", "responsetemplate"),
    },
}


def test_moodle_gets_what_its_importer_reads_with_pictures_in_it(whole_sheet: Sheet):
    quiz = ElementTree.fromstring(write_moodle([whole_sheet], "A/B"))
    category, *questions = quiz
    assert category.findtext("category/text") == "$course$/top/A//B/ada"
    kinds = [each.get("type") for each in questions]
    assert kinds == ["numerical"] * 3 + ["matching", "essay", "essay"]
    for each in questions:
        assert {part.tag for part in each} == ALWAYS | READ_BY_MOODLE[each.get("type")]
        assert sum(float(part.get("fraction")) for part in each.iter("answer") if part.keys()) in (
            100,
            0,
        )
        for holder in (each.find("questiontext"), *each.iter("subquestion")):
            names = re.findall(r"@@PLUGINFILE@@/([\w.-]+)", holder.findtext("text"))
            files = {file.get("name"): file.text for file in holder.iter("file")}
            assert sorted(files) == sorted(names)
            for text in files.values():
                ElementTree.fromstring(base64.b64decode(text))
    assert sum(int(each.findtext("defaultgrade")) for each in questions) == whole_sheet.points


def test_moodle_counts_right_what_the_key_does(whole_sheet: Sheet):
    quiz = ElementTree.fromstring(write_moodle([whole_sheet], "A"))
    numerical, matching = quiz[1], quiz[4]
    first, film = whole_sheet.questions[0], whole_sheet.questions[3]
    right, *wrong = numerical.iter("answer")
    assert (right.findtext("text"), right.get("fraction")) == (first.answer, "100")
    told = [unescape(each.findtext("feedback/text", "")) for each in wrong]
    assert told == [each.why for each in first.wrong]
    answers = [each.findtext("answer/text") for each in matching.iter("subquestion")]
    assert answers == [film.choices["abcd".index(letter)] for letter in film.answer]


# ---------------------------------------------------------------- practice at home


@pytest.fixture(scope="module")
def practice(practice_file: bytes) -> Practice:
    return msgspec.json.decode(practice_file, type=Practice)


def test_a_release_has_answered_cases_of_every_maker(practice: Practice):
    assert {each.name for each in practice.cases} == {each.name for each in MAKERS}
    for each in practice.cases:
        assert len({question.text for question in each.questions}) == FEW_CASES, each.name
        for question in each.questions:
            assert grade_answer(question, question.answer) == question.points
            assert len(question.wrong) >= 2, question.name
            for wrong in question.wrong:
                assert grade_answer(question, wrong.answer) == 0
                assert find_misunderstanding(question, wrong.answer) == wrong.why


@pytest.mark.soak
def test_at_home_all_kinds_are_asked_without_a_reference(
    practice: Practice, solution: Result, whole_sheet: Sheet
):
    with program_of(KIT / "solution", solution) as program:
        alone = Program(program.own, None, program.right, practice.given)
        some, others = (
            sheets.make_sheet(alone, "practice", seed, asked, practice.cases)
            for seed, asked in (("1", practice.asked), ("2", Asked(film=0, why=0)))
        )
    known = {each.answer for each in whole_sheet.questions[:3]}
    kinds = [each.kind for each in some.questions]
    assert kinds == ["number"] * 3 + ["film", "why", "why"]
    assert not some.dropped
    assert {each.text for each in some.questions[:3]} != {each.text for each in others.questions}
    assert not known & {each.answer for each in some.questions[:3]}


# ---------------------------------------------------------------- files, and sheets of a class


def test_the_command_makes_sheets_that_can_be_answered_and_marked(tmp_path: Path, solution: Result):
    course, results, out = (tmp_path / name for name in ("course.toml", "results", "questions"))
    course.write_text('title = "Us <b>"\n[questions]\nnumber = 1\nfilm = 0\nwhy = 1\n')
    write_json(solution, results / "ann.json")
    shutil.copytree(KIT / "solution", tmp_path / "class" / "ann")
    (tmp_path / "class" / "ben").mkdir()
    (tmp_path / "class" / "ben" / "notes.txt").write_text("nothing")
    lines = {"course": "course.toml", "results": "results", "submissions": "class"}
    run = run_in_class(tmp_path, "questions", **lines)
    assert run.exit_code == 1, run.output  # ben has no right TODO to ask about
    assert "ann: 2 questions, 5 points" in run.output and "ben: " in run.output
    sheet, key = ((out / name / "ann.html").read_text() for name in ("sheets", "keys"))
    assert "Us &lt;b&gt;: ann" in sheet
    (first, _) = read_keys(out / "keys")[0].questions
    assert f"<strong>{first.answer}" in key and f"<strong>{first.answer}" not in sheet
    assert all(each.why not in sheet for each in first.wrong)
    table = tmp_path / "answers.csv"
    table.write_text(f"student,question,answer,points\nann,1,{first.answer},\nann,2,x,1\n")
    run = run_in_class(tmp_path, "questions", "--mark", table, **lines)
    assert run.exit_code == 0, run.output
    assert (out / "totals.csv").read_text().splitlines()[1:] == ["ann,3,5,0"]


def test_a_seed_that_nobody_chose_is_drawn_once_and_kept(tmp_path: Path):
    first, again = (making.Making(tmp_path, OPTIONS) for _ in range(2))
    assert first.seed == again.seed
    assert first.seed != making.Making(tmp_path / "other", OPTIONS).seed
    practice = making.Making(tmp_path, OPTIONS, practice=True)
    assert practice.seed == f"practice {first.seed}"
    assert making.Making(tmp_path, OPTIONS).seed == first.seed


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[questions]\nfilms = 1", "there is no key films"),
        ("[questions]\nnumber = 11", "number = 11 must be a whole number from 0 to 10"),
        ("[questions]\npoints = { why = 0 }", "why = 0 must be"),
        ("questions = 3", "must be a table"),
    ],
)
def test_what_a_course_cannot_ask_is_said(text: str, words: str, tmp_path: Path):
    path = tmp_path / "course.toml"
    path.write_text(text)
    with pytest.raises(WrongCourse, match=words):
        read_course(path)


def solution_lines() -> set[str]:
    """Return the lines of the solution's regions that are long enough to recognise."""
    texts = [read_source(path) for path in python_files(KIT / "solution")]
    lines = {line.strip() for text in texts for r in regions_in(text) for line in r.lines}
    return {line for line in lines if len(line) > 12 and not line.startswith("#")}


def test_no_line_of_the_solution_is_shown_to_who_wrote_another(tmp_path: Path, solution: Result):
    (member,) = (each for each in bank() if each.name == "8-in-other-words")
    folder = tmp_path / "other"
    member.build(folder)
    todos = [t for t in solution.todos if t.id in ("8a", "8b", "8c")]
    with program_of(folder, solution.with_todos(todos)) as program:
        sheet = make_sheet(program, "dee", "1", Asked(number=0, film=0))
        own = "\n".join(program.own.texts.values())
    assert [each.kind for each in sheet.questions] == ["why", "why"]
    theirs = {line for line in solution_lines() if line not in own}
    assert theirs
    pages = make_page(sheet, "x", "sheet") + make_page(sheet, "x", "key")
    assert not [line for line in theirs if str(escape(line)) in pages]


@pytest.mark.soak
@pytest.mark.parametrize("member", RIGHT, ids=lambda each: f"{each.name}-{each.form}")
def test_every_right_member_of_the_bank_gets_a_whole_sheet(
    member: Member, tmp_path: Path, solution: Result
):
    folder = tmp_path / "handed-in"
    member.build(folder)
    with program_of(folder, solution) as program:
        sheet = make_sheet(program, member.name, "bank", Asked())
    assert len(sheet.questions) == 6
    assert {each.kind for each in sheet.questions} >= {"number", "why"}


@pytest.mark.soak
def test_clicks_and_keys_play_films_and_everybody_can_use_the_pages(
    tmp_path: Path, whole_sheet: Sheet
):
    pages = []
    for kind in ("sheet", "key", "practice"):
        pages.append(tmp_path / f"{kind}.html")
        pages[-1].write_text(make_page(whole_sheet, "Us", kind), encoding="utf-8")
    shown = "svg => getComputedStyle(svg.querySelector(':scope > g:last-of-type')).opacity"
    with chromium() as browser:
        tab = browser.new_page()
        tab.goto(pages[0].as_uri())
        film = tab.locator("#q4 svg").first
        assert film.evaluate(shown) == "0"
        other = tab.locator("#q4 svg").nth(1)
        for each, play in ((film, film.click), (other, lambda: other.press("Enter"))):
            play()
            tab.wait_for_function(f"svg => ({shown})(svg) === '1'", arg=each.element_handle())
        assert barriers(browser, *pages) == []


def test_a_sheet_bears_the_name_that_the_class_list_has():
    sheet = Sheet("ann", "1", (), full_name="Bell, Ann")
    for kind in ("sheet", "key"):
        assert "<h1>Lab 3: Bell, Ann (ann)</h1>" in make_page(sheet, "Lab 3", kind)
    assert "<h1>Lab 3: ann</h1>" in make_page(Sheet("ann", "1", ()), "Lab 3", "sheet")
