"""Answer the requests of the local page on which a person decides about a class.

`respond` needs no server. It writes the file of decisions and nothing else. Words of submissions
are text in every page, and no page runs a script.
"""

import hmac
import secrets
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path, PurePosixPath
from urllib.parse import quote, urlencode

import msgspec

from grader.classroom.book import NOTHING, Outcome
from grader.classroom.comments import (
    Comment,
    place_comment,
    split_lines,
    write_comment,
)
from grader.classroom.dashboard import read_outcomes
from grader.classroom.decisions import Decision, DecisionsFile, Table
from grader.classroom.folder import ClassFolder
from grader.errors import Stop
from grader.intake.found import CannotTake, Intake, Work
from grader.intake.names import make_portable
from grader.intake.packing import Contents, pack, show
from grader.intake.pieces import name_type, rank_file
from grader.intake.roster import ClassList, is_same_student
from grader.player.page import clean_line, fill_template
from grader.report.html import Remark
from grader.text import defuse, plural

TEMPLATES = Path(__file__).with_name("templates")
MOST_FILES, MOST_LINES = 60, 20_000  # on a page
LONGEST_FILE = 200_000  # bytes shown of a file
READABLE = ("", "empty", "a web page")  # kinds of files whose text a person can read
HEADERS = {
    "Content-Type": "text/html; charset=utf-8",
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; form-action 'self'; "
    "base-uri 'none'; frame-ancestors 'none'",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "same-origin",
    "X-Content-Type-Options": "nosniff",
}
Form = Mapping[str, str]


@dataclass(frozen=True)
class Request:
    """A request of a browser."""

    method: str
    path: str
    query: Form = field(default_factory=dict)
    form: Form = field(default_factory=dict)
    host: str = ""
    origin: str = ""
    cookie: str = ""  # the value of our own cookie


@dataclass(frozen=True)
class Response:
    status: int
    body: str = ""
    headers: Form = field(default_factory=dict)


@dataclass
class Review:
    """A class under review: its submissions, and the decisions so far."""

    known: ClassFolder
    intake: Intake
    people: ClassList  # without the work that a person chose
    host: str = "127.0.0.1"
    token: str = field(default_factory=secrets.token_urlsafe)
    read: dict[str, tuple[Contents, str]] = field(default_factory=dict)  # by name

    @cached_property
    def outcomes(self) -> dict[str, Outcome]:
        return {each.name: each for each in read_outcomes(self.known.find_results())}

    @cached_property
    def unlisted(self) -> list[str]:
        return self.people.list_unlisted(self.intake.names)

    @cached_property
    def absent(self) -> list[str]:
        return self.people.list_absent(self.intake.names)

    @property
    def file(self) -> DecisionsFile:
        return DecisionsFile(self.known.locate(self.known.settings.decisions), self.known.course)

    @property
    def names(self) -> list[str]:
        """Return all students, sorted as people sort names."""
        names = dict.fromkeys([*self.outcomes, *self.intake.names, *self.absent])
        return sorted(names, key=lambda name: self.find_outcome(name).order)

    def find_outcome(self, name: str) -> Outcome:
        full = self.people.full_names.get(name, "")
        return self.outcomes.get(name, Outcome(name, full_name=full))

    def find_reason(self, name: str) -> str:
        """Return the reason why this work needs manual review, or an empty text."""
        outcome = self.outcomes.get(name)
        if outcome is None:  # it arrived after grading, or a person chose its owner
            return self.intake.troubles.get(name, "")
        if outcome.mark is None:
            return outcome.trouble
        return "not in the class list" if name in self.unlisted else ""

    def list_decisions(self, name: str) -> list[Decision]:
        """Return the decisions about a student, by any name of the student."""
        return [each for each in self.file.list_decisions() if self.is_about(each, name)]

    def is_about(self, decision: Decision, name: str) -> bool:
        called = [each for who in decision.students for each in self.people.list_called(who)]
        same = any(is_same_student(who, name) for who in decision.students)
        return same or name in map(make_portable, called) or decision.values.get("take") == name

    def list_works(self, name: str) -> list[Work]:
        return [each for each in self.intake.works if each.name == name]

    def read_files(self, name: str) -> tuple[Contents, str]:
        """Return a student's files, and whether they are those that were graded."""
        if name not in self.read:
            self.read[name] = self.unpack_files(name)
        return self.read[name]

    def unpack_files(self, name: str) -> tuple[Contents, str]:
        works, asked = self.list_works(name), self.known.course.modules
        if len(works) == 1 and name not in self.intake.troubles:
            try:
                return Contents(pack(works[0], asked).files), "as they are graded"
            except CannotTake:
                return show(works[0], asked), "as they came"
        shown = [(work, show(work, asked)) for work in works]
        many = len(shown) > 1
        files = [
            (join_source(work, file) if many else file, content)
            for work, each in shown
            for file, content in each.files
        ]
        return Contents(files, shown[0][1].choices if len(shown) == 1 else []), "as they came"

    def list_choices(self, name: str) -> list[list[str]]:
        """Return the paths to choose from, a list for each question."""
        choices = self.read_files(name)[0].choices
        if name in self.intake.refused:
            choices = [*choices, [work.sources[0].name for work in self.list_works(name)]]
        return choices


