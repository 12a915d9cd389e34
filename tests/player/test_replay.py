"""Test replays: their data, the first difference, the script, and the page in a browser."""

import json
import math
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest
from conftest import Once, only_some
from one_worker import child_opener
from page_readers import HARMLESS, HOSTILE, Reader, Screen, barriers
from whole_bank import bank

import grader.player.replay as replays
from grader.bank.members import Member, put_regions
from grader.bank.verify import shared_worker
from grader.checks.todo_2 import checks as todo_2
from grader.checks.todo_4 import checks as todo_4
from grader.checks.todo_5 import checks as todo_5
from grader.checks.todo_8 import checks as todo_8
from grader.checks.todo_b1 import checks as todo_b1
from grader.checks.todo_b5 import checks as todo_b5
from grader.checks.whole import checks as whole
from grader.judge.failures import Failing
from grader.judge.grade import grade
from grader.judge.lab import Lab
from grader.judge.result import CheckResult, Result
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall.children import ChildEnded
from grader.player.graded import grade_with_replays
from grader.player.page import make_page
from grader.player.pairing import pair_runs
from grader.player.recording import MAX_MOMENTS, Recorder, RecordingLab, record_again
from grader.player.replay import ExpectedRuns, Replays
from grader.player.runs import Line, Replay, Run
from grader.player.script import (
    Step,
    Translator,
    write_polynomial,
    write_script,
)
from grader.protocol import (
    Answered,
    BodyLook,
    BodyRow,
    BodyValue,
    Call,
    ContactRow,
    Get,
    Items,
    Moment,
    Record,
    Returned,
    Set,
    ShapeLook,
    Vec,
    WithMoments,
)
from grader.report.files import as_json, write_json

MISTAKES = (
    "1-clamp-is-turned-round",
    "4-clamps-the-increment",
    "6-no-cap",
    "7b-moment-of-a-ring",
    "8b-old-acceleration-twice",
)
PILE = "4-every_contact_of_a_pile_keeps_within_its_friction.html"
DISC = BodyLook(0, [ShapeLook([(0.0, 0.0)], 10.0)], 1.0, 50.0)


# ---------------------------------------------------------------- one submission with many mistakes


def grade_mistakes(once: Once, name: str, todos: set[str]) -> Path:
    """Make the solution with mistakes in several TODOs, grade some, and write the result beside it.

    One test process grades it for all.
    """

    def fill(top: Path) -> None:
        folder = top / "mistaken"
        chosen = [m for m in bank() if m.name in MISTAKES and m.form == "package"]
        chosen[0].build(folder)
        for member in chosen[1:]:
            put_regions(member.regions, folder)
        options = Options(shipped_reference(), only=frozenset(todos))
        result = grade_with_replays(folder, options, top / "pages", shared_worker())
        write_json(result, top / "result.json")

    return once(name, fill) / "mistaken"


@pytest.fixture(scope="session")
def mistaken(once: Once) -> Path:
    return grade_mistakes(once, "replays-of-mistakes", {"1", "4", "8b"})


@pytest.fixture(scope="session")
def graded_result(mistaken: Path) -> Result:
    return msgspec.json.decode((mistaken.parent / "result.json").read_bytes(), type=Result)


@pytest.fixture(scope="session")
def pages(mistaken: Path) -> Path:
    return mistaken.parent / "pages"


@pytest.fixture(scope="session")
def more_pages(once: Once) -> Path:
    """Make the replays of two more TODOs, for the soak."""
    return grade_mistakes(once, "more-replays", {"6", "7b"}).parent / "pages"


def read_replay(path: Path) -> dict[str, Any]:
    """Return the data in a page."""
    text = path.read_text(encoding="utf-8")
    (found,) = re.findall(r'id="replay">(.*?)</script>', text, re.DOTALL)
    return json.loads(found)


def line_of_parting(data: dict[str, Any]) -> tuple[int, dict[str, Any]]:
    """Return the number and the line of the request at which the runs differ."""
    lines = data["scenes"][data["parting"]["scene"]]["lines"]
    last = max(n for n, line in enumerate(lines) if line["at"] <= data["parting"]["moment"])
    return last, lines[last]


def test_every_failed_check_that_gave_an_answer_has_a_replay(graded_result: Result, pages: Path):
    failed = [(t, c) for t in graded_result.todos for c in t.checks if c.state == "not yet"]
    assert len(failed) > 12
    for todo, check in failed:
        assert check.replay == f"pages/{todo.id}-{check.id}.html"
        assert (pages.parent / check.replay).is_file()
        assert (pages.parent / check.replay).with_suffix(".py").is_file()
    passed = [c for t in graded_result.todos for c in t.checks if c.state != "not yet"]
    assert passed and all(check.replay is None for check in passed)
    assert len(list(pages.iterdir())) == 2 * len(failed)


