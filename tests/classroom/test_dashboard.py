"""Test the page of a class: its sums are right, its links work, and its texts are escaped."""

import re
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import msgspec
import pytest
from command_line import run_grader
from msgspec import structs
from page_readers import HARMLESS, HOSTILE, Reader, Screen, barriers

from grader.classroom.book import Book, Outcome, make_outcome
from grader.classroom.dashboard import read_class, write_dashboard
from grader.errors import Stop
from grader.judge.result import CheckResult, Result, State, TodoResult
from grader.judge.task import Options, shipped_reference
from grader.report.files import as_json

STATES: list[State] = ["passed", "not yet", "not started", "error"]
TODOS = 14
WORTH = 7  # of each TODO
MANY = 200
ONLY_5 = Options(shipped_reference(), only=frozenset({"5"}))


def todo(number: int, state: State, mistake: str | None = None, words: str = "w") -> TodoResult:
    points = WORTH if state == "passed" else 0
    check = CheckResult(
        "a", "A title", "unit", state, points, WORTH, words, words, words, meaning=words
    )
    return TodoResult(str(number), f"Task {number}", state, points, WORTH, mistake, [check])


def result(student: int, words: str = "w") -> Result:
    """Make the result of student n, who fails the first n % 15 TODOs, in different ways."""
    wrong = student % (TODOS + 1)
    todos = [
        todo(n, STATES[1 + (student + n) % 3] if n < wrong else "passed", None, words)
        for n in range(TODOS)
    ]
    if student % 4 == 1:
        todos[0] = todo(0, "not yet", "half-for-full", words)
    bonus = TodoResult("B1", "Sleep", "passed", 5, 5, None, [])
    points = sum(each.points for each in todos)
    extra = [bonus] if student % 2 else []
    return Result(1, "s", points, WORTH * TODOS, 5 * len(extra), ["processes"], [*todos, *extra])


def make_class(folder: Path, count: int, name: str = "student {:03}", words: str = "w") -> Path:
    """Make a class in which student 3 has problems, 4 was late and 5 took longest."""
    outcomes = []
    with Book(folder) as book:
        for number in range(count):
            content = as_json(result(number, words))
            outcome = make_outcome(name.format(number), content, 2.0 + (number == 5) * 9, "")
            book.write(outcome, content)
            outcomes.append(outcome)
        if count > 4:
            book.keep_earlier(outcomes[3].name)
            outcomes[3] = Outcome(outcomes[3].name, words or "no zip")
            final = outcomes[4].points - 10
            outcomes[4] = msgspec.structs.replace(
                outcomes[4], late=True, reasons=[f"1 day late: -10 {words}"], final=final
            )
        book.finish(outcomes)
    return write_dashboard(folder, read_class(folder))


def read(page: Path) -> Reader:
    return Reader(page.read_text(encoding="utf-8"))


def links(page: Path) -> list[str]:
    return [attributes["href"] or "" for tag, attributes in read(page).tags if tag == "a"]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_class(tmp_path_factory.mktemp("term") / "Physik & Übung #1", MANY)


# ---------------------------------------------------------------- as a file


def test_two_hundred_students_are_a_small_page_whose_links_lead_to_reports(page: Path):
    assert page.stat().st_size <= 1_500_000
    seen = read(page)
    assert "default-src 'none'" in seen.source
    assert not re.search(r"@import|url\(|https?:", seen.source)
    assert not any("src" in attributes or "style" in attributes for _, attributes in seen.tags)
    found = links(page)
    assert len({link.partition("#")[0] for link in found}) == MANY
    for link in found:
        path, _, part = link.partition("#")
        report = page.parent / unquote(path)
        assert report.is_file()
        assert not part or f'id="{part}"' in report.read_text(encoding="utf-8")


def test_no_report_outlives_its_submission(tmp_path: Path):
    page = make_class(tmp_path / "class", 6)
    stale = tmp_path / "class" / "student 003.html"
    stale.write_text("of an earlier run")
    write_dashboard(tmp_path / "class", read_class(tmp_path / "class"))
    source = stale.read_text(encoding="utf-8")
    assert "No points yet: this needs manual review." in source and page.is_file()


def test_a_students_page_has_the_mark_the_dates_and_what_was_decided(tmp_path: Path):
    at = datetime(2026, 5, 4, 22, tzinfo=UTC)
    content = as_json(result(1))
    with Book(tmp_path / "class") as book:
        ann = make_outcome("ann", content, 1.0, "")
        book.write(ann, content)
        ann = structs.replace(ann, final=70, reasons=["1 day late: -10", "<ill>: +2"], due=at)
        ann = structs.replace(ann, handed_in=at, notes=["a (1).py is taken as a.py"])
        ben = Outcome("ben", "broken", final=70, max_points=98, by_hand=True, reasons=["seen: 70"])
        book.finish([ann, ben, Outcome("cem", "broken")])
    write_dashboard(tmp_path / "class", read_class(tmp_path / "class"))
    pages = {n: (tmp_path / "class" / f"{n}.html").read_text() for n in ("ann", "ben", "cem")}
    for words in ("Mark: <strong>70</strong> of 98", "1 day late: -10", "&lt;ill&gt;: +2"):
        assert words in pages["ann"]
    for words in ("2026-05-04 22:00 +00:00", "a (1).py is taken as a.py", "91</strong> of 98"):
        assert words in pages["ann"]
    assert "Mark: <strong>70</strong> of 98" in pages["ben"] and "seen: 70" in pages["ben"]
    assert "No points yet" in pages["cem"] and "broken" in pages["cem"]


