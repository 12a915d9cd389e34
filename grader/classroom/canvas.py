"""Send the marks of a class to Canvas, each with a comment and the student's page.

Only what Canvas lacks is sent, so a stopped run continues. `canvas.json` in the
folder of the class records what was sent: a person entered any other mark in Canvas.
"""

import hashlib
import os
import re
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import msgspec
from canvasapi import exceptions as refused
from canvasapi.course import Course as CanvasCourse
from canvasapi.requester import Requester
from canvasapi.upload import Uploader
from msgspec import Struct
from rich.console import Console
from rich.table import Column, Table

from grader.classroom.dashboard import Entry, read_class, write_dashboard
from grader.classroom.feedback import write_text
from grader.classroom.folder import FILE, ClassFolder, remember_class
from grader.classroom.marks import Scores, make_marks, make_parts, mark_engine
from grader.errors import Stop
from grader.intake.roster import list_name
from grader.intake.systems import read_roster
from grader.judge.course import Course
from grader.report.files import write_whole
from grader.text import name_command, printable

TOKEN = "CANVAS_TOKEN"
# Without https, others could read the token on its way, unless it stays on this machine.
ADDRESS = re.compile(
    r"(?P<base>https://[^/\s@]+|http://(?:127\.0\.0\.1|localhost)(?::\d+)?)"
    r"/courses/(?P<course>\d+)/assignments/(?P<assignment>\d+)(?:[/?#]\S*)?"
)
WAITS = (2, 5, 15, 60)  # s to wait before a limited request is repeated
COMMENTS = ["submission_comments"]  # left out by Canvas unless requested
PATIENCE = 60  # s to wait for an answer
REASONS = {  # reasons of failed requests, the narrowest kind first
    refused.InvalidAccessToken: f"it does not accept the token in {TOKEN} (401): make a new one",
    refused.Unauthorized: "the owner of the token may not do that (401)",
    refused.Forbidden: "the owner of the token may not do that (403)",
    refused.ResourceDoesNotExist: "it has no such assignment or student (404)",
    KeyboardInterrupt: "stopped",
    (ValueError, KeyError): "what answers at this address does not answer as Canvas does",
    OSError: "it cannot be reached",
}
OF_ONE_STUDENT = (  # refusals after which the others' marks may go through
    *(refused.BadRequest, refused.Unauthorized, refused.Forbidden, refused.ResourceDoesNotExist),
    *(refused.Conflict, refused.UnprocessableEntity),
)


class Record(Struct):
    """The contents of canvas.json."""

    address: str
    students: dict[str, list[str]] = {}  # marks by ids in Canvas; the last one may not have arrived


@dataclass(frozen=True)
class Delivery:
    """The mark, comment and page for one student."""

    name: str
    user: str  # the student's id in Canvas
    mark: str
    comment: str
    digest: str  # hash of the comment's and page's content
    page: Path | None

    @property
    def sign(self) -> str:
        """Return the text that identifies our comment: its page's name, or itself."""
        return f"feedback-{self.digest}" if self.page else self.comment

    def is_in(self, there: Any) -> bool:
        """Return whether Canvas has the comment or its page."""
        comments = getattr(there, "submission_comments", None) or []
        files = [file for each in comments for file in each.get("attachments") or []]
        said = [
            *(each.get("display_name") for each in files),
            *(each.get("comment") for each in comments),
        ]
        return any(self.sign in (each or "") for each in said)


@dataclass(frozen=True)
class Change:
    delivery: Delivery
    there: Any  # the submission in Canvas
    before: str  # the mark there
    ours: list[str]  # the same, if we sent it


@dataclass
class Plan:
    """The changes to send, and notes for the instructor."""

    changes: list[Change] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    unchanged: int = 0
    skipped: int = 0

    def skip(self, name: str, why: str) -> None:
        self.skipped += 1
        self.notes.append(f"{name}: skipped, {why}")

    def add(self, delivery: Delivery, there: Any, sent: list[str], over: bool) -> None:
        """Plan to send a mark; skip it if a person entered another, unless `over`."""
        if there is None:
            return self.skip(delivery.name, f"Canvas has no student {delivery.user} for it")
        if getattr(there, "excused", False):
            return self.skip(delivery.name, "Canvas has them excused: change that there")
        score = getattr(there, "entered_score", getattr(there, "score", None))
        before = "" if score is None else f"{score:g}"
        same, ours = is_score(delivery.mark, score), [m for m in sent if is_score(m, score)]
        if same and delivery.is_in(there):
            self.unchanged += 1
        elif same or over or ours or not before:
            self.changes.append(Change(delivery, there, before, ours))
        else:
            why = f"a person entered {before} in Canvas, and the mark here is {delivery.mark}"
            self.skip(delivery.name, f"{why}: replace it with --over")


