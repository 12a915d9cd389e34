"""What accuracy costs: truths are true, errors and opcodes come out, and nobody forges a price."""

import math
import random
import re
import shutil
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from conftest import KIT, HandIn
from msgspec import structs
from page_readers import HARMLESS, HOSTILE, Reader, Screen, barriers, chromium
from typer.testing import CliRunner

from grader import cli
from grader.classroom.adjustments import load_adjustments
from grader.classroom.batch import Run, grade_class
from grader.classroom.book import Book, Outcome
from grader.classroom.dashboard import read_class, write_dashboard
from grader.classroom.executor import Pool
from grader.classroom.intake.found import Found, Intake
from grader.judge.course import Course, WrongCourse, read_course
from grader.judge.grade import Options, shipped_reference
from grader.maintain.bank import members
from grader.maintain.verify import shared_worker
from grader.prices import scenes as truth
from grader.prices.chart import charts, in_opcodes, in_px
from grader.prices.front import error_for, front
from grader.prices.listing import PriceList, as_json, price_list, read_list, write_list
from grader.prices.measure import (
    BANS,
    CPU_SECONDS,
    LEAST,
    LOST,
    UNTOLD,
    Curve,
    Measured,
    Point,
    Prices,
    measure,
)
from grader.prices.others import LESSON, PYMUNK, STABLE, others
from grader.prices.page import section, write_prices
from grader.prices.scenes import G, Scene, scenes

OPTIONS = Options(shipped_reference(), trusted=True)
ON_LINUX = pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the seconds")
MANY = 200
TOWER, PENDULUM, SLIDE = scenes()


def short(scene: Scene, seconds: float = 0.1, settings: int = 1) -> Scene:
    """A sample of a scene, which takes a fraction of the time."""
    since = scene.since if scene.since < seconds else 0.0
    few = scene.settings[:settings]
    return replace(scene, seconds=seconds, since=since, enough=0, settings=few)


def measured(path: Path, *asked: Scene) -> Prices:
    return measure(path, asked, OPTIONS, shared_worker()).prices


def reason(path: Path, scene: Scene) -> str:
    """Why this engine stands at the edge."""
    curve = measured(path, scene).curve(scene.id)
    assert not curve.points
    return curve.gave_up


# ---------------------------------------------------------------- what is exact


def test_the_exact_pendulum_is_back_after_its_period_and_keeps_its_energy() -> None:
    swing = truth.Swing(140.0, 90.0, 6.0)
    a, b = 1.0, math.cos(math.pi / 4)
    for _ in range(8):
        a, b = (a + b) / 2, math.sqrt(a * b)
    period = 2 * math.pi * math.sqrt(140.0 / G) / a  # by the arithmetic-geometric mean
    assert swing.exact(0.0)[0] == pytest.approx((140.0, 0.0))
    assert swing.exact(period / 4)[0] == pytest.approx((0.0, 140.0))
    assert swing.exact(period / 2)[0] == pytest.approx((-140.0, 0.0))
    h = 1e-5
    for seconds in (0.1, 0.4, 1.0, 2.9):
        (x, y), (before, above) = swing.exact(seconds)[0], swing.exact(seconds - h)[0]
        (after, below) = swing.exact(seconds + h)[0]
        speed = math.hypot(after - before, below - above) / (2 * h)
        assert math.hypot(x, y) == pytest.approx(140.0)
        assert speed**2 / 2 == pytest.approx(G * y, rel=1e-6)


def test_the_exact_slide_is_that_of_coulombs_law_in_small_steps() -> None:
    slide = truth.Slide(10.0, 300.0, 0.6)
    x, v, omega, h = 0.0, 300.0, 0.0, 1e-5
    for _ in range(100_000):
        if v - 10.0 * omega > 0:
            v, omega = v - 0.6 * G * h, omega + 2 * 0.6 * G / 10.0 * h
        x += v * h
    assert slide.exact(1.0)[0][0] == pytest.approx(x, abs=0.05)


