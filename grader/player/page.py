"""A replay as one HTML file that needs nothing else: no network, no second file."""

import base64
import hashlib
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import jinja2
import msgspec
from markupsafe import Markup

from grader.player.film import Replay
from grader.text import printable

TEMPLATES = Path(__file__).with_name("templates")
MAX_WORDS = 1000  # characters of a submission in one line: a page has more room than a terminal


def page(title: str, words: Sequence[tuple[str, str]], replay: Replay, script: str) -> str:
    """The page of one failed check; `words` say why it failed, `script` asks the same again."""
    player = script_of_player()
    return filled(
        TEMPLATES / "player.html",
        read("player.css"),
        player,
        title=one_line(title),
        words=[(name, one_line(text)) for name, text in words],
        code=script,
        film=as_data(replay),
        player=Markup(player),
    )


def filled(
    template: Path,
    style: str,
    *scripts: str,
    around: tuple[str, str] | None = None,
    **values: object,
) -> str:
    """A page of this style and the theme's, in which these scripts may run and nothing else.

    Where it is put `around` others, by the hashes of their style and script, it lets them be, too.
    """
    style = theme() + style
    inner_style, inner_script = ([each] for each in around) if around else ([], [])
    return (
        environment(template.parent)
        .get_template(template.name)
        .render(
            style=Markup(style),
            styles=sources([allowed(style), *inner_style]),
            scripts=sources([*map(allowed, scripts), *inner_script]),
            **values,
        )
    )


def sources(hashes: Sequence[str]) -> Markup:
    """What a page's policy says of these hashes."""
    return Markup(" ").join(Markup("'{}'").format(each) for each in hashes)


@cache
def environment(templates: Path) -> jinja2.Environment:
    """Whatever is put into a page is text, unless it says otherwise; all extend `page.html`."""
    loader = jinja2.FileSystemLoader([templates, TEMPLATES])
    return jinja2.Environment(loader=loader, autoescape=True, undefined=jinja2.StrictUndefined)


def theme() -> str:
    """What all pages look like, in light and in dark."""
    return read("theme.css")


@cache
def read(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")


def hashes() -> tuple[str, str]:
    """The style and the script of a replay, as the policy of a page around it names them."""
    return allowed(theme() + read("player.css")), allowed(script_of_player())


def script_of_player() -> str:
    return read("stage.js") + read("player.js")


def allowed(content: str) -> str:
    """How a page's policy names the one script, or the one style sheet, that it may use."""
    digest = hashlib.sha256(content.encode("utf-8")).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"


def as_data(value: object) -> Markup:
    """JSON that stays data in a page: no tag can begin in it."""
    text = msgspec.json.encode(value).decode("utf-8")
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)


def one_line(text: str) -> str:
    """A submission's words without line breaks, control and direction characters."""
    return printable(text)[:MAX_WORDS]
