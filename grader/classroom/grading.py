"""A class from start to end, as the command line asks for it: taken in, graded and shown."""

from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

from grader.classroom.adjustments import load_adjustments
from grader.classroom.batch import Run, grade_class
from grader.classroom.book import Outcome
from grader.classroom.cluster import connected
from grader.classroom.dashboard import notes_of, read_class, write_dashboard
from grader.classroom.executor import Executor, Pool
from grader.classroom.fingerprint import key_of
from grader.classroom.similarity import alike, write_alike
from grader.intake.listing import opened_class
from grader.intake.names import in_short
from grader.intake.roster import beside, people_of
from grader.judge.course import Course
from grader.judge.grade import Options
from grader.judge.result import is_bonus
from grader.text import clean

LONGEST = 300  # rows that a terminal is given; the table as a file has them all
LONGEST_PAGE = 2000  # rows of the page: its makers hold all results at once, 35 kB each


@dataclass(frozen=True)
class ClassOptions:
    """How a class is to be graded, as the command line says it."""

    options: Options
    out: Path | None = None  # the class folder's name and `-results`, beside it, if left out
    jobs: int = 0
    roster: Path | None = None  # roster.csv of the class folder, if there is one
    adjust: Path | None = None  # adjustments.toml of the class folder, if there is one
    cluster: str = ""  # the address of a Dask scheduler


def run_class(path: Path, wanted: ClassOptions, console: Console) -> Run:
    """Grade the class at `path`, show it, and say where the results are."""
    path = path.resolve()
    people = people_of(path, wanted.roster)
    adjust = wanted.adjust or beside(path, "adjustments.toml")
    course = wanted.options.course
    adjustments = load_adjustments(adjust, course)
    out = wanted.out or path.with_name(f"{path.stem}-results")
    with opened_class(path, people) as intake, opened_executor(wanted) as executor:
        names = [*(each.name for each in intake.found), *intake.troubles]
        absent = people.absent(names)
        adjustments.refuse_doubts([*names, *absent])
        mine = absent if people.names else adjustments.unused(names)
        key = key_of(wanted.options)
        run = grade_class(intake, out, key, executor, console, adjustments, course, mine)
        if len(run.outcomes) <= LONGEST_PAGE:
            by_name = {each.name: each for each in intake.found}
            write_alike(run.book.folder, alike(run.prints), by_name)
        if absent:
            run.notes.append(f"nothing was handed in by {in_short(absent)}")
        if unlisted := people.unlisted(names):
            run.notes.append(f"not in the class list: {in_short(unlisted)}")
    show_class(run, console)
    console.print(page_of(run), soft_wrap=True)
    return run


def page_of(run: Run) -> str:
    """Make the page of the class, and say where it is; of too many there is none by itself."""
    if len(run.outcomes) > LONGEST_PAGE:
        return f"page:    for more than {LONGEST_PAGE}, by `grader dashboard {run.book.folder}`"
    return f"page:    {write_dashboard(run.book.folder, read_class(run.book.folder), run.course)}"


def opened_executor(wanted: ClassOptions) -> AbstractContextManager[Executor]:
    if wanted.cluster:
        return connected(wanted.cluster, wanted.options)
    return Pool(wanted.options, wanted.jobs)


# ---------------------------------------------------------------- for people


def show_class(run: Run, console: Console) -> None:
    """The table, how many passed each TODO, and all that a person should know."""
    if len(run.outcomes) <= LONGEST:
        console.print(table_of(run.outcomes))
    results = [each for each in run.outcomes if not each.trouble]
    if len(results) > 1:
        console.print(rates(results, run.course))
    for note in run.notes[:LONGEST]:
        console.print(clean(note), soft_wrap=True)
    counts = ", ".join(f"{count} {how}" for how, count in run.counts.items())
    console.print(f"{len(run.outcomes)} submissions: {counts}")
    console.print(f"results: {run.book.folder}", soft_wrap=True)
    console.print(f"table:   {run.book.table}", soft_wrap=True)


def table_of(outcomes: list[Outcome]) -> Table:
    table = Table("submission", "points", "not passed")
    for each in outcomes:
        points = "none" if each.mark is None else f"{each.mark} / {each.max_points}"
        nothing = set(each.left) == {todo for todo in each.todos if not is_bonus(todo)}
        left = "all" if nothing and not each.trouble else ", ".join(each.left)
        words = [clean(line) for line in (left, *notes_of(each)) if line]
        table.add_row(clean(each.name), points, "\n".join(words))
    return table


def rates(results: list[Outcome], course: Course) -> Table:
    """The share of submissions that pass each TODO of the assignment."""
    table = Table("TODO", "passed by", box=None)
    for todo in course.rubric.counted:
        asked = [each for each in results if todo.id in each.todos]
        if asked:
            passed = sum(todo.id not in each.left for each in asked)
            table.add_row(f"{todo.id} {todo.title}", f"{passed / len(asked):4.0%}")
    return table
