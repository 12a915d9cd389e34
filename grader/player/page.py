"""Write a replay as one HTML file that needs nothing else: no network, no second file."""

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
    """Return the page of one failed check: `words` say why it failed, `script` asks again."""
    player = read_player()
    return fill_template(
        TEMPLATES / "player.html",
        read("player.css"),
        player,
        title=clean_line(title),
        words=[(name, clean_line(text)) for name, text in words],
        code=script,
        replay=encode_data(replay),
        player=Markup(player),
    )


def fill_template(
    template: Path,
    style: str,
    *scripts: str,
    around: tuple[str, str] | None = None,
    **values: object,
) -> str:
    """Return a page of this style and the theme's, in which only these scripts may run.

    It also allows the style and script of a page that it is put `around`, given by their hashes.
    """
    style = read_theme() + style
    inner_style, inner_script = ([each] for each in around) if around else ([], [])
    return (
        load_environment(template.parent)
        .get_template(template.name)
        .render(
            style=Markup(style),
            styles=list_sources([hash_content(style), *inner_style]),
            scripts=list_sources([*map(hash_content, scripts), *inner_script]),
            **values,
        )
    )


def list_sources(hashes: Sequence[str]) -> Markup:
    """Return these hashes as a page's policy lists them."""
    return Markup(" ").join(Markup("'{}'").format(each) for each in hashes)


@cache
def load_environment(templates: Path) -> jinja2.Environment:
    """Load templates that escape what is put in, unless it is markup; all extend `page.html`."""
    loader = jinja2.FileSystemLoader([templates, TEMPLATES])
    return jinja2.Environment(loader=loader, autoescape=True, undefined=jinja2.StrictUndefined)


def read_theme() -> str:
    """Read the style of all pages, in light and in dark."""
    return read("theme.css")


@cache
def read(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")


def hash_player() -> tuple[str, str]:
    """Return the hashes of the style and the script of a replay, for the page around it."""
    return hash_content(read_theme() + read("player.css")), hash_content(read_player())


def read_player() -> str:
    return read("stage.js") + read("player.js")


def hash_content(content: str) -> str:
    """Return the name of a script or a style sheet in the policy of its page."""
    digest = hashlib.sha256(content.encode("utf-8")).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"


def encode_data(value: object) -> Markup:
    """Return JSON that stays data in a page: no tag can begin in it."""
    text = msgspec.json.encode(value).decode("utf-8")
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)


def clean_line(text: str) -> str:
    """Return a submission's words without line breaks, control and direction characters."""
    return printable(text)[:MAX_WORDS_ON_A_PAGE]
