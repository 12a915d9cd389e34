"""Test the films of the handouts: current, small, and played by pointer and keys."""

import importlib
import io
import json
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pygame
import pytest
from page_readers import Screen

from grader.judge.rubric import load_rubric

KIT = Path(__file__).parents[2]
HANDOUTS = KIT / "handouts"
FILMS = HANDOUTS / "touch" / "films"
PREDICTIONS = tomllib.loads((HANDOUTS / "predictions.toml").read_text("utf-8"))
SHEET = (HANDOUTS / "lab-sheet.md").read_text("utf-8")


def film(name: str) -> dict[str, Any]:
    text = (FILMS / f"{name}.js").read_text("utf-8")
    found = re.fullmatch(r"touch\.film\(\"(.*?)\", (.*)\);\n", text, re.DOTALL)
    assert found and found[1] == name
    data: dict[str, Any] = json.loads(found[2])
    return data


def test_no_engine_has_changed_since_they_were_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(HANDOUTS)
    made_of = importlib.import_module("make_films").engines_hash()
    assert (FILMS / "made-of.txt").read_text("ascii") == f"{made_of}\n", "run make films"


@pytest.mark.soak
def test_each_is_the_same_bit_for_bit_when_it_is_made_again(tmp_path: Path) -> None:
    command = [sys.executable, str(HANDOUTS / "make_films.py"), "--out", str(tmp_path)]
    subprocess.run(command, check=True, capture_output=True)
    made = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert made == {path.name: path.read_bytes() for path in FILMS.iterdir()}


def test_a_prediction_comes_before_the_task_and_describes_its_films() -> None:
    todos = [todo.id for todo in load_rubric().main_todos if todo.function]
    assert list(PREDICTIONS) == [todo for todo in todos if todo in PREDICTIONS]
    assert SHEET.count("**Predict.**") == len(PREDICTIONS)
    for todo in PREDICTIONS:
        section = SHEET.partition(f"## TODO {todo}:")[2].partition("\n## ")[0]
        question, _, task = section.partition("**What.**")
        assert "**Predict.**" in question and "**Predict.**" not in task
        assert f"(figures/predict-{todo}.svg)" in question
        answer = re.search(r"<strong>([ABC])\.</strong>(.*?)</p>", question, re.DOTALL)
        assert answer and answer[1] == PREDICTIONS[todo]["right"]
        said = " ".join(answer[2].split())
        assert all(each["says"] in said for each in PREDICTIONS[todo]["mistake"])


def last_places(scene: dict[str, Any]) -> list[list[float]]:
    """Return x, y and angle of moving bodies in each third of a film."""
    rows: dict[int, list[float]] = {}
    places, frames = [], scene["yours"]
    for number, frame in enumerate(frames, 1):
        rows |= {row[0]: row[1:] for row in frame[2]}
        if 3 * number % len(frames) < 3:
            moving = [n for n in rows if scene["looks"][str(n)]["mass"] is not None]
            places.append([rows[n][at] for n in moving for at in (0, 1, 4)])
    return places


@pytest.mark.parametrize("todo", PREDICTIONS)
def test_the_three_films_differ(todo: str) -> None:
    """Each pair differs by ten px or half a turn at least once."""
    data = film(f"predict-{todo}")
    assert data["right"] == "ABC".index(PREDICTIONS[todo]["right"]) and len(data["films"]) == 3
    seen = [last_places(each["scene"]) for each in data["films"]]
    for one, other in ((0, 1), (0, 2), (1, 2)):
        gaps = [
            abs(a - b) / (10 if at % 3 < 2 else 3)
            for here, there in zip(seen[one], seen[other], strict=True)
            for at, (a, b) in enumerate(zip(here, there, strict=True))
        ]
        assert max(gaps) > 1, (todo, one, other)


def test_the_tower_sinks_less_for_more_work() -> None:
    """In the lesson's engine and in pymunk, more passes or substeps help at any step size."""
    films = film("tower")["films"]
    assert len(films) == 42
    for engine in ("lesson", "pymunk"):
        for rate in (30, 60, 120):
            few, usual, many = (films[f"{engine}/{passes}/1/{rate}"] for passes in (2, 8, 30))
            assert few["sink"] > usual["sink"] > many["sink"] or engine == "pymunk"
            assert few["work"] < usual["work"] < many["work"]