def test_a_seed_changes_all_that_an_engine_could_know_by_heart() -> None:
    first, again, other = scenes(1), scenes(1), scenes(2)
    assert [each.exact(0.5) for each in first] == [each.exact(0.5) for each in again]
    for one, two, usual in zip(first, other, scenes(), strict=True):
        assert one.exact(0.5) != two.exact(0.5) != usual.exact(0.5)


# ---------------------------------------------------------------- what comes out


def test_errors_and_opcodes_come_out_the_same_twice_and_fall_and_rise_as_they_must() -> None:
    asked = [short(SLIDE, 0.1, 2), short(PENDULUM, 0.1, 2)]
    found, again = measured(KIT / "solution", *asked), measured(KIT / "solution", asked[0])
    assert msgspec.json.encode(found.curves[:1]) == msgspec.json.encode(again.curves)
    for curve in found.curves:
        assert not curve.gave_up
        cheap, dear = curve.points
        assert cheap.opcodes < dear.opcodes and cheap.error > dear.error > 0


def test_opcodes_are_those_that_the_experiments_count() -> None:
    """By another counter, of a world that is built here."""
    from experiments.opcodes import count_opcodes
    from mini_engine import Body, Box, Circle, World

    scene = short(SLIDE, 0.1)
    world = World((0, G), 0, 0)
    world.add(Body(Box((5000, 50)), (0, 50), 0, 0.0, 0.6))
    ball = world.add(Body(Circle(10), (0, -10), 1.0, 0.0, 0.6))
    ball.vel.x = 300.0
    steps = round(scene.seconds * scene.settings[0].rate)
    counts = count_opcodes(lambda: [world.step(1 / scene.settings[0].rate) for _ in range(steps)])
    del counts[Path(__file__).name]
    point = measured(KIT / "solution", scene).curves[0].points[0]
    assert point.opcodes == round(sum(counts.values()) / scene.seconds)


def test_the_engines_to_compare_with_are_better_for_their_opcodes() -> None:
    tower = replace(short(TOWER, 0.55), settings=TOWER.settings[1:2])
    asked = [tower, short(SLIDE, 0.1, 1)]
    beside = [each.prices for each in others(asked, OPTIONS, shared_worker())]
    found = {each.name: each for each in beside}
    assert list(found) == [LESSON, STABLE, PYMUNK]
    for scene in asked:
        lesson, stable, pymunk = (each.curve(scene.id) for each in found.values())
        assert not (lesson.gave_up or stable.gave_up or pymunk.gave_up)
        assert pymunk.points[0].opcodes < lesson.points[0].opcodes / 3  # the adapter's own
    sinks = error_for(found[STABLE].curve("tower"), found[LESSON].curve("tower").points[-1].opcodes)
    assert sinks is not None and sinks < found[LESSON].curve("tower").points[-1].error / 2


def test_students_are_compared_with_what_they_have(handed_out: Path) -> None:
    at_home = Options(trusted=True)
    names = [each.prices.name for each in others([], at_home, shared_worker(), handed_out)]
    assert names == [STABLE, PYMUNK]


# ---------------------------------------------------------------- who gives up


def test_what_is_not_begun_is_said_and_the_rest_is_measured(hand_in: HandIn) -> None:
    tree = hand_in("starter")
    shutil.copyfile(KIT / "solution/mini_engine/joints.py", tree / "mini_engine/joints.py")
    found = measured(tree, *(short(each) for each in scenes()))
    assert found.curve("tower").gave_up == "TODO 1, 2 and 4 are not begun"
    assert found.curve("pendulum").points
    assert reason(KIT / "starter", short(PENDULUM)) == "TODO 3 is not begun"


def test_an_engine_for_the_open_task_goes_before_the_one_that_is_graded(hand_in: HandIn) -> None:
    tree = hand_in("starter")
    shutil.copytree(KIT / "solution" / "mini_engine", tree / "open_engine")
    found = measured(tree, short(PENDULUM)), measured(KIT / "solution", short(PENDULUM))
    assert found[0].curves == found[1].curves and found[0].curves[0].points


