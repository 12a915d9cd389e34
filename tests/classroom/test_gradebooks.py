"""Test writing marks into each gradebook, and matching its students."""

import csv
import io
from pathlib import Path

import classes
import gradebooks
import pytest
from classes import FULL, TITLE, Student

from grader.classroom.book import NOTHING, Outcome
from grader.classroom.marks import Marking, Scores, make_marks, make_parts, score_sheets
from grader.intake.systems import read_roster
from grader.judge.course import Course

NAMES = {"ann": "Ann Lee", "ann2": "Ann Lee", "ben": "Ben Öz", "cem": "Cem Roe", "dora": "Dora Poe"}
PEOPLE = [Student(login, *name.split()) for login, name in NAMES.items()]
BEN, CEM, DORA = 2, 3, 4
SYSTEMS = list(gradebooks.READERS)


def list_class(system: str) -> str:
    return classes.SYSTEMS[system](Path("nowhere"), PEOPLE)


def name_in(system: str, login: str) -> str:
    return f"{login}@x.edu" if system in classes.BY_EMAIL else login


def grade_all(system: str) -> list[Outcome]:
    """Grade two students of one name, one unreadable and one adjusted by hand; Dora is absent."""
    return [
        Outcome(name_in(system, "ann"), points=16, max_points=FULL, final=16),
        Outcome(name_in(system, "ann2"), points=8, max_points=FULL, final=8),
        Outcome(name_in(system, "ben"), "the archive is broken"),
        Outcome(name_in(system, "cem"), "broken", final=14, max_points=FULL, by_hand=True),
    ]


def made(tmp_path: Path, text: str, outcomes: list[Outcome], encoding: str = "utf-8"):
    (tmp_path / "list.csv").write_bytes(text.encode(encoding))
    roster = read_roster(tmp_path / "list.csv")
    marking = Marking(TITLE, {"engine": 1}, FULL)
    file = make_marks(roster, roster.choose_key(), Scores(make_parts(outcomes), marking))
    return file.text.encode(file.encoding), file


@pytest.mark.parametrize("system", SYSTEMS)
def test_each_gradebook_reads_its_marks_back(tmp_path, system, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for encoding in ["utf-8", *(["utf-16"] if system == "blackboard" else [])]:
        content, file = made(tmp_path, list_class(system), grade_all(system), encoding)
        told = list(classes.read_marks(system, content).values())
        assert [each.mark for each in told] == ["16.0", "8.0", "", "14.0", "0"]
        assert file.given == 4
        assert any("ben" in note and "no mark yet" in note for note in file.notes)
    if system == "moodle":
        assert told[BEN].feedback == "engine not graded (the archive is broken)"
        assert "broken" in told[CEM].feedback and told[DORA].feedback == "nothing handed in"


@pytest.mark.parametrize(
    "system, column",
    [
        ("canvas", f"{TITLE} questions"),
        ("moodle", "Grade"),
        ("blackboard", f"{TITLE} questions"),
        ("brightspace", f"{TITLE} questions Points Grade"),
    ],
)
def test_sheets_of_questions_have_a_column_of_their_own(tmp_path, system, column, monkeypatch):
    """There is no worksheet, since its grades would be those of the assignment."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "list.csv").write_text(list_class(system), encoding="utf-8")
    roster = read_roster(tmp_path / "list.csv")
    sheets = {"ann": (13, 17, 0), "ann2": (3, 19, 1), "ben": (19, 19, 0)}
    totals = [(name_in(system, login), *sheet) for login, sheet in sheets.items()]
    file = make_marks(roster, roster.choose_key(), score_sheets(totals, Course(title=TITLE), 1))
    rows = list(csv.DictReader(io.StringIO(file.text.lstrip("\ufeff")), delimiter=roster.delimiter))
    marks = [row[column] for row in rows if "Possible" not in str(row)]
    assert marks[-5:] == ["12.2", "", "16.0", "", ""]
    assert "Maximum Grade" not in rows[0] and not any("counts to" in each for each in file.notes)


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_number_behind_a_name_tells_two_of_one_name_apart(tmp_path, system, monkeypatch):
    """Only Canvas's and Moodle's lists have it; other rows stay empty, with a note."""
    monkeypatch.chdir(tmp_path)
    outcomes = [Outcome(f"Ann Lee_{n}", "", n, FULL, final=n) for n in (1, 2)]
    content, file = made(tmp_path, list_class(system), outcomes)
    marks = [each.mark for each in classes.read_marks(system, content).values()]
    known = system in ("canvas", "moodle")
    assert marks == [*(["1.0", "2.0"] if known else ["", ""]), "0", "0", "0"]
    assert sum("could be theirs" in note for note in file.notes) == (0 if known else 2)


def test_a_login_that_is_half_of_two_addresses_is_nobodys(tmp_path):
    text = "Email address\nann@x.edu\nann@y.edu\nben@x.edu\n"
    content, _ = made(tmp_path, text, [Outcome("ann", "", 80, 100, final=80)])
    assert [row["Grade"] for row in gradebooks.rows_of(content)] == ["", "", "0"]


def test_two_results_of_one_student_are_for_a_person(tmp_path):
    outcomes = [Outcome(name, "", 80, 100, final=80) for name in ("ann", "ann@x.edu")]
    content, file = made(tmp_path, "Email address,ID number\nann@x.edu,ann\n", outcomes)
    assert gradebooks.rows_of(content)[0]["Grade"] == ""
    assert "ann and ann@x.edu could be theirs" in file.notes[0]


GROUPS = "Email address,Group\nann@x,1\nben@x,1\ncem@x,2\ndora@x,2\neve@x,\n"


def test_a_group_has_the_mark_of_the_one_who_handed_in(tmp_path):
    outcomes = [
        Outcome("ann@x", "", 80, 100, final=80),
        Outcome("cem@x", "", 60, 100, final=60),
        Outcome("dora@x", NOTHING, final=10, max_points=100, by_hand=True),
    ]
    content, file = made(tmp_path, GROUPS, outcomes)
    grades = [row["Grade"] for row in gradebooks.rows_of(content)]
    assert grades == ["16.0", "16.0", "12.0", "2.0", "0"]
    assert "ben@x: the mark of ann@x, of the same group" in file.notes


def test_a_group_that_handed_in_two_ways_is_for_a_person(tmp_path):
    text = "Email address,Group\nann@x,1\nben@x,1\ncem@x,1\n"
    outcomes = [Outcome("ann@x", "", 80, 100, final=80), Outcome("ben@x", "", 60, 100, final=60)]
    content, _ = made(tmp_path, text, outcomes)
    assert [row["Grade"] for row in gradebooks.rows_of(content)] == ["16.0", "12.0", ""]
