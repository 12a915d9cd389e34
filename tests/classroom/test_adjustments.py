"""Test decisions about points: applied after the checks, with reasons, and never lost."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from grader.classroom.adjustments import Adjustments, load_adjustments
from grader.errors import Stop
from grader.intake.found import Work
from grader.intake.roster import ClassList
from grader.intake.systems import read_roster
from grader.judge.course import FULL, Course

DUE = datetime(2026, 5, 4, 22, tzinfo=UTC)
LATE = "[late]\ndue = 2026-05-04T22:00:00Z\nper_day = 10\nat_most = 25\n"


def load(tmp_path: Path, text: str, course: Course = FULL) -> Adjustments:
    (tmp_path / "adjustments.toml").write_text(text, encoding="utf-8")
    return load_adjustments(tmp_path / "adjustments.toml", course)


def adjust(*lines: str, student: str = "'Ann'", **values: object) -> str:
    lines += tuple(f"{name} = {str(value).lower()}" for name, value in values.items())
    return f"\n[[adjust]]\nstudent = {student}\nreason = 'ill'\n" + "\n".join(lines) + "\n"


def final(tmp_path: Path, text: str, points: int | None = 80, **found: object):
    return load(tmp_path, text).decide(Work("ann", (), **found), points)


SHARE = LATE.replace("per_day = 10", 'per_day = "10%"').replace("at_most = 25\n", "")
SHARES = "[late]\ndue = 2026-05-04T22:00:00Z\nper_day = '10%'\nat_most = '50%'\ncap = '80%'\n"


@pytest.mark.parametrize(
    "rules, after, earned, points",
    [
        (LATE, {"seconds": -1}, 80, 80),
        (LATE, {}, 80, 80),
        (LATE, {"seconds": 1}, 80, 70),
        (LATE, {"days": 1}, 80, 70),
        (LATE, {"days": 1, "seconds": 1}, 80, 60),
        (LATE, {"days": 9}, 80, 55),  # at_most
        (LATE, {"days": 1}, 4, 0),
        (LATE + "grace = 15\n", {"minutes": 15}, 80, 80),
        (LATE + "grace = 15\n", {"minutes": 16}, 80, 70),
        (LATE + "free_days = 2\n", {"days": 2}, 80, 80),
        (LATE + "free_days = 2\n", {"days": 3}, 80, 70),
        (LATE + "cap = 60\n", {"hours": 1}, 80, 60),
        (LATE + "cap = 60\n", {"hours": -1}, 80, 80),
        (LATE + "closed_after = 3\n", {"days": 3}, 80, 55),
        (LATE + "closed_after = 3\n", {"days": 3, "seconds": 1}, 80, 0),
        (SHARE, {"hours": 1}, 87, 79),  # rounded for the student
        (SHARE, {"days": 20}, 87, 0),
        (SHARES, {"days": 1}, 100, 80),
        (SHARES, {"days": 1}, 60, 54),
        (SHARES, {"days": 4}, 60, 36),
        (SHARES, {"days": 9}, 60, 30),
        (SHARES, {"days": 9}, 20, 10),
    ],
)
def test_rules_of_lateness(tmp_path, rules, after, earned, points):
    decided = final(tmp_path, rules, earned, handed_in=DUE + timedelta(**after))
    assert decided.points == points
    assert decided.reasons or points == earned


@pytest.mark.parametrize(
    "decisions, points, reasons",
    [
        ("", 70, ["1 day late: -10"]),
        (adjust(late=False), 80, ["1 day late: 0", "excused: ill"]),
        (
            adjust(points=50) + adjust(add=-3),
            47,
            ["1 day late: -10", "ill: set to 50", "ill: -3"],
        ),
        (adjust(cap=50), 50, ["1 day late: -10", "ill: 50 at most"]),
        (adjust(bonus=3), 70, ["1 day late: -10", "ill: +3 bonus"]),
        (adjust(add=5, student="'Ben'"), 70, ["1 day late: -10"]),
    ],
)
def test_decisions_count_in_the_order_of_the_file(tmp_path, decisions, points, reasons):
    """The learning system marked it late without a time, which counts as one day."""
    decided = final(tmp_path, LATE + decisions, late=True)
    assert (decided.points, list(decided.reasons)) == (points, reasons)


def test_an_extension_is_the_students_own_date(tmp_path):
    text = LATE + adjust(due="2026-05-06T22:00:00Z")
    on_time = final(tmp_path, text, handed_in=DUE + timedelta(days=2))
    assert on_time.points == 80 and on_time.due == DUE + timedelta(days=2)
    assert on_time.reasons == ("due 2026-05-06 22:00 +00:00: ill",)
    assert final(tmp_path, text, handed_in=DUE + timedelta(days=2, seconds=1)).points == 70
    assert final(tmp_path, text, late=True).points == 80  # late by an unknown time


def test_points_by_hand_are_the_mark_of_what_could_not_be_graded(tmp_path):
    by_hand = final(tmp_path, LATE + adjust(points=70), None)
    assert (by_hand.points, by_hand.by_hand) == (70, True)
    added = final(tmp_path, LATE + adjust(add=5), None)
    assert added.points is None and "set points" in added.reasons[0]


REFUSED = [
    ("[[adjust]]\nstudent = 'a'\nadd = 1\n", "reason"),
    ("[[adjust]]\nstudent = 'a'\nreason = ' '\nadd = 1\n", "reason = ' ' must not be empty"),
    (adjust(), "write exactly one of"),
    (adjust(add=1, points=2), "write exactly one of"),
    (adjust(late=True), "late = false"),
    (adjust("add = 1.5"), "about 'Ann': add = 1.5 must be a whole number"),
    (adjust("points = 70.5"), "about 'Ann': points = 70.5 must be a whole number"),
    (adjust("add = '5'"), "about 'Ann': add = '5' must be a whole number"),
    (adjust("bonus = true"), "about 'Ann': bonus = True must be a whole number"),
    (LATE + adjust("due = '09.05.2026'"), "must be a date without quotes, as in due = 2027"),
    (adjust(ad=1), "ad"),
    (adjust(cap=300), "cap = 300 of 'Ann' is more than the 100 that there are"),
    ("[late]\nper_day = -1\n", "0 or more"),
    ("[late]\nper_day = 1\ndue = 2026-05-04T22:00:00\n", "time zone"),
    ("[late]\ndue = 2026-05-04\n", "due = 2026-05-04 23:59:59 needs its time zone"),
    ("adjust = [", "adjustments.toml"),
]


@pytest.mark.parametrize("text, words", REFUSED)
def test_what_cannot_be_meant_is_refused(tmp_path, text, words):
    with pytest.raises(Stop) as refused:
        load(tmp_path, text)
    assert words in str(refused.value)


@pytest.mark.parametrize("line", ["per_day = 41", "cap = 80", "at_most = 100"])
def test_more_points_than_a_course_has_are_refused(tmp_path, line):
    with pytest.raises(Stop, match=rf"late: {line} is more than the \d+ points that there are"):
        load(tmp_path, f"[late]\n{line}\n", Course(todos=("1", "2", "8a")))
    with pytest.raises(Stop, match="no adjustments at"):
        load_adjustments(tmp_path / "none.toml")


def test_times_without_a_zone_are_the_schools_and_dates_end_with_their_day(tmp_path):
    naive = {"handed_in": datetime(2026, 5, 5, 0, 30)}
    berlin = 'zone = "Europe/Berlin"\n[late]\ndue = 2026-05-04T23:59:00\nper_day = 10\n'
    assert final(tmp_path, berlin, **naive).points == 70
    assert final(tmp_path, LATE, **naive).points == 70  # as the due date's, UTC here
    west = LATE.replace("22:00:00Z", "22:00:00-05:00")
    assert final(tmp_path, west, handed_in=datetime(2026, 5, 4, 21, 59)).points == 80
    text = 'zone = "Asia/Kolkata"\n[late]\ndue = 2026-05-04\nper_day = 10\n'
    decided = load(tmp_path, text + adjust(due="2026-05-09"))
    assert decided.find_due(Work("ann", ())) == datetime(2026, 5, 9, 18, 29, 59, tzinfo=UTC)
    assert decided.find_due(Work("ben", ())) == datetime(2026, 5, 4, 18, 29, 59, tzinfo=UTC)


# ---------------------------------------------------------------- names of students

ROSTER = (
    "Identifier,Full name,ID number,Email address,Username\n"
    "Participant 4711,Ann Bell,007,ann@x.edu,abell\n"
    "Participant 4712,Ann Bell,008,bell@x.edu,ann2\n"
    "Participant 4713,Cem Öz,009,cem@x.edu,coz\n"
)


@pytest.fixture
def people(tmp_path: Path) -> ClassList:
    (tmp_path / "list.csv").write_text(ROSTER, encoding="utf-8")
    return ClassList(read_roster(tmp_path / "list.csv"))


@pytest.mark.parametrize(
    "who", ["cem@x.edu", "CEM", "Cem Öz", "009", "9", "coz", "4713", "Participant 4713"]
)
def test_a_student_is_known_by_every_name_of_the_class_list(tmp_path, people, who):
    decided = load(tmp_path, adjust(student=repr(who), points=3))
    decided = decided.resolve(["ann@x.edu", "cem@x.edu"], people)
    assert decided.students == ["cem@x.edu"]
    assert decided.decide(Work("cem@x.edu", ()), None).points == 3


def test_one_decision_for_several_and_a_name_that_two_have(tmp_path, people):
    decided = load(tmp_path, adjust(student="['ann', 'ben@x']", add=1))
    assert decided.decide(Work("ben@x", ()), 5).points == 6
    assert decided.decide(Work("ann@y", ()), 5).points == 6
    assert decided.find_unused(["ben@x"]) == ["ann"]
    decided.resolve(["ann@y", "ben@x"], ClassList())
    with pytest.raises(Stop, match="could be ann@x or ann@y: write one of these names"):
        decided.resolve(["ann@x", "ann@y"], ClassList())
    with pytest.raises(Stop, match="'Ann Bell' in the adjustments could be "):
        load(tmp_path, adjust(student="'Ann Bell'", points=3)).resolve(
            ["ann@x.edu", "bell@x.edu"], people
        )
    twice = adjust(student="'cem'", points=3) + adjust(student="'coz'", points=3)
    with pytest.raises(Stop, match=r"points of 'cem@x.edu' are set twice"):
        load(tmp_path, twice).resolve(["cem@x.edu"], people)
