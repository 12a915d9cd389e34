"""The handouts as pages that open with a double click, for the folder that students get."""

import html
import re
import shutil
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token

from grader.judge.course import FULL, Course
from grader.maintain.handouts import handouts_of

LEFT_OUT = {"hints.md"}  # the command gives them one at a time
SHARED = ("touch", "laws")  # of all movable figures
STYLE = """
:root { color-scheme: light dark }
body { font: 1.05rem/1.55 system-ui, sans-serif; margin: 2rem auto }
body { max-width: 52rem; padding: 0 1rem }
img { max-width: 100%; background: white }
table { border-collapse: collapse; display: block; overflow-x: auto }
td, th { border: 1px solid #8888; padding: .3rem .6rem; text-align: left; vertical-align: top }
pre { background: #8882; padding: .8rem; overflow-x: auto }
"""
PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>{style}</style>
{scripts}</head>
<body>
{body}</body>
</html>
"""


def write_pages(handouts: Path, folder: Path, course: Course = FULL) -> None:
    """Write a page for each of a course's handouts, and the figures that are in them."""
    every = handouts_of(handouts, course)
    texts = {name: text for name, text in every.items() if name not in LEFT_OUT}
    (folder / "figures").mkdir(parents=True)
    for name, text in texts.items():
        target = folder / name.replace(".md", ".html")
        page = as_page(text, set(texts), scripts_of(text, handouts))
        target.write_text(page, encoding="utf-8", newline="\n")
        for figure in figures_in(text):
            shutil.copyfile(handouts / figure, folder / figure)
    shutil.copytree(handouts / "touch", folder / "touch")


def figures_in(text: str) -> list[str]:
    return re.findall(r"\]\((figures/[^)]+)\)", text)


def scripts_of(text: str, handouts: Path) -> str:
    """What a page loads to make those of its figures movable that have a script in touch/."""
    names = [Path(figure).stem for figure in figures_in(text)]
    movable = [name for name in names if (handouts / "touch" / f"{name}.js").is_file()]
    if not movable:
        return ""
    tags = [f'<script defer src="touch/{name}.js"></script>' for name in [*SHARED, *movable]]
    return "\n".join(['<link rel="stylesheet" href="touch/touch.css">', *tags, ""])


def as_page(text: str, pages: set[str], scripts: str = "") -> str:
    """One page; a link to a handout that is none of `pages` becomes plain words."""
    reader = MarkdownIt("commonmark").enable("table")
    tokens = reader.parse(text.replace("- [ ] ", "- \N{BALLOT BOX} "))
    for token, after in zip(tokens, [*tokens[1:], None], strict=True):
        if token.type == "heading_open" and after is not None:
            token.attrSet("id", anchor(after.content))
        mend_links(token.children or [], pages)
    title = next(each.content for each in tokens if each.type == "inline")
    body = reader.renderer.render(tokens, reader.options, {})
    return PAGE.format(title=html.escape(title), style=STYLE, scripts=scripts, body=body)


def mend_links(tokens: list[Token], pages: set[str]) -> None:
    kept = True
    for token in tokens:
        if token.type == "link_open":
            name, mark, place = str(token.attrGet("href")).partition("#")
            kept = not name.endswith(".md") or name in pages
            token.attrSet(
                "href", name.removesuffix(".md") + ".html" * name.endswith(".md") + mark + place
            )
        if token.type in ("link_open", "link_close"):
            token.hidden = not kept


def anchor(heading: str) -> str:
    """What a link to this heading names."""
    words = re.sub(r"[^\w\s-]", "", heading).strip().lower()
    return re.sub(r"[\s-]+", "-", words)
