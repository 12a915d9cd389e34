"""Write sheets as Moodle XML, for its question bank: a category for each student.

It follows Moodle's own importer (question/format/xml/format.php): numerical questions with a
tolerance and feedback for known wrong answers, matching questions for films, essays for questions
marked by a person. Pictures are in the file.
"""

import base64
from collections.abc import Iterable

from grader.player.page import load_environment
from grader.questions.page import TEMPLATES, mark_up
from grader.questions.question import KINDS, Picture, Sheet
from grader.text import digits


def write_moodle(sheets: Iterable[Sheet], title: str) -> bytes:
    """Return the file to import, of one sheet or of many."""
    page = load_environment(TEMPLATES).get_template("moodle.xml")
    text = page.render(
        sheets=sheets,
        title=title,
        kinds=KINDS,
        mark_up=mark_up,
        number_of=digits,
        name_file=name_file,
        encode=lambda picture: base64.b64encode(picture.svg.encode()).decode(),
    )
    return text.encode() + b"\n"


def name_file(picture: Picture) -> str:
    return "".join(c if c.isalnum() else "-" for c in picture.name) + ".svg"
