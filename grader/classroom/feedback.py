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
from grader.judge.course import FULL, Course
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


@dataclass(frozen=True)
class GradedClass:
    entries: list[Entry]
    pages: Path  # the folder of all pages
    course: Course = FULL

    def find_page(self, name: str) -> Path | None:
        page = self.pages / f"{name}.html"
        return page if page.is_file() else None


def zip_files(files: dict[str, bytes]) -> bytes:
    """Return a zip, the same for the same files."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in sorted(files.items()):
            put_in(archive, name, content)
    return out.getvalue()


def answer_export(
    lms: Lms, intake: Intake, graded: GradedClass, people: ClassList | None = None
) -> Feedback:
    """Return the pages under the LMS's names of the submissions."""
    made, people = Feedback(), people or ClassList()
    answer_absent(lms, intake, graded, people, made)
    entries = {each.outcome.name: each for each in graded.entries}
    works: dict[tuple[Path, ...], list[Page]] = {}
    for found in sorted(intake.found, key=lambda each: each.handed_in_by != ""):
        entry, path = entries.get(found.name), graded.find_page(found.name)
        if entry is None or path is None:
            made.notes.append(f"{found.name}: skipped, there is no page: grade the class again")
            continue
        text = write_text(entry.outcome, entry.show_result(graded.course), graded.course)
        page = make_page(found, path.read_bytes(), text, people)
        works.setdefault(found.sources, []).append(page)
    for sources, pages in works.items():
        files = dict(lms.name_pages(sources[0], pages))
        if not files:
            who = " and ".join(each.name for each in pages)
            made.notes.append(f"{who}: skipped, {lms.name} does not name files so")
        for name, content in files.items():
            made.files[name] = zip_files(content) if isinstance(content, dict) else content
    return made


def answer_absent(
    lms: Lms, intake: Intake, graded: GradedClass, people: ClassList, made: Feedback
) -> None:
    """Add the pages of students without a file, if the LMS takes such pages."""
    names = {each.outcome.name for each in graded.entries} - {each.name for each in intake.found}
    for name in sorted(names.union(intake.troubles)):
        page = graded.find_page(name)
        participant = people.participants.get(name, "")
        file = lms.name_page(participant, PAGE) if participant else ""
        if file and page:
            made.files[file] = page.read_bytes()
        elif name in intake.troubles or page:
            why = intake.troubles.get(name, "no file of theirs came that a page could answer")
            made.notes.append(f"{name}: skipped, {why}")


def make_page(found: Work, content: bytes, text: str, people: ClassList) -> Page:
    """Return the page for one student; other group members get it beside the first one's."""
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


def address_pages(roster: Roster, key: str, graded: GradedClass) -> Feedback:
    """Return the pages by addresses, for mailing, and a list; each member of a group gets one."""
    column = find_address_column(roster)
    made = Feedback()
    outcomes = [each.outcome for each in graded.entries]
    absent = [each.name for each in outcomes if each.trouble == NOTHING]
    owners = find_owners(roster, key, [each.name for each in outcomes], absent)
    table = [["address", "name", "file"]]
    for row in roster.rows:
        address, names = row[column].strip(), owners.find_results(row)
        if len(names) != 1 or not address:
            why = f"{' and '.join(names)} could be theirs" if names else "no page is theirs"
            made.notes.append(f"{row[key] or address}: skipped, {why}")
        elif page := graded.find_page(names[0]):
            file = f"{make_portable(address)}.html"
            made.files[file] = page.read_bytes()
            table.append([address, names[0], file])
    made.files["addresses.csv"] = format_csv(table).encode("utf-8")
    return made


def place_for_nbgrader(graded: GradedClass) -> Feedback:
    """Return the pages beside nbgrader's own feedback, also of students without a notebook."""
    made = Feedback()
    for name in (each.outcome.name for each in graded.entries):
        if page := graded.find_page(name):
            made.files[f"{name}/{ASSIGNMENT}/engine-{PAGE}"] = page.read_bytes()
    return made
