"""What a person decides about points: applied on top, with its reason, and never lost."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from grader.classroom.adjustments import Adjustments, load_adjustments
from grader.classroom.intake.found import Found
from grader.judge.submission import CannotGrade

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
    final = loaded(tmp_path, LATE).final(Found("ann", (), handed_in=DUE + after), 80)
    assert final.points == points
    assert bool(final.reasons) == (points < 80)


def test_a_mark_of_the_lms_without_a_time_is_one_day(tmp_path):
    final = loaded(tmp_path, LATE).final(Found("ann", (), late=True), 80)
    assert final.points == 70 and final.reasons == ("1 day late: -10",)


def test_points_never_fall_below_0(tmp_path):
    assert loaded(tmp_path, LATE).final(Found("ann", (), late=True), 4).points == 0


def test_who_is_excused_loses_nothing_and_it_is_said(tmp_path):
    final = loaded(tmp_path, LATE + adjust(late=False)).final(Found("ann", (), late=True), 80)
    assert final.points == 80 and final.reasons == ("1 day late: 0", "excused: ill")


def test_points_are_added_and_set_in_the_order_of_the_file(tmp_path):
    both = loaded(tmp_path, LATE + adjust(points=50) + adjust(add=-3))
    final = both.final(Found("ann", (), late=True), 80)
    assert final.points == 47
    assert final.reasons == ("1 day late: -10", "ill: set to 50", "ill: -3")


def test_nobody_else_is_touched(tmp_path):
    adjustments = loaded(tmp_path, adjust(add=5))
    assert adjustments.final(Found("ben", ()), 80).reasons == ()
    assert adjustments.unused(["ben"]) == ["Ann"] and adjustments.unused(["ANN"]) == []


@pytest.mark.parametrize(
    "text, words",
    [
        ("[[adjust]]\nstudent = 'a'\nadd = 1\n", "reason"),
        ("[[adjust]]\nstudent = 'a'\nreason = ' '\nadd = 1\n", "needs a reason"),
        (adjust(), "one of"),
        (adjust(add=1, points=2), "one of"),
        (adjust(late=True), "late = false"),
        (adjust(add=1.5), "int"),
        (adjust(ad=1), "ad"),
        ("[late]\nper_day = -1\n", "0 or more"),
        ("[late]\nper_day = 1\ndue = 2026-05-04T22:00:00\n", "time zone"),
        ("adjust = [", "adjustments.toml"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, text, words):
    with pytest.raises(CannotGrade, match=words):
        loaded(tmp_path, text)


def test_a_missing_file_is_said(tmp_path):
    with pytest.raises(CannotGrade, match="no adjustments at"):
        load_adjustments(tmp_path / "none.toml")
