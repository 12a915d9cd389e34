"""Write sheets as Moodle XML, for its question bank: a category for each student.

It follows Moodle's own importer (question/format/xml/format.php): numerical questions with a
tolerance and feedback for known wrong answers, matching ones for films, multiple choice for lines,
essays for what a person marks. Pictures are in the file.
"""

import base64
from collections.abc import Iterable, Iterator
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from markupsafe import Markup

from grader.questions.page import mark_up
from grader.questions.question import KINDS, Picture, Question, Sheet
from grader.text import digits

NUMBER_ALONE = "3"  # of showunits: the answer is a number without its unit


def write_moodle(sheets: Iterable[Sheet], title: str) -> bytes:
    """Return the file to import, of one sheet or of many."""
    quiz = Element("quiz")
    for sheet in sheets:
        top = Element("question", type="category")
        path = "/".join(each.replace("/", "//") for each in (title, sheet.student))
        add_text(SubElement(top, "category"), f"$course$/top/{path}")
        quiz.append(top)
        for number, question in enumerate(sheet.questions, 1):
            quiz.extend(make_elements(f"{number:02} {KINDS[question.kind]}", question))
    indent(quiz)
    text: bytes = tostring(quiz, "utf-8", xml_declaration=True)
    return text + b"\n"


def make_elements(name: str, question: Question) -> Iterator[Element]:
    """Yield the elements of a question; one that a machine and a person mark is two."""
    match question.kind:
        case "number":
            yield make_numerical(name, question)
        case "film":
            yield make_matching(name, question)
        case "line":
            yield make_multichoice(name, question)
            if question.by_hand:
                yield make_essay(f"{name}: in words", question)
        case "why":
            yield make_essay(name, question)


def make_numerical(name: str, question: Question) -> Element:
    found = start_question("numerical", name, question, question.by_machine)
    add_answer(found, 100, question.answer, "", question.tolerance)
    for wrong in question.wrong:
        add_answer(found, 0, wrong.answer, str(mark_up(wrong.why, "")), question.tolerance)
    for tag, value in (("unitgradingtype", "0"), ("unitpenalty", "0"), ("unitsleft", "0")):
        SubElement(found, tag).text = value
    SubElement(found, "showunits").text = NUMBER_ALONE
    return found


def make_matching(name: str, question: Question) -> Element:
    found = start_question("matching", name, question, question.by_machine, with_pictures=False)
    SubElement(found, "shuffleanswers").text = "0"
    for picture, letter in zip(question.pictures, question.answer, strict=True):
        part = SubElement(found, "subquestion", format="html")
        add_text(part, show_picture(picture))
        add_file(part, picture)
        add_text(SubElement(part, "answer"), question.choices["abcdefgh".index(letter)])
    return found


def make_multichoice(name: str, question: Question) -> Element:
    found = start_question("multichoice", name, question, question.by_machine)
    for tag, value in (("single", "true"), ("shuffleanswers", "0"), ("answernumbering", "none")):
        SubElement(found, tag).text = value
    for number in range(1, len(question.code) + 1):
        right = str(number) == question.answer
        words = str(mark_up(question.why)) if right else ""
        add_answer(found, 100 if right else 0, f"line {number}", words, form="html")
    return found


def make_essay(name: str, question: Question) -> Element:
    found = start_question("essay", name, question, question.by_hand)
    for tag, value in (
        ("responseformat", "editor"),
        ("responserequired", "1"),
        ("responsefieldlines", "10"),
        ("attachments", "0"),
        ("attachmentsrequired", "0"),
    ):
        SubElement(found, tag).text = value
    points = Markup("").join(Markup("<li>{}</li>").format(mark_up(x, "")) for x in question.rubric)
    info = Markup("{}<ul>{}</ul>").format(mark_up(question.why), points)
    add_text(SubElement(found, "graderinfo", format="html"), info)
    add_text(SubElement(found, "responsetemplate", format="html"), "")
    return found


# ---------------------------------------------------------------- the parts of all


def start_question(
    kind: str, name: str, question: Question, points: int, with_pictures: bool = True
) -> Element:
    """Make the parts that questions of all kinds have."""
    found = Element("question", type=kind)
    add_text(SubElement(found, "name"), f"{name} ({question.name})")
    pictures = question.pictures if with_pictures else ()
    lines = Markup("\n").join(Markup("<li>{}</li>").format(line) for line in question.code)
    code = Markup("<ol style='font-family: monospace; white-space: pre-wrap'>{}</ol>").format(lines)
    about = SubElement(found, "questiontext", format="html")
    add_text(
        about, mark_up(question.text) + (code if question.code else "") + show_pictures(pictures)
    )
    for picture in pictures:
        add_file(about, picture)
    add_text(SubElement(found, "generalfeedback", format="html"), mark_up(question.why))
    for tag, value in (("defaultgrade", str(points)), ("penalty", "0"), ("hidden", "0")):
        SubElement(found, tag).text = value
    return found


def add_answer(
    question: Element,
    fraction: int,
    text: str,
    feedback: str,
    tolerance: float | None = None,
    form: str = "moodle_auto_format",
) -> None:
    found = SubElement(question, "answer", fraction=str(fraction), format=form)
    add_text(found, text)
    if tolerance is not None:
        SubElement(found, "tolerance").text = digits(tolerance)
    add_text(SubElement(found, "feedback", format="html"), feedback)


def add_text(parent: Element, text: str) -> None:
    SubElement(parent, "text").text = str(text)


def show_pictures(pictures: Iterable[Picture]) -> Markup:
    return Markup("").join(map(show_picture, pictures))


def show_picture(picture: Picture) -> Markup:
    """Show a picture where Moodle puts the file of that name."""
    form = Markup('<p>{}</p><p><img src="@@PLUGINFILE@@/{}" alt="{}" width="450"></p>')
    return form.format(picture.name, name_file(picture), picture.alt)


def add_file(parent: Element, picture: Picture) -> None:
    file = SubElement(parent, "file", name=name_file(picture), path="/", encoding="base64")
    file.text = base64.b64encode(picture.svg.encode()).decode()


def name_file(picture: Picture) -> str:
    return "".join(c if c.isalnum() else "-" for c in picture.name) + ".svg"
