"""Write a sheet as a page, its key, and a practice page with answers to unfold."""

import re
from pathlib import Path
from typing import Any, Literal

from markupsafe import Markup, escape

from grader.player.page import clean_line, fill_template
from grader.questions.question import KINDS, Sheet
from grader.text import digits

TEMPLATES = Path(__file__).with_name("templates")
PageKind = Literal["sheet", "key", "practice"]


def make_page(sheet: Sheet, title: str, kind: PageKind) -> str:
    """Return one self-contained page."""
    helpers: dict[str, Any] = {"kinds": KINDS, "mark_up": mark_up, "number_of": digits}
    page = TEMPLATES / "sheet.html"
    return fill_template(page, "sheet.css", sheet=sheet, title=title, kind=kind, **helpers)


def mark_up(text: str, tag: str = "p") -> Markup:
    """Mark up a text: paragraphs for lines, and code for backticks; the rest is plain text."""
    paragraphs = [mark_up_code(clean_line(line)) for line in text.splitlines()]
    if not tag:
        return Markup(" ").join(paragraphs)
    return Markup("").join(Markup("<p>{}</p>").format(each) for each in paragraphs)


def mark_up_code(line: str) -> Markup:
    parts = re.split(r"`([^`]*)`", line)
    return Markup("").join(
        Markup("<code>{}</code>").format(part) if number % 2 else escape(part)
        for number, part in enumerate(parts)
    )
