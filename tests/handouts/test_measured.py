"""Figures of what was measured: they say what results.json has, and answer pointer and keys."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from page_readers import Screen, chromium

from grader.judge.course import FULL
from grader.maintain.measured import measured
from grader.maintain.pages import write_pages

HANDOUTS = Path(__file__).parents[2] / "handouts"
RESULTS = json.loads((HANDOUTS / "results.json").read_text("utf-8"))
SCRIPT = measured(RESULTS).partition("= ")[2].removesuffix(";\n")
PAGE = (HANDOUTS / "accuracy.md").read_text("utf-8")


@pytest.fixture(scope="module")
def screen(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Screen]:
    folder = tmp_path_factory.mktemp("pages")
    write_pages(HANDOUTS, folder, FULL)
    with chromium() as browser:
        screen = Screen(browser, folder / "accuracy.html")
        yield screen
        assert screen.complaints == []


def opened(screen: Screen, name: str) -> Any:
    """A figure as it is when its page has just been loaded."""
    page = name.partition("-")[0]
    screen.page.goto(re.sub(r"\w+\.html.*", f"{page}.html", screen.page.url))
    figure = screen.page.locator(f'figure[data-figure="{name}"]')
    figure.scroll_into_view_if_needed()
    return figure


@pytest.fixture
def figure(screen: Screen) -> Any:
    return opened(screen, "accuracy-budgets")


def off(engine: str, ms: int, scene: str = "tower of 20", error: str = "sink") -> str:
    """How the figure says an error of results.json."""
    least = RESULTS["accuracy.md"][f"{scene}, {engine}: {error} within {ms} ms, least"]
    number = f"{least:.1e}".replace("e-0", "e-") if least < 1e-3 else f"{float(f'{least:.2g}'):g}"
    return f"{engine} within {ms} ms of a frame: {error} off by {number} px"


def test_every_number_of_the_table_is_there() -> None:
    data = json.loads(SCRIPT)["budgets"]
    assert len({(cell["scene"], cell["engine"], cell["ms"]) for cell in data}) == len(data) == 90
    for cell in data:
        row = rf"^\| {cell['scene']}: {cell['error']} \((px|of the exact)\) \| {cell['ms']} ms \|"
        found = re.search(row, PAGE, re.MULTILINE)
        assert found and (found[1] == "px") == (cell["error"] in ("sink", "worst link"))
        line = f"{cell['scene']}, {cell['engine']}: {cell['error']} within {cell['ms']} ms"
        ends = [RESULTS["accuracy.md"][f"{line}, {end}"] for end in ("least", "most")]
        assert ends == [cell["least"], cell["most"]]


def test_keys_go_from_mark_to_mark(screen: Screen, figure: Any) -> None:
    words = figure.locator("output")
    assert words.inner_text().startswith(off("lesson", 4))
    figure.locator("svg").focus()
    screen.page.keyboard.press("ArrowRight")
    assert words.inner_text().startswith(off("lesson", 16))
    screen.page.keyboard.press("ArrowRight")  # there is no more
    assert words.inner_text().startswith(off("lesson", 16))
    screen.page.keyboard.press("ArrowDown")
    assert words.inner_text().startswith(off("stable", 16))


def test_the_mark_under_the_pointer_says_its_value(screen: Screen, figure: Any) -> None:
    marks = figure.locator("svg circle[r='5']")
    assert marks.count() == 15
    for number, engine in ((0, "lesson"), (3, "stable"), (9, "pymunk")):
        box = marks.nth(number).bounding_box()
        screen.page.mouse.move(box["x"] + 6, box["y"] + 6)
        assert figure.locator("output").inner_text().startswith(off(engine, 1))


def test_engines_are_switched_off_and_on(screen: Screen, figure: Any) -> None:
    marks, words = figure.locator("svg circle[r='5']"), figure.locator("output")
    figure.get_by_label("lesson").focus()
    screen.page.keyboard.press("Space")
    assert marks.count() == 12 and not words.inner_text().startswith("lesson")
    for engine in ("stable", "compiled", "pymunk", "box2d"):
        figure.get_by_label(engine).uncheck()
    assert words.inner_text() == "All engines are switched off."
    figure.get_by_label("pymunk").check()
    assert marks.count() == 3
    assert words.inner_text().startswith(off("pymunk", 1))
    figure.locator("select").select_option("100 kg on 1 kg")
    assert words.inner_text().startswith(off("pymunk", 1, "100 kg on 1 kg"))


def test_prices_add_up_to_those_of_all_together() -> None:
    for balls, prices in json.loads(SCRIPT)["prices"].items():
        together = RESULTS["effects.md"][f"{balls} balls, all of them together: price in opcodes"]
        assert sum(prices.values()) == pytest.approx(together, rel=0.01)


def test_what_is_declared_is_paid_for(screen: Screen) -> None:
    figure, prices = opened(screen, "effects-stacked"), json.loads(SCRIPT)["prices"]
    words, drawing = figure.locator("output"), figure.locator("svg")
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


@pytest.mark.parametrize("name", ["accuracy-budgets", "effects-stacked"])
def test_it_fits_a_phone_and_paper_has_the_still(screen: Screen, name: str) -> None:
    figure = opened(screen, name)
    screen.page.set_viewport_size({"width": 390, "height": 800})
    assert screen.page.evaluate("document.documentElement.scrollWidth") <= 390
    screen.page.emulate_media(media="print")
    assert figure.locator("img.still").is_visible() and not figure.locator("svg").is_visible()
    screen.page.emulate_media(media="screen")
    screen.page.set_viewport_size({"width": 1280, "height": 720})
