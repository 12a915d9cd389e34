"""Write a replay as one HTML file that needs no network and no other file."""

import base64
import hashlib
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import jinja2
import msgspec
from markupsafe import Markup

from grader.player.runs import Replay
from grader.text import printable

TEMPLATES = Path(__file__).with_name("templates")
MAX_WORDS_ON_A_PAGE = 1000  # characters of a submission in one line: more than in a terminal


def make_page(title: str, words: Sequence[tuple[str, str]], replay: Replay, script: str) -> str:
    """Return the page of one failed check: its reasons in `words`, and its script."""
    return fill_template(
        TEMPLATES / "player.html",
        "player.css",
        read_player(),
        title=clean_line(title),
        words=[(name, clean_line(text)) for name, text in words],
        code=script,
        replay=encode_data(replay),
        player=Markup(read_player()),
    )


def fill_template(
    template: Path, css: str, *scripts: str, has_replays: bool = False, **values: object
) -> str:
    """Return a page with the style sheet `css`, which lies beside its template, and the theme's.

    Only these scripts may run in it, and the player if it `has_replays`.
    """
    style = read_style(template.with_name(css))
    styles, allowed = [style], list(scripts)
    if has_replays:
        styles.append(read_style(TEMPLATES / "player.css"))
        allowed.append(read_player())
    page = load_environment(template.parent).get_template(template.name)
    sources = {"styles": list_sources(styles), "scripts": list_sources(allowed)}
    return page.render(style=Markup(style), **sources, **values)


def list_sources(contents: Sequence[str]) -> Markup:
    """Return the hashes of scripts or style sheets as a page's policy lists them."""
    digests = [hashlib.sha256(each.encode("utf-8")).digest() for each in contents]
    return Markup(" ").join(
        Markup("'sha256-{}'").format(base64.b64encode(each).decode()) for each in digests
    )


@cache
def load_environment(templates: Path) -> jinja2.Environment:
    """Load templates that escape every value but markup; all extend `page.html`."""
    loader = jinja2.FileSystemLoader([templates, TEMPLATES])
    return jinja2.Environment(loader=loader, autoescape=True, undefined=jinja2.StrictUndefined)


def load_templates(folder: Path) -> None:
    """Load all templates of a folder, before processes fork that fill them in."""
    environment = load_environment(folder)
    for name in environment.list_templates(extensions=["html"]):
        environment.get_template(name)


@cache
def read_style(path: Path) -> str:
    """Read a style sheet, after the theme of all pages for light and dark."""
    theme = TEMPLATES / "theme.css"
    return theme.read_text(encoding="utf-8") + path.read_text(encoding="utf-8")


@cache
def read_player() -> str:
    scripts = (TEMPLATES / "stage.js", TEMPLATES / "player.js")
    return "".join(each.read_text(encoding="utf-8") for each in scripts)


def encode_data(value: object) -> Markup:
    """Return JSON that stays data in a page: no tag can begin in it."""
    text = msgspec.json.encode(value).decode("utf-8")
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)


def clean_line(text: str) -> str:
    """Return a submission's words without line breaks, control and direction characters."""
    return printable(text)[:MAX_WORDS_ON_A_PAGE]