def test_marks_and_reasons_are_the_same_with_and_without_replays(
    mistaken: Path, pages: Path, tmp_path: Path
):
    options = Options(shipped_reference(), only=frozenset({"8b"}))
    plain = grade(mistaken, options, shared_worker())
    seen = grade_with_replays(mistaken, options, tmp_path / "again", shared_worker())
    blank = re.sub(rb'"replay": "[^"]*"', b'"replay": null', as_json(seen))
    assert blank == as_json(plain) != as_json(seen)
    again = {path.name: path.read_bytes() for path in (tmp_path / "again").iterdir()}
    assert again == {path.name: path.read_bytes() for path in pages.glob("8b-*")}


def test_pages_need_nothing_else_and_are_not_large(pages: Path):
    for path in pages.glob("*.html"):
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"(https?:)?//[a-z]+\.[a-z]|\b(src|href)=|@import|url\(", text), path
        assert len(text) < 250_000, path


# ---------------------------------------------------------------- the first difference


@pytest.mark.parametrize(
    ("page", "line"),
    [
        (
            "1-overlap_from_outside_points_into_the_box",
            {"yours": "None", "expected": "normal (0, 1), depth 5, point (10, -20)"},
        ),
        ("4-friction_stops_at_its_limit_both_ways", {"code": "world.step(1 / 120)"}),
        pytest.param(
            "7b-a_ball_resists_turning_as_a_full_disc",
            {
                "yours": "a body of mass 1, moment 100",
                "expected": "a body of mass 1, moment 50",
            },
            marks=pytest.mark.soak,
        ),
    ],
)
def test_runs_part_at_the_wrong_call(
    page: str, line: dict[str, str], request: pytest.FixtureRequest
):
    pages = request.getfixturevalue("more_pages" if page[0] in "67" else "pages")
    _, found = line_of_parting(read_replay(pages / f"{page}.html"))
    assert {name: found[name] for name in line} == line


@pytest.mark.soak
def test_a_missing_cap_parts_in_the_slow_frame(more_pages: Path):
    """The frames are 2 ms, six of 0.1 s, then the slow one."""
    data = read_replay(more_pages / "6-a_slow_frame_runs_eight_steps.html")
    steps = [moment[1] for moment in data["scenes"][0]["yours"]]
    jumps = [n for n in range(1, len(steps)) if steps[n] - steps[n - 1] > 8]
    assert data["parting"]["moment"] == jumps[0]


def test_another_mass_parts_where_nothing_else_does():
    heavy, light = runs(AT_REST), runs(AT_REST)
    heavy[0].looks[1] = msgspec.structs.replace(DISC, mass=2.0)
    found = pair_runs(heavy, light, exact=False).parting
    assert found is not None and found.words == "ball has another mass or moment"


def test_an_integrator_is_a_curve_over_the_time(pages: Path):
    data = read_replay(pages / "8b-velocity_verlet_keeps_the_spring_swinging.html")
    scene = data["scenes"][0]
    assert scene["curve"]
    times = [moment[0] for moment in scene["yours"]]
    assert times.count(0) == 1 and math.isclose(max(times), 10.0, abs_tol=1e-5)
    assert len(times) == 301


def test_the_right_run_parts_nowhere_from_itself():
    rubric = {todo.id: todo for todo in load_rubric().todos}
    chosen = (
        ("4", todo_4.every_contact_of_a_pile_keeps_within_its_friction),
        ("whole", whole.the_rod_swings_alike_at_any_frame_rate),
    )
    with child_opener(KIT / "solution") as children:
        for todo, function in chosen:
            check = next(c for c in rubric[todo].checks if c.id == function.__name__)
            failing = Failing(rubric[todo], check, function, [])
            runs = [record_again(failing, children, []).recorder.scenes[-1] for _ in range(2)]
            both = pair_runs(*runs)
            assert both.parting is None and both.compared
            assert len(both.scenes[0].yours) == len(both.scenes[0].expected) > 20


def runs(*rows: BodyRow, answer: str = "", signature: str = "call") -> list[Run]:
    line = Line(signature, answer, [Moment(0.0, 0, [row], [], []) for row in rows], code="it()")
    return [Run("", [line], {1: DISC}, {1: "ball"})]


AT_REST = BodyRow(1, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"x": 0.4}, ""),
        ({"x": 0.6}, "ball is 0.6 px off"),
        ({"vy": 0.4}, ""),
        ({"vy": 0.6}, "ball has a velocity that is 0.6 px/s off"),
        ({"angle": 0.04}, ""),
        ({"angle": 0.06}, "ball is turned by 0.06 rad too much or too little"),
        ({"omega": 0.06}, "ball has a spin that is 0.06 rad/s off"),
        ({"y": math.nan}, "ball has numbers that are not finite"),
        ({"number": 2}, "body 2 should not be there"),
    ],
)
def test_runs_part_by_half_a_pixel(change: dict[str, float], words: str):
    moved = msgspec.structs.replace(AT_REST, **change)
    both = pair_runs(runs(AT_REST, AT_REST, moved), runs(AT_REST, AT_REST, AT_REST), exact=False)
    found = both.parting
    assert (found is None) == (words == "")
    if found is not None:
        assert (found.moment, found.words) == (2, words)


