"""Remember the files and settings of a class, in `class.toml` of its folder.

People may edit the file. A command changes only the lines whose values it is given.
"""

import re
import secrets
import tomllib
from dataclasses import dataclass
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.classroom.adjustments import Adjustments, load_adjustments
from grader.errors import Stop
from grader.intake.learning_systems import BY_NAME
from grader.intake.roster import ClassList
from grader.intake.systems import find_system, read_roster
from grader.judge.course import Course, read_course
from grader.report.files import write_whole
from grader.text import name_command

FILE = "class.toml"
SEED_BITS = 128  # too many to try
MARKS = "marks.toml"
HEAD = """\
# What this class is. `grader class` reads it, and you may edit it. Paths count from this folder.
"""
SIGNS = {  # a comment for each line
    "course": "what is asked; the kit's own course.toml if left out",
    "roster": "the class list, as the learning system exports it",
    "key": "its column that identifies students; found if left out",
    "submissions": "the export, a zip or a folder",
    "decisions": "what people decide: extensions, points, comments",
    "marks": "shares of notebooks, decimals, and the mark for absent students",
    "nbgrader": "the course folder of nbgrader, whose gradebook has the notebooks' points",
    "results": "what grading writes",
    "system": "the learning system",
    "canvas": "the assignment in Canvas, by its page's address",
    "seed": "other numbers in every check; keep it secret",
    "earlier": "classes of earlier years, to compare with",
}


