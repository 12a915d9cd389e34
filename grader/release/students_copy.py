"""Make the students' copy of the grader: no solution, no closed forms, no hidden checks.

The hidden checks are cut out of their files, with everything that only they use. An oracle keeps
its name and looks its answers up, and so do the known mistakes: see judge/recorded.py. So do the
numbers for practice: see questions/practice.py.
"""

import json
import shutil
import tomllib
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from functools import wraps
from itertools import product
from pathlib import Path
from typing import Any

import msgspec

from grader.bank.sync import is_laid_in, read_given_sources
from grader.checks import exact
from grader.judge import misconceptions
from grader.judge.children import Worker, start_worker
from grader.judge.course import FULL, Course
from grader.judge.grade import KIT, Options, grading
from grader.judge.lab import Observation
from grader.judge.recorded import Answers, Recorded, RecordedMistake, key, oracles
from grader.judge.rubric import CHECKS, Check, Rubric, load_rubric, visible
from grader.questions.practice import FILE as PRACTICE
from grader.release.handed_out import make_students_tree
from grader.release.practice import make_practice
from grader.source.cut import asked_of, pruned, with_bodies

NOT_FOR_STUDENTS = (
    *("bank", "bench", "classroom", "intake", "release", "__pycache__"),
    *("checks/*/mistakes.py", "checks/expected_runs.json"),
    *("cli/classroom.py", "cli/dev.py", "cli/questions.py"),
    *(f"questions/{name}.py" for name in ("cases*", "making", "marking", "numbers", "tally")),
    *(f"questions/{name}.py" for name in ("moodle", "notebook")),
    *("questions/templates/bank.html", "questions/templates/moodle.xml"),
)  # below the package
# Of the checks; each uses only those after it.
HELPERS = ("whole.lab_scene", "whole.lesson_rules", "pacing", "strategies", "telling", "exact")
Tree = tuple[Path, frozenset[str]]  # a submission, and the TODOs to ask it about; empty for all


def list_hidden_checks(rubric: Rubric) -> list[str]:
    """List the functions that no TODO shows to students."""
    shown = {check.id for todo in visible(rubric).todos for check in todo.checks}
    named = [check.id for todo in rubric.todos for check in todo.checks if check.hidden]
    return [name for name in dict.fromkeys(named) if name not in shown]


def write_copy(folder: Path, wrong: Iterable[Tree], course: Course = FULL) -> None:
    """Write the package into `folder`, with what a course has of the checks.

    The next question of a check may depend on an answer. So wrong submissions are asked as well:
    the more there are, the more often a student's copy can name a mistake.
    """
    package = folder / "grader"
    shutil.copytree(KIT / "grader", package, ignore=skip_files)
    checks = package / "checks"
    # First, while nothing notes what the closed forms are asked: it asks hidden checks as well.
    (checks / PRACTICE).write_bytes(make_practice(course))
    rubric = visible(course.rubric)
    texts = cut_checks(rubric)
    for todo in load_rubric().todos:
        if f"{todo.folder}/checks.py" not in texts:
            shutil.rmtree(checks / todo.folder, ignore_errors=True)
    texts["rubric.toml"] = write_rubric(rubric)
    texts |= cut_course_files(course)
    table = record_answers(wrong, rubric)
    asked = {
        name: each for name, each in table.oracles.items() if f"def {name}(" in texts["exact.py"]
    }
    table = msgspec.structs.replace(table, oracles=asked)
    recorded = msgspec.to_builtins(table)
    texts["recorded.json"] = json.dumps(recorded, separators=(",", ":"), sort_keys=True)
    for name, text in texts.items():
        (checks / name).write_text(text, encoding="utf-8", newline="\n")


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
    """Write the fields of a TOML table, whose values JSON writes the same."""
    return [f"{name} = {json.dumps(value)}" for name, value in table.items()]


