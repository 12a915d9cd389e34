"""Return pages to a whole class: in each learning system's form, or by mail.

No student gets another's page: those that neither the export nor the class list identifies are
skipped, with a note.
"""

import io
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

from grader.classroom.book import NOTHING, Outcome
from grader.classroom.comments import describe_remark
from grader.classroom.dashboard import Entry, make_standing
from grader.classroom.owners import find_owners
from grader.errors import Stop
from grader.intake.found import Intake, Work
from grader.intake.lms import PAGE, Lms, Page
from grader.intake.names import make_portable
from grader.intake.roster import ClassList, Roster
from grader.judge.course import Course
from grader.judge.result import Result
from grader.judge.wording import format_reasons
from grader.report.files import put_in
from grader.report.html import list_failed_first
from grader.text import clean, format_csv

ASSIGNMENT = "physics-engine"
ADDRESSES = ("Email address", "Email", "SIS Login ID", "Username")


@dataclass
class Feedback:
    """Files to return, by name, and notes on skipped students."""

    files: dict[str, bytes] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def zip_files(files: dict[str, bytes]) -> bytes:
    """Return a zip, the same for the same files."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in sorted(files.items()):
            put_in(archive, name, content)
    return out.getvalue()


def answer_export(
    lms: Lms, intake: Intake, graded: list[Entry], people: ClassList, course: Course
) -> Feedback:
    """Return the pages, named as the LMS needs; all submissions must be graded."""
    made, entries = Feedback(), {each.outcome.name: each for each in graded}
    for name in sorted(entries.keys() - {each.name for each in intake.found}):
        participant = people.participants.get(name, "")
        if file := lms.name_page(participant, PAGE) if participant else "":
            made.files[file] = entries[name].page.read_bytes()
        else:
            why = intake.troubles.get(name, "no file of theirs came that a page could answer")
            made.notes.append(f"{name}: skipped, {why}")
    works: dict[tuple[Path, ...], list[Page]] = {}
    for found in sorted(intake.found, key=lambda each: each.handed_in_by != ""):
        page = make_page(found, entries[found.name], people, course)
        works.setdefault(found.sources, []).append(page)
    for sources, pages in works.items():
        files = dict(lms.name_pages(sources[0], pages))
        if not files:
            who = " and ".join(each.name for each in pages)
            made.notes.append(f"{who}: skipped, {lms.name} does not name files so")
        for name, content in files.items():
            made.files[name] = zip_files(content) if isinstance(content, dict) else content
    return made


def make_page(found: Work, entry: Entry, people: ClassList, course: Course) -> Page:
    """Return a student's page, under their own file name if another member handed in."""
    content = entry.page.read_bytes()
    text = write_text(entry.outcome, entry.show_result(course), course)
    if not found.handed_in_by:
        return Page(found.name, PAGE, content, text)
    file = f"feedback-{make_portable(found.name)}.html"
    participant = people.participants.get(found.name, "")
    return Page(found.name, file, content, text, participant)


def write_text(outcome: Outcome, result: Result | None, course: Course) -> str:
    """Return the page as plain text, for recipients without pages."""
    standing = make_standing(outcome, course)
    mark = "no points yet" if standing.mark is None else f"{standing.mark} / {standing.max_points}"
    mark += f", which is {standing.scaled} in the gradebook" if standing.scaled else ""
    lines = [f"Mark: {mark}", *(f"{name}: {clean(text)}" for name, text in standing.lines)]
    remarks = map(describe_remark, outcome.remarks)
    lines += [f"Comment: {clean(words)}" for words in remarks]
    for todo in list_failed_first(result) if result else []:
        points = f"{todo.points} / {todo.max_points}"
        lines += ["", f"TODO {todo.id} {todo.title}: {todo.state}, {points}"]
        for check in todo.failed:
            why = (f"    {line}" for line in format_reasons(check))
            lines += [f"  {check.title} ({check.points} / {check.max_points})", *why]
    return "\n".join(lines) + "\n"


def find_address_column(roster: Roster) -> str:
    """Return the column of addresses; raises Stop if there is none."""
    columns = [*ADDRESSES, *roster.columns]
    listed = [name for name in columns if name in roster.columns]
    column = next((name for name in listed if any("@" in row[name] for row in roster.rows)), None)
    if column is None:
        raise Stop(f"{roster.path} holds no address in any column: add a column {ADDRESSES[0]!r}")
    return column


def address_pages(roster: Roster, key: str, graded: list[Entry]) -> Feedback:
    """Return pages named by address, and a list of them; each group member gets one."""
    column = find_address_column(roster)
    made, entries = Feedback(), {each.outcome.name: each for each in graded}
    absent = [name for name, each in entries.items() if each.outcome.trouble == NOTHING]
    owners = find_owners(roster, key, entries, absent)
    table = [["address", "name", "file"]]
    for row in roster.rows:
        address, names = row[column].strip(), owners.find_results(row)
        if len(names) != 1 or not address:
            why = f"{' and '.join(names)} could be theirs" if names else "no page is theirs"
            made.notes.append(f"{row[key] or address}: skipped, {why}")
        else:
            file = f"{make_portable(address)}.html"
            made.files[file] = entries[names[0]].page.read_bytes()
            table.append([address, names[0], file])
    made.files["addresses.csv"] = format_csv(table).encode("utf-8")
    return made


def place_for_nbgrader(graded: list[Entry]) -> Feedback:
    """Return all pages, with their paths beside nbgrader's own feedback."""
    place = f"{ASSIGNMENT}/engine-{PAGE}"
    return Feedback({f"{each.outcome.name}/{place}": each.page.read_bytes() for each in graded})