def is_score(mark: str, score: float | None) -> bool:
    return score is not None and abs(float(mark) - score) < 1e-6


def upload_class(
    known: ClassFolder, to: str, send: bool, over: bool, others_known: bool, console: Console
) -> bool:
    """Show the marks that Canvas lacks, or send them; return whether a student was skipped.

    Raises Stop if Canvas cannot be reached or stops answering.
    """
    address, plan = to or known.settings.canvas, Plan()
    deliveries = list_deliveries(known, others_known, plan)
    with explain("nothing was sent"):
        assignment = open_assignment(address, known)
        listed = ask(lambda: list(assignment.get_submissions(include=COMMENTS, per_page=100)))
    there = {str(getattr(each, "user_id", "")): each for each in listed}
    if to:
        remember_class(known.folder, {"canvas": to}, other_course=False)
    path = known.locate("canvas.json")
    record = read_record(path, address)
    for delivery in deliveries:
        plan.add(delivery, there.get(delivery.user), record.students.get(delivery.user, []), over)
    if plan.changes:
        console.print(tabulate(plan.changes))
    sent = send_changes(plan, record, path) if send else []
    for note in plan.notes:
        console.print(printable(note), soft_wrap=True)
    done = f"{len(sent)} sent" if send else f"{len(plan.changes)} to send"
    more = "" if send or not plan.changes else ": --send sends them"
    console.print(f"{done}, {plan.unchanged} unchanged, {plan.skipped} skipped{more}")
    return plan.skipped > 0


def tabulate(changes: list[Change]) -> Table:
    titles = ("student", "in Canvas", "mark", "comment")
    table = Table(*(Column(title, overflow="fold") for title in titles))
    for each in changes:
        delivery, words = (
            each.delivery,
            each.delivery.comment + "\nwith their page" * bool(each.delivery.page),
        )
        lines = "\n".join(printable(line) for line in words.splitlines())
        table.add_row(printable(delivery.name), each.before or "none", delivery.mark, lines)
    return table


# ---------------------------------------------------------------- deliveries


def list_deliveries(known: ClassFolder, others_known: bool, plan: Plan) -> list[Delivery]:
    """Write all pages; return each student's delivery; note skipped ones in `plan`."""
    results, course = known.find_results(), known.course
    roster = read_roster(known.find_roster("an upload"))
    if "ID" not in roster.columns:
        raise Stop(
            f"{roster.path} has no column ID, Canvas's number of a student: export the gradebook "
            f"of Canvas, and name it: {name_command('class new', known.folder)} --roster FILE"
        )
    key, entries = roster.choose_key(known.settings.key), read_class(results)
    write_dashboard(results, entries, course)
    parts = make_parts(each.outcome for each in entries)
    scores = Scores(parts, mark_engine(known.marks, course), others_known=others_known)
    made = make_marks(roster, key, scores)
    plan.notes += made.notes
    by_name = {each.outcome.name: each for each in entries}
    ids = Counter(row["ID"].strip() for row in roster.rows)
    deliveries = []
    for each in made.rows:
        row, mark = each.row, each.mark
        user, full = row["ID"].strip(), list_name(row)
        name = f"{full} ({row[key]})" if full else row[key]
        if not mark:  # make_marks notes the reason
            plan.skipped += 1
        elif not user or ids[user] > 1:
            plan.skip(name, f"the class list has ID {user!r} {ids[user]} times")
        else:
            found = next(map(by_name.get, made.owners.find_results(row)), None)
            deliveries.append(make_delivery((name, user, mark), found, each.summary, course))
    return deliveries


def make_delivery(
    who: tuple[str, str, str], entry: Entry | None, summary: str, course: Course
) -> Delivery:
    """Return a mark with its comment, and with the student's page if there is one."""
    if entry is None:
        return Delivery(*who, summary, hash_text(summary), None)
    # Students already have the findings of earlier runs from Canvas.
    outcome = msgspec.structs.replace(entry.outcome, before="", changed=[])
    comment = write_text(outcome, None, course).strip()
    digest = hash_text(write_text(outcome, entry.show_result(course), course))
    return Delivery(*who, comment, digest, entry.page)