def with_step(hand_in: HandIn, before: str, after: str = "", top: str = "") -> Path:
    """The solution with code of somebody's own before and after each step."""
    tree = hand_in("solution")
    text = (
        f"{top}\n_real = World.step\ndef _step(self, dt):\n    {before}\n    _real(self, dt)\n"
        f"    {after or 'pass'}\nWorld.step = _step\n"
    )
    with open(tree / "mini_engine" / "world.py", "a", encoding="utf-8") as file:
        file.write(text)
    return tree


GIVE_UP = {
    "raise ZeroDivisionError('no mass')": "ZeroDivisionError: no mass (1/60 s)",
    "self.bodies[-1].pos.x = math.nan": "Body.pos.x is nan",
    "self.bodies[-1].pos.x = 1e5": "a body is 1e+05 px from where it should be",
    "import sys; sys.settrace(None)": "sys.settrace was called",
    "import sys; sys._getframe().f_trace_opcodes = False": "its opcodes were hidden",
}


@pytest.mark.parametrize("code", GIVE_UP)
def test_who_gives_up_or_meddles_stands_at_the_edge_with_the_reason(
    code: str, hand_in: HandIn
) -> None:
    assert GIVE_UP[code] in reason(with_step(hand_in, code), short(SLIDE))


@ON_LINUX
def test_work_of_another_thread_is_noticed(hand_in: HandIn) -> None:
    busy = "lambda: sum(range(10**5))"
    code = f"import threading; t = threading.Thread(target={busy}); t.start(); t.join()"
    assert "thread" in reason(with_step(hand_in, code), short(SLIDE))


def test_less_work_while_opcodes_are_counted_is_another_engine(hand_in: HandIn) -> None:
    tree = with_step(
        hand_in, "self.bodies[-1].vel *= 1.0 if sys.gettrace() else 0.9", top="import sys"
    )
    told = reason(tree, short(SLIDE))
    assert "px where opcodes are counted and" in told and "where they are not" in told


def test_a_tower_that_is_nailed_into_the_air_is_none(hand_in: HandIn) -> None:
    tree = with_step(hand_in, "return")
    assert "after the floor was taken away" in reason(tree, short(TOWER))


def test_who_freezes_a_tower_until_its_floor_is_gone_has_the_way_down_as_its_error(
    hand_in: HandIn,
) -> None:
    tree = with_step(hand_in, "if self.bodies[0].pos.y < 1000: return")
    (point,) = measured(tree, short(TOWER, 0.55)).curves[0].points
    assert point.error == 10 * truth.GAP


def test_what_works_in_c_cannot_be_imported(hand_in: HandIn) -> None:
    assert "numpy" in BANS
    tree = with_step(hand_in, "pass", top="import pymunk")
    assert "pymunk may not be imported here: it works in machine code" in reason(tree, short(SLIDE))


@ON_LINUX
def test_work_that_no_opcode_tells_is_seen_in_the_kernels_seconds(hand_in: HandIn) -> None:
    scene = short(PENDULUM, 1.0)
    lesson, forger = (
        measure(each, [scene], OPTIONS, shared_worker())
        for each in (KIT / "solution", with_step(hand_in, "pass", "sum(range(100_000))"))
    )
    assert not any(
        curve.gave_up for curve in [*lesson.checked(lesson).curves, *forger.prices.curves]
    )
    assert "something works that nobody counts" in forger.checked(lesson).curves[0].gave_up
    assert forger.checked(None) == forger.prices


# ---------------------------------------------------------------- the front


def beaten(point: Point, others: Sequence[Point]) -> bool:
    return any(
        each.opcodes <= point.opcodes
        and each.error <= point.error
        and (each.opcodes, each.error) != (point.opcodes, point.error)
        for each in others
    )


