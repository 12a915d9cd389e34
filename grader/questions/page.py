"""Write a sheet as a page to print or open, its key, and one for practice, whose answers open."""

import re
from pathlib import Path
from typing import Literal

from markupsafe import Markup, escape

from grader.player.page import clean_line, fill_template
from grader.questions.question import KINDS, Picture, Sheet
from grader.text import digits

TEMPLATES = Path(__file__).with_name("templates")
PageKind = Literal["sheet", "key", "practice"]


def make_page(sheet: Sheet, title: str, kind: PageKind) -> str:
    """Return one page that needs nothing else."""
    return fill_template(
        TEMPLATES / "sheet.html",
        (TEMPLATES / "sheet.css").read_text(encoding="utf-8"),
        sheet=sheet,
        title=title,
        kind=kind,
        kinds=KINDS,
        mark_up=mark_up,
        show_picture=show_picture,
        number_of=digits,
    )


def mark_up(text: str, tag: str = "p") -> Markup:
    """Mark up a text: a paragraph for each line, and its code as code; all else is plain text."""
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


def show_picture(picture: Picture) -> Markup:
    """Show a picture of ours, which has numbers of a submission in it and no words."""
    return Markup(picture.svg)
