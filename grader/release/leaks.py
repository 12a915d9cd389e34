"""Looking for the solution in everything that students get, inside archives as well.

A secret is a statement of a TODO region as a row of words and signs, in which the names that a
student may choose stand for any name. So it is found under other names, in other layout, in a page
or in a notebook. What stands in given code is no secret, nor is what is too short to tell anything.
"""

import ast
import builtins
import html
import io
import json
import re
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

from grader.bank.sync import laid_in
from grader.judge.course import FULL, Course
from grader.judge.rubric import CHECKS, Rubric, visible
from grader.release.students_copy import cut_checks, hidden_checks
from grader.source.definitions import statements
from grader.source.regions import python_files, read_source, regions_in, replaced

WORD = re.compile(r"[^\W\d]\w*|\d+(?:\.\d+)?|\*\*|//|<=|>=|==|!=|[-+*/]=|\S")
NAME = r"[^\W\d]\w*(?: \. [^\W\d]\w*)*"  # any name, also one with dots
TELLING, NAMELESS = 6, 8  # words and signs; what is shorter tells nothing, without names or with
FIXED = re.compile(r"\w+|[-+*/]=?|\*\*")  # words and signs that say more than brackets do
LONG = 30  # characters of a line of a hidden check
ARCHIVES = {".zip", ".whl"}
MARKED = re.compile(r"### BEGIN (SOLUTION|HIDDEN TESTS)\n(.*?)### END \1", re.S)


@dataclass(frozen=True)
class Secret:
    what: str  # such as: TODO 4
    text: str  # as it stands in the kit
    pattern: re.Pattern[str]  # what it looks like in a row of words
    anchor: str  # the longest part of that which stands in every copy

    def found_in(self, row: "Row") -> Iterator[re.Match[str]]:
        return self.pattern.finditer(row.words) if self.anchor in row.words else iter(())


@dataclass(frozen=True)
class Leak:
    file: str
    line: int
    what: str
    text: str

    def __str__(self) -> str:
        return f"{self.file}, line {self.line}, gives away {self.what}: {self.text}"


def leaks_in(folder: Path, secrets: list[Secret]) -> Iterator[Leak]:
    """Every place below a folder where a secret stands; a copy of a file is told of once."""
    seen = set()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            name = path.relative_to(folder).as_posix()
            for file, text in texts_in(name, path.read_bytes()):
                if text not in seen:
                    seen.add(text)
                    yield from leaks_in_text(file, text, secrets)


def leaks_in_text(file: str, text: str, secrets: list[Secret]) -> Iterator[Leak]:
    row = Row(text)
    for secret in secrets:
        for match in secret.found_in(row):
            yield Leak(file, row.line(match.start()), secret.what, secret.text)


class Row:
    """A text as one row of words and signs, a space between any two."""

    def __init__(self, text: str) -> None:
        self.words = f" {' '.join(WORD.findall(text))} "
        self.text = text

    def line(self, position: int) -> int:
        """The line of the text that a position in the row belongs to."""
        number = self.words.count(" ", 0, position + 1) - 1
        word = next(islice(WORD.finditer(self.text), number, None))
        return self.text.count("\n", 0, word.start()) + 1


def texts_in(name: str, data: bytes) -> Iterator[tuple[str, str]]:
    """What a person can read in a file; in an archive, of each of its files."""
    suffix = Path(name).suffix.lower()
    if suffix in ARCHIVES:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for each in archive.namelist():
                yield from texts_in(f"{name}/{each}", archive.read(each))
        return
    text = data.decode("utf-8", "replace").replace("\r\n", "\n")
    if suffix in (".html", ".svg"):  # as it is, and as it is shown
        yield name, html.unescape(re.sub(r"<[^>]*>", "", text))
    elif suffix in (".json", ".ipynb"):
        text = "\n".join(strings_in(json.loads(text)))
    yield name, text


def strings_in(document: Any) -> Iterator[str]:
    """The texts of a JSON document; the lines of a notebook's cell follow one another."""
    match document:
        case str():
            yield document.removesuffix("\n")
        case dict():
            for name, value in document.items():
                yield name
                yield from strings_in(value)
        case list():
            for value in document:
                yield from strings_in(value)


# ---------------------------------------------------------------- what is secret


def secrets_of(kit: Path, course: Course = FULL) -> list[Secret]:
    """All that must not be in the release of a course."""
    solution = kit / "solution"
    asked = {todo.id for todo in course.rubric.todos}
    given = given_texts(solution, asked)
    programs = Row("\n".join(text for name, text in given if not laid_in(name)))
    everything = Row("\n".join(text for _, text in given))
    found: dict[str, list[Secret]] = {}
    for known, searched in (
        (everything, notebook_secrets(solution / "notebooks")),
        (programs, region_secrets(solution, asked)),  # what is laid in must not hold any of it
    ):
        for candidates in searched:
            for each in candidates:
                if not any(each.found_in(known)):
                    found.setdefault(each.pattern.pattern, []).append(each)
                    break
    merged = [merge(alike) for alike in found.values()]
    return [*merged, *hidden_secrets(course.rubric)]


def merge(alike: list[Secret]) -> Secret:
    """One secret for what several TODOs have in common."""
    what = " and ".join(dict.fromkeys(each.what for each in alike))
    return replace(alike[0], what=what)


