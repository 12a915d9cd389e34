"""What a person decides about points: applied on top, with its reason, and never lost."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from grader.classroom.adjustments import Adjustments, load_adjustments
from grader.errors import Stop
from grader.intake.found import Found
from grader.intake.roster import ClassList
from grader.intake.systems import read_roster
from grader.judge.course import Course

DUE = datetime(2026, 5, 4, 22, tzinfo=UTC)
LATE = "[late]\ndue = 2026-05-04T22:00:00Z\nper_day = 10\nat_most = 25\n"


def loaded(tmp_path: Path, text: str) -> Adjustments:
    (tmp_path / "adjustments.toml").write_text(text, encoding="utf-8")
    return load_adjustments(tmp_path / "adjustments.toml")


def adjust(**what: object) -> str:
    lines = [f"{name} = {str(value).lower()}" for name, value in what.items()]
    return "\n[[adjust]]\nstudent = 'Ann'\nreason = 'ill'\n" + "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    "after, points",
    [
        (timedelta(seconds=-1), 80),
        (timedelta(0), 80),
        (timedelta(seconds=1), 70),
        (timedelta(days=1), 70),
        (timedelta(days=1, seconds=1), 60),
        (timedelta(days=9), 55),  # 25 at most
    ],
)
def test_days_that_have_begun_cost_their_points(tmp_path, after, points):
    final = loaded(tmp_path, LATE).decide(Found("ann", (), handed_in=DUE + after), 80)
    assert final.points == points
    assert bool(final.reasons) == (points < 80)


def test_a_mark_of_the_lms_without_a_time_is_one_day(tmp_path):
    final = loaded(tmp_path, LATE).decide(Found("ann", (), late=True), 80)
    assert final.points == 70 and final.reasons == ("1 day late: -10",)


def test_points_never_fall_below_0(tmp_path):
    assert loaded(tmp_path, LATE).decide(Found("ann", (), late=True), 4).points == 0


def test_who_is_excused_loses_nothing_and_it_is_said(tmp_path):
    final = loaded(tmp_path, LATE + adjust(late=False)).decide(Found("ann", (), late=True), 80)
    assert final.points == 80 and final.reasons == ("1 day late: 0", "excused: ill")


def test_points_are_added_and_set_in_the_order_of_the_file(tmp_path):
    both = loaded(tmp_path, LATE + adjust(points=50) + adjust(add=-3))
    final = both.decide(Found("ann", (), late=True), 80)
    assert final.points == 47
    assert final.reasons == ("1 day late: -10", "ill: set to 50", "ill: -3")


def test_nobody_else_is_touched(tmp_path):
    adjustments = loaded(tmp_path, adjust(add=5))
    assert adjustments.decide(Found("ben", ()), 80).reasons == ()
    assert adjustments.find_unused(["ben"]) == ["Ann"] and adjustments.find_unused(["ANN"]) == []


@pytest.mark.parametrize(
    "text, words",
    [
        ("[[adjust]]\nstudent = 'a'\nadd = 1\n", "reason"),
        ("[[adjust]]\nstudent = 'a'\nreason = ' '\nadd = 1\n", "reason = . . must not be empty"),
        (adjust(), "one of"),
        (adjust(add=1, points=2), "one of"),
        (adjust(late=True), "late = false"),
        (adjust(add=1.5), "about .Ann.: add = 1.5 must be a whole number"),
        (adjust(ad=1), "ad"),
        ("[late]\nper_day = -1\n", "0 or more"),
        ("[late]\nper_day = 1\ndue = 2026-05-04T22:00:00\n", "time zone"),
        ("adjust = [", "adjustments.toml"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, text, words):
    with pytest.raises(Stop, match=words):
        loaded(tmp_path, text)


def test_a_date_alone_is_the_end_of_that_day_in_the_schools_zone(tmp_path):
    """As in course.toml; people write extensions so."""
    text = 'zone = "Asia/Kolkata"\n[late]\ndue = 2026-05-04\nper_day = 10\n'
    decided = loaded(tmp_path, text + adjust(due="2026-05-09"))
    assert decided.find_due(Found("ann", ())) == datetime(2026, 5, 9, 18, 29, 59, tzinfo=UTC)
    assert decided.find_due(Found("ben", ())) == datetime(2026, 5, 4, 18, 29, 59, tzinfo=UTC)
    with pytest.raises(Stop, match="due = 2026-05-04 23:59:59 needs its time zone"):
        loaded(tmp_path, "[late]\ndue = 2026-05-04\n")


@pytest.mark.parametrize(
    "line, words",
    [
        ("points = 70.5", "about 'Ann': points = 70.5 must be a whole number"),
        ("add = '5'", "about 'Ann': add = '5' must be a whole number"),
        ("bonus = true", "about 'Ann': bonus = True must be a whole number"),
        ("due = '09.05.2026'", "must be a date without quotes, as in due = 2027"),
    ],
)
def test_what_is_no_number_or_date_is_said_in_the_words_of_the_file(tmp_path, line, words):
    name, _, value = line.partition(" = ")
    with pytest.raises(Stop) as refused:
        loaded(tmp_path, LATE + f"[[adjust]]\nstudent = 'Ann'\nreason = 'x'\n{name} = {value}\n")
    assert words in str(refused.value)


def test_a_missing_file_is_said(tmp_path):
    with pytest.raises(Stop, match="no adjustments at"):
        load_adjustments(tmp_path / "none.toml")


# ---------------------------------------------------------------- all that a person decides


def final(tmp_path: Path, text: str, points: int | None = 80, **found: object):
    return loaded(tmp_path, text).decide(Found("ann", (), **found), points)


def late_by(**time: float) -> dict[str, datetime]:
    return {"handed_in": DUE + timedelta(**time)}


@pytest.mark.parametrize(
    "line, after, points",
    [
        ("grace = 15", {"minutes": 15}, 80),
        ("grace = 15", {"minutes": 16}, 70),
        ("free_days = 2", {"days": 2}, 80),
        ("free_days = 2", {"days": 3}, 70),
        ("cap = 60", {"hours": 1}, 60),
        ("cap = 60", {"hours": -1}, 80),
        ("closed_after = 3", {"days": 3}, 55),  # at_most
        ("closed_after = 3", {"days": 3, "seconds": 1}, 0),
    ],
)
def test_rules_of_lateness(tmp_path, line, after, points):
    assert final(tmp_path, LATE + line + "\n", **late_by(**after)).points == points


def test_a_share_of_what_was_earned_is_rounded_for_the_student(tmp_path):
    share = LATE.replace("per_day = 10", 'per_day = "10%"').replace("at_most = 25\n", "")
    assert final(tmp_path, share, 87, **late_by(hours=1)).points == 87 - 8
    assert final(tmp_path, share, 87, **late_by(days=20)).points == 0


def test_an_extension_is_the_students_own_date(tmp_path):
    text = LATE + adjust(due="2026-05-06T22:00:00Z")
    on_time = final(tmp_path, text, **late_by(days=2))
    assert on_time.points == 80 and on_time.due == DUE + timedelta(days=2)
    assert on_time.reasons == ("due 2026-05-06 22:00 +00:00: ill",)
    assert final(tmp_path, text, **late_by(days=2, seconds=1)).points == 70
    assert final(tmp_path, text, late=True).points == 80  # late, and nobody knows by how much


def test_points_by_hand_are_the_mark_of_what_could_not_be_graded(tmp_path):
    by_hand = final(tmp_path, LATE + adjust(points=70), None)
    assert (by_hand.points, by_hand.by_hand) == (70, True)
    added = final(tmp_path, LATE + adjust(add=5), None)
    assert added.points is None and "set points" in added.reasons[0]


def test_a_cap_and_a_bonus(tmp_path):
    assert final(tmp_path, LATE + adjust(cap=50)).points == 50
    given = final(tmp_path, LATE + adjust(bonus=3))
    assert (given.points, given.reasons) == (80, ("ill: +3 bonus",))


def test_times_without_a_zone_are_the_schools(tmp_path):
    naive = {"handed_in": datetime(2026, 5, 5, 0, 30)}
    berlin = 'zone = "Europe/Berlin"\n[late]\ndue = 2026-05-04T23:59:00\nper_day = 10\n'
    assert final(tmp_path, berlin, **naive).points == 70
    assert final(tmp_path, LATE, **naive).points == 70  # as the due date's, UTC here
    west = LATE.replace("22:00:00Z", "22:00:00-05:00")
    assert final(tmp_path, west, handed_in=datetime(2026, 5, 4, 21, 59)).points == 80


def test_one_decision_for_several_and_an_address_by_its_first_half(tmp_path):
    text = "[[adjust]]\nstudent = ['ann', 'ben@x']\nreason = 'pair'\nadd = 1\n"
    decided = loaded(tmp_path, text)
    assert decided.decide(Found("ben@x", ()), 5).points == 6
    assert decided.decide(Found("ann@y", ()), 5).points == 6
    decided.resolve(["ann@y", "ben@x"], ClassList())
    with pytest.raises(Stop, match="could be ann@x or ann@y: write one of these names"):
        decided.resolve(["ann@x", "ann@y"], ClassList())


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
    text = f"[[adjust]]\nstudent = {who!r}\nreason = 'ill'\npoints = 3\n"
    decided = loaded(tmp_path, text).resolve(["ann@x.edu", "cem@x.edu"], people)
    assert decided.students == ["cem@x.edu"]
    assert decided.decide(Found("cem@x.edu", ()), None).points == 3


def test_a_name_that_two_have_is_refused_with_both(tmp_path, people):
    text = "[[adjust]]\nstudent = 'Ann Bell'\nreason = 'ill'\npoints = 3\n"
    with pytest.raises(Stop, match="'Ann Bell' in the adjustments could be "):
        loaded(tmp_path, text).resolve(["ann@x.edu", "bell@x.edu"], people)
    twice = text.replace("Ann Bell", "cem") + text.replace("Ann Bell", "coz")
    with pytest.raises(Stop, match=r"points of 'cem@x.edu' are set twice"):
        loaded(tmp_path, twice).resolve(["cem@x.edu"], people)


SHARES = "[late]\ndue = 2026-05-04T22:00:00Z\nper_day = '10%'\nat_most = '50%'\ncap = '80%'\n"


@pytest.mark.parametrize(
    "days, earned, points", [(1, 100, 80), (1, 60, 54), (4, 60, 36), (9, 60, 30), (9, 20, 10)]
)
def test_lateness_in_shares_of_what_was_earned_and_of_full_marks(tmp_path, days, earned, points):
    after = DUE + timedelta(days=days)
    final = loaded(tmp_path, SHARES).decide(Found("ann", (), handed_in=after), earned)
    assert final.points == points


@pytest.mark.parametrize("line", ["per_day = 41", "cap = 80", "at_most = 100"])
def test_more_points_than_a_course_has_are_refused(tmp_path, line):
    (tmp_path / "a.toml").write_text(f"[late]\n{line}\n", encoding="utf-8")
    with pytest.raises(Stop, match=rf"late: {line} is more than the \d+ points that there are"):
        load_adjustments(tmp_path / "a.toml", Course(todos=("1", "2", "8a")))


def test_a_cap_above_all_points_is_refused(tmp_path):
    with pytest.raises(Stop, match="cap = 300 of 'Ann' is more than the 100 that there are"):
        loaded(tmp_path, adjust(cap=300))