def join_source(work: Work, file: str) -> str:
    """Return a file's path, beginning with the name of its submission."""
    source = work.sources[0].name
    return file if file.partition("/")[0] == source else f"{source}/{file}"


# ---------------------------------------------------------------- requests


def respond(review: Review, request: Request) -> Response:
    """Answer a request; without the token the answer is 403."""
    if request.host not in (review.host, review.host.replace("127.0.0.1", "localhost")):
        return refuse(403, "This page is for this machine alone.")
    if request.path == "/" and is_same(request.query.get("token", ""), review.token):
        cookie = f"{name_cookie(review)}={review.token}; HttpOnly; SameSite=Strict; Path=/"
        return Response(303, "", {"Location": "/", "Set-Cookie": cookie})
    if not is_same(request.cookie, review.token):
        return refuse(403, "Open the address that `grader class review` printed.")
    if request.method == "POST":
        if request.origin != f"http://{request.host}":
            return refuse(403, "This form is not of this page.")
        return change(review, request)
    if request.method != "GET":
        return refuse(405, "This page does not do that.")
    if request.path == "/":
        return Response(200, render_class(review), HEADERS)
    name = request.query.get("name", "")
    if request.path != "/student" or name not in review.names:
        return refuse(404, "There is no such page.")
    return Response(200, render_student(review, name, request.query), HEADERS)


def name_cookie(review: Review) -> str:
    """Return our cookie's name, with the port: browsers share cookies among ports."""
    return f"review-{review.host.rpartition(':')[2]}"


def is_same(given: str, token: str) -> bool:
    return hmac.compare_digest(given.encode("utf-8", "replace"), token.encode())


def refuse(status: int, words: str) -> Response:
    return Response(status, words, {**HEADERS, "Content-Type": "text/plain; charset=utf-8"})


def change(review: Review, request: Request) -> Response:
    """Apply a form and show the student again, or show the reason why nothing was written."""
    form = request.form
    name = form.get("name", "")
    act = ACTS.get(request.path)
    if act is None or name not in review.names:
        return refuse(404, "There is no such form.")
    try:
        act(review, name, form)
    except Stop as error:
        return Response(400, render_student(review, name, form, str(error)), HEADERS)
    return Response(303, "", {"Location": f"/student?{urlencode({'name': name, 'done': 1})}"})


def decide_points(review: Review, name: str, form: Form) -> None:
    """Write a mark or added points; replace an earlier one of its kind."""
    kind = form.get("kind", "")
    if kind not in ("points", "add"):
        raise Stop("choose what the points do")
    values = {"student": name, kind: read_number(form, "points"), "reason": read_reason(form)}
    put(review, name, values, lambda old: old.what == kind)


def decide_work(review: Review, name: str, form: Form) -> None:
    """Write which work counts; replace an earlier choice."""
    path = form.get("path", "")
    paths = next((each for each in review.list_choices(name) if path in each), None)
    if paths is None:
        raise Stop("choose one of the files or folders")
    values = {"student": name, "take": path, "reason": read_reason(form)}
    put(review, name, values, lambda old: old.values.get("take") in paths)


def decide_owner(review: Review, name: str, form: Form) -> None:
    """Write the owner of work that is under a name outside the class list."""
    student = form.get("student", "")
    if student not in review.people.names or name not in review.unlisted:
        raise Stop("choose a student of the class list")
    values = {"student": student, "take": name, "reason": read_reason(form)}
    put(review, name, values, lambda old: old.values.get("take") == name)


def decide_comment(review: Review, name: str, form: Form) -> None:
    """Write a comment, on a line if the form names one."""
    words, file = (
        defuse(form.get("comment", "").replace("\r", "")).strip(),
        form.get("file", ""),
    )
    if not words:
        raise Stop("the comment is empty: write one")
    comment = Comment(name, words)
    if file:
        files = dict(review.read_files(name)[0].files)
        line = read_number(form, "line")
        if file not in files or not 0 < line <= len(split_lines(files[file])):
            raise Stop(f"{file} has no line {line}")
        comment = write_comment(name, words, file, line, files[file])
    review.file.put("comment", msgspec.to_builtins(comment))


