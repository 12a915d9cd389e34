"""Test that figures of measurements show the values of results.json, and obey pointer and keys."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from page_readers import Screen, chromium

from grader.release.measured import make_script

HANDOUTS = Path(__file__).parents[2] / "handouts"
RESULTS = json.loads((HANDOUTS / "results.json").read_text("utf-8"))
SCRIPT = make_script(RESULTS).partition("= ")[2].removesuffix(";\n")
PAGE = (HANDOUTS / "accuracy.md").read_text("utf-8")


@pytest.fixture(scope="module")
def screen(handout_pages: Path) -> Iterator[Screen]:
    with chromium() as browser:
        screen = Screen(browser, handout_pages / "accuracy.html")
        yield screen
        assert screen.complaints == []


def open_figure(screen: Screen, name: str) -> Any:
    """Load the page of a figure; return the figure."""
    page = name.partition("-")[0]
    screen.page.goto(re.sub(r"[\w-]+\.html.*", f"{page}.html", screen.page.url))
    figure = screen.page.locator(f'figure[data-figure="{name}"]')
    figure.scroll_into_view_if_needed()
    return figure


def test_prices_add_up_to_those_of_all_together() -> None:
    for balls, prices in json.loads(SCRIPT)["prices"].items():
        together = RESULTS["effects.md"][f"{balls} balls, all of them together: price in opcodes"]
        assert sum(prices.values()) == pytest.approx(together, rel=0.01)


@pytest.mark.soak
def test_prices_of_declared_effects_add_up(screen: Screen) -> None:
    figure, prices = open_figure(screen, "effects-stacked"), json.loads(SCRIPT)["prices"]
    words, drawing = figure.locator("output"), figure.locator("svg[role]")
    every = sum(prices["40"].values())
    assert f"the price of contacts is {prices['40']['contacts']:,} opcodes" in words.inner_text()
    assert f"added up: {every:,} opcodes" in (drawing.text_content() or "")
    drawing.focus()
    screen.page.keyboard.press("ArrowRight")
    assert f"the price of friction is {prices['40']['friction']:,} opcodes" in words.inner_text()
    figure.get_by_label("10 rods").uncheck()
    less = every - prices["40"]["10 rods"]
    assert f"added up: {less:,} opcodes" in (drawing.text_content() or "")
    box = drawing.bounding_box()
    screen.page.mouse.move(box["x"] + 12, box["y"] + 70)
    assert f"the price of move only is {prices['40']['move only']:,} opcodes" in words.inner_text()
    figure.get_by_label("contacts").uncheck()
    assert figure.get_by_label("friction").is_disabled()
    figure.get_by_label("balls").focus()
    screen.page.keyboard.press("ArrowRight")
    left = ("move only", "10 springs", "damping", "sleep, all awake")
    assert f"added up: {sum(prices['200'][each] for each in left):,} " in (
        drawing.text_content() or ""
    )


# ---------------------------------------------------------------- curves


CHARTS = json.loads(SCRIPT)["charts"]


def curve_of(name: str, look: str, panel: int = 0) -> dict[str, Any]:
    return next(each for each in CHARTS[name]["panels"][panel]["curves"] if each["look"] == look)


def test_every_figure_of_curves_has_its_data() -> None:
    shown = re.findall(r"figures/(accuracy-[\w-]+)\.svg", PAGE)
    assert set(CHARTS) == set(shown) and len(CHARTS) == len(shown)


@pytest.mark.parametrize("name", CHARTS)
def test_no_point_of_a_curve_lies_beyond_its_axes(name: str) -> None:
    bottom, top = CHARTS[name]["ends"]
    for panel in CHARTS[name]["panels"]:
        for curve in panel["curves"]:
            assert curve["points"] or curve["high"] or curve["low"]
            assert all(x > 0 and bottom < y < top for x, y in curve["points"])


@pytest.mark.parametrize(
    ("name", "look", "line"),
    [
        ("accuracy-dials-tower", "as it is", "tower of 20, lesson, 8 passes: sink"),
        ("accuracy-dials-tower", "step", "tower of 20, lesson, 8 passes, 1/60 s: sink"),
        ("accuracy-dials-tower", "step", "tower of 20, lesson, 8 passes, 1/480 s: sink"),
        ("accuracy-dials-tower", "passes", "tower of 20, lesson, 64 passes: sink"),
        ("accuracy-engines-tower", "stable", "tower of 20, stable, 32 substeps: sink"),
        ("accuracy-smooth-energy", "rk4", "orbit, rk4: energy error of the first round"),
        ("accuracy-smooth-energy", "rk4", "orbit, rk4: energy error of the last round"),
    ],
)
def test_a_curve_has_the_points_of_the_lines(name: str, look: str, line: str) -> None:
    errors = [error for _, error in curve_of(name, look)["points"]]
    assert pytest.approx(RESULTS["accuracy.md"][line], rel=1e-3) in errors


def describe_point(curve: dict[str, Any], place: int, unit: str) -> str:
    """Return the start of a figure's text about a point."""
    number = float(f"{curve['points'][place][1]:.3g}")
    return f"{curve['name']}: sink {number:g}{unit}; work (the engine as it is: 1): "


@pytest.mark.soak
def test_a_curve_is_read_by_keys_and_switched_off(screen: Screen) -> None:
    figure = open_figure(screen, "accuracy-dials-tower")
    words, keys = figure.locator("output"), screen.page.keyboard
    passes, step = (curve_of("accuracy-dials-tower", look) for look in ("passes", "step"))
    figure.locator("svg[role]").first.focus()
    keys.press("ArrowRight")
    assert words.inner_text().startswith(describe_point(passes, 1, " px"))
    keys.press("ArrowDown")
    assert words.inner_text().startswith("step: sink ")
    for _ in range(9):
        keys.press("ArrowRight")
    assert words.inner_text().startswith(describe_point(step, -1, " px"))
    figure.get_by_label("step", exact=True).uncheck()
    assert not words.inner_text().startswith("step")
    for look in ("passes", "shared substeps", "as it is"):
        figure.get_by_label(look, exact=True).uncheck()
    assert words.inner_text() == "All curves are switched off."


@pytest.mark.soak
def test_a_figure_with_two_axes_along_has_a_choice(screen: Screen) -> None:
    figure = open_figure(screen, "accuracy-smooth-spring")
    figure.locator("select").select_option("how often the force was asked for")
    assert "; how often the force was asked for: " in figure.locator("output").inner_text()


@pytest.mark.soak
@pytest.mark.parametrize(
    "name",
    [
        *("effects-stacked", next(iter(CHARTS))),
        *(pytest.param(name, marks=pytest.mark.soak) for name in list(CHARTS)[1:]),
    ],
)
def test_a_figure_fits_a_phone_and_is_printed_as_a_picture(screen: Screen, name: str) -> None:
    figure = open_figure(screen, name)
    screen.page.set_viewport_size({"width": 390, "height": 800})
    assert screen.page.evaluate("document.documentElement.scrollWidth") <= 390
    screen.page.emulate_media(media="print")
    assert figure.locator("img.still").is_visible()
    assert not figure.locator("svg[role]").first.is_visible()
    screen.page.emulate_media(media="screen")
    screen.page.set_viewport_size({"width": 1280, "height": 720})
