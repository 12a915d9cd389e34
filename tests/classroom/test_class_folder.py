"""Test class folders, which remember options and the course."""

import csv
import re
from pathlib import Path

import classes
import packed
import pytest
from command_line import call_class
from points_pool import Inline

from grader.classroom import grading
from grader.classroom.folder import read_class_folder
from grader.classroom.marks import Marking, Part, Parts
from grader.classroom.nbgrader import gradebook

COURSE = 'title = "Lab 3"\ntodos = ["8a"]\nout_of = 10\n[points]\n8a = 20\n'
POINTS = {"ann": 5, "ben": 10, "cem": 20}


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Make a class list, an export, a course, and a stand-in for grading."""
    monkeypatch.setattr(grading, "open_executor", lambda wanted: Inline())
    rows = [f"{name}@x.edu,{name.title()} Lee" for name in (*POINTS, "dora")]
    (tmp_path / "list.csv").write_text("\n".join(["Email address,Full name", *rows, ""]))
    (tmp_path / "autumn.toml").write_text(COURSE)
    for name, points in POINTS.items():
        classes.put(tmp_path / "export" / f"{name}.zip", packed.as_zip(classes.work(points)))
    return tmp_path


def make(place: Path, *more: object) -> Path:
    words = ("--roster", place / "list.csv", "--course", place / "autumn.toml")
    said = call_class("new", place / "lab", *words, *more)
    assert "No problems found" in said and "Lab 3, 20 points" in said and "4 students" in said
    return place / "lab"


def read_grades(lab: Path) -> list[str]:
    with open(lab / "marks.csv", encoding="utf-8") as table:
        return [row["Grade"] for row in csv.DictReader(table)]


def test_no_command_is_told_twice_what_the_class_is(place: Path):
    lab = make(place, "--submissions", place / "export")
    assert "3 submissions" in call_class("grade", lab)
    with open(lab / "results.class.csv", encoding="utf-8-sig") as table:
        assert [row["points"] for row in csv.DictReader(table)] == ["5", "10", "20"]
    assert "4 of 4 marks" in call_class("marks", lab)
    assert read_grades(lab) == ["2.5", "5.0", "10.0", "0"]
    assert "Lab 3" in (lab / "results.class.html").read_text(encoding="utf-8")


def test_bonus_tasks_are_named_too(place: Path):
    (place / "autumn.toml").write_text(
        'todos = ["8a", "8c", "B1", "B4"]\npoints = { 8a = 3, 8c = 1 }\n'
    )
    said = call_class("new", place / "lab", "--course", place / "autumn.toml")
    assert "4 points, TODO 8a, 8c; bonus B1, B4" in said


def test_marks_are_rounded_and_absent_as_the_settings_say(place: Path):
    lab = place / "lab"
    lab.mkdir()
    (lab / "marks.toml").write_text('decimals = 0\nabsent = "none"\nshares = { engine = 7 }\n')
    make(place, "--submissions", place / "export")
    call_class("grade", lab)
    assert "4 of 4 marks" in call_class("marks", lab)
    assert read_grades(lab) == ["3", "5", "10", "none"]


def test_marks_of_notebooks_come_from_the_gradebook_of_nbgrader(
    place: Path, monkeypatch: pytest.MonkeyPatch
):
    lab = place / "lab"
    lab.mkdir()
    (lab / "gradebook.db").write_bytes(b"")
    (lab / "marks.toml").write_text("shares = { engine = 3, quiz = 1 }\n")
    make(place)
    asked = []

    def read_parts(folder: Path, marking: Marking) -> dict[str, Parts]:
        asked.append(folder)
        return {f"{name}@x.edu": {"engine": Part(points, 20)} for name, points in POINTS.items()}

    monkeypatch.setattr(gradebook, "read_parts", read_parts)
    call_class("marks", lab)
    assert asked == [lab] and read_grades(lab) == ["1.9", "3.8", "7.5", "0"]


def test_the_export_may_come_later(place: Path):
    lab = make(place)
    said = call_class("grade", lab)
    assert "there is nothing at" in said and "--submissions FILE" in said
    (place / "export").rename(lab / "submissions")
    assert "3 submissions" in call_class("grade", lab)


def test_another_course_over_results_is_refused_unless_it_is_wanted(place: Path):
    lab = make(place, "--submissions", place / "export")
    call_class("grade", lab)
    before = (lab / "class.toml").read_text(encoding="utf-8")
    (place / "other.toml").write_text(COURSE.replace("20", "30"))
    other = ("--course", place / "other.toml")
    said = call_class("new", lab, *other)
    assert "TODO 8a has 20 points there, and 30 here" in said and "--other-course" in said
    assert (lab / "class.toml").read_text(encoding="utf-8") == before
    call_class("new", lab, *other, "--other-course")
    for command in ("grade", "marks", "feedback", "questions"):
        assert "TODO 8a has 20 points there, and 30 here" in call_class(command, lab), command
    assert "3 submissions" in call_class("grade", lab, "--other-course")


def test_commands_that_a_message_names_can_be_typed(place: Path):
    spaced = place / "lab 5"
    assert f"grader class grade '{spaced}'" in call_class("new", spaced)
    assert f"grader class new '{place / 'no lab'}' --roster" in call_class(
        "grade", place / "no lab"
    )


def test_lines_that_a_person_wrote_stay(place: Path):
    lab = make(place)
    file = lab / "class.toml"
    text = re.sub("seed = .*", "seed = 3 # drawn", file.read_text(encoding="utf-8"))
    file.write_text(f"# mine\n{text}", "utf-8")
    call_class("new", lab, "--submissions", place / "export")
    text = file.read_text(encoding="utf-8")
    assert text.startswith("# mine\n") and "seed = 3 # drawn" in text
    assert f'submissions = "{place.as_posix()}/export"' in text


@pytest.mark.parametrize(
    "line, words",
    [
        ("colour = 3", "unknown field `colour`"),
        ('system = "nosuch"', "'nosuch' is not one of"),
        ("results = ", "Invalid value (at line"),
        ("seed = 'x'", "Expected `int"),
    ],
)
def test_a_line_that_nobody_can_mean_is_a_sentence(place: Path, line: str, words: str):
    lab = make(place)
    file = lab / "class.toml"
    name = line.partition(" ")[0]
    others = [each for each in file.read_text(encoding="utf-8").splitlines() if name not in each]
    file.write_text("\n".join([*others, line, ""]), encoding="utf-8")
    assert words in call_class("grade", lab)


def test_a_class_draws_a_seed_that_nobody_can_try_and_keeps_it(place: Path):
    lab = make(place)
    call_class("new", place / "other")
    first, second = (read_class_folder(each).settings.seed for each in (lab, place / "other"))
    assert first and second and first != second and max(first, second).bit_length() > 100
    call_class("new", lab, "--submissions", place / "export")
    assert read_class_folder(lab).settings.seed == first
    call_class("new", lab, "--seed", "7")
    assert read_class_folder(lab).settings.seed == 7


def test_what_needs_review_names_the_file_of_decisions_and_takes_them(place: Path):
    classes.put(place / "export" / "dora.zip", b"PK broken")
    lab = make(place)
    (place / "export").rename(lab / "submissions")
    assert f"1 needs manual review: set points in {lab / 'decisions.toml'}" in call_class(
        "grade", lab
    )
    decision = '[[adjust]]\nstudent = "Dora Lee"\npoints = 9\nreason = "shown in the lab"\n'
    (lab / "decisions.toml").write_text(decision, encoding="utf-8")
    assert "manual review" not in call_class("grade", lab)
    assert "4 of 4 marks" in call_class("marks", lab)
