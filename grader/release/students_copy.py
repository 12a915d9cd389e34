"""The copy of the grader that students get: no solution, no closed forms, no hidden checks.

The hidden checks are cut out of their files, and everything that only they use. An oracle keeps
its name and looks its answers up, and so do the known mistakes: see judge/recorded.py. So do the
numbers that are asked for practice: see questions/practice.py.
"""

import json
import shutil
import tomllib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import wraps
from itertools import product
from pathlib import Path
from typing import Any

import msgspec

from grader.bank.sync import given_sources, laid_in
from grader.checks import exact
from grader.judge import misconceptions
from grader.judge.children import Worker, start_worker
from grader.judge.course import FULL, Course
from grader.judge.grade import KIT, Options, grading
from grader.judge.lab import Observation
from grader.judge.recorded import Answers, Recorded, RecordedMistake, key, oracles
from grader.judge.rubric import CHECKS, Check, Rubric, load_rubric, visible
from grader.questions.practice import FILE as PRACTICE
from grader.release.handed_out import students_tree
from grader.release.practice import practice_of
from grader.source.cut import asked_of, pruned, with_bodies

NOT_FOR_STUDENTS = (
    *("bank", "bench", "classroom", "intake", "release", "__pycache__"),
    *("checks/*/mistakes.py", "checks/expected_runs.json"),
    *("cli/classroom.py", "cli/dev.py", "cli/questions.py"),
    *("questions/cases*.py", "questions/numbers.py", "questions/templates/bank.html"),
    *(f"questions/{name}.py" for name in ("making", "marking", "tally")),
    *(f"questions/{name}.py" for name in ("moodle", "notebook")),
)  # below the package
HELPERS = (
    "whole.lab_scene",
    "whole.lesson_rules",
    "pacing",
    "strategies",
    "telling",
    "exact",
)  # of the checks; each uses only those after it
Tree = tuple[Path, frozenset[str]]  # a submission, and the TODOs to ask it about; empty for all


def hidden_checks(rubric: Rubric) -> list[str]:
    """The names of the functions that no TODO shows to students."""
    shown = {check.id for todo in visible(rubric).todos for check in todo.checks}
    named = [check.id for todo in rubric.todos for check in todo.checks if check.hidden]
    return [name for name in dict.fromkeys(named) if name not in shown]


def write_copy(folder: Path, wrong: Iterable[Tree], course: Course = FULL) -> None:
    """Write the package into `folder`, with what a course has of the checks.

    What a check asks next may follow from an answer. So wrong submissions are asked as well: the
    more there are, the more often a student's copy can name a mistake.
    """
    package = folder / "grader"
    shutil.copytree(KIT / "grader", package, ignore=left_out)
    checks = package / "checks"
    # First, while nothing notes what the closed forms are asked: it asks hidden checks as well.
    (checks / PRACTICE).write_bytes(practice_of(course))
    rubric = visible(course.rubric)
    texts = cut_checks(rubric)
    for todo in load_rubric().todos:
        if f"{todo.folder}/checks.py" not in texts:
            shutil.rmtree(checks / todo.folder, ignore_errors=True)
    texts["rubric.toml"] = as_toml(rubric)
    texts |= of_the_course(course)
    table = record(wrong, rubric)
    asked = {
        name: each for name, each in table.oracles.items() if f"def {name}(" in texts["exact.py"]
    }
    table = msgspec.structs.replace(table, oracles=asked)
    recorded = msgspec.to_builtins(table)
    texts["recorded.json"] = json.dumps(recorded, separators=(",", ":"), sort_keys=True)
    for name, text in texts.items():
        (checks / name).write_text(text, encoding="utf-8", newline="\n")


def left_out(folder: str, names: list[str]) -> set[str]:
    """Those of a folder that students do not get."""
    paths = {name: Path(folder, name).relative_to(KIT / "grader") for name in names}
    return {name for name in names if any(map(paths[name].match, NOT_FOR_STUDENTS))}


# ---------------------------------------------------------------- cutting


def as_toml(rubric: Rubric) -> str:
    """The text of a rubric.toml."""
    lines = ["# What is asked and what it is worth, as far as it is checked here."]
    for todo in rubric.todos:
        fields = dict(msgspec.to_builtins(todo))
        checks = [unusual(check) for check in todo.checks]
        del fields["checks"]
        lines += ["", "[[todos]]", *(f"{name} = {json.dumps(fields[name])}" for name in fields)]
        lines += ["checks = [", *(f"  {inline(check)}," for check in checks), "]"]
    return "\n".join(lines) + "\n"


def unusual(check: Check) -> dict[str, Any]:
    """The fields of a check that are not as they go without saying."""
    usual = Check("", 0, "unit")
    always = ("id", "points", "kind")
    fields: dict[str, Any] = msgspec.to_builtins(check)
    return {n: v for n, v in fields.items() if n in always or v != getattr(usual, n)}


def inline(table: dict[str, Any]) -> str:
    """A table of TOML on one line; of its values, JSON and TOML write the same."""
    return "{ " + ", ".join(f"{name} = {json.dumps(table[name])}" for name in table) + " }"


