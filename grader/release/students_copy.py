"""Make the students' copy of the grader: no solution, no closed forms, no hidden checks.

The hidden checks are cut out of their files, with everything that only they use. Oracles and known
mistakes keep their names and look up recorded answers: see judge/recorded.py. Numbers for practice
do so too: see questions/practice.py.
"""

import json
import shutil
from collections.abc import Collection, Iterable, Iterator
from contextlib import closing, contextmanager
from functools import cache, partial, wraps
from itertools import product
from pathlib import Path
from typing import Any

import msgspec

from grader.bank.sync import is_laid_in, read_given_sources
from grader.bank.verify import run_in_processes, shared_worker
from grader.checks import exact
from grader.judge.course import Course
from grader.judge.explain import misconceptions
from grader.judge.grade import grading
from grader.judge.lab import Observation
from grader.judge.recorded import (
    Answers,
    RecordedAnswers,
    RecordedKind,
    RecordedMistake,
    key,
    oracles,
)
from grader.judge.rubric import CHECKS, Check, Rubric, drop_hidden, load_rubric
from grader.judge.task import KIT, Options
from grader.judge.wall.children import Worker, start_worker
from grader.questions.practice import FILE as PRACTICE
from grader.release.handed_out import make_students_tree
from grader.release.handouts import make_handouts, make_tasks
from grader.release.practice import make_practice
from grader.release.recordings import Record
from grader.report.screen import TASKS
from grader.source.cut import prune_modules, replace_bodies
from grader.source.regions import read_source

NOT_FOR_STUDENTS = (
    *("bank", "bench", "classroom", "intake", "release", "__pycache__"),
    *("checks/*/mistakes.py", "checks/mistakes.*", "checks/expected_runs.json"),
    *("cli/classes.py", "cli/classroom.py", "cli/dev.py", "cli/questions.py"),
    *(f"questions/{name}.py" for name in ("cases*", "making", "marking", "moodle", "numbers")),
    "questions/templates/moodle.xml",
)  # below the package
PACKAGE = "grader.checks"
PLUGIN = "pytest_plugin.py"  # for authors of checks; no check needs it
Tree = tuple[Path, frozenset[str]]  # a submission, and the TODOs to ask it about; empty for all


def list_hidden_checks(rubric: Rubric) -> list[str]:
    """List the functions that no TODO shows to students."""
    shown = {check.id for todo in drop_hidden(rubric).todos for check in todo.checks}
    named = [check.id for todo in rubric.todos for check in todo.checks if check.hidden]
    return [name for name in dict.fromkeys(named) if name not in shown]


def write_copy(folder: Path, wrong: Iterable[Tree], course: Course, record: Record) -> None:
    """Write the package into `folder`, with the checks of a course.

    A check's next question may depend on an answer. So wrong submissions are recorded as well: the
    more there are, the more mistakes a student's copy can name.
    """
    checks = write_code(folder, course)
    # First, before calls of closed forms are recorded: it also runs hidden checks.
    (checks / PRACTICE).write_bytes(record("practice", lambda: make_practice(course)))
    answers = record(
        "answers", lambda: encode_table(record_answers(wrong, drop_hidden(course.rubric)))
    )
    noted = json.loads(answers)
    exacts = checks / "exact.py"
    text = read_source(exacts) if exacts.exists() else ""
    asked = noted["oracles"].items()
    noted["oracles"] = {name: each for name, each in asked if f"def {name}(" in text}
    write_file(checks / "recorded.json", encode_table(noted).decode())


def encode_table(table: object) -> bytes:
    """Return a table as JSON; the same content gives the same bytes."""
    plain = msgspec.to_builtins(table)
    return json.dumps(plain, separators=(",", ":"), sort_keys=True).encode()