ACTS: dict[str, Callable[[Review, str, Form], None]] = {
    "/points": decide_points,
    "/work": decide_work,
    "/owner": decide_owner,
    "/comment": decide_comment,
    "/remove": lambda review, name, form: review.file.remove(form.get("key", "")),
}


def put(review: Review, name: str, values: Table, is_old: Callable[[Decision], bool]) -> None:
    """Write a decision; replace an old one about this student alone."""
    found = filter(is_old, review.list_decisions(name))
    old = next((each for each in found if isinstance(each.values["student"], str)), None)
    if old is not None and "take" not in values:
        values = values | {"student": old.values["student"]}
    review.file.put("adjust", values, old)


def read_number(form: Form, name: str) -> int:
    words = form.get(name, "").strip()
    try:
        return int(words[:9])
    except ValueError:
        raise Stop(f"{name} {words[:40]!r} is not a whole number") from None


def read_reason(form: Form) -> str:
    words = " ".join(defuse(form.get("reason", "")).split())
    if not words:
        raise Stop("the reason is missing: the student reads it")
    return words


# ---------------------------------------------------------------- pages


@dataclass(frozen=True)
class File:
    """A file as the page shows it: its lines, or a note with the reason for none."""

    name: str
    lines: list[str]
    note: str = ""
    remarks: dict[int, list[str]] = field(default_factory=dict)  # comments by line


def render_class(review: Review) -> str:
    rows = [(name, review.find_outcome(name), review.find_reason(name)) for name in review.names]
    decisions = review.file.list_decisions()
    decided = {n: [each for each in decisions if review.is_about(each, n)] for n, _, _ in rows}
    return fill(
        "review.html",
        known=review.known,
        waiting=[row for row in rows if row[2]],
        absent=review.absent,
        NOTHING=NOTHING,
        others=[row for row in rows if not row[2]],
        decided=decided,
    )


def render_student(review: Review, name: str, given: Form, problem: str = "") -> str:
    """Return the page of a student; `given` fills in its forms."""
    shown, how = review.read_files(name)
    decisions, files = review.list_decisions(name), dict(shown.files)
    placed = [  # comments beside their lines in these files
        place_comment(msgspec.convert(each.values, Comment), files)
        if each.kind == "comment"
        else None
        for each in decisions
    ]
    remarks = [remark for remark in placed if remark and remark.line]
    return fill(
        "review_student.html",
        name=name,
        outcome=review.find_outcome(name),
        reason=review.find_reason(name),
        sources=[source.name for work in review.list_works(name) for source in work.sources],
        choices=review.list_choices(name),
        owners=list_owners(review) if name in review.unlisted else [],
        decisions=list(zip(decisions, placed, strict=True)),
        files=list_files(shown, remarks),
        how=how,
        given=given,
        problem=problem,
        known=review.known,
    )


def list_owners(review: Review) -> list[tuple[str, str]]:
    """Return possible owners, students who handed in nothing first."""
    names = [*review.absent, *(n for n in review.people.names if n not in review.absent)]
    return [(name, review.find_outcome(name).label) for name in names]


def list_files(shown: Contents, remarks: list[Remark]) -> list[File]:
    """Return the files to show, those of the lab first."""
    ranked = sorted(shown.files, key=lambda each: rank_file(PurePosixPath(each[0])))
    files, room = [], MOST_LINES
    for name, content in ranked[:MOST_FILES]:
        files.append(show_file(name, content, remarks, room))
        room -= len(files[-1].lines)
    return files


def show_file(name: str, content: bytes, remarks: list[Remark], most: int) -> File:
    """Return a file with at most `most` lines."""
    words = name_type(content[:4096])
    if words not in READABLE or b"\0" in content[:4096]:
        return File(name, [], f"{words or 'no text'}, {len(content)} bytes")
    lines = split_lines(content[:LONGEST_FILE])
    notes = {
        f"cut off after {LONGEST_FILE} bytes": len(content) > LONGEST_FILE,
        f"cut off after {plural(most, 'line')}": len(lines) > most,
        "not UTF-8: wrong letters are shown as \ufffd": "\ufffd" in "".join(lines),
    }
    note = next((note for note, applies in notes.items() if applies), words.removeprefix("empty"))
    beside: dict[int, list[str]] = {}
    for each in remarks:
        if each.file == name:
            beside.setdefault(each.line, []).append(each.comment)
    return File(name, lines[:most], note, beside)


def fill(template: str, **values: object) -> str:
    values |= {"clean": clean_line, "harmless": defuse, "quote": quote, "forms": True}
    return fill_template(TEMPLATES / template, "review.css", has_replays=False, **values)
