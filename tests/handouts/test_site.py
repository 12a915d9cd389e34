"""Test the web pages, opened from a folder and without the internet; zensical checks links."""

import importlib.util
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pytest
from page_readers import Reader, Screen, barriers

KIT = Path(__file__).parents[2]
BUILT = pytest.mark.skipif(
    importlib.util.find_spec("zensical") is None,
    reason="zensical is not installed: it builds the site",
)

pytestmark = [pytest.mark.soak, BUILT]


def list_loads(page: Path) -> list[str]:
    """Return the addresses that a page loads."""
    return [
        value or ""
        for tag, attributes in Reader(page.read_text(encoding="utf-8")).tags
        for name, value in attributes.items()
        if name == "src" or (name == "href" and tag != "a")
    ]


@pytest.fixture(scope="module")
def sites(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build both sites; return their folder."""
    folder = tmp_path_factory.mktemp("handouts")
    program = KIT / "handouts" / "make_site.py"
    done = subprocess.run(
        [sys.executable, str(program), "--out", str(folder)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def pages(site: Path) -> list[Path]:
    found = sorted(site.rglob("*.html"))
    assert len(found) > 10
    return [page for page in found if page.name != "404.html"]  # it is for servers


@pytest.mark.parametrize("name", ["students", "instructors"])
def test_pages_load_nothing_from_elsewhere(sites: Path, name: str) -> None:
    for page in pages(sites / name):
        for source in list_loads(page):
            assert not re.match(r"(https?:)?//", source), f"{page.name} loads {source}"
            if not source.startswith("data:"):
                assert (page.parent / source.partition("#")[0]).is_file(), source


@pytest.mark.parametrize("name", ["students", "instructors"])
def test_every_link_leads_to_a_file(sites: Path, name: str) -> None:
    for page in pages(sites / name):
        for tag, attributes in Reader(page.read_text(encoding="utf-8")).tags:
            link = unquote((attributes.get("href") or "").partition("#")[0])
            if tag == "a" and link and not re.match(r"\w+:", link):
                assert (page.parent / link).exists(), f"{page.name}: {link}"


def test_students_get_nothing_of_the_instructors_part(sites: Path) -> None:
    students, instructors = sites / "students", sites / "instructors"
    assert (instructors / "instructor" / "quiz-answers.html").is_file()
    assert not list(students.rglob("*quiz-answers*"))
    for text in students.rglob("*.*"):
        if text.suffix in (".html", ".js", ".json", ".xml"):
            words = text.read_text(encoding="utf-8")
            assert "Answers and marking" not in words and "instructor/" not in words, text.name


def test_search_does_not_give_hints_away(sites: Path) -> None:
    index = (sites / "students" / "search.json").read_text(encoding="utf-8")
    assert "accumulated" in index
    assert "Nearly the code" not in index and "Right." not in index


@pytest.fixture(scope="module")
def page_opener(browser: Any) -> Iterator[Callable[[Path], Screen]]:
    screens: list[Screen] = []

    def open_page(page: Path) -> Screen:
        screens.append(Screen(browser, page))
        return screens[-1]

    yield open_page
    for screen in screens:
        screen.page.close()


def test_a_browser_opens_every_page_without_complaint(
    sites: Path, page_opener: Callable[[Path], Screen]
) -> None:
    for page in pages(sites / "instructors"):
        screen = page_opener(page)
        screen.page.locator("h1").first.wait_for()
        assert screen.complaints == [], page.name


@pytest.mark.parametrize("name", ["students", "instructors"])
def test_the_site_is_for_all(sites: Path, browser: Any, name: str) -> None:
    assert barriers(browser, *pages(sites / name)) == []


def test_search_finds_a_word_in_pages_opened_from_a_folder(
    sites: Path, page_opener: Callable[[Path], Screen]
) -> None:
    screen = page_opener(sites / "students" / "index.html")
    screen.page.keyboard.press("/")
    screen.page.keyboard.type("friction")
    screen.page.get_by_text("TODO 4: friction within its limit").first.wait_for()
    assert screen.complaints == []