def hash_text(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def read_record(path: Path, address: str) -> Record:
    """Read the record of this assignment; return an empty one for any other."""
    try:
        record = msgspec.json.decode(path.read_bytes(), type=Record)
    except FileNotFoundError:
        return Record(address)
    except msgspec.MsgspecError as error:
        raise Stop(f"{path}: {error}: move it away, and replace marks with --over") from error
    return record if record.address == address else Record(address)


# ---------------------------------------------------------------- Canvas


def open_assignment(address: str, known: ClassFolder) -> Any:
    """Return the assignment in Canvas; raises Stop if this class's marks do not fit it."""
    match, token = ADDRESS.fullmatch(address), os.environ.get(TOKEN, "").strip()
    if match is None:
        raise Stop(
            f"{address!r} in {known.folder / FILE} or --to is no assignment in Canvas: copy the "
            "address of its page from a browser: https://…/courses/1/assignments/2"
        )
    if not re.fullmatch(r"[!-~]+", token):
        raise Stop(
            f"the environment variable {TOKEN} holds no token: make one in Canvas under Account, "
            "Settings, New access token"
        )
    requester = Requester(match["base"], token)
    session = requester._session  # without a timeout of its own
    session.request = partial(session.request, timeout=PATIENCE)  # pyright: ignore
    course = CanvasCourse(requester, {"id": int(match["course"])})
    assignment = ask(lambda: course.get_assignment(int(match["assignment"])))
    total, worth = mark_engine(known.marks, known.course).total, assignment.points_possible
    if worth != total or assignment.grading_type in ("pass_fail", "not_graded"):
        raise Stop(
            f"these marks are out of {total:g}, and the assignment in Canvas is out of {worth}, "
            f"graded as {assignment.grading_type}: change it there, or out_of in the course"
        )
    return assignment


def ask(request: Callable[[], Any]) -> Any:
    """Make a request, and repeat it later while Canvas limits requests."""
    for wait in WAITS:
        try:
            return request()
        except refused.CanvasException as error:
            if not is_throttled(error):
                raise
        time.sleep(wait)
    return request()


def is_throttled(error: BaseException) -> bool:
    """Return whether Canvas limits requests, by status 403 or 429."""
    return "rate limit exceeded" in str(error).lower()


def send_changes(plan: Plan, record: Record, path: Path) -> list[str]:
    """Send all changes, and return the names sent; raises Stop if Canvas stops answering."""
    sent: list[str] = []
    for each in plan.changes:
        delivery = each.delivery
        record.students[delivery.user] = [*each.ours, delivery.mark]
        write_whole(msgspec.json.encode(record), path)
        done = f"sent already: {', '.join(sent) or 'none'}; {delivery.name}: may have arrived"
        with explain(f"{done}. The same command goes on from there"):
            why_not = send_change(each)
        if why_not:
            plan.skip(delivery.name, f"Canvas refuses {delivery.mark}: {why_not}")
            continue
        record.students[delivery.user] = [delivery.mark]
        write_whole(msgspec.json.encode(record), path)
        sent.append(delivery.name)
        if taken := getattr(each.there, "points_deducted", None):
            words = f"Canvas's own late policy takes {taken:g} more points from the mark"
            plan.notes.append(f"{delivery.name}: {words}")
    return sent


def send_change(change: Change) -> str:
    """Send a mark, its comment and its page; return Canvas's reason to refuse, or an empty text."""
    delivery, there = change.delivery, change.there
    grade, comment = {"posted_grade": delivery.mark}, {"text_comment": delivery.comment}
    words = {"submission": grade, "comment": comment, "prefer_points_over_scheme": True}
    try:
        files = {"file_ids": [upload_page(delivery, delivery.page, there)]} if delivery.page else {}
        ask(lambda: there.edit(**words | {"comment": comment | files}))
    except OF_ONE_STUDENT as error:
        if is_throttled(error):
            raise
        return find_reason(error)
    return ""


def upload_page(delivery: Delivery, page: Path, there: Any) -> int:
    """Upload a student's page for a comment, and return its id in Canvas."""
    place = (
        f"courses/{there.course_id}/assignments/{there.assignment_id}/submissions/{delivery.user}"
    )
    with TemporaryDirectory() as folder:
        path = Path(folder, f"{delivery.sign}.html")  # Canvas takes its name
        path.write_bytes(page.read_bytes())
        uploader = Uploader(there._requester, f"{place}/comments/files", path)
        return int(ask(uploader.start)[1]["id"])


@contextmanager
def explain(done: str) -> Iterator[None]:
    """Raise Stop if Canvas fails, with the reason and the progress so far."""
    try:
        yield
    except (refused.CanvasException, OSError, ValueError, KeyError, KeyboardInterrupt) as error:
        raise Stop(f"Canvas: {find_reason(error)}; {done}") from error


def find_reason(error: BaseException) -> str:
    """Return why a request failed; the error's text could hold the token."""
    if is_throttled(error):
        return "it accepts no more requests for now (rate limit): wait some minutes"
    known = (words for kind, words in REASONS.items() if isinstance(error, kind))
    return next(known, f"{error!s:.200}")