def test_the_front_is_what_nobody_beats_by_brute_force() -> None:
    rng = random.Random(1)
    for _ in range(300):
        few = rng.randint(1, 9)  # many are equal then
        points = [
            (f"s{n}", Point("", rng.randint(1, few), float(rng.randint(1, few))))
            for n in range(rng.randint(0, 25))
        ]
        all_of_them = [point for _, point in points]
        right = [each for each in points if not beaten(each[1], all_of_them)]
        found = front(points)
        assert sorted(found, key=str) == sorted(right, key=str)
        assert [each[1].opcodes for each in found] == sorted(each[1].opcodes for each in found)


def test_an_error_for_so_many_opcodes_lies_between_two_settings() -> None:
    curve = Curve("tower", [Point("b", 400, 1.0), Point("a", 100, 4.0)])
    asked = (50, 100, 200, 400, 9000)
    assert [error_for(curve, n) for n in asked] == [None, 4.0, pytest.approx(2.0), 1.0, 1.0]
    assert error_for(Curve("tower", []), 100) is None


# ---------------------------------------------------------------- pages


def made_up(count: int, name: str = "student {:03}") -> PriceList:
    """A class of engines that nobody ran, of which every tenth gave up somewhere."""
    rng = random.Random(7)
    engines = []
    for number in range(count):
        better = math.exp(rng.gauss(0, 0.5))
        curves = []
        for scene in scenes():
            if rng.random() < 0.1:
                words = rng.choice(["TODO 3 is not begun", "ValueError: Body.pos.x is nan"])
                curves.append(Curve(scene.id, [], words))
                continue
            cost = rng.uniform(0.7, 1.6)
            points = [
                Point(each.words, round(cost * 4e5 * 2**n), round(better * 16 / 2.2**n, 3))
                for n, each in enumerate(scene.settings)
            ]
            curves.append(Curve(scene.id, points))
        engines.append(Prices(name.format(number), curves))
    beside = []
    for name, share in ((LESSON, 1.0), (STABLE, 0.2), (PYMUNK, 0.1)):
        curves = []
        for scene in scenes():
            points = [
                Point(each.words, 500_000 * 2**n, share * 16 / 2.0**n)
                for n, each in enumerate(scene.settings)
            ]
            curves.append(Curve(scene.id, points))
        beside.append(Prices(name, curves))
    return price_list(scenes(), beside, engines)


def test_the_same_engines_in_another_order_make_the_same_page_and_list() -> None:
    found = made_up(5)
    turned = price_list(scenes(), found.others, found.engines[::-1])
    assert as_json(turned) == as_json(found) and section(turned) == section(found)


def test_the_page_shows_every_engine_the_front_and_why_others_gave_up(tmp_path: Path) -> None:
    found, path = made_up(30), tmp_path / "p.html"
    write_prices(found, "a class", path)
    page = Reader(path.read_text(encoding="utf-8"))
    shown = [a["data-name"] for tag, a in page.tags if tag == "g" and a.get("data-name")]
    assert set(shown) == {each.name for each in found.engines} | {LESSON, STABLE}
    assert found.python in page.text and "pymunk, 8 passes" in page.text
    for drawn in charts(found):
        assert drawn.front and drawn.gave_up
        for name, point in drawn.front:
            assert (
                f"{name}{point.setting}{in_opcodes(point.opcodes)}{in_px(point.error)}" in page.text
            )
        for why, names in drawn.gave_up:
            assert f"({len(names)}): {', '.join(names)}: {why}." in page.text


def test_nobody_who_gave_up_is_left_out_however_many_they_are() -> None:
    curves = [Curve(scene.id, [], "TODO 3 is not begun") for scene in scenes()]
    engines = [Prices(f"student {n:03}", curves) for n in range(MANY)]
    text = str(section(price_list(scenes(), [], engines)))
    assert "student 000, student 001" in text and "student 199: TODO 3 is not begun." in text


