"""Write the handouts as pages that open with a double click, for the student's folder.

Each page is one file: its figures, scripts and films are inside it.
"""

import json
import re
import shutil
from base64 import b64encode
from collections.abc import Iterable, Mapping
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token

from grader.judge.course import FULL, Course
from grader.player.page import TEMPLATES, load_environment
from grader.release.formulas import typeset
from grader.release.handouts import make_handouts
from grader.release.measured import make_script
from grader.source.regions import read_source

STAGE = TEMPLATES / "stage.js"

SHARED = ("touch", "laws", "stage", "films", "measured")  # scripts of all movable figures
MEASURED = (
    "accuracy.md",
    "hard-cases.md",
    "effects.md",
)  # handed out with the engines
START = "index.md"  # the order of its links is the order of the pages
FEWEST = 3  # sections of a page that begins with a list of them
SITE_ONLY = re.compile(r"\A---\n.*?^---\n", re.M | re.S)  # front matter of a page for the site
EMPTY: Mapping[str, str] = {}
HERE = Path(__file__).with_name("templates")
READER = MarkdownIt("commonmark").enable("table")
STYLE = (HERE / "handout.css").read_text(encoding="utf-8")


def write_pages(
    handouts: Path, folder: Path, course: Course = FULL, measured: bool = False
) -> None:
    """Write a course's handouts of the lab or, if `measured`, those about engines.

    The pages about engines link to those of the lab, which do not link to them.
    """
    texts = sort_pages(make_handouts(handouts, course))
    if measured:
        write_files(handouts, folder, texts, MEASURED)
    else:
        write_files(handouts, folder, {n: texts[n] for n in texts if n not in MEASURED})


def write_files(
    handouts: Path, folder: Path, texts: Mapping[str, str], names: Iterable[str] | None = None
) -> None:
    """Write the pages of these names, or all; links to missing texts become plain words."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in texts if names is None else names:
        page = embed_figures(make_page(name, texts, read_scripts(texts[name], handouts)), handouts)
        (folder / html_name(name)).write_text(page, encoding="utf-8", newline="\n")


def embed_figures(page: str, handouts: Path) -> str:
    """Embed the figures of a page, each with its name for scripts and style."""

    def embed(found: re.Match[str]) -> str:
        path = handouts / found[1]
        kind = "svg+xml" if path.suffix == ".svg" else path.suffix[1:]
        content = b64encode(path.read_bytes()).decode()
        return f'data-figure="{found[1]}" src="data:image/{kind};base64,{content}"'

    return re.sub(r'src="(figures/[^"]+)"', embed, page)


def read_scripts(text: str, handouts: Path) -> dict[str, str]:
    """Return the style, scripts and films of a page's movable figures."""
    names = list_scripts(text, handouts)
    if not names:
        return {}
    touch = handouts / "touch"
    films = [touch / "films" / f"{Path(figure).stem}.js" for figure in find_figures(text)]
    texts = {"style": read_source(touch / "touch.css")}
    texts |= {f"film-{film.stem}": read_source(film) for film in films if film.is_file()}
    made = {"stage": read_source(STAGE), "measured": write_measurements(handouts)}
    return texts | {name: made.get(name) or read_source(touch / f"{name}.js") for name in names}


def lay_out_touch(handouts: Path, folder: Path) -> None:
    """Copy the scripts and films of movable figures, with the stage of replays and measurements."""
    shutil.copytree(handouts / "touch", folder / "touch")
    shutil.copyfile(STAGE, folder / "touch" / STAGE.name)
    script = folder / "touch" / "measured.js"
    script.write_text(write_measurements(handouts), encoding="utf-8", newline="\n")


def write_measurements(handouts: Path) -> str:
    return make_script(json.loads((handouts / "results.json").read_text(encoding="utf-8")))


def find_figures(text: str) -> list[str]:
    return re.findall(r"\]\((figures/[^)]+)\)", text)


def list_scripts(text: str, handouts: Path) -> list[str]:
    """Return the scripts in touch/ for the movable figures of a page."""
    names = [Path(figure).stem for figure in find_figures(text)]
    kinds = dict.fromkeys(each for name in names for each in (name, name.partition("-")[0]))
    movable = [name for name in kinds if (handouts / "touch" / f"{name}.js").is_file()]
    return [*SHARED, *movable] if movable else []


def sort_pages(texts: Mapping[str, str]) -> dict[str, str]:
    """Sort the pages in the order of the first page's links, without the site's front matter."""
    linked = re.findall(r"\]\(([\w-]+\.md)\)", texts.get(START, ""))
    names = [name for name in dict.fromkeys([START, *linked, *texts]) if name in texts]
    return {name: SITE_ONLY.sub("", texts[name]) for name in names}


def make_page(name: str, texts: Mapping[str, str], scripts: Mapping[str, str] = EMPTY) -> str:
    """Make one page; links to missing handouts become plain words."""
    tokens = parse_page(texts[name])
    sections = []
    for token, after in zip(tokens, [*tokens[1:], None], strict=True):
        if token.type == "heading_open" and after is not None:
            token.attrSet("id", make_anchor(after.content))
            sections += [after.content] if token.tag == "h2" else []
        mend_links(token.children or [], texts)
    body = render_page(tokens)
    heading, end, rest = body.partition("</h1>\n")
    template = load_environment(HERE).get_template("handout.html")
    return template.render(
        name=name,
        texts=texts,
        style=STYLE,
        scripts=scripts,
        ways=list_ways(name, list(texts)),
        heading=heading + end.strip(),
        sections=sections if len(sections) >= FEWEST else [],
        rest=make_scrollable(rest),
        find_title=find_title,
        html_name=html_name,
        make_anchor=make_anchor,
    )


def parse_page(text: str) -> list[Token]:
    return READER.parse(typeset(text.replace("- [ ] ", "- \N{BALLOT BOX} ")))


def render_page(tokens: list[Token]) -> str:
    """Return the HTML of a parsed page."""
    return str(READER.renderer.render(tokens, READER.options, {}))


def find_title(text: str) -> str:
    return next(line[2:] for line in text.splitlines() if line.startswith("# "))


def html_name(name: str) -> str:
    return name.removesuffix(".md") + ".html"


def list_ways(name: str, names: list[str]) -> list[tuple[str, str, str]]:
    """Return links to the first page and to those before and after this one."""
    at = names.index(name)
    back = [("", "Start", names[0]), ("previous", "Previous", names[at - 1])] if at else []
    return [*back, *(("next", "Next", each) for each in names[at + 1 : at + 2])]


def make_scrollable(body: str) -> str:
    """Make wide tables and code reachable and scrollable by keyboard."""
    body = body.replace("<table>", '<div class="wide" tabindex="0">\n<table>')
    return body.replace("</table>", "</table>\n</div>").replace("<pre>", '<pre tabindex="0">')


def mend_links(tokens: list[Token], pages: Iterable[str]) -> None:
    kept = True
    for token in tokens:
        if token.type == "link_open":
            name, mark, place = str(token.attrGet("href")).partition("#")
            page = name.endswith(".md")
            kept = not page or name in pages
            token.attrSet("href", (html_name(name) if page else name) + mark + place)
        if token.type in ("link_open", "link_close"):
            token.hidden = not kept


def make_anchor(heading: str) -> str:
    words = re.sub(r"[^\w\s-]", "", heading).strip().lower()
    return re.sub(r"[\s-]+", "-", words)
