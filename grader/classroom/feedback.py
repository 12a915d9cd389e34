"""Pages of a whole class on their way back: as each learning system takes them, or by mail.

Nobody gets another's page: a student whom the export or the class list does not name for sure is
left out, and said.
"""

import io
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

from grader.classroom.book import NOTHING
from grader.classroom.dashboard import Entry, standing_of
from grader.classroom.owners import match
from grader.intake import brightspace, canvas, moodle
from grader.intake.found import Found, Intake
from grader.intake.names import portable
from grader.intake.roster import CannotRead, ClassList, Roster
from grader.judge import wording as words
from grader.judge.course import FULL, Course
from grader.judge.wording import told
from grader.report.files import put_in
from grader.report.sinks.tables import as_csv
from grader.text import clean

System = Literal["moodle", "canvas", "brightspace", "email", "nbgrader"]
PAGE = "feedback.html"
ASSIGNMENT = "physics-engine"
ADDRESSES = ("Email address", "Email", "SIS Login ID", "Username")


@dataclass
class Feedback:
    """What to hand back: files by their names, and who is left out."""

    files: dict[str, bytes] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    def zipped(self) -> bytes:
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in sorted(self.files.items()):
                put_in(archive, name, content)
        return out.getvalue()


@dataclass(frozen=True)
class Returned:
    """What goes back to one student: to a group's others beside what its first one gets."""

    found: Found
    entry: Entry
    page: bytes
    participant: str = ""  # what Moodle calls somebody who has no file there

    @property
    def file(self) -> str:
        mate = self.found.handed_in_by
        return f"feedback-{portable(self.found.name)}.html" if mate else PAGE


def by_export(
    system: System,
    intake: Intake,
    entries: list[Entry],
    pages: Path,
    course: Course = FULL,
    people: ClassList | None = None,
) -> Feedback:
    """The pages under the names that the LMS gave to what was handed in."""
    made = Feedback()
    graded = {each.outcome.name: each for each in entries}
    without = set(graded).difference(each.name for each in intake.found)
    for name in sorted(without.union(intake.troubles)):
        page = pages / f"{name}.html"
        participant = people.participant(name) if people and system == "moodle" else ""
        if participant and page.is_file():  # Moodle takes a page also where no file was handed in
            made.files[moodle_name(participant, PAGE)] = page.read_bytes()
        elif name in intake.troubles or page.is_file():
            why = intake.troubles.get(name, "no file of theirs came that a page could answer")
            made.notes.append(f"{name}: left out, {why}")
    works: dict[tuple[Path, ...], list[Returned]] = {}
    for found in sorted(intake.found, key=lambda each: each.handed_in_by != ""):
        entry = graded.get(found.name)
        page = pages / f"{found.name}.html"
        if entry is None or not page.is_file():
            made.notes.append(f"{found.name}: left out, there is no page: grade the class again")
            continue
        if entry.result is not None:
            entry = replace(entry, result=told(entry.result, course))
        participant = people.participant(found.name) if people else ""
        theirs = Returned(found, entry, page.read_bytes(), participant)
        works.setdefault(found.sources, []).append(theirs)
    for sources, members in works.items():
        names = dict(NAMED[system](sources[0], members))
        if not names:
            who = " and ".join(each.found.name for each in members)
            made.notes.append(f"{who}: left out, {system} does not name files so")
        made.files |= names
    return made


def for_moodle(source: Path, members: list[Returned]) -> Iterator[tuple[str, bytes]]:
    """Moodle takes a participant's number and the kind of upload from a file's name."""
    known = moodle.NAME.fullmatch(source.name)
    if known is None:
        return
    first = f"{known['name']}_{known['id']}"
    for each in members:
        own = each.participant if each.found.handed_in_by else ""
        file = PAGE if own else each.file
        yield moodle_name(own or first, file), each.page


def moodle_name(participant: str, file: str) -> str:
    """What Moodle calls somebody's file; it takes what follows the first `_` for the number."""
    name, _, number = participant.rpartition("_")
    return f"{name.replace('_', ' ')}_{number}_assignsubmission_file_{file}"


def for_canvas(source: Path, members: list[Returned]) -> Iterator[tuple[str, bytes]]:
    """Canvas takes the very names that it gave, so a zip stays one and a text a text."""
    if canvas.matched(source) is None:
        return
    if source.suffix.lower() != ".zip":
        first, *mates = members
        texts = [as_text(first.entry)]
        texts += [f"{each.found.name}\n{as_text(each.entry)}" for each in mates]
        yield source.name, "\n".join(texts).encode("utf-8")
        return
    inner = Feedback({each.file: each.page for each in members})
    yield source.name, inner.zipped()


def for_brightspace(source: Path, members: list[Returned]) -> Iterator[tuple[str, bytes]]:
    """Brightspace takes the folders of its download, with other files in them."""
    if known := brightspace.NAME.fullmatch(source.name):
        folder = f"{known['ids']} - {known['name']} - {known['when']}"
        for each in members:
            yield f"{folder}/{each.file}", each.page


NAMED = {"moodle": for_moodle, "canvas": for_canvas, "brightspace": for_brightspace}


def as_text(entry: Entry) -> str:
    """The page in plain words, for where no page can be."""
    standing = standing_of(entry.outcome)
    mark = "no points yet" if standing.mark is None else f"{standing.mark} / {standing.max_points}"
    lines = [f"Mark: {mark}", *(f"{name}: {clean(text)}" for name, text in standing.lines)]
    for todo in entry.result.shown if entry.result else []:
        lines += [
            "",
            f"TODO {todo.id} {todo.title}: {todo.state}, {todo.points} / {todo.max_points}",
        ]
        for check in todo.failed:
            why = (f"    {line}" for line in words.reasons(check))
            lines += [f"  {check.title} ({check.points} / {check.max_points})", *why]
    return "\n".join(lines) + "\n"


# ---------------------------------------------------------------- by the class list


def by_address(roster: Roster, key: str, entries: list[Entry], pages: Path) -> Feedback:
    """The pages by addresses, for mailing, and a list of them; a group's go to all of it."""
    columns = [*ADDRESSES, *roster.columns]
    column = next((name for name in columns if has_addresses(roster, name)), None)
    if column is None:
        raise CannotRead(f"{roster.path} has no column of addresses: {', '.join(ADDRESSES)}")
    made = Feedback()
    absent = [each.outcome.name for each in entries if each.outcome.trouble == NOTHING]
    owners = match(roster, key, [each.outcome.name for each in entries], absent)
    listed = [["address", "name", "file"]]
    for row in roster.rows:
        address, names = row[column].strip(), owners.of(row)
        if len(names) != 1 or not address:
            why = f"{' and '.join(names)} could be theirs" if names else "no page is theirs"
            made.notes.append(f"{row[key] or address}: left out, {why}")
            continue
        page = pages / f"{names[0]}.html"
        if page.is_file():
            file = f"{portable(address)}.html"
            made.files[file] = page.read_bytes()
            listed.append([address, names[0], file])
    made.files["addresses.csv"] = as_csv(listed).encode("utf-8")
    return made


def has_addresses(roster: Roster, column: str) -> bool:
    return column in roster.columns and any("@" in row[column] for row in roster.rows)


def for_nbgrader(entries: list[Entry], pages: Path) -> Feedback:
    """The pages beside nbgrader's own feedback, also of students who handed in no notebook."""
    made = Feedback()
    for entry in entries:
        page = pages / f"{entry.outcome.name}.html"
        if page.is_file():
            made.files[f"{entry.outcome.name}/{ASSIGNMENT}/engine-{PAGE}"] = page.read_bytes()
    return made