def test_names_and_reasons_of_students_are_text(tmp_path: Path) -> None:
    found = made_up(2, HOSTILE + "{}")
    curves = [Curve(scene.id, [], HOSTILE) for scene in scenes()]
    found = structs.replace(found, engines=[*found.engines, Prices("x" + HOSTILE, curves)])
    for own in ("", "x" + HOSTILE):
        write_prices(found, HOSTILE, tmp_path / "p.html", own)
        page = Reader((tmp_path / "p.html").read_text(encoding="utf-8"))
        assert not page.handlers and page.count("img") == 0
        assert page.count("script") == (0 if own else 2) and HARMLESS in page.text


def test_the_smallest_and_the_largest_numbers_have_a_place() -> None:
    ends = [Point("2 passes", 1, 1e-3), Point("8 passes", 10**9, 1000.0)]
    for points in (ends, ends[:1]):
        one = Prices("s", [Curve("tower", points)])
        text = str(section(price_list(scenes(), [], [one])))
        assert "nan" not in text and "inf" not in text and 'data-name="s"' in text


def test_a_students_page_has_their_own_curve_and_no_other_name() -> None:
    found = made_up(9)
    own = next(each for each in found.engines if all(curve.points for curve in each.curves))
    text = str(section(found, own.name))
    assert not any(each.name in text for each in found.engines if each is not own)
    assert text.count('class="line own"') == len(scenes()) and "For the lesson's" in text


def test_the_class_page_and_everybodys_page_have_the_curves(tmp_path: Path) -> None:
    results = tmp_path / "c"
    write_list(made_up(3, "s{}"), results)
    with Book(results) as book:
        book.close_with([Outcome(f"s{n}", "no zip") for n in range(3)])
    page = write_dashboard(results, read_class(results)).read_text(encoding="utf-8")
    assert page.count('data-name="s1"') >= 3 and "script.points" in page
    write_list(made_up(0), results)
    assert read_list(results) == made_up(0)


# ---------------------------------------------------------------- the open task


def test_the_open_task_asks_for_less_sinking_at_the_lessons_price() -> None:
    curve = Curve("tower", [Point("8 passes", 1000, 5.0)])
    lesson = Prices(LESSON, [curve])
    for opcodes, error, done in (
        (1000, 5.0, False),
        (1000, 4.6, False),
        (1000, 4.5, True),
        (1001, 0.1, False),
        (10, 0.1, True),
    ):
        own = Prices("s", [Curve("tower", [Point("x", opcodes, error)])])
        assert price_list(scenes(), [lesson], [own]).sinks_less(own) is done
    at_home = price_list(scenes(), [], [own])
    assert not at_home.sinks_less(own)


def test_its_points_are_a_bonus_where_the_course_says_so(tmp_path: Path) -> None:
    def bonus(course: Course) -> tuple[int, list[str]]:
        run = Run(
            Intake(),
            Book(tmp_path / "c"),
            "",
            load_adjustments(None, course),
            course,
            less_sunk=frozenset({"ann"}),
        )
        for name in ("ann", "bob"):
            run.record("graded", Found(name, ()), Outcome(name, points=50, max_points=100))
        ann, bob = run.outcomes
        assert bob.bonus == 0 and ann.points == 50
        return ann.bonus, ann.notes

    assert bonus(Course()) == (0, [])
    assert bonus(Course(open_task=3)) == (3, ["open task: +3"])


def test_grading_a_class_reads_who_has_done_it(tmp_path: Path) -> None:
    found = made_up(2, "s{}")
    curve = Curve("tower", [Point("8 passes", 500_000, 0.1)])
    found = structs.replace(found, engines=[Prices("s0", [curve]), found.engines[1]])
    write_list(found, tmp_path / "c")
    for points, done in ((0, set()), (2, {"s0"})):
        course, pool = Course(open_task=points), Pool(OPTIONS, 1)
        run = grade_class(Intake(), tmp_path / "c", "", pool, cli.console, course=course)
        assert run.less_sunk == done


@pytest.mark.parametrize(
    "text",
    ["open_task = -1", "open_task = 1.5", "open_task = true", 'open_task = 1\nbonus = "left out"'],
)
def test_a_wrong_number_of_its_points_is_said_in_one_sentence(text: str, tmp_path: Path) -> None:
    path = tmp_path / "course.toml"
    path.write_text(text)
    with pytest.raises(WrongCourse, match=r"open_task = ") as caught:
        read_course(path)
    assert str(caught.value).count("\n") == 0