def given_texts(solution: Path, asked: set[str]) -> list[tuple[str, str]]:
    """What students get anyway, by file: all around the regions asked, and the stubs within."""
    found = []
    for path in python_files(solution):
        text = read_source(path)
        around = replaced(text, {each.id: () for each in regions_in(text) if each.id in asked})
        found.append((path.relative_to(solution).as_posix(), around))
    for path in notebooks_in(solution / "notebooks"):
        found += [(path.name, MARKED.sub("", cell)) for cell in cells_of(path)]
    stubs = json.loads((CHECKS / "stubs.json").read_bytes())
    return [*found, *stubs.items()]


def region_secrets(solution: Path, asked: set[str]) -> Iterator[list[Secret]]:
    """What stands in the regions: for each statement, what to look for, the widest first."""
    for path in python_files(solution):
        text = read_source(path)
        functions = list(functions_of(text))
        for region in (each for each in regions_in(text) if each.id in asked):
            within = range(region.start + 1, region.stop + 1)
            for function in functions:
                if function.lineno < within.stop and within.start <= (function.end_lineno or 0):
                    yield from statement_secrets(f"TODO {region.id}", text, function, within)


def functions_of(text: str) -> Iterator[ast.FunctionDef]:
    for node in statements(text):
        yield from (each for each in ast.walk(node) if isinstance(each, ast.FunctionDef))


def notebooks_in(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.ipynb"))


def cells_of(path: Path) -> list[str]:
    """The sources of a notebook's cells of code."""
    cells = json.loads(path.read_bytes())["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def notebook_secrets(folder: Path) -> Iterator[list[Secret]]:
    """The lines that nbgrader takes out of the students' notebooks."""
    for path in notebooks_in(folder):
        for source in cells_of(path):
            whole = ast.Module(statements(source), [])
            for marked in MARKED.finditer(source):
                first, last = (source.count("\n", 0, place) for place in marked.span())
                what = f"{marked[1].lower()} of {path.name}"
                yield from statement_secrets(what, source, whole, range(first + 1, last + 2))


def statement_secrets(
    what: str, source: str, scope: ast.FunctionDef | ast.Module, within: range
) -> Iterator[list[Secret]]:
    """For each statement in these lines its value and itself, and itself with its own names."""
    chosen = names_chosen(scope)
    for node in ast.walk(scope):
        if isinstance(node, ast.stmt) and node.lineno in within:
            parts = [ast.get_source_segment(source, part) or "" for part in telling_parts(node)]
            forms = [(text, chosen) for text in parts] + [(text, set()) for text in parts[-1:]]
            yield [secret(what, text, names) for text, names in forms if tells(text, names)]


def tells(text: str, chosen: set[str]) -> bool:
    """Whether a piece of code is its own, also without the names somebody chose."""
    words = WORD.findall(text)
    if not chosen:
        return len(words) >= TELLING
    fixed = [word for word in words if word not in chosen and FIXED.fullmatch(word)]
    return len(words) >= NAMELESS and len(fixed) >= 2


def telling_parts(node: ast.stmt) -> list[ast.AST]:
    """What of a statement is looked for: its value, and all of it; of a compound one its head."""
    match node:
        case ast.Expr(value=ast.Constant()):  # a docstring
            return []
        case ast.Assign(value=value) | ast.AugAssign(value=value) | ast.Expr(value=value):
            return [value, node]
        case ast.Return(value=ast.expr() as value):
            return [value, node]
        case ast.If(test=value) | ast.While(test=value) | ast.Assert(test=value):
            return [value]
        case ast.For(iter=value):
            return [value]
    return []


def names_chosen(scope: ast.FunctionDef | ast.Module) -> set[str]:
    """The names that somebody else may choose otherwise: those of parameters and variables."""
    names = {each.arg for each in ast.walk(scope) if isinstance(each, ast.arg)}
    for each in ast.walk(scope):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Store):
            names.add(each.id)
    return names - set(vars(builtins))


def secret(what: str, text: str, chosen: set[str]) -> Secret:
    """What a piece of code looks like in a row of words, whatever the chosen names are."""
    groups: dict[str, str] = {}
    parts, fixed, before = [], [""], ""
    for word in WORD.findall(text):
        if word not in chosen or before == ".":
            parts.append(re.escape(word))
            fixed[-1] += f" {word}"
        else:
            known = word in groups
            group = groups.setdefault(word, f"n{len(groups)}")
            parts.append(f"(?P={group})" if known else f"(?P<{group}>{NAME})")
            fixed.append("")
        before = word
    pattern = re.compile(" " + " ".join(parts) + " ")
    return Secret(what, " ".join(text.split()), pattern, max(fixed, key=len) + " ")


def hidden_secrets(rubric: Rubric) -> Iterator[Secret]:
    """The names of the hidden checks, and the lines of what is cut out with them."""
    for name in hidden_checks(rubric):
        yield secret("a hidden check", name, set())
    for file, kept in cut_checks(visible(rubric)).items():
        source = (CHECKS / file).read_text(encoding="utf-8")
        shown = {ast.dump(function) for function in functions_of(kept)}
        for function in functions_of(source):
            if ast.dump(function) not in shown:
                body = source.splitlines()[function.body[0].lineno - 1 : function.end_lineno]
                for line in map(str.strip, body):
                    if len(line) >= LONG and line not in kept:
                        yield secret(f"{function.name}, which is hidden", line, set())
