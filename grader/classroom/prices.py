"""A class's price list: every submission's engine measured, and shown on the page of the class.

What is measured is kept in `DIR.prices.jsonl`, a line for each submission as soon as it is there: a
run that was stopped goes on, and what has not changed is not measured again.
"""

import hashlib
import platform
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import msgspec
from msgspec import Struct, structs
from rich.console import Console

from grader.classroom.batch import Task, grade_all
from grader.classroom.book import Book
from grader.classroom.dashboard import read_class, write_dashboard
from grader.classroom.executor import Graded, Pool, shared_worker
from grader.classroom.fingerprint import fingerprint
from grader.classroom.grading import people_of
from grader.classroom.intake.found import CannotTake, Found, Intake, Package
from grader.classroom.intake.listing import opened_class
from grader.classroom.intake.packing import pack
from grader.classroom.names import in_short
from grader.classroom.progress import Counter
from grader.judge.children import start_worker
from grader.judge.course import Course
from grader.judge.grade import Options
from grader.judge.workplace import work_folder
from grader.prices.listing import PriceList, price_list, write_list
from grader.prices.measure import Curve, Measured, Prices, measure
from grader.prices.others import lesson_in, others
from grader.prices.page import write_prices
from grader.prices.scenes import Scene, scenes
from grader.report.files import write_whole

PRICES = Path(scenes.__code__.co_filename).parent


@dataclass(frozen=True)
class ClassPrices:
    """How a class is to be measured, as the command line says it."""

    options: Options
    out: Path | None = None  # its results; the class folder's name and `-results` if left out
    jobs: int = 0
    roster: Path | None = None


class Kept(Struct, frozen=True):
    """A line of the book."""

    key: str
    prices: Prices


class PricePool(Pool):
    """Processes of this machine that measure."""

    @staticmethod
    def work(package: Package, options: Options) -> Graded:
        with work_folder() as work:
            found = measure(package.unpack(work), scenes(options.seed), options, shared_worker())
        return msgspec.json.encode(found), 0.0


@dataclass
class Measuring:
    """One class, and what is known of its engines so far."""

    intake: Intake
    scenes: tuple[Scene, ...]
    lesson: Measured | None
    key: str
    book: Path
    engines: dict[str, Kept] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=lambda: {"measured": 0, "kept": 0, "trouble": 0})

    def tasks(self) -> Iterator[Task]:
        """The work that must be measured, each once; all else is noted on the way."""
        known = {each.prices.name: each for each in read_book(self.book)}
        works: dict[tuple[Path, ...], list[Found]] = {}
        for found in self.intake.found:
            works.setdefault(found.sources, []).append(found)
        for members in works.values():
            try:
                package = pack(members[0])
            except CannotTake as error:
                self.trouble([each.name for each in members], str(error))
                continue
            key = hashlib.sha256(f"{self.key} {package.digest}".encode()).hexdigest()
            new = []
            for found in members:
                kept = known.get(found.name)
                if kept is not None and kept.key == key:
                    self.note("kept", kept)
                else:
                    new.append(found)
            if new:
                yield Task(new, structs.replace(package, name=new[0].name), key)

    def measured(self, task: Task, graded: Graded) -> None:
        prices = msgspec.json.decode(graded[0], type=Measured).checked(self.lesson)
        with open(self.book, "ab") as book:
            for found in task.members:
                kept = Kept(task.key, structs.replace(prices, name=found.name))
                book.write(msgspec.json.encode(kept) + b"\n")
                self.note("measured", kept)

    def trouble(self, names: list[str], why: str) -> None:
        """Nothing could be measured: at the edge, too, and asked again next time."""
        curves = [Curve(scene.id, [], " ".join(why.split())) for scene in self.scenes]
        for name in names:
            self.note("trouble", Kept("", Prices(name, curves)))

    def note(self, how: str, kept: Kept) -> None:
        self.engines[kept.prices.name] = kept
        self.counts[how] += 1


def run_prices(path: Path, wanted: ClassPrices, console: Console) -> None:
    """Measure the class at `path`, and put its price list beside its results."""
    path, options = path.resolve(), wanted.options
    people = people_of(path, wanted.roster)
    results = (wanted.out or path.with_name(f"{path.stem}-results")).resolve()
    results.parent.mkdir(parents=True, exist_ok=True)
    book = results.with_name(f"{results.name}.prices.jsonl")
    asked = scenes(options.seed)
    worker = start_worker()
    try:
        beside = others(asked, options, worker)
    finally:
        worker.close()
    with opened_class(path, people) as intake:
        run = Measuring(intake, asked, lesson_in(beside), key_of(options), book)
        with PricePool(options, wanted.jobs) as pool:
            measure_all(run, pool, console)
    write_book(book, [run.engines[name] for name in sorted(run.engines)])
    engines = [each.prices for each in run.engines.values()]
    prices = price_list(asked, [each.prices for each in beside], engines)
    tell(prices, run.counts, console)
    show(prices, results, options.course, console)


def measure_all(run: Measuring, pool: Pool, console: Console) -> None:
    """Whatever nobody has measured yet; what could not be taken in stands at the edge, too."""
    total = len(run.intake.found) + len(run.intake.troubles)
    with Counter("measuring", total, console) as counter:
        for name, why in run.intake.troubles.items():
            run.trouble([name], why)
        for task, graded in grade_all(run.tasks(), pool):
            if isinstance(graded, str):
                run.trouble([each.name for each in task.members], graded)
            else:
                run.measured(task, graded)
            counter.reached(len(run.engines))


def show(prices: PriceList, results: Path, course: Course, console: Console) -> None:
    """Write the list and its page, and the pages of the class and of everybody anew."""
    write_list(prices, results)
    page = results.with_name(f"{results.name}.prices.html")
    write_prices(prices, results.name, page)
    console.print(f"page:    {page}", soft_wrap=True)
    if Book(results).known:
        shown = write_dashboard(results, read_class(results), course)
        console.print(f"class:   {shown}", soft_wrap=True)
    if course.open_task:
        console.print("The points of the open task count once `grade --class` runs again.")


def tell(prices: PriceList, counts: dict[str, int], console: Console) -> None:
    told = ", ".join(f"{count} {how}" for how, count in counts.items())
    console.print(f"{len(prices.engines)} engines: {told}")
    better = [each.name for each in prices.engines if prices.sinks_less(each)]
    if better:
        console.print(f"the tower sinks less for the lesson's opcodes: {in_short(better)}")


def key_of(options: Options) -> str:
    """The hash of all that a price depends on, the submission aside."""
    digest = hashlib.sha256(fingerprint().encode() + platform.python_version().encode())
    for file in sorted(PRICES.rglob("*.py")):
        digest.update(file.read_bytes())
    digest.update(msgspec.json.encode([options.seed, options.isolation]))
    return digest.hexdigest()


def read_book(path: Path) -> Iterator[Kept]:
    """The lines of a book; of one that was cut off, those that are whole."""
    if path.exists():
        for line in path.read_bytes().splitlines():
            with suppress(msgspec.MsgspecError):
                yield msgspec.json.decode(line, type=Kept)


def write_book(path: Path, kept: list[Kept]) -> None:
    """Whole, and without those whose trouble may be over next time."""
    lines = (msgspec.json.encode(each) + b"\n" for each in kept if each.key)
    write_whole(b"".join(lines), path)
