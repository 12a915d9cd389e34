"""Write the page of a class, which needs no other file, and the students' reports beside it.

All of it comes from the results and the class book. Names and words of students are text in it.
"""

import statistics
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from urllib.parse import quote

from markupsafe import Markup
from msgspec import structs

from grader.classroom.adjustments import write_time
from grader.classroom.book import Book, Outcome
from grader.classroom.marks import USUAL_TOTAL, compute_mark, load_marking, make_parts
from grader.classroom.similarity import read_pairs
from grader.errors import Stop
from grader.judge.course import FULL, Course
from grader.judge.result import Result, State, TodoResult
from grader.judge.wall.outer import Allowance, call_each_within, call_within
from grader.judge.wording import withhold_reasons
from grader.player.page import clean_line, fill_template, load_templates
from grader.report.files import read_result, write_whole
from grader.report.html import TEMPLATES as REPORTS
from grader.report.html import Standing, write_report

TEMPLATES = Path(__file__).with_name("templates")
BINS = 10  # of the distribution
SLOWEST = 10
WRITING = Allowance("writing its page", cpu=30)
WRITING_CLASS = Allowance("writing the page of the class", cpu=120)
MARKS: dict[State, str] = {  # the class of a cell: passed, wrong, untouched
    "passed": "p",
    "not yet": "w",
    "error": "w",
    "waiting": "w",
    "not started": "u",
}


@dataclass(frozen=True)
class Entry:
    """A submission: its line in the class book, and a brief result if it was graded.

    A full result takes 50 kB, so it is read only when needed.
    """

    outcome: Outcome
    brief: Result | None = None  # shown on the page of the class
    folder: Path = Path()  # of the results

    @property
    def page(self) -> Path:
        """Return the student's report, which `write_dashboard` writes for everybody."""
        return self.folder / f"{self.outcome.name}.html"

    def read_result(self) -> Result:
        """Read the full result."""
        return read_result(self.folder / f"{self.outcome.name}.json")

    def show_result(self, course: Course) -> Result | None:
        """Read the result as students may see it; None if there is none."""
        return withhold_reasons(self.read_result(), course) if self.brief else None

    @property
    def share(self) -> float:
        """Return the share of full marks; more than 1 if points were added by hand."""
        return self.outcome.final / self.outcome.max_points if self.outcome.max_points else 0.0

    @property
    def bin(self) -> int:
        return max(0, min(int(self.share * BINS), BINS - 1))

    @cached_property
    def todos(self) -> dict[str, TodoResult]:
        return {todo.id: todo for todo in self.brief.todos} if self.brief else {}

    @property
    def mistakes(self) -> list[str]:
        """Return its known mistakes, by their names on the page."""
        return [f"{id}:{t.misconception}" for id, t in self.todos.items() if t.misconception]


@dataclass(frozen=True)
class Rate:
    """The numbers of students who passed a TODO, tried it, and did not start it."""

    id: str
    title: str
    passed: int
    wrong: int
    untouched: int

    @property
    def share(self) -> float:
        return self.passed / (self.passed + self.wrong + self.untouched)


@dataclass(frozen=True)
class Mistake:
    """A known mistake, and the students who make it."""

    todo: str
    name: str
    entries: list[Entry]

    @property
    def meaning(self) -> str:
        checks = (check for entry in self.entries for check in entry.todos[self.todo].checks)
        return next((check.meaning for check in checks if check.meaning), "")

    @property
    def key(self) -> str:
        return f"{self.todo}:{self.name}"


def read_class(results: Path) -> list[Entry]:
    """Return the class with its results."""
    return [read_entry(results.resolve(), outcome) for outcome in read_outcomes(results)]


def read_outcomes(results: Path) -> list[Outcome]:
    """Return the lines of the class book; raise Stop if there are none."""
    outcomes = Book(results).outcomes.values()
    if not outcomes:
        raise Stop(f"there are no results in {results}: grade a class first, with --class")
    return sorted(outcomes, key=lambda each: each.order)


def read_entry(folder: Path, outcome: Outcome) -> Entry:
    """Return an outcome with its result; if that is unreadable, set its trouble."""
    entry = Entry(outcome, folder=folder)
    if outcome.trouble:
        return entry
    try:
        return replace(entry, brief=shorten_result(entry.read_result()))
    except Stop as error:
        words = f"its result cannot be read: {error}"
        return replace(entry, outcome=structs.replace(outcome, trouble=words))


def shorten_result(result: Result) -> Result:
    """Return a result with only the checks that describe a known mistake."""
    todos = []
    for todo in result.todos:
        checks = [each for each in todo.checks if todo.misconception and each.meaning]
        todos.append(structs.replace(todo, checks=checks))
    return structs.replace(result, todos=todos)


