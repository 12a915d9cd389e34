"""Find problems before grading: of a class list, decisions and submissions.

It reads all files as grading does, and writes none. A person must solve each problem, in a file or
with the students. Problems that grading handles are not mentioned.
"""

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from grader.classroom.adjustments import Adjustments, load_adjustments
from grader.classroom.folder import ClassFolder
from grader.classroom.marks import Marking, load_marking, read_total
from grader.errors import Stop
from grader.intake.found import CannotTake, Intake
from grader.intake.listing import open_class
from grader.intake.names import fold
from grader.intake.packing import pack
from grader.intake.roster import ClassList, Roster, list_full_names
from grader.intake.systems import find_system, read_roster
from grader.judge.course import FULL, Course
from grader.text import plural


def find_problems(known: ClassFolder) -> list[str]:
    """Return all problems of a class, a sentence each."""
    course, roster, people, adjustments = FULL, None, ClassList(), Adjustments()
    found: list[str] = []
    with collect_stop(found):
        course = known.course
    with collect_stop(found):
        if known.roster is not None:
            roster = read_roster(known.roster)
            people = ClassList(roster, known.settings.key)
            found += check_roster(roster, roster.choose_key(known.settings.key))
    with collect_stop(found):
        marking = load_marking(known.marks, course)
        found += check_gradebook(roster, marking) if roster else ()
    with collect_stop(found):
        adjustments = load_adjustments(known.decisions, course)
        people.chosen = adjustments.choices
    names = people.names
    with collect_stop(found):
        if known.submissions.exists():
            with open_class(known.submissions, people) as intake:
                names = [*intake.names, *people.list_absent(intake.names)]
                found += check_submissions(intake, people, adjustments, course)
    return [*found, *check_names(adjustments, names, people, known.decisions)]


@contextmanager
def collect_stop(found: list[str]) -> Iterator[None]:
    """Catch Stop, and add its message to `found`."""
    try:
        yield
    except Stop as error:
        found.append(str(error))


def check_roster(roster: Roster, key: str) -> Iterator[str]:
    """Yield students whom a class list does not identify."""
    if roster.doubt:
        yield roster.doubt
    nameless = sum(not row[key].strip() for row in roster.rows)
    if nameless:
        have = f"{plural(nameless, 'row')} {'has' if nameless == 1 else 'have'}"
        yield f"{roster.path}: {have} no {key!r}: no work will match them"
    for value, count in Counter(fold(row[key]) for row in roster.rows).items():
        if value and count > 1:
            yield f"{roster.path}: {value!r} is listed {count} times under {key!r}"
    full: dict[str, set[str]] = {}
    for row in roster.rows:
        for name in list_full_names(row):
            full.setdefault(fold(name), set()).add(row[key])
    twins = {frozenset(keys) for keys in full.values() if len(keys) > 1}
    if find_system(roster).names_alone:
        for each in sorted(map(sorted, twins)):
            yield (
                f"{roster.path}: {' and '.join(each)} have one name: where an export gives names "
                "alone, say who is who in a column Called"
            )
    if roster.group_column and not roster.list_groups():
        column = roster.group_column
        yield f"{roster.path}: the column {column!r} is empty: no group shares a mark"


def check_gradebook(roster: Roster, marking: Marking) -> Iterator[str]:
    """Yield differences between a gradebook and the settings of marks."""
    sign, title = find_system(roster).title_sign, marking.title
    if sign and not any(name.startswith(f"{title} {sign}") for name in roster.columns):
        yield (
            f"{roster.path} has no column {title!r}: make the assignment there and export again, "
            "or change the title in the course or marks.toml"
        )
    worth = read_total(roster, title)
    if worth is not None and worth != marking.total:
        yield f"{roster.path} counts to {worth:g}, and the marks' total is {marking.total:g}"


def check_submissions(
    intake: Intake, people: ClassList, adjustments: Adjustments, course: Course
) -> Iterator[str]:
    """Yield work that cannot be graded, and students whose time or name is unknown."""
    yield from (f"{name}: {words}" for name, words in sorted(intake.troubles.items()))
    for found in intake.found:
        try:
            pack(found, course.modules)
        except CannotTake as error:
            yield f"{found.name}: {error}"
    if unlisted := people.list_unlisted(intake.names):
        yield f"not in the class list: {', '.join(unlisted)}: no mark will be theirs"
    late = adjustments.late
    timeless = [each.name for each in intake.found if each.handed_in is None]
    if late is not None and late.due is not None and timeless:
        yield (
            f"no time is known of {', '.join(timeless)}: they are late only if the export marks "
            "them so, and by one day"
        )


def check_names(
    adjustments: Adjustments, names: list[str], people: ClassList, path: Path | None
) -> Iterator[str]:
    """Yield decisions whose student is unknown or ambiguous."""
    try:
        adjustments = adjustments.resolve(names, people)
    except Stop as error:
        yield str(error)
    if names:
        for name in adjustments.find_unused(names):
            yield f"{path}: no student {name!r} in this class"