def test_an_invisible_difference_counts_if_there_is_no_other():
    tiny, more = (msgspec.structs.replace(AT_REST, x=x) for x in (0.001, 0.6))
    still = runs(AT_REST, AT_REST)
    found = pair_runs(runs(tiny, AT_REST), still).parting
    assert found is not None and found.moment == 0
    found = pair_runs(runs(tiny, more), still).parting
    assert found is not None and found.moment == 1
    rounded = msgspec.structs.replace(AT_REST, x=1e-9, vy=1e-7)
    assert pair_runs(runs(rounded, AT_REST), still).parting is None


def test_slow_bodies_part_by_a_share_of_their_speed():
    right, off, near = (
        runs(BodyRow(1, 0.0, 0.0, speed, 0.0, 0.0, 0.0)) for speed in (0.125, 0.1, 0.1249)
    )
    assert pair_runs(off, right, exact=False).parting is not None
    assert pair_runs(near, right, exact=False).parting is None


def test_a_missing_or_misplaced_rod_parts():
    with_rod, without = runs(AT_REST), runs(AT_REST)
    with_rod[0].lines[0].moments[0].rods.append((0.0, 0.0, 1.0, 1.0))
    found = pair_runs(without, with_rod).parting
    assert found is not None and found.words == "0 rods instead of 1"
    without[0].lines[0].moments[0].rods.append((0.0, 0.0, 1.0, 2.0))
    found = pair_runs(without, with_rod).parting
    assert found is not None and found.words == "a rod has other ends"


def test_another_depth_of_a_contact_parts():
    yours, right = runs(AT_REST), runs(AT_REST)
    for each, depth in ((yours, 0.0), (right, 0.25)):
        contact = ContactRow(0.0, 0.0, 0.0, 1.0, depth, 1.0, 0.0, 0.6, 1, 2)
        each[0].lines[0].moments[0].touches.append(contact)
    found = pair_runs(yours, right).parting
    assert found is not None and found.words == "a contact has another depth"


def test_another_answer_parts_and_another_request_is_not_compared():
    same = runs(AT_REST, answer="1")
    assert pair_runs(same, runs(AT_REST, answer="1")).parting is None
    found = pair_runs(same, runs(AT_REST, answer="2")).parting
    assert found is not None and "another answer" in found.words
    other = pair_runs(same, runs(BodyRow(1, 9.0, 0.0, 0.0, 0.0, 0.0, 0.0), signature="get"))
    assert other.parting is None and not other.compared


def test_a_shorter_run_waits_for_the_longer_one():
    both = pair_runs(runs(AT_REST), runs(AT_REST, AT_REST, AT_REST))
    assert len(both.scenes[0].yours) == len(both.scenes[0].expected) == 3


# ---------------------------------------------------------------- scripts


def run_script(script: Path, tree: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, str(script)],
        cwd=tree,
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=600,
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1", "PYGAME_HIDE_SUPPORT_PROMPT": "1"},
    )


SCRIPTS = (  # check, what the mistaken tree prints, what the solution prints
    (
        "1-overlap_from_outside_points_into_the_box",
        r"^None$",
        r"Vector2\(0, 1\), 5\.0, Vector2\(10, -20\)",
    ),
    ("1-balls_land_on_a_floor_and_lie_there", r"^\[80, 22", r"^\[80, 3[67]"),
    ("4-every_contact_of_a_pile_keeps_within_its_friction", r"\[", r"\["),
    ("6-a_slow_frame_runs_eight_steps", r"^2001 ms: 240 steps", r"^2001 ms: [78] steps"),
    ("7b-a_ball_resists_turning_as_a_full_disc", r"\(1\.0, 100\.", r"\(1\.0, 50\."),
    ("8b-velocity_verlet_keeps_the_spring_swinging", r"^2507\.", r"^99\.3"),
)


@pytest.mark.parametrize(
    ("name", "wrong", "right"),
    [
        pytest.param(*each, marks=() if each[0][:2] in ("1-", "8b") else pytest.mark.soak)
        for each in SCRIPTS
    ],
)
def test_the_script_shows_the_mistake_in_the_tree_as_it_is(
    name: str, wrong: str, right: str, mistaken: Path, request: pytest.FixtureRequest
):
    printed = []
    pages = request.getfixturevalue("more_pages" if name[0] in "67" else "pages")
    for tree, pattern in ((mistaken, wrong), (KIT / "solution", right)):
        done = run_script(pages / f"{name}.py", tree)
        assert done.returncode == 0, done.stderr
        assert re.search(pattern, done.stdout, re.MULTILINE), done.stdout
        printed.append(done.stdout)
    assert printed[0] != printed[1]