def write_code(folder: Path, course: Course, whole: bool = False) -> Path:
    """Write the package without recordings; if `whole`, with the oracles' own code.

    Returns the folder of its checks.
    """
    checks = folder / "grader" / "checks"
    shutil.copytree(KIT / "grader", checks.parent, ignore=skip_files)
    rubric = drop_hidden(course.rubric)
    texts = cut_checks(rubric, read_checks() if whole else replace_oracles(read_checks()))
    remove_unneeded(checks, texts)
    texts["rubric.toml"] = write_rubric(rubric)
    for name, text in (texts | cut_course_files(course)).items():
        write_file(checks / name, text)
    return checks


def write_file(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")


def remove_unneeded(checks: Path, needed: Collection[str]) -> None:
    """Remove unneeded files of checks, and folders that are then empty."""
    for module in read_checks():
        if (name := write_name(module)) not in {*needed, PLUGIN}:
            (checks / name).unlink()
    for folder in {checks / todo.folder for todo in load_rubric().todos}:
        if {each.name for each in folder.iterdir()} <= {"__init__.py"}:
            shutil.rmtree(folder)


def skip_files(folder: str, names: list[str]) -> set[str]:
    """Return the names in a folder that students do not get."""
    paths = {name: Path(folder, name).relative_to(KIT / "grader") for name in names}
    return {name for name in names if any(map(paths[name].match, NOT_FOR_STUDENTS))}


def write_rubric(rubric: Rubric) -> str:
    lines = ["# What is asked and what it is worth, as far as it is checked here."]
    for todo in rubric.todos:
        fields = dict(msgspec.to_builtins(todo))
        del fields["checks"]
        lines += ["", "[[todos]]", *write_fields(fields), "checks = ["]
        for check in todo.checks:  # a table on one line
            lines.append(f"  {{ {', '.join(write_fields(list_unusual_fields(check)))} }},")
        lines.append("]")
    return "\n".join(lines) + "\n"


def list_unusual_fields(check: Check) -> dict[str, Any]:
    """Return the fields of a check that differ from their defaults."""
    usual = Check("", 0, "unit")
    always = ("id", "points", "kind")
    fields: dict[str, Any] = msgspec.to_builtins(check)
    return {n: v for n, v in fields.items() if n in always or v != getattr(usual, n)}


def write_fields(table: dict[str, Any]) -> list[str]:
    """Write the fields of a TOML table, whose values have the same form in JSON."""
    return [f"{name} = {json.dumps(value)}" for name, value in table.items()]


def cut_course_files(course: Course) -> dict[str, str]:
    """Return the files beside the checks: stubs, given code, and dates of the course."""
    asked = {todo.id for todo in course.rubric.todos}
    stubs = json.loads((CHECKS / "stubs.json").read_bytes())
    stubs = {name: stub for name, stub in stubs.items() if name.removeprefix("def ") in asked}
    files = make_students_tree(KIT, course)
    programs = {n: files[n].decode() for n in files if n.endswith(".py") and not is_laid_in(n)}
    due = f"due = {course.due.isoformat()}\n" if course.due else ""
    return {
        "stubs.json": json.dumps(stubs, indent=1) + "\n",
        "given.json": json.dumps(read_given_sources(programs), indent=1) + "\n",
        TASKS: json.dumps(make_tasks(make_handouts(KIT / "handouts", course)), indent=1) + "\n",
        "course.toml": f"title = {json.dumps(course.title)}\n{due}",
    }


def cut_checks(rubric: Rubric, sources: dict[str, str] | None = None) -> dict[str, str]:
    """Return the check files that a rubric needs, cut to the code it uses."""
    shown: dict[str, set[str]] = {}
    for todo in rubric.todos:
        module = f"{PACKAGE}.{todo.folder}.checks"
        shown.setdefault(module, set()).update(check.id for check in todo.checks)
    texts = prune_modules(sources or replace_oracles(read_checks()), shown)
    return {write_name(module): text for module, text in texts.items()}


@cache
def read_checks() -> dict[str, str]:
    """Return the sources below checks/ by module, without the known mistakes."""
    return {
        ".".join([PACKAGE, *path.relative_to(CHECKS).with_suffix("").parts]): read_source(path)
        for path in CHECKS.rglob("*.py")
        if path.name not in ("mistakes.py", "__init__.py")
    }


def write_name(module: str) -> str:
    """Return the name of a module's file below the checks."""
    return f"{module.removeprefix(f'{PACKAGE}.').replace('.', '/')}.py"


def replace_oracles(sources: dict[str, str]) -> dict[str, str]:
    """Replace the oracles' code by a look-up of recorded answers."""
    bodies = {}
    for name in oracles:
        code = getattr(exact, name).__code__
        inputs = ", ".join(code.co_varnames[: code.co_argcount])
        bodies[name] = f'return recorded.answer("{name}", {inputs})'
    return sources | {exact.__name__: replace_bodies(sources[exact.__name__], bodies)}


def record_answers(wrong: Iterable[Tree], rubric: Rubric) -> RecordedAnswers:
    """Record the questions of the visible checks, and the answers of the oracles and all models."""
    with closing(start_worker()) as worker, note_oracles() as notes:
        seen = observe((KIT / "solution", frozenset()), rubric, worker)
    for found in run_in_processes(partial(observe, rubric=drop_properties(rubric)), wrong, jobs=0):
        seen += found
    asked = [todo.id for todo in rubric.todos]
    for todo in asked:
        misconceptions.load_known(todo)
    mistakes = [
        RecordedMistake(
            each.todo,
            each.id,
            each.meaning,
            each.about,
            ask_model(each.model, each.about, seen),
            each.apart,
        )
        for todo in asked  # the same order in every process, for any modules loaded before
        for each in misconceptions.known_mistakes
        if each.todo == todo
    ]
    kinds = {
        about: RecordedKind(
            ask_model(kind.right, about, seen),
            ask_model(kind.traits, about, seen),
            kind.parts,
            kind.apart,
        )
        for about, kind in misconceptions.kinds.items()
    }
    return RecordedAnswers(notes, kinds, mistakes)


def drop_properties(rubric: Rubric) -> Rubric:
    """Remove the property checks, which draw their questions."""
    todos = [
        msgspec.structs.replace(todo, checks=[c for c in todo.checks if c.kind != "property"])
        for todo in rubric.todos
    ]
    return Rubric(todos)


def observe(tree: Tree, rubric: Rubric, worker: Worker | None = None) -> list[Observation]:
    """Return all observations of these checks, also those after a failure."""
    path, todos = tree
    options = Options(reference=None, only=todos, trusted=True)
    with grading(path, options, worker or shared_worker(), rubric) as run:
        run.surveys_all = True
        run.run()
    return [each for observations in run.observations.values() for each in observations]


@contextmanager
def note_oracles() -> Iterator[dict[str, Answers]]:
    """Call the oracles with all listed inputs, and record all their answers."""
    notes: dict[str, Answers] = {name: {} for name in oracles}
    usual = {name: getattr(exact, name) for name in oracles}
    for name, values in oracles.items():
        setattr(exact, name, note_answers(usual[name], notes[name]))
        for inputs in product(*values) if values else ():
            getattr(exact, name)(*inputs)
    try:
        yield notes
    finally:
        for name, function in usual.items():
            setattr(exact, name, function)


def note_answers(function: Any, notes: Answers) -> Any:
    @wraps(function)
    def ask_and_note(*inputs: Any) -> Any:
        notes[key(inputs)] = function(*inputs)
        return notes[key(inputs)]

    return ask_and_note


def ask_model(model: misconceptions.Model, about: str, seen: list[Observation]) -> Answers:
    """Return a model's answers to all observed inputs."""
    found = {}
    for each in seen:
        if each.about == about:
            try:
                found[key(each.inputs)] = misconceptions.predict(model, each.inputs)
            except misconceptions.Undecided:
                continue
    return found
