"""Grade a class from start to end: read it, grade it, write its pages and show it."""

from collections.abc import Sequence
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Column, Table

from grader.classroom.adjustments import load_adjustments
from grader.classroom.batch import Run, grade_class
from grader.classroom.book import Book, Outcome
from grader.classroom.cluster import connect
from grader.classroom.dashboard import list_notes, read_class, write_dashboard
from grader.classroom.executor import Executor, Pool
from grader.classroom.fingerprint import make_key
from grader.classroom.similarity import find_pairs, read_prints, write_pairs
from grader.intake.listing import open_class
from grader.intake.roster import ClassList
from grader.intake.systems import find_file, read_class_list
from grader.judge.course import Course
from grader.judge.result import is_bonus
from grader.judge.task import Options
from grader.judge.wall.outer import Exceeded, Failed, Lost
from grader.text import plural, printable

LONGEST = 300  # rows in a terminal; the table's file has all
LONGEST_PAGE = 2000  # students on the page, which reads every result again


@dataclass(frozen=True)
class ClassOptions:
    options: Options
    out: Path | None = None  # by default beside the class folder, with its name and `-results`
    jobs: int = 0
    adjust: Path | None = None  # by default adjustments.toml among the submissions
    cluster: str = ""  # the address of a Dask scheduler
    people: ClassList | None = None  # by default those of roster.csv among the submissions
    earlier: Sequence[Path] = ()  # classes of earlier years, to compare with


def run_class(path: Path, wanted: ClassOptions, console: Console) -> Run:
    """Grade the class at `path`, show it, and print the folder of results."""
    path = path.resolve()
    people = wanted.people or read_class_list(path)
    course = wanted.options.course
    adjustments = load_adjustments(wanted.adjust or find_file(path, "adjustments.toml"), course)
    book = Book(wanted.out or path.with_name(f"{path.stem}-results"))
    people.chosen = adjustments.choices
    with open_class(path, people) as intake, open_executor(wanted) as executor:
        names = intake.names
        absent = people.list_absent(names)
        adjustments = adjustments.resolve([*names, *absent], people)
        run = Run(intake, book, make_key(wanted.options), adjustments, course, people)
        others = absent if people.names else adjustments.find_unused(names)
        grade_class(run, executor, console, others)
        if len(run.outcomes) <= LONGEST_PAGE:
            write_similar(run, wanted.earlier)
        if absent:
            run.notes.append(f"nothing was handed in by {', '.join(absent)}")
        if unlisted := people.list_unlisted(names):
            run.notes.append(f"not in the class list: {', '.join(unlisted)}")
    show_class(run, console)
    console.print(write_page(run), soft_wrap=True)
    return run


def write_similar(run: Run, earlier: Sequence[Path]) -> None:
    """Write the page of similar pairs, within the class and with classes of earlier years."""
    with ExitStack() as stack:
        found, prints = {each.name: each for each in run.intake.found}, list(run.prints)
        here = {each.name for each in prints}
        for folder in earlier:
            others, more = read_prints(stack, folder, read_class_list(folder))
            found |= others
            prints += more
        try:
            pairs = find_pairs(prints, of=here)
        except (Exceeded, Failed, Lost) as error:
            run.notes.append(f"similar pairs: {error}")
            pairs = []
        write_pairs(run.book.folder, pairs, found)


def write_page(run: Run) -> str:
    """Write the page of the class unless it is too large, and return its path."""
    folder = run.book.folder
    if len(run.outcomes) > LONGEST_PAGE:
        return f"page:    for more than {LONGEST_PAGE}, by `grader dashboard {folder}`"
    return f"page:    {write_dashboard(folder, read_class(folder), run.course)}"


def open_executor(wanted: ClassOptions) -> AbstractContextManager[Executor]:
    if wanted.cluster:
        return connect(wanted.cluster, wanted.options)
    return Pool(wanted.options, wanted.jobs)


def show_class(run: Run, console: Console) -> None:
    """Print the table, the share that passed each TODO, and all notes."""
    if len(run.outcomes) <= LONGEST:
        console.print(tabulate_class(run.outcomes))
    results = [each for each in run.outcomes if not each.trouble]
    if len(results) > 1:
        console.print(tabulate_rates(results, run.course))
    for note in run.notes:
        console.print(printable(note), soft_wrap=True)
    counts = ", ".join(f"{count} {how}" for how, count in run.counts.items())
    console.print(f"{plural(len(run.outcomes), 'submission')}: {counts}")
    console.print(f"results: {run.book.folder}", soft_wrap=True)
    console.print(f"table:   {run.book.table}", soft_wrap=True)


def tabulate_class(outcomes: list[Outcome]) -> Table:
    titles = ("submission", "points", "not passed")
    table = Table(*(Column(title, overflow="fold") for title in titles))
    for each in outcomes:
        points = "none" if each.mark is None else f"{each.mark} / {each.max_points}"
        nothing = set(each.left) == {todo for todo in each.todos if not is_bonus(todo)}
        left = "all" if nothing and not each.trouble else ", ".join(each.left)
        words = [printable(line) for line in (left, *list_notes(each)) if line]
        table.add_row(printable(each.label), points, "\n".join(words))
    return table


def tabulate_rates(results: list[Outcome], course: Course) -> Table:
    table = Table("TODO", "passed by", box=None)
    for todo in course.rubric.main_todos:
        graded = [each for each in results if todo.id in each.todos]
        if graded:
            passed = sum(todo.id not in each.left for each in graded)
            table.add_row(f"{todo.id} {todo.title}", f"{passed / len(graded):4.0%}")
    return table