def test_the_scene_of_a_forbidden_change_is_shown(tmp_path: Path):
    """The check ends two scenes later, where nothing is wrong."""
    (member,) = [m for m in bank() if (m.name, m.form) == ("1-lifts-the-circle-out", "package")]
    member.build(tmp_path / "tree")
    options = Options(shipped_reference(), only=frozenset({"1"}))
    grade_with_replays(tmp_path / "tree", options, tmp_path / "pages", shared_worker())
    shown = read_replay(tmp_path / "pages/1-a_centre_inside_leaves_by_the_nearest_face.html")
    assert shown["parting"] is not None
    assert "at (5, -15)" in shown["scenes"][0]["experiment"]


def test_a_script_names_bodies_by_the_list_that_they_are_in():
    translator = Translator("mini_engine", {1: "world"})
    body = BodyValue(7, Vec(0, 0), Vec(0, 0), 0.0, 0.0, 1.0, 1.0, 10.0)
    translator.translate(Get(1, "bodies"), Returned(Items([body])))
    assert translator.translate(Get(7, "friction"), Returned(0.6)) == ["world.bodies[0].friction"]


def test_a_script_ends_with_the_answer_that_was_judged():
    """A check may set fields of the object after it."""
    asked = Step(Call("mini_engine:circle_box"), ["contact = circle_box(ball, box)"], silent=False)
    later = Step(Set(1, {"jn": 12.0}), ["contact.jn = 12.0"], silent=True)
    lines = write_script("A check", Translator("mini_engine"), [asked, later], []).splitlines()
    assert lines[-1] == "print(contact and (contact.normal, contact.depth, contact.point))"
    assert "contact.jn = 12.0" not in lines


def test_names_begin_at_one_and_agree_with_the_picture(pages: Path):
    """A replay has the same names as its script, for any earlier objects of the check."""
    bodies = 0
    for path in pages.glob("*.py"):
        made = re.findall(r"^(ball|box)(\d*) = Body", path.read_text("utf-8"), re.MULTILINE)
        for kind in ("ball", "box"):
            numbers = list(dict.fromkeys(n for each, n in made if each == kind))
            assert numbers == ["", *map(str, range(2, len(numbers) + 1))][: len(numbers)], path
        names = {f"{kind} {number}".strip() for kind, number in made}
        scenes = read_replay(path.with_suffix(".html"))["scenes"]
        seen = {each.partition(",")[0] for scene in scenes for each in scene["names"].values()}
        assert not names or seen <= names, path
        bodies += len(names)
    assert bodies > 20


def test_scripts_are_short(pages: Path):
    """Imports, comments and the path do not count."""
    for path in pages.glob("*.py"):
        lines = path.read_text(encoding="utf-8").splitlines()
        own = [line for line in lines if line and not re.match(r"#|import |from |sys\.path", line)]
        assert 0 < len(own) <= 24, path
        if path.name.startswith(("1-overlap", "1-a_centre", "1-no", "8b-")):
            assert len(own) <= 13, path


def test_a_force_is_worked_out_as_the_judge_does():
    assert write_polynomial([0.0, -4.0]) == "lambda x: -4.0 * x"
    for terms in ([0.5], [1.0, 2.0, 0.0, -3.0], [0.0, 0.0], [0.25, 0.0, 0.0, 0.25]):
        force = eval(write_polynomial(terms))
        for x in (-2.0, 0.0, 0.7):
            assert force(x) == sum(c * x**n for n, c in enumerate(terms)) or math.isclose(
                force(x), sum(c * x**n for n, c in enumerate(terms)), rel_tol=1e-15
            )


# ---------------------------------------------------------------- without a reference


def test_without_a_reference_the_run_stands_alone(mistaken: Path, tmp_path: Path):
    options = Options(None, only=frozenset({"8b"}))
    grade_with_replays(mistaken, options, tmp_path / "alone", shared_worker())
    data = read_replay(tmp_path / "alone" / "8b-velocity_verlet_keeps_the_spring_swinging.html")
    assert not data["compared"] and data["parting"] is None
    assert data["scenes"][0]["expected"] == [] != data["scenes"][0]["yours"]


def test_recorded_runs_stand_in_for_the_reference(
    mistaken: Path,
    pages: Path,
    tmp_path: Path,
    expected_runs: bytes,
    monkeypatch: pytest.MonkeyPatch,
):
    runs = msgspec.json.decode(expected_runs, type=ExpectedRuns)
    monkeypatch.setattr(replays, "load_expected", lambda: runs)
    options = Options(None, only=frozenset({"1", "8b"}))
    grade_with_replays(mistaken, options, tmp_path / "recorded", shared_worker())
    compared = 0
    for path in (tmp_path / "recorded").glob("*.html"):
        parting, live = (read_replay(each)["parting"] for each in (path, pages / path.name))
        if parting is not None:
            compared += 1
            assert parting["body"] == live["body"], path
            assert abs(parting["moment"] - live["moment"]) <= 3, path  # recorded with two decimals
    assert compared >= 5


