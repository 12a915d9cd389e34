"""Test that all problems of a course are reported at once, before grading."""

from pathlib import Path

import classes
import packed
import pytest
from command_line import run_grader

from grader.classroom.course_check import find_problems
from grader.classroom.folder import ClassFolder, Settings
from grader.cli import classroom

GOOD = "Email address,Group\nann@x.edu,1\nben@x.edu,1\n"


@pytest.fixture
def place(tmp_path: Path) -> Path:
    (tmp_path / "list.csv").write_text(GOOD, encoding="utf-8")
    classes.put(tmp_path / "class" / "ann.zip", packed.as_zip(classes.work(3)))
    classes.put(tmp_path / "class" / "ben.zip", packed.as_zip(classes.work(3)))
    return tmp_path


def list_problems(place: Path, **texts: str) -> list[str]:
    names = {"roster": "list.csv", "adjust": "decisions.toml", "marking": "marks.toml"}
    for name, text in {"roster": GOOD, **texts}.items():
        (place / names[name]).write_text(text, encoding="utf-8")
    return find_problems(ClassFolder(place, Settings(roster="list.csv", submissions="class")))


def test_of_what_is_well_nothing_is_said(place, monkeypatch):
    monkeypatch.setattr(classroom, "find_release_problems", lambda _: [])  # see test_courses.py
    assert list_problems(place, adjust="[[adjust]]\nstudent = 'ann'\nadd = 1\nreason = 'x'\n") == []
    done = run_grader("course-check")
    assert done.exit_code == 0 and "No problems found" in done.output


def test_all_that_would_go_wrong_is_said_at_once(place):
    classes.put(place / "class" / "cem.rar", b"Rar!")
    classes.put(place / "class" / "dora.docx", b"")
    classes.put(place / "class" / "finn.zip", packed.as_zip({"a.docx": ""}))
    adjust = (
        "[late]\ndue = 2026-05-04T12:00:00Z\nper_day = 5\n"
        "[[adjust]]\nstudent = 'nobody'\nadd = 1\nreason = 'x'\n"
    )
    faults = list_problems(place, adjust=adjust, marking="title = 1\n")
    for words in (
        "cem: the archive is broken",
        "finn: nothing of the lab",
        "not in the class list: cem, finn",
        "no time is known of ann, ben, cem, finn",
        "no student 'nobody' in this class",
        "marks.toml",
    ):
        assert any(words in fault for fault in faults), (words, faults)


@pytest.mark.parametrize(
    "roster, words",
    [
        ("Email address\nann@x.edu\nann@x.edu\n", "is listed 2 times"),
        ("Email address,Name\nann@x.edu,A\n,B\n", "1 row has no 'Email address'"),
        (
            "First name,Last name,Email address\nA,L,a@x.edu\nA,L,b@x.edu\n",
            "a@x.edu and b@x.edu have one name",
        ),
        ("Email address,Group\nann@x.edu,\n", "no group shares a mark"),
        ("Name\nAnn\n", "has none of"),
    ],
)
def test_a_class_list_that_does_not_tell_people_apart(place, roster, words):
    assert any(words in fault for fault in list_problems(place, roster=roster))


def test_a_gradebook_without_the_assignments_column(place):
    """The column's title is the course's, or that of marks.toml."""
    canvas = classes.canvas(place / "other", []).replace("(77)", "(77),Essay (78)")
    for title, marking in (("Physics engine", {}), ("Essay", {"marking": "title = 'Essay'\n"})):
        marking = {name: f"{text}shares.engine = 1\n" for name, text in marking.items()}
        assert not any("no column" in f for f in list_problems(place, roster=canvas, **marking))
        other = canvas.replace(f"{title} (", "Other (")
        assert any(
            f"no column {title!r}" in f for f in list_problems(place, roster=other, **marking)
        )


@pytest.mark.parametrize("system", ["moodle", "blackboard", "brightspace"])
def test_marks_out_of_another_number_than_the_gradebooks(place, system):
    roster = classes.SYSTEMS[system](place / "other", classes.students())
    marking = 'title = "Physics engine"\nshares.engine = 1\ntotal = '
    assert any(
        "counts to 20" in f for f in list_problems(place, roster=roster, marking=marking + "100")
    )
    fine = list_problems(place, roster=roster, marking=f"{marking}{classes.FULL}")
    assert not any("counts to" in fault for fault in fine)


def test_decisions_are_checked_as_a_whole(place):
    adjust = (
        "[[adjust]]\nstudent = 'ann'\npoints = 700\nreason = 'x'\n"
        "[[adjust]]\nstudent = 'ann'\npoints = 7\nreason = 'x'\n"
    )
    (fault,) = list_problems(place, adjust=adjust)
    for words in ("points = 700", "set twice"):
        assert words in fault
