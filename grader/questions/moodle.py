"""Sheets as Moodle XML, to be imported into a question bank: a category for each student.

Written as Moodle's own importer reads it (its question/format/xml/format.php): numerical questions
with a tolerance and feedback for known wrong answers, matching ones for films, multiple choice for
lines, essays for what a person marks. Pictures travel in the file.
"""

import base64
from collections.abc import Iterable, Iterator
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from markupsafe import Markup

from grader.questions.page import worded
from grader.questions.question import KINDS, Picture, Question, Sheet
from grader.text import digits

NUMBER_ALONE = "3"  # of showunits: the answer is a number without its unit


def moodle_xml(sheets: Iterable[Sheet], title: str) -> bytes:
    """The file to import, of one sheet or of many."""
    quiz = Element("quiz")
    for sheet in sheets:
        top = Element("question", type="category")
        path = "/".join(each.replace("/", "//") for each in (title, sheet.student))
        text_in(SubElement(top, "category"), f"$course$/top/{path}")
        quiz.append(top)
        for number, question in enumerate(sheet.questions, 1):
            quiz.extend(elements(f"{number:02} {KINDS[question.kind]}", question))
    indent(quiz)
    text: bytes = tostring(quiz, "utf-8", xml_declaration=True)
    return text + b"\n"


def elements(name: str, question: Question) -> Iterator[Element]:
    """A question as Moodle has it; one that a machine and a person mark is two."""
    match question.kind:
        case "number":
            yield numerical(name, question)
        case "film":
            yield matching(name, question)
        case "line":
            yield multichoice(name, question)
            if question.by_hand:
                yield essay(f"{name}: in words", question)
        case "why":
            yield essay(name, question)


def numerical(name: str, question: Question) -> Element:
    found = begun("numerical", name, question, question.by_machine)
    answer(found, 100, question.answer, "", question.tolerance)
    for wrong in question.wrong:
        answer(found, 0, wrong.answer, str(worded(wrong.why, "")), question.tolerance)
    for tag, value in (("unitgradingtype", "0"), ("unitpenalty", "0"), ("unitsleft", "0")):
        SubElement(found, tag).text = value
    SubElement(found, "showunits").text = NUMBER_ALONE
    return found


def matching(name: str, question: Question) -> Element:
    found = begun("matching", name, question, question.by_machine, with_pictures=False)
    SubElement(found, "shuffleanswers").text = "0"
    for picture, letter in zip(question.pictures, question.answer, strict=True):
        part = SubElement(found, "subquestion", format="html")
        text_in(part, shown(picture))
        file_in(part, picture)
        text_in(SubElement(part, "answer"), question.choices["abcdefgh".index(letter)])
    return found


def multichoice(name: str, question: Question) -> Element:
    found = begun("multichoice", name, question, question.by_machine)
    for tag, value in (("single", "true"), ("shuffleanswers", "0"), ("answernumbering", "none")):
        SubElement(found, tag).text = value
    for number in range(1, len(question.code) + 1):
        right = str(number) == question.answer
        words = str(worded(question.why)) if right else ""
        answer(found, 100 if right else 0, f"line {number}", words, form="html")
    return found


def essay(name: str, question: Question) -> Element:
    found = begun("essay", name, question, question.by_hand)
    for tag, value in (
        ("responseformat", "editor"),
        ("responserequired", "1"),
        ("responsefieldlines", "10"),
        ("attachments", "0"),
        ("attachmentsrequired", "0"),
    ):
        SubElement(found, tag).text = value
    points = Markup("").join(Markup("<li>{}</li>").format(worded(x, "")) for x in question.rubric)
    info = Markup("{}<ul>{}</ul>").format(worded(question.why), points)
    text_in(SubElement(found, "graderinfo", format="html"), info)
    text_in(SubElement(found, "responsetemplate", format="html"), "")
    return found


# ---------------------------------------------------------------- the parts of all


def begun(
    kind: str, name: str, question: Question, points: int, with_pictures: bool = True
) -> Element:
    """What questions of all kinds have."""
    found = Element("question", type=kind)
    text_in(SubElement(found, "name"), f"{name} ({question.name})")
    pictures = question.pictures if with_pictures else ()
    lines = Markup("\n").join(Markup("<li>{}</li>").format(line) for line in question.code)
    code = Markup("<ol style='font-family: monospace; white-space: pre-wrap'>{}</ol>").format(lines)
    about = SubElement(found, "questiontext", format="html")
    text_in(about, worded(question.text) + (code if question.code else "") + images(pictures))
    for picture in pictures:
        file_in(about, picture)
    text_in(SubElement(found, "generalfeedback", format="html"), worded(question.why))
    for tag, value in (("defaultgrade", str(points)), ("penalty", "0"), ("hidden", "0")):
        SubElement(found, tag).text = value
    return found


def answer(
    question: Element,
    fraction: int,
    text: str,
    feedback: str,
    tolerance: float | None = None,
    form: str = "moodle_auto_format",
) -> None:
    found = SubElement(question, "answer", fraction=str(fraction), format=form)
    text_in(found, text)
    if tolerance is not None:
        SubElement(found, "tolerance").text = digits(tolerance)
    text_in(SubElement(found, "feedback", format="html"), feedback)


def text_in(parent: Element, text: str) -> None:
    SubElement(parent, "text").text = str(text)


def images(pictures: Iterable[Picture]) -> Markup:
    return Markup("").join(map(shown, pictures))


def shown(picture: Picture) -> Markup:
    """A picture where Moodle puts the file of that name."""
    form = Markup('<p>{}</p><p><img src="@@PLUGINFILE@@/{}" alt="{}" width="450"></p>')
    return form.format(picture.name, file_name(picture), picture.alt)


def file_in(parent: Element, picture: Picture) -> None:
    file = SubElement(parent, "file", name=file_name(picture), path="/", encoding="base64")
    file.text = base64.b64encode(picture.svg.encode()).decode()


def file_name(picture: Picture) -> str:
    return "".join(c if c.isalnum() else "-" for c in picture.name) + ".svg"
