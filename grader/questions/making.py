"""Make sheets and keys as files, of a submission or a class."""

import secrets
from contextlib import closing
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path

import msgspec
from rich.console import Console

from grader.errors import Stop
from grader.intake.found import Package, Work
from grader.intake.listing import open_class
from grader.intake.names import make_portable
from grader.intake.packing import open_submission, pack
from grader.intake.roster import ClassList
from grader.judge.result import Result
from grader.judge.submission import CannotGrade
from grader.judge.task import Options
from grader.judge.wall.children import Worker, start_worker
from grader.judge.wall.outer import GRADING, Exceeded, Failed, Lost, WatchedProcess
from grader.judge.wall.workplace import work_folder
from grader.questions.cases import MAKERS
from grader.questions.marking import read_keys
from grader.questions.moodle import write_moodle
from grader.questions.page import make_page
from grader.questions.program import open_program
from grader.questions.question import Sheet
from grader.questions.sheet import make_sheet
from grader.report.files import read_result, write_whole
from grader.report.progress import Counter
from grader.text import plural, printable

SEED_BITS = 128  # too many to try
SHEET = replace(GRADING, what="making its sheet")
ENDED = "it ended the process that makes sheets"


@dataclass(frozen=True)
class SheetResult:
    """The sheet of one student, or why there is none."""

    student: str
    sheet: Sheet | None
    words: str


@dataclass(frozen=True)
class Making:
    """Options for making sheets, and their folder."""

    out: Path
    options: Options
    secret: int | None = None
    practice: bool = False
    results: Path | None = None

    @cached_property
    def seed(self) -> str:
        """Return the seed of all numbers, besides the student's name; the same in a second run.

        Without a secret, draw one: otherwise anyone with the kit could make any sheet.
        """
        file = self.out / "seed.txt"
        if self.secret is not None:
            seed = str(self.secret)
        elif file.is_file():
            seed = file.read_text(encoding="utf-8").strip().removeprefix("practice ")
        else:
            seed = str(secrets.randbits(SEED_BITS))
        write_whole(f"{seed}\n".encode(), file)
        return f"practice {seed}" if self.practice else seed

    def result_of(self, student: str) -> Result | None:
        """Return an earlier result of grading, if there is one."""
        if self.results is None:
            return None
        try:
            return read_result(self.results / f"{make_portable(student)}.json")
        except Stop as error:
            raise CannotGrade(f"{error}: grade the class again") from error

    def make(self, student: str, path: Path, worker: Worker, full_name: str = "") -> SheetResult:
        """Write the sheet of the submission at `path`."""
        result = self.result_of(student)
        with open_program(path, self.options, worker, result) as program:
            asked = self.options.course.questions
            sheet = make_sheet(program, student, self.seed, asked, MAKERS)
        sheet = msgspec.structs.replace(sheet, full_name=full_name)
        self.write(sheet)
        left_out = f", {len(sheet.dropped)} not asked" if sheet.dropped else ""
        count = f"{plural(len(sheet.questions), 'question')}, {plural(sheet.points, 'point')}"
        return SheetResult(student, sheet, f"{student}: {count}{left_out}")

    def write(self, sheet: Sheet) -> None:
        title, name = self.options.course.title, make_portable(sheet.student)
        if self.practice:
            text = make_page(sheet, title, "practice")
            write_whole(text.encode(), self.out / "practice" / f"{name}.html")
            return
        write_whole(make_page(sheet, title, "sheet").encode(), self.out / "sheets" / f"{name}.html")
        write_whole(make_page(sheet, title, "key").encode(), self.out / "keys" / f"{name}.html")
        key = msgspec.json.format(msgspec.json.encode(sheet))
        write_whole(key + b"\n", self.out / "keys" / f"{name}.json")

    def finish(self) -> None:
        """Write all sheets into one file for Moodle."""
        if not self.practice:
            sheets = read_keys(self.out / "keys")
            write_whole(write_moodle(sheets, self.options.course.title), self.out / "moodle.xml")


def make_one(making: Making, path: Path, student: str) -> SheetResult:
    """Make the sheet of one submission; `student` is its author, if not its name."""
    notes: list[str] = []
    opened = open_submission(path, notes.append, making.options.course.modules)
    with opened as folder, closing(start_worker()) as worker:
        made = making.make(printable(student or folder.resolve().name), folder, worker)
    making.finish()
    return replace(made, words="\n".join([*notes, made.words]))


def make_class(
    making: Making, path: Path, people: ClassList, console: Console
) -> list[SheetResult]:
    """Make a sheet for each submission of a class, and for each member of a group."""
    with open_class(path, people) as intake, closing(WatchedProcess()) as process:
        made = [SheetResult(name, None, f"{name}: {why}") for name, why in intake.troubles.items()]
        with Counter("making sheets", len(intake.found), console) as counter:
            for number, each in enumerate(intake.found, 1):
                full_name = people.full_names.get(each.name, "")
                made.append(make_for(making, each, process, full_name))
                counter.reached(number)
    making.finish()
    return made


def make_for(making: Making, found: Work, process: WatchedProcess, full_name: str) -> SheetResult:
    """Make the sheet of one student of a class; a failure does not stop the others."""
    try:
        package = pack(found, making.options.course.modules)
        return process.call(SHEET, SheetResult, make_of_package, making, package, full_name)
    except (CannotGrade, Exceeded, Failed) as error:
        return SheetResult(found.name, None, f"{found.name}: {error}")
    except Lost:
        return SheetResult(found.name, None, f"{found.name}: needs manual review: {ENDED}")


def make_of_package(making: Making, package: Package, full_name: str) -> SheetResult:
    """Make one student's sheet in this process, whose worker is reused."""
    try:
        with work_folder() as work:
            return making.make(package.name, package.unpack(work), keep_worker(), full_name)
    except CannotGrade as error:
        return SheetResult(package.name, None, f"{package.name}: {error}")


@cache
def keep_worker() -> Worker:
    """Start the worker for all sheets that this process makes; it ends with the process."""
    return start_worker()