def count_rates(entries: list[Entry]) -> list[Rate]:
    """Return a rate for each TODO that any result shows, in the order of the results."""
    shown = {todo.id for each in entries if each.brief for todo in each.brief.todos_to_show}
    ids = [id for id in dict.fromkeys(id for each in entries for id in each.todos) if id in shown]
    rates = []
    for id in ids:
        todos = [each.todos[id] for each in entries if id in each.todos]
        passed = sum(todo.state == "passed" for todo in todos)
        untouched = sum(todo.state == "not started" for todo in todos)
        wrong = len(todos) - passed - untouched
        rates.append(Rate(id, todos[0].title, passed, wrong, untouched))
    return rates


def find_mistakes(entries: list[Entry]) -> list[Mistake]:
    """Return the known mistakes, the most common first."""
    makers: dict[tuple[str, str], list[Entry]] = {}
    for entry in entries:
        for todo in entry.todos.values():
            if todo.misconception:
                makers.setdefault((todo.id, todo.misconception), []).append(entry)
    found = [Mistake(*mistake, each) for mistake, each in makers.items()]
    return sorted(found, key=lambda each: (-len(each.entries), each.key))


def write_dashboard(results: Path, entries: list[Entry], course: Course = FULL) -> Path:
    """Write the page beside the folder of results, and a report per student into it."""
    folder = Book(results).folder
    load_templates(REPORTS)
    works = [partial(write_entry, entry, course) for entry in entries]
    for entry, answer in zip(entries, call_each_within(WRITING, None, works), strict=True):
        if isinstance(answer, Exception):
            standing = make_standing(entry.outcome, course)
            standing.lines.append(("Page", str(answer)))
            write_report(None, entry.page, standing)
    path = folder.with_name(f"{folder.name}.class.html")
    rendering = partial(render_class, folder, entries, course.title)
    write_whole(call_within(WRITING_CLASS, str, rendering).encode("utf-8"), path)
    return path


def write_entry(entry: Entry, course: Course) -> None:
    """Write the report of one student."""
    write_report(entry.show_result(course), entry.page, make_standing(entry.outcome, course))


def make_standing(outcome: Outcome, course: Course) -> Standing:
    """Return the mark, the dates and all decisions, for the head of a page."""
    lines = [
        ("Group", outcome.group_in_words.removeprefix("group ")),
        ("Handed in", write_time(outcome.handed_in)),
        ("Due", write_time(outcome.due)),
        ("Not graded", outcome.trouble),
        ("Before", outcome.before),
        *(("Changed", words) for words in outcome.changed if outcome.before),
        *(("Decided", words) for words in outcome.reasons),
        *(("Note", words) for words in outcome.notes),
    ]
    return Standing(
        outcome.label,
        outcome.mark,
        outcome.max_points,
        outcome.bonus if course.bonus == "apart" else 0,
        scale_mark(outcome, course),
        [(name, words) for name, words in lines if words],
        outcome.remarks,
    )


def scale_mark(outcome: Outcome, course: Course) -> str:
    """Return a mark on the gradebook's scale; empty if the scale is the same."""
    total = course.out_of or USUAL_TOTAL
    if outcome.mark is None or not outcome.max_points or total == outcome.max_points:
        return ""
    parts = make_parts([outcome])[outcome.name]
    return f"{compute_mark(parts, load_marking(None, course))} of {total:g}"


def render_class(folder: Path, entries: list[Entry], title: str = FULL.title) -> str:
    """Return the page; its links to reports and replays lead into `folder` beside it."""
    graded = [each for each in entries if each.brief]
    marked = [each for each in entries if each.outcome.mark is not None]
    points = [each.outcome.final for each in marked]
    timed = [each for each in graded if each.outcome.seconds]
    script = (TEMPLATES / "dashboard.js").read_text(encoding="utf-8")
    return fill_template(
        TEMPLATES / "dashboard.html",
        "dashboard.css",
        script,
        title=title,
        pages=folder.name,
        folder=f"./{quote(folder.name)}/",
        entries=entries,
        graded=graded,
        troubled=[each for each in entries if each.outcome.mark is None],
        mean=f"{statistics.fmean(points):.1f}" if points else "none",
        median=f"{statistics.median(points):g}" if points else "none",
        full=sum(each.outcome.final >= each.outcome.max_points for each in marked),
        bins=[sum(each.bin == number for each in marked) for number in range(BINS)],
        rates=count_rates(graded),
        mistakes=find_mistakes(graded),
        alike=read_pairs(folder),
        slowest=sorted(timed, key=lambda each: -each.outcome.seconds)[:SLOWEST],
        bonus=any(each.outcome.bonus for each in marked),
        marks=MARKS,
        notes=list_notes,
        clean=clean_line,
        quote=quote,
        script=Markup(script),
    )


def list_notes(outcome: Outcome) -> list[str]:
    """Return the notes on a submission in a table."""
    decided = [] if outcome.trouble or not outcome.reasons else [f"found {outcome.points}"]
    decided = ["; ".join([*decided, *outcome.reasons])]
    late = ["late"] if outcome.late and not outcome.reasons else []
    notes = [outcome.trouble, outcome.group_in_words, *late, *decided, *outcome.notes]
    return [words for words in [*notes, *outcome.changes] if words]