def of_the_course(course: Course) -> dict[str, str]:
    """The files beside the checks that are about the TODOs: stubs, given code, hints, and dates."""
    asked = {todo.id for todo in course.rubric.todos}
    stubs = json.loads((CHECKS / "stubs.json").read_bytes())
    stubs = {name: stub for name, stub in stubs.items() if name.removeprefix("def ") in asked}
    files = students_tree(KIT, course)
    programs = {n: files[n].decode() for n in files if n.endswith(".py") and not laid_in(n)}
    hints = tomllib.loads((CHECKS / "hints.toml").read_text(encoding="utf-8"))
    kept = [f"{id} = {json.dumps(hints[id])}\n" for id in hints if id in asked]
    about = {"title": course.title, "due": course.due.isoformat() if course.due else ""}
    return {
        "stubs.json": json.dumps(stubs, indent=1) + "\n",
        "given.json": json.dumps(given_sources(programs), indent=1) + "\n",
        "hints.toml": "".join(kept),
        "course.toml": f"title = {json.dumps(about['title'])}\n"
        + (f"due = {about['due']}\n" if about["due"] else ""),
    }


def cut_checks(rubric: Rubric) -> dict[str, str]:
    """The files of checks as students get them, by name."""
    shown: dict[str, set[str]] = {}
    for todo in rubric.todos:
        name = f"{todo.folder}.checks"
        shown.setdefault(name, set()).update(check.id for check in todo.checks)
    texts = {name: pruned(source_of(name), roots) for name, roots in shown.items()}
    for helper in HELPERS:
        source = source_of(helper)
        if helper == "exact":
            source = with_recorded_oracles(source)
        roots = set().union(*(asked_of(text, helper) for text in texts.values()))
        texts[helper] = pruned(source, roots)
    return {f"{name.replace('.', '/')}.py": text for name, text in texts.items()}


def source_of(name: str) -> str:
    return (CHECKS / f"{name.replace('.', '/')}.py").read_text(encoding="utf-8")


def with_recorded_oracles(source: str) -> str:
    """The oracles with their names and inputs, and a look-up for what they do."""
    bodies = {}
    for name in oracles:
        code = getattr(exact, name).__code__
        inputs = ", ".join(code.co_varnames[: code.co_argcount])
        bodies[name] = f'return recorded.answer("{name}", {inputs})'
    return with_bodies(source, bodies)


# ---------------------------------------------------------------- recording


def record(wrong: Iterable[Tree], rubric: Rubric) -> Recorded:
    """What the visible checks ask, and what the oracles and all models answer."""
    worker = start_worker()
    try:
        with oracles_noted() as notes:
            seen = watch(KIT / "solution", frozenset(), rubric, worker)
        for path, todos in wrong:
            seen += watch(path, todos, without_properties(rubric), worker)
    finally:
        worker.close()
    asked = [todo.id for todo in rubric.todos]
    for todo in asked:
        misconceptions.load_known(todo)
    mistakes = [
        RecordedMistake(
            each.todo, each.id, each.meaning, each.about, answers(each.model, each.about, seen)
        )
        for todo in asked  # the same order in every process, whatever was loaded before
        for each in misconceptions.known_mistakes
        if each.todo == todo
    ]
    right, traits = (
        {about: answers(model, about, seen) for about, model in models.items()}
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


def without_properties(rubric: Rubric) -> Rubric:
    """The checks that do not ask at random."""
    todos = [
        msgspec.structs.replace(todo, checks=[c for c in todo.checks if c.kind != "property"])
        for todo in rubric.todos
    ]
    return Rubric(todos)


def watch(path: Path, todos: frozenset[str], rubric: Rubric, worker: Worker) -> list[Observation]:
    """What these checks see of a submission, each asked to its end."""
    with grading(path, Options(reference=None, only=todos, trusted=True), worker, rubric) as run:
        run.surveys_all = True
        run.run()
    return [each for observations in run.observations.values() for each in observations]


@contextmanager
def oracles_noted() -> Iterator[dict[str, Answers]]:
    """Write down what the oracles answer; those with known values are asked all of them."""
    notes: dict[str, Answers] = {name: {} for name in oracles}
    usual = {name: getattr(exact, name) for name in oracles}
    for name, values in oracles.items():
        setattr(exact, name, noted(usual[name], notes[name]))
        for inputs in product(*values) if values else ():
            getattr(exact, name)(*inputs)
    try:
        yield notes
    finally:
        for name, function in usual.items():
            setattr(exact, name, function)


def noted(function: Any, notes: Answers) -> Any:
    @wraps(function)
    def asked(*inputs: Any) -> Any:
        notes[key(inputs)] = function(*inputs)
        return notes[key(inputs)]

    return asked


def answers(model: misconceptions.Model, about: str, seen: list[Observation]) -> Answers:
    """What a model says to everything that was observed."""
    found = {}
    for each in seen:
        if each.about == about:
            try:
                found[key(each.inputs)] = misconceptions.predict(model, each.inputs)
            except misconceptions.Undecided:
                continue
    return found
