"""Read class lists of Canvas and Moodle, and write marks into them."""

import csv
import io

import pytest

from grader.classroom.marks import (
    Marking,
    Part,
    Scores,
    compute_mark,
    load_marking,
    make_marks,
)
from grader.errors import Stop
from grader.intake.roster import list_people
from grader.intake.systems import read_roster
from grader.release.nbgrader_course import INSTRUCTOR

CANVAS = """\
Student,ID,SIS User ID,SIS Login ID,Section,Essay (1),Physics engine (4711),Final Score
    Points Possible,,,,,10,100,(read only)
"Müller, Zoë",17,s-17,zoe,"Section ""A"", late",7,,93
"O'Brien, Ben",18,s-18,ben,B,8,,88
"Student, Test",99,,test,,,,
"""
MOODLE = """\
First name,Last name,ID number,Email address,Quiz total
Zoë,Müller,s-17,zoe@school.example,3
=cmd|'/c calc'!A1,李,s-18,ben@school.example,4
"""
MARKING = Marking("Physics engine", {"engine": 70, "quiz": 30})
ZOE = {"engine": Part(80, 100), "quiz": Part(8, 8), "journal": Part(0, 12, waiting=True)}


def read_list(tmp_path, text, encoding="utf-8"):
    (tmp_path / "class.csv").write_bytes(text.encode(encoding))
    return read_roster(tmp_path / "class.csv")


def rows(made, delimiter=","):
    return list(csv.reader(io.StringIO(made.text.removeprefix("\ufeff")), delimiter=delimiter))


# ---------------------------------------------------------------- Canvas


def test_canvas_gets_its_columns_back_with_one_mark_each(tmp_path):
    roster = read_list(tmp_path, CANVAS)
    scores = Scores({"zoe": ZOE, "guest": ZOE}, MARKING, others_known=True)
    made = make_marks(roster, roster.choose_key(), scores)
    assert rows(made) == [
        ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Physics engine (4711)"],
        ["    Points Possible", "", "", "", "", "100"],
        ["Müller, Zoë", "17", "s-17", "zoe", 'Section "A", late', "86.0"],
        ["O'Brien, Ben", "18", "s-18", "ben", "B", "0"],
    ]
    guest = "guest: handed in, but is not in the class list under 'SIS Login ID'"
    assert made.given == 2 and guest in made.notes


def test_a_byte_order_mark_and_semicolons_come_back_as_they_came(tmp_path):
    roster = read_list(
        tmp_path, CANVAS.replace(",", ";").replace("Müller;", "Müller,"), "utf-8-sig"
    )
    made = make_marks(roster, roster.choose_key(), Scores({"zoe": ZOE}, MARKING))
    assert made.text.startswith("\ufeffStudent;ID;")
    assert rows(made, ";")[2][0] == "Müller, Zoë" and rows(made, ";")[2][-1] == "86.0"


# ---------------------------------------------------------------- Moodle


def test_moodle_gets_identifiers_grade_and_feedback(tmp_path):
    roster = read_list(tmp_path, MOODLE)
    made = make_marks(roster, roster.choose_key(), Scores({"zoe": ZOE, "ben": {}}, MARKING))
    assert rows(made) == [
        ["First name", "Last name", "ID number", "Email address", "Grade", "Feedback"],
        ["Zoë", "Müller", "s-17", "zoe@school.example", "86.0", "engine 80 / 100; quiz 8 / 8"],
        ["'=cmd|'/c calc'!A1", "李", "s-18", "ben@school.example", "0.0", ""],
    ]


def test_the_key_may_be_another_column(tmp_path):
    roster = read_list(tmp_path, MOODLE)
    made = make_marks(roster, roster.choose_key("ID number"), Scores({"s-17": ZOE}, MARKING))
    assert rows(made)[1][4] == "86.0"
    with pytest.raises(Stop, match="no column 'Login'"):
        roster.choose_key("Login")


def test_names_match_whatever_the_case_and_the_form_of_accents(tmp_path):
    roster = read_list(tmp_path, "Email address\nZo\u00eb@x.example\n")
    made = make_marks(roster, roster.choose_key(), Scores({"zoe\u0308": ZOE}, MARKING))
    assert rows(made)[1][0] == "Zo\u00eb@x.example" and rows(made)[1][1] == "86.0"


def test_nbgrader_is_told_the_names(tmp_path):
    found = list(list_people(read_list(tmp_path, CANVAS), "SIS Login ID"))
    assert found[0] == {"id": "zoe", "first_name": "Zoë", "last_name": "Müller", "email": ""}
    found = list(list_people(read_list(tmp_path, MOODLE), "ID number"))
    assert found[0]["first_name"] == "Zoë" and found[0]["email"] == "zoe@school.example"


# ---------------------------------------------------------------- marks


OUT_OF_20 = Marking("x", {"engine": 1}, total=20, decimals=0)


@pytest.mark.parametrize(
    ("parts", "marking", "mark"),
    [
        ({"engine": Part(100, 100), "quiz": Part(8, 8)}, MARKING, "100.0"),
        ({"engine": Part(100, 100)}, MARKING, "70.0"),
        ({}, MARKING, "0.0"),
        ({"engine": Part(50, 100), "quiz": Part(4, 8), "other": Part(9, 9)}, MARKING, "50.0"),
        ({"engine": Part(0.5, 100), "quiz": Part(0, 8)}, MARKING, "0.4"),  # 0.35, half up
        ({"engine": Part(100, 100), "quiz": Part(0, 0)}, MARKING, "70.0"),
        ({"engine": Part(72, 100)}, OUT_OF_20, "14"),
        ({"engine": Part(72.5, 100)}, OUT_OF_20, "15"),
    ],
)
def test_shares_make_one_mark(parts, marking, mark):
    assert compute_mark(parts, marking) == mark


def test_the_shipped_settings_name_the_notebooks():
    from handed_in import NAMES

    marking = load_marking(INSTRUCTOR / "marks.toml")
    assert sorted(marking.shares) == NAMES and sum(marking.shares.values()) == 100


# ---------------------------------------------------------------- unreadable lists


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is empty"),
        ("Student,ID\n", "is empty"),
        ("Name,Name\nx,y\n", "two columns of one name"),
        ("Name,Group\nx,y\n", "--key"),
    ],
)
def test_a_list_that_makes_no_sense_is_refused(tmp_path, text, words):
    with pytest.raises(Stop, match=words):
        read_list(tmp_path, text).choose_key()


def test_a_list_that_is_not_utf_8_is_read_and_somebody_is_asked_to_look(tmp_path):
    text = MOODLE.replace("李", "Ö")
    read, usual = read_list(tmp_path, text, "latin-1"), read_list(tmp_path, text)
    assert read.rows == usual.rows
    assert "is not UTF-8" in read.doubt and "Zoë" in read.doubt and not usual.doubt


@pytest.mark.parametrize(
    "text",
    [
        'title = "x"',
        'title = "x"\n[shares]\nengine = -1',
        'title = "x"\n[shares]\nengine = 0',
        'title = "x"\ntotal = 0\n[shares]\nengine = 1',
        'title = "x"\nweights = 1\n[shares]\nengine = 1',
        "title = ",
    ],
)
def test_settings_that_make_no_sense_are_refused(tmp_path, text):
    (tmp_path / "marks.toml").write_text(text, encoding="utf-8")
    with pytest.raises(Stop, match=r"marks\.toml"):
        load_marking(tmp_path / "marks.toml")
