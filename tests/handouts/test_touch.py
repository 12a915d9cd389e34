"""Test movable figures: they compute the same as the grader, and obey all controls."""

import json
import math
import random
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from page_readers import Screen
from samples import sample

import integrators
import mini_engine
from grader.checks import exact
from grader.checks.exact import Disc, Lever, Rect, Rod
from grader.release.pages import SHARED as LOADED
from grader.release.pages import find_figures

KIT = Path(__file__).parents[2]
TOUCH = KIT / "handouts" / "touch"
SHARED = ("touch", "laws", "films")
NAMES = sorted(path.stem for path in TOUCH.glob("*.js") if path.stem not in SHARED)
PLAYED = ("predict", "tower")  # by films: see test_films.py
MEASURED = (  # see test_measured.py
    "accuracy",
    "effects-stacked",
)
MOVED = [name for name in NAMES if name not in PLAYED + MEASURED]
POINTS = 1000
SHOWING = ("lesson.md", "lab-sheet.md", "accuracy.md", "effects.md", "hard-cases.md")
METHODS = ["explicit_euler", "semi_implicit_euler", "velocity_verlet", "rk4"]


def test_each_has_a_still_picture_that_the_lesson_shows() -> None:
    texts = [(KIT / "handouts" / name).read_text("utf-8") for name in SHOWING]
    shown = [Path(each).stem for text in texts for each in find_figures(text)]
    kinds = {name.partition("-")[0] for name in shown}
    assert len(NAMES) >= 10 and set(NAMES) <= {*shown, *kinds}


def test_the_site_loads_every_one_of_them() -> None:
    settings = (KIT / "handouts" / "site" / "mkdocs.yml").read_text("utf-8")
    assert re.findall(r"touch/(\S+)\.js", settings) == [*LOADED, *NAMES]


def test_pages_without_such_a_figure_load_nothing(handout_pages: Path) -> None:
    assert "<script" in (handout_pages / "lesson.html").read_text("utf-8")
    assert "<script" not in (handout_pages / "quiz.html").read_text("utf-8")


def test_none_of_them_asks_for_anything_from_elsewhere() -> None:
    for path in (each for each in TOUCH.rglob("*") if each.is_file()):
        found = re.findall(r"https?://\S+", path.read_text("utf-8"))
        assert not [each for each in found if "www.w3.org" not in each], path.name


@pytest.fixture(scope="module")
def screen(browser: Any, handout_pages: Path) -> Iterator[Screen]:
    screen = Screen(browser, handout_pages / "lesson.html")
    yield screen
    assert screen.complaints == []
    screen.page.close()


# ---------------------------------------------------------------- computing


def compute(screen: Screen, law: str, inputs: list[Any]) -> list[Any]:
    """Return the page's result for each input, a list of arguments."""
    source = f"inputs => inputs.map(each => ({law})(...each))"
    answers: list[Any] = json.loads(json.dumps(screen.page.evaluate(source, inputs)))
    assert len(answers) == len(inputs)
    return answers


def test_contacts_are_those_of_the_grader(screen: Screen) -> None:
    rng = random.Random(1)
    box = Rect(3.0, -7.0, 60.0, 25.0)
    discs = [
        Disc(rng.uniform(-100, 100), rng.uniform(-70, 60), rng.uniform(2, 60))
        for _ in range(POINTS)
    ]
    inputs = [[each._asdict(), box._asdict()] for each in discs]
    kinds = set()
    for disc, found in zip(discs, compute(screen, "laws.circleBox", inputs), strict=True):
        (right,) = exact.circle_box(disc, box)
        kinds.add((right is None, found["distance"] > 0))
        assert (found["depth"] <= 0) == (right is None)
        if right is not None:
            normal, point = found["out"], found["point"]
            numbers = -normal["x"], -normal["y"], found["depth"], point["x"], point["y"]
            assert numbers == pytest.approx(right, abs=1e-9)
    assert len(kinds) == 3  # no contact, outside, inside


def test_damping_is_that_of_the_grader(screen: Screen) -> None:
    inputs = [(rate, seconds) for rate in exact.RATES for seconds in exact.DAMPED_STEPS]
    found = compute(screen, "laws.damped", [list(each) for each in inputs])
    assert found == pytest.approx([exact.compute_share(*each) for each in inputs])


