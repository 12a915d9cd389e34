"""Read the pages that the grader writes, with a parser and in a real browser."""

import html.parser
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from typing import Any

import pytest

WIDTHS = (1280, 390)  # px, of desktop and phone
PATIENCE = 600_000  # ms, enough for a busy machine

# Texts that a submission may put into names and messages: HTML, Markdown, controls, directions.
HOSTILE = (
    "</script ><script>alert(1)</script>\"'><img src=x onerror=alert(2)>&lt;b&gt; *a* \u202e\x07\n#"
)
HARMLESS = HOSTILE.replace("\u202e", " ").replace("\x07", " ").replace("\n", " ")  # the same shown


class Reader(html.parser.HTMLParser):
    """The tags of a page, and its text."""

    def __init__(self, source: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text, self.source = "", source
        self.feed(source)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.text += data

    def count(self, tag: str) -> int:
        return [each for each, _ in self.tags].count(tag)

    @property
    def handlers(self) -> list[str]:
        """Return attributes that would run something."""
        return [name for _, attributes in self.tags for name in attributes if name[:2] == "on"]


@contextmanager
def chromium() -> Iterator[Any]:
    """Open a browser, if this machine has one."""
    sync_api = pytest.importorskip(
        "playwright.sync_api", reason="needs playwright, of the extra `dev`"
    )
    names = ("chromium", "chromium-browser", "google-chrome")
    path = next(filter(None, map(shutil.which, names)), None)
    if path is None:
        pytest.skip("needs Chromium on the PATH, to open a page as a person would")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=path, args=["--no-sandbox"], timeout=PATIENCE
        )
        yield browser
        browser.close()


def barriers(browser: Any, *paths: Path) -> list[str]:
    """List the serious and critical barriers that axe finds.

    All folded parts are opened, in light and dark, on desktop and phone.
    """
    axe = pytest.importorskip("axe_playwright_python", reason="needs axe, of the extra `dev`")
    rules = Path(axe.__file__).with_name("axe.min.js").read_text(encoding="utf-8")
    found = []
    for scheme, width in product(("light", "dark"), WIDTHS):
        size = {"width": width, "height": 900}
        page = browser.new_page(bypass_csp=True, color_scheme=scheme, viewport=size)
        for path in paths:
            page.goto(path.resolve().as_uri())
            page.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
            page.evaluate(rules)
            for each in page.evaluate("axe.run()")["violations"]:
                if each["impact"] in ("serious", "critical"):
                    place = each["nodes"][0]["html"]
                    found.append(f"{path.name}, {scheme}, {width} px: {each['help']}: {place}")
        page.close()
    return found


class Screen:
    """A page in the browser; records its console output and network requests."""

    def __init__(self, browser: Any, path: Path, **options: Any) -> None:
        self.page = browser.new_page(viewport={"width": 900, "height": 1000}, **options)
        self.page.set_default_timeout(PATIENCE)
        self.complaints: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("dialog", lambda dialog: self.complaints.append(dialog.message))
        self.page.on("request", self._asked)
        self.page.goto(path.resolve().as_uri())

    def _asked(self, request: Any) -> None:
        if not request.url.startswith(("file:", "about:")):
            self.complaints.append(request.url)

    @property
    def position(self) -> int:
        """Return the frame that a replay shows."""
        return int(self.page.locator("#picture").get_attribute("data-position"))