def test_recorded_runs_are_of_fixed_checks_and_compact(expected_runs: bytes):
    runs = msgspec.json.decode(expected_runs, type=ExpectedRuns)
    assert set(runs) == {
        f"{todo.id}/{check.id}"
        for todo in only_some(load_rubric()).todos
        for check in todo.checks
        if check.kind != "property" and not check.hidden
    }
    assert all(any(run.lines for scene in runs[name] for run in scene) for name in runs)
    assert len(expected_runs) < 2_500_000
    assert b"circle_box(" not in expected_runs


# ---------------------------------------------------------------- what a submission may send


class Liar:
    """Replaces a child: it answers every recording with the same message."""

    cpu = rested = 0.0
    heard = 0

    def __init__(self, answer: WithMoments) -> None:
        self.answer = answer

    def ask(self, request: Any) -> Answered:
        return Answered(1, self.answer if isinstance(request, Record) else Returned(""))

    def end(self) -> None: ...


def make_failing(again: Any) -> Failing:
    todo = load_rubric().todos[0]
    return Failing(todo, todo.checks[0], again, [])


def record_liar(answer: WithMoments, requests: int) -> RecordingLab:
    def again(lab: RecordingLab) -> None:
        for _ in range(requests):
            lab.call("circle_box")

    return record_again(make_failing(again), lambda seconds: Liar(answer), [])  # type: ignore[arg-type,return-value]


