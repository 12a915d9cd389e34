"""Before anything is graded: what would go wrong with a class list, decisions and submissions.

Everything is read as grading reads it, and nothing is written. What is said is for a person to
mend, in the file or with the students; what grading takes care of by itself is not said.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from grader.classroom.adjustments import Adjustments, load_adjustments
from grader.classroom.marks import Marking, load_marking, total_of
from grader.intake.found import CannotTake, Intake
from grader.intake.listing import opened_class
from grader.intake.names import folded, in_short
from grader.intake.packing import pack
from grader.intake.roster import GROUPS, CannotRead, ClassList, Roster, names_in, read_roster
from grader.judge.course import FULL, Course, WrongCourse, read_course
from grader.judge.submission import CannotGrade

TITLED = {"canvas": "(", "blackboard": "["}  # what follows an assignment's title in a column


@dataclass(frozen=True)
class Files:
    """What there is to check; None where there is none yet."""

    roster: Path | None = None
    key: str = ""
    adjust: Path | None = None
    marking: Path | None = None
    submissions: Path | None = None


def faults_of_course(files: Files, path: Path | None = None) -> Iterator[str]:
    """All that would go wrong, a sentence each; `path` is the course, or else it is the kit's."""
    course, roster, people, adjustments = FULL, None, ClassList(), Adjustments()
    try:
        course = read_course(path)
    except WrongCourse as error:
        yield str(error)
    if files.roster is not None:
        try:
            roster = read_roster(files.roster)
            people = ClassList(roster, files.key)
            yield from faults_of_roster(roster, roster.key(files.key))
        except CannotRead as error:
            yield str(error)
    if files.marking is not None:
        try:
            marking = load_marking(files.marking, course)
            if roster is not None:
                yield from faults_of_title(roster, marking.title, files.marking)
                yield from faults_of_total(roster, marking)
        except CannotRead as error:
            yield str(error)
    try:
        adjustments = load_adjustments(files.adjust, course)
    except CannotGrade as error:
        yield str(error)
    if files.submissions is None:
        yield from faults_of_names(adjustments, people.names, people, files.adjust)
        return
    try:
        with opened_class(files.submissions, people) as intake:
            names = [*(each.name for each in intake.found), *intake.troubles]
            yield from faults_of_submissions(intake, people, adjustments, course)
    except CannotGrade as error:
        yield str(error)
        return
    everybody = [*names, *people.absent(names)]
    yield from faults_of_names(adjustments, everybody, people, files.adjust)


def faults_of_roster(roster: Roster, key: str) -> Iterator[str]:
    """Whom a class list does not tell from others, or at all."""
    if roster.doubt:
        yield roster.doubt
    nameless = sum(not row[key].strip() for row in roster.rows)
    if nameless:
        yield f"{roster.path}: {nameless} rows have no {key!r}: nobody's work will be theirs"
    for value, count in Counter(folded(row[key]) for row in roster.rows).items():
        if value and count > 1:
            yield f"{roster.path}: {value!r} stands {count} times under {key!r}"
    full: dict[str, set[str]] = {}
    for row in roster.rows:
        for name in names_in(row):
            full.setdefault(folded(name), set()).add(row[key])
    twins = {frozenset(keys) for keys in full.values() if len(keys) > 1}
    if roster.kind in ("plain", "brightspace"):
        for each in sorted(map(sorted, twins)):
            yield (
                f"{roster.path}: {' and '.join(each)} have one name: where an export gives names "
                "alone, say who is who in a column Called"
            )
    column = next((name for name in GROUPS if name in roster.columns), None)
    if column and not any(row[column].strip() for row in roster.rows):
        yield f"{roster.path}: the column {column!r} is empty: no group shares a mark"


def faults_of_title(roster: Roster, title: str, path: Path) -> Iterator[str]:
    """A gradebook that has no column of the assignment's title would get a new one."""
    sign = TITLED.get(roster.kind)
    if sign and not any(name.startswith(f"{title} {sign}") for name in roster.columns):
        yield (
            f"{roster.path} has no column {title!r}, as {path} or the course calls it: make the "
            "assignment and export again, or change the title"
        )


def faults_of_total(roster: Roster, marking: Marking) -> Iterator[str]:
    """Marks out of one number, in a gradebook that counts to another."""
    worth = total_of(roster, marking.title)
    if worth is not None and worth != marking.total:
        yield f"{roster.path} counts to {worth:g}, and the marks' total is {marking.total:g}"


def faults_of_submissions(
    intake: Intake, people: ClassList, adjustments: Adjustments, course: Course = FULL
) -> Iterator[str]:
    yield from (f"{name}: {words}" for name, words in sorted(intake.troubles.items()))
    for found in intake.found:
        try:
            pack(found, course.modules)
        except CannotTake as error:
            yield f"{found.name}: {error}"
    names = [*(each.name for each in intake.found), *intake.troubles]
    if unlisted := people.unlisted(names):
        yield f"not in the class list: {in_short(unlisted)}: no mark will be theirs"
    late = adjustments.late
    timeless = [each.name for each in intake.found if each.handed_in is None]
    if late is not None and late.due is not None and timeless:
        yield (
            f"no time is known of {in_short(timeless)}: late is only whom the export marks so, "
            "and by one day"
        )


def faults_of_names(
    adjustments: Adjustments, names: list[str], people: ClassList, path: Path | None
) -> Iterator[str]:
    """Decisions about nobody, or about two."""
    try:
        adjustments.refuse_doubts(names)
    except CannotGrade as error:
        yield str(error)
    if names:
        for name in adjustments.unused(names):
            yield f"{path}: {name!r} is nobody of this class"
