"""Marks on their way into each gradebook, and who is who there."""

import csv
import io
from pathlib import Path

import gradebooks
import pytest
from command_line import run_in_class

from grader.classroom.book import NOTHING, Book, Outcome
from grader.classroom.marks import Marking, Scores, make_marks, make_parts, score_sheets
from grader.intake.systems import read_roster
from grader.judge.course import Course

TITLE = "Physics engine"
CANVAS = f"""\
Student,ID,SIS User ID,SIS Login ID,Section,Other (1),{TITLE} (77)
    Points Possible,,,,,10,100
"Lee, Ann",1,s1,ann,A,3,
"Lee, Ann",2,s2,ann2,A,3,
"Öz, Ben",3,s3,ben,A,3,
"Roe, Cem",4,s4,cem,A,3,
"Poe, Dora",5,s5,dora,A,3,
"""
WORKSHEET = """\
Identifier,Full name,ID number,Email address,Status,Grade,Maximum Grade,Feedback comments
Participant 1,Ann Lee,s1,ann@x.edu,Submitted,,100,
Participant 2,Ann Lee,s2,ann2@x.edu,Submitted,,100,
Participant 3,Ben Öz,s3,ben@x.edu,Submitted,,100,
Participant 4,Cem Roe,s4,cem@x.edu,Submitted,,100,
Participant 5,Dora Poe,s5,dora@x.edu,No submission,,100,
"""
BLACKBOARD = (
    "\t".join(["Last Name", "First Name", "Username", "Student ID", "Last Access", "Availability"])
    + f"\t{TITLE} [Total Pts: 100 Score] |4711\n"
    + "".join(
        f"{last}\t{first}\t{login}\ts{n}\t\tYes\t\n"
        for n, (last, first, login) in enumerate(
            [
                ("Lee", "Ann", "ann"),
                ("Lee", "Ann", "ann2"),
                ("Öz", "Ben", "ben"),
                ("Roe", "Cem", "cem"),
                ("Poe", "Dora", "dora"),
            ],
            1,
        )
    )
)
BRIGHTSPACE = f"""\
OrgDefinedId,Username,Last Name,First Name,Email,{TITLE} Points Grade <Numeric MaxPoints:100>,End-of-Line Indicator
#s1,ann,Lee,Ann,ann@x.edu,,#
#s2,ann2,Lee,Ann,ann2@x.edu,,#
#s3,ben,Öz,Ben,ben@x.edu,,#
#s4,cem,Roe,Cem,cem@x.edu,,#
#s5,dora,Poe,Dora,dora@x.edu,,#
"""  # noqa: E501
ANN, ANN2, BEN, CEM, DORA = range(5)


def graded(key: str) -> list[Outcome]:
    """Two of one name, one that could not be read, one with points set by hand; Dora is absent."""
    by_hand = Outcome("cem" + key, "broken", final=70, max_points=100, by_hand=True)
    return [
        Outcome("ann" + key, points=80, max_points=100, final=80),
        Outcome("ann2" + key, points=40, max_points=100, final=40),
        Outcome("ben" + key, "the archive is broken"),
        by_hand,
    ]


def made(tmp_path: Path, text: str, outcomes: list[Outcome], encoding: str = "utf-8"):
    (tmp_path / "list.csv").write_bytes(text.encode(encoding))
    roster = read_roster(tmp_path / "list.csv")
    marking = Marking(TITLE, {"engine": 1})
    file = make_marks(roster, roster.choose_key(), Scores(make_parts(outcomes), marking))
    return file.text.encode(file.encoding), file


@pytest.mark.parametrize(
    "text, key, read",
    [
        (CANVAS, "", lambda content: gradebooks.canvas(content, TITLE)),
        (WORKSHEET, "@x.edu", gradebooks.moodle_worksheet),
        (BLACKBOARD, "", lambda content: gradebooks.blackboard(content, TITLE)),
        (BRIGHTSPACE, "", lambda content: gradebooks.brightspace(content, TITLE)),
    ],
    ids=["Canvas", "Moodle", "Blackboard", "Brightspace"],
)
def test_each_gradebook_reads_its_marks_back(tmp_path, text, key, read):
    for encoding in ["utf-8", *(["utf-16"] if text is BLACKBOARD else [])]:
        content, file = made(tmp_path, text, graded(key), encoding)
        told = list(read(content).values())
        assert [mark for mark, _ in told] == ["80.0", "40.0", "", "70.0", "0"]
        assert file.given == 4
        assert any("ben" in note and "no mark yet" in note for note in file.notes)
    if text is WORKSHEET:
        assert told[BEN][1] == "engine not graded (the archive is broken)"
        assert "broken" in told[CEM][1] and told[DORA][1] == "nothing handed in"