class Counted:
    """A world that has a step and nothing else."""

    def step(self, dt: float) -> None:
        pass


@pytest.mark.soak
def test_frames_run_the_steps_of_the_reference(screen: Screen) -> None:
    lengths = [4 + 0.25 * n for n in range(POINTS)]  # ms
    for length, frames in zip(
        lengths, compute(screen, "laws.runFrames", [[each, 10] for each in lengths]), strict=True
    ):
        rest, paid, seconds = 0.0, 0, 0.0
        for frame in frames:
            rest, steps = mini_engine.advance(Counted(), rest, length / 1000)
            paid += frame["steps"] - steps
            seconds += (frame["steps"] - steps) * mini_engine.STEP
            # If the sum is exactly a step, rounding decides in which frame it runs.
            assert abs(paid) <= 1
            assert frame["waiting"] / 1000 + seconds == pytest.approx(rest, abs=1e-9)


@pytest.mark.soak
def test_a_disc_gives_way_as_the_grader_has_it(screen: Screen) -> None:
    rng = random.Random(2)
    floor = Lever(0.0, 1.0, 0.0, 0.0)
    levers = [
        Lever(rng.uniform(0.1, 9), rng.uniform(1, 90), rng.uniform(-90, 90), rng.uniform(-90, 90))
        for _ in range(POINTS)
    ]
    angles = [rng.uniform(-math.pi, math.pi) for _ in levers]
    inputs = [
        [{"mass": each.mass, "radius": each.radius}, {"x": each.rx, "y": each.ry}, angle]
        for each, angle in zip(levers, angles, strict=True)
    ]
    found = compute(screen, "laws.giving", inputs)
    for lever, angle, answer in zip(levers, angles, found, strict=True):
        axis = math.cos(angle), math.sin(angle)
        right = exact.effective_mass(lever, floor, axis)
        assert answer["moving"] + answer["turning"] == pytest.approx(right)


def test_rods_are_those_of_the_grader(screen: Screen) -> None:
    rng = random.Random(3)
    inputs, rods = [], []
    for _ in range(POINTS):
        masses = [rng.uniform(0.1, 9), rng.uniform(0.1, 9)]
        if rng.random() < 0.3:
            masses[rng.randrange(2)] = 0.0
        speeds = [rng.uniform(-400, 400) if mass else 0.0 for mass in masses]
        length, now = rng.uniform(10, 200), rng.uniform(10, 200)
        at_once = {"massA": masses[0], "massB": masses[1], "dt": 1 / 120, "error": now - length}
        inputs.append([{**at_once, "speedA": speeds[0], "speedB": speeds[1]}])
        ends = [(speed, 0.0) for speed in speeds]
        rods.append(Rod(masses[0], masses[1], length, (now, 0.0), ends[0], ends[1], 1 / 120))
    for rod, found in zip(rods, compute(screen, "laws.rodSolved", inputs), strict=True):
        (a, _), (b, _) = exact.solve_rod(rod)
        assert (found["speedA"], found["speedB"]) == pytest.approx((a, b), abs=1e-7)


@pytest.mark.soak
def test_chains_are_those_of_the_grader_pass_by_pass(screen: Screen) -> None:
    rng = random.Random(5)
    inputs: list[Any] = []
    for _ in range(POINTS):
        masses = [rng.choice([0.0, rng.uniform(0.1, 9)]), rng.uniform(0.1, 9), rng.uniform(0.1, 9)]
        errors = [rng.uniform(-60, 60), rng.uniform(-60, 60)]
        inputs.append(
            [{"masses": masses, "errors": errors, "passes": rng.randint(1, 8), "dt": 1 / 120}]
        )
    for (given,), found in zip(inputs, compute(screen, "laws.chainSolved", inputs), strict=True):
        speeds = [0.0, 0.0, 0.0]
        for _ in range(given["passes"]):
            for n, error in enumerate(given["errors"]):
                ends = [(speed, 0.0) for speed in speeds[n : n + 2]]
                rod = Rod(*given["masses"][n : n + 2], 100.0, (100 + error, 0.0), *ends, 1 / 120)
                speeds[n : n + 2] = (x for x, _ in exact.solve_rod(rod))
        assert found["speeds"] == pytest.approx(speeds, abs=1e-6)
        assert found["after"][-1] == pytest.approx(
            [speeds[1] - speeds[0], speeds[2] - speeds[1]], abs=1e-6
        )