class Settings(Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """The lines of class.toml."""

    course: str = ""
    roster: str = ""
    key: str = ""
    submissions: str = "submissions.zip"
    decisions: str = "decisions.toml"
    results: str = "results"
    marks: str = ""
    nbgrader: str = ""
    system: str = ""
    canvas: str = ""
    seed: int | None = None
    earlier: list[str] = []


@dataclass(frozen=True)
class ClassFolder:
    """A class: its folder, and the settings of its class.toml."""

    folder: Path
    settings: Settings

    def locate(self, name: str) -> Path:
        return self.folder / name

    @property
    def submissions(self) -> Path:
        """Return the export, or a folder beside it with the unpacked export."""
        path = self.locate(self.settings.submissions)
        unpacked = path.with_suffix("")
        return unpacked if unpacked.is_dir() and not path.exists() else path

    def find_submissions(self) -> Path:
        """Return the export; raises Stop if it is missing."""
        if not self.submissions.exists():
            raise Stop(
                f"there is nothing at {self.submissions}: put the export of the learning system "
                f"there, or name it: {name_command('class new', self.folder)} --submissions FILE"
            )
        return self.submissions

    @property
    def roster(self) -> Path | None:
        return self.locate(self.settings.roster) if self.settings.roster else None

    def find_roster(self, purpose: str) -> Path:
        """Return the class list; raises Stop if there is none."""
        if self.roster is None:
            raise Stop(
                f"{purpose} needs the class list, and {self.folder / FILE} names none: "
                f"{name_command('class new', self.folder)} --roster FILE"
            )
        return self.roster

    @property
    def decisions(self) -> Path | None:
        """Return the file of decisions; None if it does not exist."""
        path = self.locate(self.settings.decisions)
        return path if path.is_file() else None

    @property
    def nbgrader(self) -> Path | None:
        return self.locate(self.settings.nbgrader) if self.settings.nbgrader else None

    @property
    def marks(self) -> Path | None:
        """Return the settings of marks: the class's own, or its nbgrader course's."""
        own = self.locate(self.settings.marks or MARKS)
        if self.settings.marks or own.is_file():
            return own
        return self.nbgrader / MARKS if self.nbgrader else None

    @property
    def results(self) -> Path:
        return self.locate(self.settings.results)

    @property
    def earlier(self) -> list[Path]:
        return [self.locate(each) for each in self.settings.earlier]

    @property
    def course_path(self) -> Path | None:
        return self.locate(self.settings.course) if self.settings.course else None

    @property
    def course(self) -> Course:
        return read_course(self.course_path)

    def list_people(self) -> ClassList:
        """Return the students of the class list, with the work that a person assigned to them."""
        roster = read_roster(self.roster) if self.roster else None
        people = ClassList(roster, self.settings.key)
        people.chosen = load_adjustments(self.decisions, self.course).choices
        return people

    def resolve_decisions(self, names: list[str]) -> Adjustments:
        """Return the decisions, with students by their names in the class."""
        people = self.list_people()
        return load_adjustments(self.decisions, self.course).resolve(names, people)

    @property
    def course_name(self) -> str:
        return self.settings.course or "the kit's course.toml"

    def find_results(self) -> Path:
        """Return the folder of results; raises Stop if they are of another course."""
        if not self.results.is_dir():
            command = name_command("class grade", self.folder)
            raise Stop(f"there are no results in {self.results}: {command}")
        self.refuse_other_course("grade the class again with --other-course")
        return self.results

    def refuse_other_course(self, remedy: str) -> None:
        """Raise Stop if the results' course has other TODOs or points."""
        if difference := find_difference(self.results, self.course):
            raise Stop(
                f"{self.results} holds results of another course than {self.course_name}: "
                f"{difference}. Name that course in {self.folder / FILE}, or {remedy}"
            )


class AskedTodo(Struct, frozen=True):
    """A TODO of a result, without its points."""

    id: str
    max_points: int


class AskedTodos(Struct, frozen=True):
    """A result without its points and checks."""

    todos: list[AskedTodo]


def find_difference(results: Path, course: Course) -> str:
    """Say how the results and a course differ; empty if they do not."""
    asked = {todo.id: todo.max_points for todo in course.rubric.todos}
    for path in sorted(results.glob("[!.]*.json")):
        try:
            result = msgspec.json.decode(path.read_bytes(), type=AskedTodos)
        except (OSError, msgspec.MsgspecError):
            continue
        graded = {todo.id: todo.max_points for todo in result.todos}
        for id in dict.fromkeys([*graded, *asked]):
            if graded.get(id) != asked.get(id):
                before, now = (each.get(id, "no") for each in (graded, asked))
                return f"TODO {id} has {before} points there, and {now} here"
    return ""


def read_class_folder(folder: Path) -> ClassFolder:
    """Read class.toml; raises Stop if it is missing or invalid."""
    path = folder / FILE
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise Stop(
            f"there is no {path}: name the folder of a class, or make one: "
            f"{name_command('class new', folder)} --roster FILE"
        ) from error
    return ClassFolder(folder, parse_settings(text, path))


def parse_settings(text: str, path: Path) -> Settings:
    try:
        settings = msgspec.convert(tomllib.loads(text), Settings)
    except (ValueError, msgspec.MsgspecError) as error:
        raise Stop(f"{path}: {error}") from error
    if settings.system and settings.system not in BY_NAME:
        known = ", ".join(BY_NAME)
        raise Stop(f"{path}: system = {settings.system!r} is not one of {known}: leave it out")
    return settings


def remember_class(folder: Path, named: dict[str, object], other_course: bool) -> ClassFolder:
    """Write the named values into class.toml, without a change to its other lines.

    Raises Stop, and writes nothing, if results are of another course, unless `other_course`.
    """
    path = folder / FILE
    made = not path.exists()
    text = HEAD if made else path.read_text(encoding="utf-8-sig")
    lines = find_usual_files(folder) | named if made else named
    for name, value in lines.items():
        text = set_line(text, name, value)
    known = ClassFolder(folder, parse_settings(text, path))
    if known.roster is not None and (made or "roster" in named) and "system" not in named:
        system = find_system(read_roster(known.roster)).name
        text = set_line(text, "system", system) if system in BY_NAME else text
        known = ClassFolder(folder, parse_settings(text, path))
    if not other_course:
        known.refuse_other_course("say --other-course")
    write_whole(text.encode("utf-8"), path)
    return known


def find_usual_files(folder: Path) -> dict[str, object]:
    """Return the settings of a new class: existing files with the usual names, and a seed."""
    usual = {"course": "course.toml", "roster": "roster.csv"}
    there: dict[str, object] = {
        name: file for name, file in usual.items() if (folder / file).is_file()
    }
    if (folder / "gradebook.db").is_file():
        there["nbgrader"] = "."
    settings = Settings()
    always = ("submissions", "decisions", "results")
    drawn = {"seed": secrets.randbits(SEED_BITS)}
    return there | {name: getattr(settings, name) for name in always} | drawn


def set_line(text: str, name: str, value: object) -> str:
    """Return the text with this line, in the position of an older one."""
    line = f"{name} = {msgspec.json.encode(value).decode()}  # {SIGNS[name]}"
    pattern = re.compile(rf"^{name}\s*=.*$", re.MULTILINE)
    if pattern.search(text):
        return pattern.sub(lambda _: line, text, count=1)
    return f"{text.rstrip()}\n{line}\n"


def shorten_path(path: Path, folder: Path) -> str:
    """Return a path as class.toml holds it, relative if it lies in the folder."""
    whole, inside = path.resolve(), folder.resolve()
    if whole.is_relative_to(inside):
        return whole.relative_to(inside).as_posix()
    return whole.as_posix()
