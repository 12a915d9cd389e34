"""Test the page of one submission: it shows the whole result, and nothing from outside."""

import re
from pathlib import Path
from typing import Any

import msgspec
import pytest
from page_readers import HARMLESS, HOSTILE, Reader, Screen, barriers

from grader.judge.result import CheckResult, Result, TodoResult, Where
from grader.player.page import make_page
from grader.player.pairing import pair_runs
from grader.player.runs import Line, Run
from grader.protocol import BodyLook, BodyRow, Moment, ShapeLook
from grader.report.html import render, write_report


def result(name: str = "ada", words: str = "words", replay: str | None = None) -> Result:
    """Make a result with a TODO of every state."""
    where = Where(words, 12)
    checks = {
        "passed": CheckResult("a", "A title", "unit", "passed", 3, 3),
        "not yet": CheckResult(
            "b", "B title", "scene", "not yet", 0, 4, words, words, words, words, where, replay
        ),
        "error": CheckResult("c", "C title", "property", "error", 0, 5, got=words, where=where),
        "waiting": CheckResult("d", "D title", "scene", "waiting", 0, 6, got="waiting for TODO 1"),
        "not started": CheckResult("e", "E title", "scene", "not started", 0, 7),
    }
    todos = [
        TodoResult(
            f"{number}",
            f"Task {number}",
            check.state,
            check.points,
            check.max_points,
            words if check.state == "not yet" else None,
            [check],
        )
        for number, check in enumerate(checks.values(), 1)
    ]
    return Result(1, name, 3, 25, 0, ["processes"], todos)


def little_replay() -> str:
    look = BodyLook(0, [ShapeLook([(0.0, 0.0)], 10.0)], 1.0, 50.0)
    row = BodyRow(1, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0)
    line = Line("call", "1", [Moment(0.0, 0, [row], [], [])], code="it()")
    return make_page("A replay", [], pair_runs([Run("", [line, line], {1: look})], []), "print()")


def written(tmp_path: Path, made: Result) -> Reader:
    write_report(made, tmp_path / "report.html")
    return Reader((tmp_path / "report.html").read_text(encoding="utf-8"))


def test_a_reason_that_checks_share_is_shown_once(tmp_path: Path):
    made = result(words="'(' was never closed")
    failed = [each for todo in made.todos for each in todo.checks if each.state == "error"]
    twin = msgspec.structs.replace(failed[0], id="twin", title="Twin title", ran="another call")
    made.todos[2].checks.append(twin)
    text = written(tmp_path, made).text
    assert "Twin title" in text and "another call" not in text
    assert text.count("same as above") == 1


def test_all_of_the_result_is_there(tmp_path: Path):
    seen = written(tmp_path, result())
    text = re.sub(r"\s+", " ", seen.text)
    assert "3 of 25 points" in text
    for todo in result().todos:
        assert (
            f"TODO {todo.id}: {todo.title} {todo.state} {todo.points} / {todo.max_points}" in text
        )
        for check in todo.checks:
            assert f"{check.state} {check.title} {check.points} / {check.max_points}" in text
    for name in ("We ran", "Expected", "Got", "Meaning", "Look at", "words:12"):
        assert name in text
    assert "waiting for TODO 1" in text
    assert "A known mistake: words" in text
    assert "Not confined: files, network, other processes" in text


def test_what_is_to_be_done_stands_before_what_is_done():
    todos = [
        TodoResult(id, f"Task {id}", state, 0, 1, None, [])
        for id, state in (("1", "passed"), ("2", "not yet"), ("3", "passed"), ("4", "not started"))
    ]
    page = render(Result(1, "ada", 2, 4, 0, [], todos), {})
    assert re.findall(r'<section id="todo-(\d)"', page) == ["2", "4", "1", "3"]


def test_nothing_comes_from_outside(tmp_path: Path):
    seen = written(tmp_path, result())
    assert "default-src 'none'" in seen.source
    for _, attributes in seen.tags:
        assert all(
            (value or "").startswith("#") for name, value in attributes.items() if name == "href"
        )
        assert "src" not in attributes
    assert not re.search(r"@import|url\(|https?:", seen.source)


def test_words_of_a_submission_stay_words(tmp_path: Path):
    seen = written(tmp_path, result(name=HOSTILE, words=HOSTILE))
    assert (seen.count("script"), seen.count("img"), seen.handlers) == (0, 0, [])
    assert seen.text.count(HARMLESS) >= 7
    assert not set("\u202e\x07") & set(seen.source)


def test_long_words_are_cut(tmp_path: Path):
    seen = written(tmp_path, result(words="x" * 1_000_000))
    assert len(seen.source) < 50_000


def test_replays_are_taken_in_and_what_is_gone_is_linked(tmp_path: Path):
    (tmp_path / "replays").mkdir()
    (tmp_path / "replays" / "2-b.html").write_text(little_replay(), encoding="utf-8")
    seen = written(tmp_path, result(replay="replays/2-b.html"))
    frames = [attributes for tag, attributes in seen.tags if tag == "iframe"]
    assert [frame["srcdoc"] for frame in frames] == [little_replay()]
    assert frames[0]["sandbox"] == "allow-scripts"
    gone = written(tmp_path, result(replay="replays/gone.html"))
    assert ("a", {"href": "replays/gone.html"}) in gone.tags


def test_a_browser_shows_the_replay_and_obeys_no_words(browser: Any, tmp_path: Path):
    (tmp_path / "replays").mkdir()
    (tmp_path / "replays" / "2-b.html").write_text(little_replay(), encoding="utf-8")
    written(tmp_path, result(name=HOSTILE, words=HOSTILE, replay="replays/2-b.html"))
    screen = Screen(browser, tmp_path / "report.html")
    screen.page.get_by_text("See it").click()
    inside = screen.page.frame_locator("iframe")
    inside.locator("#on").click()
    assert inside.locator("#picture").get_attribute("data-position") == "1"
    assert screen.complaints == []


@pytest.mark.soak
def test_a_report_is_for_all_with_the_replay_in_it(browser: Any, tmp_path: Path):
    (tmp_path / "replays").mkdir()
    (tmp_path / "replays" / "2-b.html").write_text(little_replay(), encoding="utf-8")
    written(tmp_path, result(replay="replays/2-b.html"))
    assert barriers(browser, tmp_path / "report.html") == []
    screen = Screen(browser, tmp_path / "report.html")
    for _ in range(20):  # by keys alone
        screen.page.keyboard.press("Tab")
        if screen.page.evaluate("document.activeElement.tagName") == "SUMMARY":
            break
    screen.page.keyboard.press("Enter")
    assert screen.page.locator("details").get_attribute("open") is not None
