"""The web pages, opened one by one in a browser, from a folder and without the internet."""

import importlib.util
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest
from page_readers import barriers, chromium

KIT = Path(__file__).parents[2]
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
BROWSER = next(filter(None, map(shutil.which, BROWSERS)), None)
BUILT = pytest.mark.skipif(
    importlib.util.find_spec("zensical") is None,
    reason="zensical is not installed: it builds the site",
)
SEEN = pytest.mark.skipif(BROWSER is None, reason="there is no Chromium here to open pages with")

pytestmark = [pytest.mark.soak, BUILT]


class Parts(HTMLParser):
    """What a page points to, and what can be pointed to in it."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loads: list[str] = []
        self.ids: set[str] = set()
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name == "id":
                self.ids.add(value or "")
            elif name == "href" and tag == "a":
                self.links.append(value or "")
            elif name in ("src", "href"):
                self.loads.append(value or "")


@pytest.fixture(scope="module")
def sites(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with both sites."""
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
def test_every_link_of_the_site_leads_somewhere(sites: Path, name: str) -> None:
    parts = {page.resolve(): Parts(page) for page in pages(sites / name)}
    for page, here in parts.items():
        for link in here.links:
            if link.startswith(("http:", "https:")):
                continue
            target, _, anchor = link.partition("#")
            place = (page.parent / target).resolve() if target else page
            assert place in parts, f"{page.name} links to {link}"
            if anchor and not anchor.startswith("__"):
                assert anchor in parts[place].ids, f"{page.name} links to {link}"


@pytest.mark.parametrize("name", ["students", "instructors"])
def test_pages_load_nothing_from_elsewhere(sites: Path, name: str) -> None:
    for page in pages(sites / name):
        for source in Parts(page).loads:
            assert not re.match(r"(https?:)?//", source), f"{page.name} loads {source}"
            if not source.startswith("data:"):
                assert (page.parent / source.partition("#")[0]).is_file(), source


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


# Put into a page: it writes down what goes wrong.
WATCH = """<script>
const complaints = [];
const note = (words) => {
  complaints.push(words);
  document.documentElement.dataset.complaints = complaints.join("; ");
};
addEventListener("error", (e) => note(e.message || `cannot load ${e.target.src}`), true);
addEventListener("unhandledrejection", (e) => note(`${e.reason}`));
console.error = (...words) => note(words.join(" "));
console.warn = console.error;
</script>"""


# Put into a page: it searches for a word, and writes down what is found.
SEARCH = """<script>
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const roots = () => [...document.querySelectorAll("*")].map((e) => e.shadowRoot);
const inside = () => roots().find((e) => e?.querySelector("input"));
addEventListener("load", async () => {
  await wait(500);
  document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "/", bubbles: true }));
  await wait(500);
  const field = inside().querySelector("input");
  field.value = "friction";
  field.dispatchEvent(new InputEvent("input", { bubbles: true }));
  await wait(2000);
  document.documentElement.dataset.found = inside().textContent;
});
</script>"""


def opened(page: Path, folder: Path, script: str = "") -> tuple[str, str]:
    """The page as a browser shows it, and what it complained about."""
    text = page.read_text(encoding="utf-8")
    watched = page.with_name(f"watched-{page.name}")
    watched.write_text(text.replace("<head>", f"<head>{WATCH}{script}", 1), encoding="utf-8")
    done = subprocess.run(
        [
            str(BROWSER),
            *("--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder}"),
            *("--virtual-time-budget=5000", "--dump-dom", watched.as_uri()),
        ],
        capture_output=True,
        text=True,
        timeout=600,
    )
    watched.unlink()
    complaints = re.search('data-complaints="([^"]*)"', done.stdout)
    return done.stdout, complaints[1] if complaints else ""


@SEEN
def test_a_browser_opens_every_page_without_complaint(sites: Path, tmp_path: Path) -> None:
    for page in pages(sites / "instructors"):
        shown, complaints = opened(page, tmp_path)
        assert "<h1" in shown, f"{page.name} shows nothing"
        assert not complaints, f"{page.name}: {complaints}"


@SEEN
@pytest.mark.parametrize(
    "broken",
    ['<img src="none.png">', "<script>nothing.is = here</script>"],
    ids=["picture", "code"],
)
def test_a_browsers_complaint_is_noticed(sites: Path, tmp_path: Path, broken: str) -> None:
    page = sites / "students" / "broken.html"
    text = page.with_name("quiz.html").read_text(encoding="utf-8")
    page.write_text(text.replace("</h1>", f"</h1>{broken}"), encoding="utf-8")
    complaints = opened(page, tmp_path)[1]
    page.unlink()
    assert complaints


@SEEN
@pytest.mark.parametrize("name", ["students", "instructors"])
def test_the_site_is_for_all(sites: Path, name: str) -> None:
    with chromium() as browser:
        assert barriers(browser, *pages(sites / name)) == []


@SEEN
def test_search_finds_a_word_in_pages_opened_from_a_folder(sites: Path, tmp_path: Path) -> None:
    shown, complaints = opened(sites / "students" / "index.html", tmp_path, SEARCH)
    assert not complaints
    found = re.search('data-found="([^"]*)"', shown)
    assert found is not None
    assert "TODO 4: friction within its limit" in found[1]