def test_a_flood_of_moments_is_cut():
    row = BodyRow(1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    moment = Moment(0.0, 0, [row] * 5000, [], [(0.0, 0.0, 0.0, 0.0)] * 5000)
    looks = dict.fromkeys(range(5000), DISC)
    lab = record_liar(WithMoments(Returned(None), looks, [moment] * 1000), 50)
    moments = [moment for line in lab.recorder.scenes[0][0].lines for moment in line.moments]
    assert len(moments) <= MAX_MOMENTS
    assert all(len(each.bodies) <= 80 and len(each.rods) <= 20 for each in moments)
    assert len(lab.recorder.scenes[0][0].looks) <= 80


def test_numbers_that_are_none_stay_data():
    row = BodyRow(1, math.nan, math.inf, 0.0, 0.0, -math.inf, 0.0)
    answer = WithMoments(Returned(None), {1: DISC}, [Moment(0.0, 0, [row], [], [])])
    lab = record_liar(answer, 1)
    text = make_page("title", [], pair_runs(lab.recorder.scenes[0], []), "")
    data = re.search(r'id="replay">(.*?)</script>', text)
    assert data and json.loads(data[1])["scenes"][0]["yours"][0][2] == [
        [1, None, None, 0.0, 0.0, None, 0.0]
    ]


def test_an_empty_recording_breaks_nothing():
    lab = record_liar(WithMoments(Returned(Vec(1.0, 2.0)), {}, []), 3)
    both = pair_runs(lab.recorder.scenes[0], [])
    assert both.scenes[0].yours == [] and make_page("title", [], both, "")


EVERYTHING = """
import sys

class Everything:
    def __getattr__(self, name):
        return self
    def __call__(self, *args, **kwargs):
        return self
    def __getitem__(self, key):
        return self

sys.modules[__name__] = Everything()
"""


def test_an_object_that_has_everything_is_looked_at_for_a_moment_only(tmp_path: Path):
    (tmp_path / "integrators.py").write_text(EVERYTHING, encoding="utf-8")
    rk4 = next(todo for todo in load_rubric().todos if todo.id == "8c")
    again = todo_8.rk4_keeps_the_spring_swinging
    with child_opener(tmp_path) as children:
        lab = record_again(Failing(rk4, rk4.checks[1], again, []), children, [])
    assert lab.failure is not None and not lab.ended


def test_children_that_die_while_recorded_end_the_replays(graded_result: Result, tmp_path: Path):
    """Marks and reasons stay; after a few deaths no more replays are made."""
    opened_children = []

    def open_child(seconds: int) -> Any:
        opened_children.append(seconds)
        raise ChildEnded("it ended")

    maker = Replays(tmp_path / "none", open_child, None)
    calls = {
        (todo.id, check.id): make_failing(lambda lab: lab.call("circle_box"))
        for todo in graded_result.todos
        for check in todo.checks
    }
    result = maker.add_to(graded_result, calls)
    assert len(opened_children) == replays.MAX_DEATHS
    assert not (tmp_path / "none").exists()
    assert result.points == graded_result.points


def test_old_replays_go_and_links_are_not_followed(graded_result: Result, tmp_path: Path):
    folder = tmp_path / "replays"
    folder.mkdir()
    todo = graded_result.todos[0]
    stale = folder / f"{todo.id}-{todo.checks[0].id}.html"
    for path in (stale, stale.with_suffix(".py"), folder / "mine.txt"):
        path.write_text("old", encoding="utf-8")
    Replays(folder, lambda seconds: None, None).add_to(graded_result, {})  # type: ignore[arg-type,return-value]
    assert [each.name for each in folder.iterdir()] == ["mine.txt"]
    link = tmp_path / "link"
    link.symlink_to(folder, target_is_directory=True)
    stale.write_text("old", encoding="utf-8")
    assert Replays(link, lambda seconds: None, None).add_to(graded_result, {}) is graded_result  # type: ignore[arg-type,return-value]
    assert stale.exists()


def make_hostile_page() -> str:
    line = Line("call", HOSTILE, [Moment(0.0, 0, [AT_REST], [], [])], code=HOSTILE)
    both = pair_runs([Run(HOSTILE, [line, line], {1: DISC}, {1: HOSTILE})], [])
    return make_page(HOSTILE, [("Got", HOSTILE)], both, HOSTILE)


def test_words_of_a_submission_stay_words():
    text = make_hostile_page()
    seen = Reader(text)
    assert (seen.count("script"), seen.count("img"), seen.handlers) == (2, 0, [])
    assert HARMLESS in seen.text
    data = json.loads(re.search(r'id="replay">(.*?)</script>', text)[1])  # type: ignore[index]
    assert data["scenes"][0]["lines"][0]["yours"] == HOSTILE


# ---------------------------------------------------------------- in a browser


@pytest.fixture(scope="module")
def opened_page(browser: Any, pages: Path) -> Iterator[Screen]:
    shown = Screen(browser, pages / PILE)
    yield shown
    assert shown.complaints == []


@pytest.fixture
def screen(opened_page: Screen) -> Screen:
    """Show the page as it opens, with nothing in focus."""
    opened_page.page.evaluate("document.activeElement.blur()")
    opened_page.page.keyboard.press("p")
    return opened_page


def gaps(scene: dict[str, Any]) -> list[float]:
    """Return the largest distance of bodies of both runs in each moment, px."""
    found: list[float] = []
    here: dict[int, list[float]] = {}
    there: dict[int, list[float]] = {}
    for mine, right in zip(scene["yours"], scene["expected"], strict=True):
        for moment, places in ((mine, here), (right, there)):
            places |= {number: state for number, *state in moment[2]}
        found.append(max(math.dist(here[each][:2], there[each][:2]) for each in here))
    return found


def test_the_player_finds_where_one_sees_the_parting_and_where_it_is_largest(
    opened_page: Screen, pages: Path
):
    screen = opened_page
    data = read_replay(pages / PILE)
    apart, first = gaps(data["scenes"][0]), data["parting"]["moment"]
    largest = apart.index(max(apart))
    seen = screen.position  # it opens there
    assert first < seen < largest
    assert apart[seen] > max(apart[:seen]) and apart[seen - 1] < apart[largest] / 4
    words = screen.page.locator("#parting").inner_text()
    assert f"differ from moment {first + 1} of" in words
    assert (
        f"You can see it from moment {seen + 1} on; it is largest in moment {largest + 1}." in words
    )
    screen.page.keyboard.press("l")
    assert screen.position == largest
    screen.page.keyboard.press("p")
    assert screen.position == seen
    screen.page.get_by_role("button", name="Largest gap").click()
    assert screen.position == largest


def test_the_player_steps_and_scrubs(screen: Screen, pages: Path):
    data = read_replay(pages / PILE)
    count, parting = len(data["scenes"][0]["yours"]), screen.position
    keys = screen.page.keyboard
    keys.press("Home")
    assert screen.position == 0
    keys.press("ArrowRight")
    keys.press("ArrowRight")
    keys.press("ArrowLeft")
    assert screen.position == 1
    keys.press("End")
    assert screen.position == count - 1
    keys.press("ArrowRight")
    assert screen.position == count - 1
    keys.press("p")
    assert screen.position == parting
    screen.page.locator("#moment").fill("30")
    assert screen.position == 30
    screen.page.get_by_role("button", name="First difference").click()
    assert screen.position == parting
    screen.page.locator("#lines li").first.click()
    assert screen.position == 0
    keys.press("Tab")
    keys.press("Enter")  # the second line, by keys alone
    assert screen.position == data["scenes"][0]["lines"][1]["at"]
    keys.press("Home")
    assert f"moment 1 of {count}" in screen.page.locator("#position").inner_text()


def test_the_player_plays_and_stops_by_a_key(screen: Screen):
    """The test sets the page's clock, so a busy machine misses no moment."""
    keys, clock = screen.page.keyboard, screen.page.clock
    clock.install()
    clock.pause_at("2030-01-01")
    keys.press("Home")
    keys.press(" ")
    assert screen.page.locator("#play").inner_text() == "Stop"
    clock.run_for(500)
    assert screen.position > 5
    keys.press(" ")
    stopped = screen.position
    clock.run_for(200)
    assert screen.position == stopped and screen.page.locator("#play").inner_text() == "Play"
    clock.resume()


def test_the_picture_changes_and_tells_the_numbers_under_the_mouse(screen: Screen):
    screen.page.keyboard.press("Home")
    picture = screen.page.locator("#picture")
    first = picture.screenshot()
    screen.page.keyboard.press("End")
    assert picture.screenshot() != first
    screen.page.keyboard.press("Home")
    assert picture.screenshot() == first
    names = set()
    for _ in range(4):
        screen.page.keyboard.press("b")
        names.add(screen.page.locator("#who").inner_text())
    assert names == {"ball, static", "ball 2, 1 kg", "ball 3, 3 kg", "ball 4, 2 kg"}
    cells = screen.page.locator("#values tbody tr").first.locator("td").all_inner_texts()
    assert cells[0] == cells[1] != ""


@pytest.mark.soak
def test_a_body_under_the_mouse_is_the_one_in_the_table(browser: Any, pages: Path):
    shown = Screen(browser, pages / "1-overlap_from_outside_points_into_the_box.html")
    box = shown.page.locator("#picture").bounding_box()
    shown.page.keyboard.press("b")
    other = shown.page.locator("#who").inner_text()
    for share in range(1, 20):
        shown.page.mouse.move(box["x"] + box["width"] * share / 20, box["y"] + box["height"] / 3)
        if shown.page.locator("#who").inner_text() != other:
            break
    assert shown.page.locator("#who").inner_text() == "ball, 1 kg"
    row = shown.page.locator("#values tbody tr").first.locator("td").all_inner_texts()
    assert row == ["10", "10"]
    assert shown.complaints == []


@pytest.mark.soak
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pages_open_without_a_complaint(browser: Any, pages: Path, more_pages: Path, scheme: str):
    shown = Screen(browser, next(pages.glob("*.html")), color_scheme=scheme)
    dark = "22, 25, 34" in shown.page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert dark == (scheme == "dark")
    for page in (next(more_pages.glob("6-*.html")), next(pages.glob("8b-*.html"))):
        shown.page.goto(page.resolve().as_uri())
        shown.page.keyboard.press("End")
        assert shown.position == int(shown.page.locator("#moment").get_attribute("max"))
    assert shown.complaints == []


@pytest.mark.soak
def test_a_replay_is_for_all(browser: Any, pages: Path):
    first, *_, last = sorted(pages.glob("*.html"))  # a scene, and an integrator's curve
    assert barriers(browser, first, last) == []


@pytest.mark.soak
def test_hostile_words_do_nothing_in_a_browser(browser: Any, tmp_path: Path):
    path = tmp_path / "hostile.html"
    path.write_text(make_hostile_page(), encoding="utf-8")
    shown = Screen(browser, path)
    shown.page.keyboard.press("End")
    assert shown.position == 1
    assert "alert(1)" in shown.page.locator("#answer-yours").inner_text()
    assert shown.complaints == []


@pytest.mark.soak
def test_the_script_can_be_copied(browser: Any, pages: Path):
    context = browser.new_context(permissions=["clipboard-read", "clipboard-write"])
    path = pages / "1-overlap_from_outside_points_into_the_box.html"
    shown = context.new_page()
    shown.goto(path.resolve().as_uri())
    shown.locator("#copy").click()
    shown.get_by_text("Copied").wait_for()
    text = shown.evaluate("navigator.clipboard.readText()")
    assert text == path.with_suffix(".py").read_text(encoding="utf-8")
    context.close()


# ---------------------------------------------------------------- the whole bank


# Failures that a picture cannot show: checks of what is printed, read or drawn, and members.
UNSEEN = {
    "the_program_says_how_many_steps_ran",
    "the_space_keeps_its_damping_and_settings",
    "the_picture_shows_where_the_balls_are",
    "the_pymunk_stack_falls_when_it_is_knocked_over",  # reads the last line as well
    "2-cleans-the-axis",  # off in the eighth digit, as is the next one
    "B2-damping-remembered",
    "7d-fewer-passes-when-slow",  # sets the passes of a space
    "B3-remembers-the-first-grid",  # right in the first scene
    "B3-compares-all-pairs",  # right everywhere, and slow
}


def is_unseen(member: Member, check: CheckResult) -> bool:
    """Return whether a right and a wrong run look the same; so do sleepers and balls that lie."""
    return bool(UNSEEN & {member.name, check.id}) or member.name.startswith("B1-")


@pytest.mark.soak
@pytest.mark.parametrize(
    "member",
    [member for member in bank() if member.kind == "wrong"][::5],
    ids=lambda member: f"{member.name}-{member.form}",
)
def test_wrong_answers_of_the_bank_part_and_their_scripts_run(member: Member, tmp_path: Path):
    tree = tmp_path / "tree"
    member.build(tree)
    options = Options(shipped_reference(), only=member.todos)
    result = grade_with_replays(tree, options, tmp_path / "pages", shared_worker())
    for check in (check for todo in result.todos for check in todo.checks):
        if check.state == "not yet":
            assert check.replay is not None, check.id
            parts = read_replay(tmp_path / check.replay)["parting"] is not None
            assert parts or is_unseen(member, check), check.id
            script = (tmp_path / check.replay).with_suffix(".py")
            runs_on = "never" in member.name  # a loop that does not end
            if not runs_on and "main()" not in script.read_text(encoding="utf-8"):
                done = run_script(script, tree)
                assert done.returncode == 0 and done.stdout.strip(), (check.id, done.stderr)


@pytest.fixture(scope="module")
def arm_recorder() -> Recorder:
    """Record questions about an effective mass; the last has bodies of the first scene."""
    recorder = record_solution("2", todo_2.only_the_part_of_an_arm_across_the_axis_counts)
    assert len(recorder.scenes) > 1
    return recorder


@pytest.fixture(scope="module")
def arms(arm_recorder: Recorder) -> Replay:
    return pair_runs(arm_recorder.scenes[-1], arm_recorder.scenes[-1])


def record_solution(todo_id: str, function: Callable[[Lab], None]) -> Recorder:
    """Record a check of the solution."""
    (todo,) = (todo for todo in load_rubric().todos if todo.id == todo_id)
    check = next(each for each in todo.checks if each.id == function.__name__)
    with child_opener(KIT / "solution") as children:
        return record_again(Failing(todo, check, function, []), children, []).recorder


def test_a_world_of_an_earlier_scene_is_shown_with_its_bodies():
    recorder = record_solution("5", todo_5.one_world_follows_its_rates_and_its_step)
    for runs in recorder.scenes[1:]:
        assert all(len(moment.bodies) == 1 for moment in runs[-1].lines[-1].moments)


def test_the_last_scene_of_a_long_check_is_recorded():
    recorder = record_solution("B1", todo_b1.nothing_sleeps_that_moves_flies_or_hangs)
    assert recorder.scenes[0] and recorder.scenes[-1][-1].lines and not recorder.scenes[-2]


def test_a_body_between_two_steps_is_asked_in_the_scene_of_the_step(tmp_path: Path):
    recorder = record_solution("B5", todo_b5.a_body_is_drawn_on_its_way_through_the_step)
    run_again(recorder, recorder.steps[0] + recorder.steps[1], tmp_path / "again.py")


def test_a_script_makes_the_bodies_of_an_earlier_scene(arm_recorder: Recorder, tmp_path: Path):
    assert float(run_again(arm_recorder, arm_recorder.steps[-1], tmp_path / "again.py")) > 0


def run_again(recorder: Recorder, steps: list[Step], script: Path) -> str:
    """Run the script of some steps on the solution; return what it prints."""
    script.write_text(write_script("", recorder.translator, steps, []), "utf-8")
    done = run_script(script, KIT / "solution")
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_question_about_the_effective_mass_shows_its_arms_and_axis(arms: Replay):
    (scene,) = arms.scenes
    (line,) = (each for each in scene.lines if each.marks)
    assert len(line.marks) == 2 and len({(each.axis_x, each.axis_y) for each in line.marks}) == 1
    seen = {row[0] for moment in scene.yours for row in moment[2]}
    assert {mark.body for mark in line.marks} <= seen
    assert all(name.endswith(" kg") for name in scene.names.values())


def test_friction_is_drawn_with_its_limit(pages: Path):
    data = read_replay(pages / PILE)
    rows = [row for moment in data["scenes"][0]["expected"] for row in moment[3] or ()]
    beyond = [row for row in rows if abs(row[6]) > row[7] * (1 + 1e-4) + 1e-4]
    assert rows and not beyond and any(row[7] > 0 for row in rows)
    rows = [row for moment in data["scenes"][0]["yours"] for row in moment[3] or ()]
    assert any(abs(row[6]) > row[7] + 0.01 for row in rows), "that is the mistake"


@pytest.mark.soak
def test_lines_in_the_picture_are_named(browser: Any, arms: Replay, screen: Screen, tmp_path: Path):
    screen.page.keyboard.press("End")
    assert "how far friction may turn it" in screen.page.locator("#legend").inner_text()
    (tmp_path / "arms.html").write_text(make_page("Arms", [], arms, ""), encoding="utf-8")
    shown = Screen(browser, tmp_path / "arms.html")
    assert shown.page.locator("#legend").inner_text().startswith("Dashed: the arm. Grey: the axis.")
    assert shown.complaints == []
    shown.page.close()


def test_where_only_the_work_differs_it_says_that_there_is_nothing_to_see():
    run = Run("", [Line("call", "", [Moment(0.0, 0, [], [], [])], counts_work=True)])
    both = pair_runs([run], [run])
    assert both.parting is None and "counts work" in both.note
    assert pair_runs([Run("", [Line("call", "", [])])], []).note == ""