def test_the_pages_say_what_is_measured() -> None:
    page = (KIT / "handouts/instructor/prices.md").read_text(encoding="utf-8")
    for words in (
        f"{CPU_SECONDS} s of processor",
        f"{LOST:g} px from where",
        f"Below {LEAST:g} px",
    ):
        assert words in page
    for scene, told in zip(scenes(), re.findall(r"^\| a .*\|$", page, re.M), strict=True):
        first, last = scene.settings[0].words, scene.settings[-1].words
        assert f"{first.removesuffix(' passes').removesuffix(' s')} to {last} |" in told
        assert f", {scene.seconds:g} s |" in told and f"TODO {', '.join(scene.needs)} |" in told
    assert UNTOLD == 5 and "five\n  times those of the lesson's" in (
        KIT / "handouts/instructor/security.md"
    ).read_text(encoding="utf-8")


# ---------------------------------------------------------------- the command


def test_the_command_refuses_what_it_would_pass_over() -> None:
    run = CliRunner().invoke
    assert run(cli.prices.app, ["--class"]).exit_code == 2
    assert run(cli.prices.app, [str(KIT / "solution"), "--jobs", "2"]).exit_code == 2
    assert run(cli.prices.app, [str(KIT / "nothing")]).exit_code == 2


@pytest.mark.soak
def test_a_class_is_measured_kept_and_shown(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    shutil.copytree(KIT / "solution" / "mini_engine", folder / "ann" / "mini_engine")
    shutil.copytree(KIT / "starter" / "mini_engine", folder / "bob" / "mini_engine")
    shutil.copytree(folder / "ann" / "mini_engine", folder / "eve" / "mini_engine")
    world = folder / "eve" / "mini_engine" / "world.py"
    text = world.read_text(encoding="utf-8")
    world.write_text(text.replace("        # 3 solve\n", "        assert len(self.bodies) < 9\n"))
    (folder / "dan").mkdir()
    (folder / "dan" / "essay.txt").write_text("not the lab")
    results = folder.with_name("class-results")
    with Book(results) as book:
        book.close_with([Outcome(each, "not graded") for each in ("ann", "bob")])
    pages = []
    for told in ("3 measured, 0 kept, 1 trouble", "0 measured, 3 kept, 1 trouble"):
        run = CliRunner().invoke(cli.prices.app, ["--class", str(folder), "--jobs", "2"])
        assert run.exit_code == 0 and f"4 engines: {told}" in run.output, run.output
        pages.append((tmp_path / "class-results.prices.json").read_bytes())
    assert pages[0] == pages[1]
    found = read_list(results)
    assert found is not None and [each.name for each in found.engines] == [
        "ann",
        "bob",
        "dan",
        "eve",
    ]
    ann, bob, dan, eve = found.engines
    assert found.lesson and ann.curves == found.lesson.curves and not found.sinks_less(ann)
    assert {curve.gave_up for curve in bob.curves} == {
        "TODO 1, 2 and 4 are not begun",
        "TODO 3 is not begun",
    }
    assert "AssertionError" in eve.curve("tower").gave_up and eve.curve("slide").points
    assert all(curve.gave_up and not curve.points for curve in dan.curves)
    assert 'data-name="ann"' in (tmp_path / "class-results.class.html").read_text("utf-8")
    assert (tmp_path / "class-results.prices.html").is_file()


@ON_LINUX
@pytest.mark.soak
def test_who_finds_the_number_and_writes_another_one_is_seen_at_every_setting(
    hand_in: HandIn,
) -> None:
    code = "if sys.gettrace(): sys.gettrace().__self__.so_far.__closure__[0].cell_contents = 0"
    tree = with_step(hand_in, "pass", code, "import sys")
    lesson, forger = (
        measure(each, scenes(), OPTIONS, shared_worker()) for each in (KIT / "solution", tree)
    )
    assert lesson.checked(lesson) == lesson.prices
    assert all(point.opcodes < 1000 for curve in forger.prices.curves for point in curve.points)
    for curve in forger.checked(lesson).curves:
        assert "at 2 passes its opcodes" in curve.gave_up or "at 1/60 s its" in curve.gave_up
    for number in range(4):  # one setting alone
        for curve in forger.prices.curves:
            one = Curve(curve.scene, curve.points[number : number + 1])
            taken = {curve.scene: forger.seconds[curve.scene][number : number + 1]}
            assert Measured(Prices("s", [one]), taken).checked(lesson).curves[0].gave_up


@pytest.mark.soak
def test_who_never_ends_stands_at_the_edge(
    hand_in: HandIn, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("grader.prices.measure.CPU_SECONDS", 1)
    told = reason(with_step(hand_in, "while True: pass"), short(SLIDE))
    assert "used up its 1 s of processor time" in told


@pytest.mark.soak
def test_a_class_of_200_is_readable_by_pointer_keys_print_and_on_a_phone(tmp_path: Path) -> None:
    found, path = made_up(MANY), tmp_path / "p.html"
    write_prices(found, "a class", path)
    with chromium() as browser:
        screen = Screen(browser, path)
        page = screen.page
        for number, drawn in enumerate(charts(found)):
            figure = page.locator("figure").nth(number)
            points = [
                (each.name, point)
                for each in found.engines
                for point in each.curve(drawn.asked.id).points
            ]
            unbeaten = {
                (name, point.setting)
                for name, point in points
                if not beaten(point, [other for _, other in points])
            }
            rows = figure.locator(".on-front tbody tr").all_inner_texts()
            assert {tuple(row.split("\t")[:2]) for row in rows} == unbeaten
            svg = figure.locator("svg")
            svg.scroll_into_view_if_needed()
            box = svg.bounding_box()
            name, point = drawn.front[0]
            line = next(each for each in drawn.lines if each.name == name)
            which = next(n for n, words in enumerate(line.words) if words.startswith(point.setting))
            x, y = line.places[which]
            share = box["width"] / 460
            page.mouse.move(box["x"] + x * share, box["y"] + y * share)
            assert figure.locator(".reads").inner_text() == f"{name}: {line.words[which]}"
            assert figure.locator(".told text").text_content() == name
            assert page.locator(".prices select").input_value() == name
            assert figure.locator(f'.chosen[data-name="{name}"]').count() == 1
        page.locator(".prices select").focus()
        before = page.locator(".prices select").input_value()
        page.keyboard.press("ArrowDown")
        after = page.locator(".prices select").input_value()
        assert after != before and after in page.locator(".reads").first.inner_text()
        page.emulate_media(media="print", color_scheme="dark")
        assert not page.locator(".find").is_visible()
        assert page.locator(".on-front").first.is_visible()
        page.emulate_media(media="screen")
        page.set_viewport_size({"width": 390, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        assert screen.complaints == []
        own = tmp_path / "own.html"
        write_prices(found, "one", own, found.engines[1].name)
        assert barriers(browser, path, own) == []


@pytest.mark.soak
def test_every_right_engine_of_the_bank_is_measured_and_no_hostile_one_stops_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("grader.prices.measure.CPU_SECONDS", 2)
    asked = [short(each) for each in scenes()]
    lesson = measure(KIT / "solution", asked, OPTIONS, shared_worker())
    for number, member in enumerate(members(KIT)):
        if member.kind not in ("right", "hostile"):
            continue
        folder = tmp_path / str(number)
        member.build(KIT, folder / member.name.replace("/", "-"))
        found = measure(next(folder.iterdir()), asked, OPTIONS, shared_worker())
        for curve in found.checked(lesson).curves:
            assert curve.points or curve.gave_up, member.name
            assert member.kind == "hostile" or curve.points or "numpy" in curve.gave_up, member.name