@pytest.mark.soak
def test_a_sliding_ball_rolls_at_the_speed_of_the_grader(screen: Screen) -> None:
    speeds = [float(number) for number in range(1, POINTS)]
    answers = compute(screen, "laws.sliding", [[each, 0.4, 60.0] for each in speeds])
    for speed, found in zip(speeds, answers, strict=True):
        assert found["speed"] == pytest.approx(exact.rolling_speed(speed))
        assert found["rim"] == pytest.approx(found["speed"]) and found["rolls"]


@pytest.mark.soak
@pytest.mark.parametrize("name", METHODS)
def test_a_step_on_a_spring_is_that_of_the_grader(screen: Screen, name: str) -> None:
    rng = random.Random(4)
    method = getattr(exact, name, None) or getattr(integrators, name)
    steps = [rng.uniform(0.01, 1.5) for _ in range(POINTS // 4)]  # rad of the swing
    found = compute(screen, f"laws.integrators.{name}", [[each] for each in steps])
    for h, (a, b, c, d) in zip(steps, found, strict=True):
        x, s = rng.uniform(-9, 9), rng.uniform(-9, 9)
        right = method(x, s, h, lambda place: -place)
        assert (a * x + b * s, c * x + d * s) == pytest.approx(right, abs=1e-9)


# ---------------------------------------------------------------- moved by keys and pointer


def figure(screen: Screen, name: str) -> Any:
    found = screen.page.locator(f'figure[data-figure="{name}"]')
    assert found.count() == 1
    return found


def words(screen: Screen, name: str) -> str:
    text = str(figure(screen, name).locator("output").inner_text())
    return text.replace("\N{MINUS SIGN}", "-")


def slide(screen: Screen, name: str, label: str, value: float) -> None:
    figure(screen, name).get_by_label(label).fill(str(value))


@pytest.mark.parametrize("name", sample(MOVED, 4))
def test_every_one_is_drawn_and_says_what_it_shows(screen: Screen, name: str) -> None:
    found = figure(screen, name)
    assert found.locator("svg g *").count() > 5
    assert re.search(r"\d", words(screen, name))
    assert not found.locator("img").is_visible()
    named = found.locator("input, button, .handle").all()
    assert named and all(each.evaluate("each => each.tabIndex >= 0") for each in named)


def test_the_circle_is_moved_by_keys(screen: Screen) -> None:
    assert "60 px - 43 px = 17 px" in words(screen, "contact")
    circle = figure(screen, "contact").locator(".handle")
    circle.focus()
    for _ in range(12):
        screen.page.keyboard.press("ArrowDown")
    assert "The top face is nearest. Depth = radius + gap = 60 px + 17 px = 77 px" in words(
        screen, "contact"
    )
    for _ in range(13):
        screen.page.keyboard.press("Shift+ArrowUp")
    assert "60 px + 4 px = 64 px" in words(screen, "contact")


@pytest.mark.soak
def test_the_circle_is_dragged(screen: Screen) -> None:
    found = figure(screen, "contact")
    found.scroll_into_view_if_needed()
    place, paper = (
        found.locator(".handle .grip").bounding_box(),
        found.locator("svg[role]").bounding_box(),
    )
    mouse = screen.page.mouse
    mouse.move(place["x"] + place["width"] / 2, place["y"] + place["height"] / 2)
    mouse.down()
    mouse.move(paper["x"] + 10, paper["y"] + 10, steps=4)
    mouse.up()
    assert words(screen, "contact").startswith("No contact")
    mouse.move(paper["x"] + 200, paper["y"] + 200)  # let go: it stays
    assert words(screen, "contact").startswith("No contact")


def test_long_frames_are_cut_and_short_ones_lose_nothing(screen: Screen) -> None:
    slide(screen, "accumulator", "a frame takes", 100)
    assert "33 ms are given up (red), and the scene runs at 67 %" in words(screen, "accumulator")
    slide(screen, "accumulator", "a frame takes", 20)
    assert "2.40 steps" in words(screen, "accumulator")
    assert "Nothing is lost" in words(screen, "accumulator")


@pytest.mark.soak
@pytest.mark.parametrize(
    ("name", "settings", "said"),
    [
        ("damping", {"steps a second": 60}, "54.7 % after a second. The rate leaves 54.9 %"),
        ("damping", {"steps a second": 240}, "9.0 % after a second. The rate leaves 54.9 %"),
        ("integrators", {"swings": 300}, "explicit Euler: the energy grows without bound."),
        ("accumulated", {}, "ask for +4. Clamping each change gives 11: 7 too much"),
        (
            "accumulated",
            {f"pass {number} asks for": number for number in range(1, 5)},
            "Both rules give 10",
        ),
        ("rolling", {"time": 0.5}, "It rolls at 200 px/s, two thirds of 300 px/s"),
        ("rolling", {"friction": 0}, "On ice it keeps its 300 px/s"),
        ("rod", {"passes": 2}, "After 2 passes their ends part at -113 and -360 px/s"),
        ("rod", {"passes": 8}, "part at -612 and -360 px/s"),
    ],
)
def test_a_figure_says_what_its_settings_give(
    screen: Screen, name: str, settings: dict[str, float], said: str
) -> None:
    for label, value in settings.items():
        slide(screen, name, label, value)
    assert said in words(screen, name)


@pytest.mark.soak
def test_an_impulse_through_the_centre_does_not_turn(screen: Screen) -> None:
    handle = figure(screen, "effective-mass").locator(".handle")
    handle.focus()
    for _ in range(13):
        screen.page.keyboard.press("ArrowDown")
    screen.page.keyboard.press("Shift+ArrowDown")
    assert " = 0 px (dashed)" in words(screen, "effective-mass")
    assert "0.500 + 0.000 = 0.500 per kg" in words(screen, "effective-mass")


@pytest.mark.soak
def test_a_ball_rolls_in_real_time_and_stops_when_asked(screen: Screen) -> None:
    """The test controls the page's clock, so it misses no moment on a busy machine."""
    slide(screen, "rolling", "friction", 0.5)
    slide(screen, "rolling", "time", 0)
    found = figure(screen, "rolling")
    screen.page.clock.install()
    screen.page.clock.pause_at("2030-01-01")
    found.get_by_role("button", name="Roll").click()
    screen.page.clock.run_for(200)
    assert found.locator("output").get_attribute("aria-live") == "off"
    found.get_by_role("button", name="Stop").click()
    now = float(found.get_by_label("time").input_value())
    assert now == pytest.approx(0.2, abs=0.05)
    screen.page.clock.run_for(200)
    assert float(found.get_by_label("time").input_value()) == now
    screen.page.clock.resume()


# ---------------------------------------------------------------- other pages than wide and light


BEYOND = """names => names.flatMap(name => {
    const figure = document.querySelector(`figure[data-figure="${name}"]`);
    const paper = figure.querySelector("svg[role]").getBoundingClientRect();
    return [...figure.querySelectorAll("svg[role] text, label, label *, button")].filter(each => {
        const place = each.getBoundingClientRect();
        const left = each.tagName === "text" && place.left < paper.left - 1;
        return place.width && (left || place.right > paper.right + 1);
    }).map(each => `${name}: ${each.textContent}`);
})"""


def test_they_fit_a_phone(screen: Screen) -> None:
    """All words and controls of a figure lie within its width."""
    usual = screen.page.viewport_size
    screen.page.set_viewport_size({"width": 390, "height": 800})
    screen.page.wait_for_function("document.querySelector('.touch svg').clientWidth < 390")
    assert screen.page.evaluate(BEYOND, MOVED) == []
    screen.page.set_viewport_size(usual)


VISIBLE = """names => names.filter(name => {
    const picture = document.querySelector(`img[data-figure="figures/${name}.svg"]`);
    return picture.getBoundingClientRect().width > 0;
})"""


def test_paper_has_the_still_picture(screen: Screen) -> None:
    names = [*MOVED, "tower"]
    screen.page.emulate_media(media="print")
    assert screen.page.evaluate(VISIBLE, names) == names
    assert not screen.page.locator("figure .controls:visible").count()
    screen.page.emulate_media(media="screen")


@pytest.mark.soak
def test_browsers_without_scripts_have_the_still_picture(browser: Any, handout_pages: Path) -> None:
    plain = Screen(browser, handout_pages / "lesson.html", java_script_enabled=False)
    for name in [*MOVED, "tower"]:
        assert plain.page.locator(f'img[data-figure="figures/{name}.svg"]').is_visible()
    plain.page.close()