# ---------------------------------------------------------------- in a browser


def show_film(screen: Screen, name: str) -> Any:
    figure = screen.page.locator(f'figure[data-figure="{name}"]')
    figure.scroll_into_view_if_needed()
    figure.locator("canvas[data-frame]").first.wait_for()
    return figure


@pytest.fixture(scope="module")
def lesson(browser: Any, handout_pages: Path) -> Iterator[Screen]:
    screen = Screen(browser, handout_pages / "lesson.html")
    yield screen
    assert screen.complaints == []


@pytest.mark.soak
def test_a_prediction_is_made_by_keys_or_pointer(browser: Any, handout_pages: Path) -> None:
    screen = Screen(browser, handout_pages / "lab-sheet.html")
    for way in ("keys", "pointer"):
        figure = show_film(screen, {"keys": "predict-3", "pointer": "predict-1"}[way])
        words = figure.locator("output")
        assert words.inner_text().startswith("Which one will it be?")
        buttons = figure.get_by_role("button")
        assert buttons.all_inner_texts() == ["A", "B", "C"]
        if way == "keys":
            buttons.nth(0).focus()
            screen.page.keyboard.press("Enter")
            assert (
                words.inner_text()
                == "No: A cuts the corner: a rope pulls and cannot push. It is C."
            )
        else:
            buttons.nth(1).click()
            assert words.inner_text() == "Yes, B."
            assert "right" in (buttons.nth(1).get_attribute("class") or "")
        canvases = figure.locator("canvas")
        frames = canvases.evaluate_all("all => all.map(each => each.dataset.frame)")
        assert len(frames) == 3 and len(set(frames)) == 1  # they keep step
        before = figure.locator("canvas").first.get_attribute("data-frame")
        screen.page.wait_for_function(
            "([figure, before]) => figure.querySelector('canvas').dataset.frame !== before",
            arg=[figure.element_handle(), before],
        )
    assert screen.complaints == []
    screen.page.close()


@pytest.mark.soak
def test_the_tower_tells_what_was_recorded(lesson: Screen) -> None:
    screen = lesson
    figure, films = show_film(screen, "tower"), film("tower")["films"]
    words = figure.locator("output")
    assert f"{films['lesson/8/1/60']['sink']:.1f} px" in words.inner_text()
    engine, passes, substeps, rate = figure.locator("select").all()
    passes.focus()
    screen.page.keyboard.press("End")
    assert f"{films['lesson/30/1/60']['sink']:.1f} px" in words.inner_text()
    engine.select_option("stable")
    rate.select_option("120")
    substeps.select_option("4")
    assert passes.is_disabled()
    assert f"{films['stable/1/4/120']['sink']:.1f} px" in words.inner_text()
    chart = figure.locator("svg[role]")
    chart.focus()
    screen.page.keyboard.press("ArrowLeft")  # to what costs less
    costs = sorted((each["work"], key) for key, each in films.items() if key.startswith("stable"))
    assert f"{films[costs[-2][1]]['work']:,} times" in words.inner_text()
    canvas = figure.locator("canvas")
    before = canvas.get_attribute("data-frame")
    figure.get_by_role("button", name="Play").click()
    screen.page.wait_for_function(
        "([canvas, before]) => canvas.dataset.frame !== before",
        arg=[canvas.element_handle(), before],
    )


@pytest.mark.soak
def test_drawings_are_no_white_slabs_in_the_dark(lesson: Screen) -> None:
    """White paper becomes as dark as the page, and black lines become bright."""
    screen = lesson
    screen.page.emulate_media(color_scheme="dark")
    drawing = screen.page.locator('img[data-figure$=".svg"]:visible').first
    drawing.scroll_into_view_if_needed()
    box = drawing.bounding_box()
    shot = screen.page.screenshot()
    picture = pygame.image.load(io.BytesIO(shot))
    paper = picture.get_at((int(box["x"] + 3), int(box["y"] + 3)))[:3]
    page = picture.get_at((3, int(box["y"] + 3)))[:3]
    assert max(page) < 60 and max(abs(a - b) for a, b in zip(paper, page, strict=True)) < 8