def test_the_numbers_add_up(page: Path):
    results = [result(number) for number in range(MANY) if number != 3]
    source = page.read_text(encoding="utf-8")
    mean = (sum(each.points for each in results) - 10) / len(results)  # one was late
    assert f"<dt>mean</dt><dd>{mean:.1f}</dd>" in source
    full = sum(each.points == WORTH * TODOS for each in results)  # without any bonus
    assert f"<dt>full marks</dt><dd>{full}</dd>" in source
    for number in range(TODOS):
        passed = sum(each.todos[number].state == "passed" for each in results)
        share = f'<td class="n">{100 * passed / len(results):.0f} %</td>'
        assert f'<th scope="row">{number}</th><td>Task {number}</td>{share}' in source
    counts = re.findall(r'data-filter="bin"[^>]*>(\d+)<', source)
    assert sum(map(int, counts)) == len(results)
    row = next(row for row in source.split("<tr") if "student 001</a></th>" in row)  # bonus apart
    assert f'<td class="n">{result(1).points}</td><td class="n">5</td>' in row


def test_words_of_students_stay_words(tmp_path: Path):
    name = "'; x&lt;b&gt; {:03} --"
    page = make_class(tmp_path / "class", 6, name, HOSTILE)
    seen = read(page)
    assert (seen.count("script"), seen.count("img"), seen.handlers) == (1, 0, [])
    assert seen.text.count(HARMLESS) >= 4 and "x&lt;b&gt; 000" in seen.text
    assert not set("\u202e\x07") & set(seen.source)


def test_an_empty_folder_is_refused(tmp_path: Path):
    with pytest.raises(Stop, match="there are no results in"):
        read_class(tmp_path)
    assert run_grader("dashboard", tmp_path).exit_code == 2


# ---------------------------------------------------------------- in a browser


@pytest.fixture
def screen(browser: Any, page: Path) -> Iterator[Screen]:
    shown = Screen(browser, page)
    yield shown
    shown.page.close()
    assert shown.complaints == []


def column(screen: Screen, number: int) -> list[str]:
    rows = screen.page.locator("#table tbody tr:visible")
    return rows.evaluate_all(f"rows => rows.map(row => row.cells[{number}].textContent.trim())")


@pytest.mark.soak
def test_a_click_sorts_searches_and_shows_whom_a_count_counts(screen: Screen):
    names = column(screen, 0)
    head = screen.page.locator("#table thead th").nth(1)
    head.locator("button").click()
    falling = column(screen, 1)
    assert falling[-1] == ""  # the ungraded one stays at the end
    numbers = [int(points) for points in falling[:-1]]
    assert numbers == sorted(numbers, reverse=True) and len(set(numbers)) > 10
    assert head.get_attribute("aria-sort") == "descending"
    head.locator("button").press("Enter")
    assert [int(points) for points in column(screen, 1)[:-1]] == sorted(numbers)
    screen.page.locator("#table thead button").first.click()
    assert column(screen, 0) == names == sorted(names)
    screen.page.get_by_label("Search").fill("STUDENT 01")
    assert column(screen, 0) == [f"student {number:03}" for number in range(10, 20)]
    assert screen.page.locator("#count").inner_text() == f"10 of {MANY}"
    screen.page.get_by_label("Search").fill("")
    for kind, shown in (("trouble", ["student 003"]), ("late", ["student 004"]), ("", names)):
        screen.page.locator("#kind").select_option(kind)
        assert column(screen, 0) == shown
    makers = [number for number in range(MANY) if number % 4 == 1]
    screen.page.locator(".mistakes tbody button").press("Enter")
    assert column(screen, 0) == [f"student {number:03}" for number in makers]
    screen.page.get_by_role("button", name="show all").click()
    assert len(column(screen, 0)) == MANY
    for button in screen.page.locator("[data-filter]").all()[::5]:
        button.click()
        assert len(column(screen, 0)) == int(button.inner_text())


@pytest.mark.soak
def test_a_hostile_class_is_quiet_in_the_browser(browser: Any, tmp_path: Path):
    shown = Screen(browser, make_class(tmp_path / "class", 6, "'; {:03}", HOSTILE))
    shown.page.locator("#table thead button").last.click()
    shown.page.locator("#table a").first.click()
    assert shown.page.locator("h1").count() == 1
    assert shown.complaints == []
    assert barriers(browser, make_class(tmp_path / "quiet", 3)) == []