def cut_course_files(course: Course) -> dict[str, str]:
    """Return the files beside the checks: stubs, given code, hints, and dates of the course."""
    asked = {todo.id for todo in course.rubric.todos}
    stubs = json.loads((CHECKS / "stubs.json").read_bytes())
    stubs = {name: stub for name, stub in stubs.items() if name.removeprefix("def ") in asked}
    files = make_students_tree(KIT, course)
    programs = {n: files[n].decode() for n in files if n.endswith(".py") and not is_laid_in(n)}
    hints = tomllib.loads((CHECKS / "hints.toml").read_text(encoding="utf-8"))
    kept = [f"{id} = {json.dumps(hints[id])}\n" for id in hints if id in asked]
    due = f"due = {course.due.isoformat()}\n" if course.due else ""
    return {
        "stubs.json": json.dumps(stubs, indent=1) + "\n",
        "given.json": json.dumps(read_given_sources(programs), indent=1) + "\n",
        "hints.toml": "".join(kept),
        "course.toml": f"title = {json.dumps(course.title)}\n{due}",
    }


def cut_checks(rubric: Rubric) -> dict[str, str]:
    shown: dict[str, set[str]] = {}
    for todo in rubric.todos:
        name = f"{todo.folder}.checks"
        shown.setdefault(name, set()).update(check.id for check in todo.checks)
    texts = {name: pruned(read_check(name), roots) for name, roots in shown.items()}
    for helper in HELPERS:
        source = read_check(helper)
        if helper == "exact":
            source = replace_oracles(source)
        roots = set().union(*(asked_of(text, helper) for text in texts.values()))
        texts[helper] = pruned(source, roots)
    return {f"{name.replace('.', '/')}.py": text for name, text in texts.items()}


def read_check(name: str) -> str:
    return (CHECKS / f"{name.replace('.', '/')}.py").read_text(encoding="utf-8")


def replace_oracles(source: str) -> str:
    """Keep the names and inputs of the oracles; let each look its answer up."""
    bodies = {}
    for name in oracles:
        code = getattr(exact, name).__code__
        inputs = ", ".join(code.co_varnames[: code.co_argcount])
        bodies[name] = f'return recorded.answer("{name}", {inputs})'
    return with_bodies(source, bodies)


def record_answers(wrong: Iterable[Tree], rubric: Rubric) -> Recorded:
    """Record what the visible checks ask, and what the oracles and all models answer."""
    with closing(start_worker()) as worker:
        with note_oracles() as notes:
            seen = observe(KIT / "solution", frozenset(), rubric, worker)
        for path, todos in wrong:
            seen += observe(path, todos, drop_properties(rubric), worker)
    asked = [todo.id for todo in rubric.todos]
    for todo in asked:
        misconceptions.load_known(todo)
    mistakes = [
        RecordedMistake(
            each.todo, each.id, each.meaning, each.about, ask_model(each.model, each.about, seen)
        )
        for todo in asked  # the same order in every process, whatever was loaded before
        for each in misconceptions.known_mistakes
        if each.todo == todo
    ]
    right, traits = (
        {about: ask_model(model, about, seen) for about, model in models.items()}
        for models in (misconceptions.right_models, misconceptions.trait_models)
    )
    return Recorded(
        notes,
        right,
        traits,
        misconceptions.part_names,
        sorted(misconceptions.separate_questions),
        mistakes,
    )


def drop_properties(rubric: Rubric) -> Rubric:
    """Keep the checks that do not ask at random."""
    todos = [
        msgspec.structs.replace(todo, checks=[c for c in todo.checks if c.kind != "property"])
        for todo in rubric.todos
    ]
    return Rubric(todos)


def observe(path: Path, todos: frozenset[str], rubric: Rubric, worker: Worker) -> list[Observation]:
    """Return all observations of these checks, run to the end even after a failure."""
    with grading(path, Options(reference=None, only=todos, trusted=True), worker, rubric) as run:
        run.surveys_all = True
        run.run()
    return [each for observations in run.observations.values() for each in observations]


@contextmanager
def note_oracles() -> Iterator[dict[str, Answers]]:
    """Note what the oracles answer; those with known values are asked all of them."""
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
    def asked(*inputs: Any) -> Any:
        notes[key(inputs)] = function(*inputs)
        return notes[key(inputs)]

    return asked


def ask_model(model: misconceptions.Model, about: str, seen: list[Observation]) -> Answers:
    """Return what a model says to everything that was observed."""
    found = {}
    for each in seen:
        if each.about == about:
            try:
                found[key(each.inputs)] = misconceptions.predict(model, each.inputs)
            except misconceptions.Undecided:
                continue
    return found