@pytest.mark.parametrize(
    "text, key, column",
    [
        (CANVAS, "", f"{TITLE} questions"),
        (WORKSHEET, "@x.edu", "Grade"),
        (BLACKBOARD, "", f"{TITLE} questions"),
        (BRIGHTSPACE, "", f"{TITLE} questions Points Grade"),
    ],
    ids=["Canvas", "Moodle", "Blackboard", "Brightspace"],
)
def test_sheets_of_questions_have_a_column_of_their_own(tmp_path, text, key, column):
    """And no worksheet, whose grades would be those of the assignment."""
    (tmp_path / "list.csv").write_text(text, encoding="utf-8")
    roster = read_roster(tmp_path / "list.csv")
    totals = [(f"ann{key}", 13, 17, 0), (f"ann2{key}", 3, 19, 1), (f"ben{key}", 19, 19, 0)]
    file = make_marks(roster, roster.choose_key(), score_sheets(totals, Course(title=TITLE), 1))
    rows = list(csv.DictReader(io.StringIO(file.text.lstrip("\ufeff")), delimiter=roster.delimiter))
    marks = [row[column] for row in rows if "Possible" not in str(row)]
    assert marks[-5:] == ["12.2", "", "16.0", "", ""]
    assert "Maximum Grade" not in rows[0] and not any("counts to" in each for each in file.notes)


@pytest.mark.parametrize("text", [CANVAS, WORKSHEET], ids=["Canvas", "Moodle"])
def test_the_number_behind_a_name_tells_two_of_one_name_apart(tmp_path, text):
    outcomes = [
        Outcome("Ann Lee_1", points=80, max_points=100, final=80),
        Outcome("Ann Lee_2", points=40, max_points=100, final=40),
    ]
    content, _ = made(tmp_path, text, outcomes)
    read = gradebooks.moodle_worksheet if text is WORKSHEET else None
    told = read(content) if read else gradebooks.canvas(content, TITLE)
    assert [mark for mark, _ in told.values()][:2] == ["80.0", "40.0"]


@pytest.mark.parametrize("text", [BLACKBOARD, BRIGHTSPACE], ids=["Blackboard", "Brightspace"])
def test_an_ambiguous_row_is_left_empty_and_said(tmp_path, text):
    content, file = made(tmp_path, text, [Outcome("Ann Lee_12-34", "", 80, 100, final=80)])
    read = gradebooks.blackboard if text is BLACKBOARD else gradebooks.brightspace
    assert [mark for mark, _ in read(content, TITLE).values()] == ["", "", "0", "0", "0"]
    assert sum("Ann Lee_12-34 could be theirs" in note for note in file.notes) == 2


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
    assert grades == ["80.0", "80.0", "60.0", "10.0", "0"]
    assert "ben@x: the mark of ann@x, of the same group" in file.notes


def test_a_group_that_handed_in_two_ways_is_for_a_person(tmp_path):
    text = "Email address,Group\nann@x,1\nben@x,1\ncem@x,1\n"
    outcomes = [Outcome("ann@x", "", 80, 100, final=80), Outcome("ben@x", "", 60, 100, final=60)]
    content, _ = made(tmp_path, text, outcomes)
    assert [row["Grade"] for row in gradebooks.rows_of(content)] == ["80.0", "60.0", ""]


def test_the_command_writes_blackboards_file_as_blackboard_does(tmp_path):
    with Book(tmp_path / "out") as book:
        book.finish(graded(""))
    (tmp_path / "list.xls").write_bytes(BLACKBOARD.encode("utf-16"))
    settings = tmp_path / "marks.toml"
    settings.write_text(f'title = "{TITLE}"\n[shares]\nengine = 1\n', encoding="utf-8")
    done = run_in_class(tmp_path, "marks", roster="list.xls", results="out")
    assert done.exit_code == 1, done.output
    told = gradebooks.blackboard((tmp_path / "marks.csv").read_bytes(), TITLE)
    assert told["cem"] == ("70.0", "") and told["ben"] == ("", "")
