"""Look for the solution in everything that students get, inside archives as well.

A secret is a statement of a TODO region as a list of tokens, in which names that students choose
match any name. So it is found under other names and layouts, in pages and notebooks. Statements
that are in given code, or too short, are no secrets.
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

from grader.bank.sync import is_laid_in
from grader.judge.course import FULL, Course
from grader.judge.rubric import CHECKS, Rubric, drop_hidden
from grader.release.notebooks import is_in_course
from grader.release.students_copy import cut_checks, list_hidden_checks, read_checks
from grader.source.definitions import statements
from grader.source.regions import python_files, read_source, regions_in, replace_regions

WORD = re.compile(r"[^\W\d]\w*|\d+(?:\.\d+)?|\*\*|//|<=|>=|==|!=|[-+*/]=|\S")
NAME = r"[^\W\d]\w*(?: \. [^\W\d]\w*)*"  # any name, also with dots
TELLING, NAMELESS = 6, 8  # tokens; shorter code is no secret, without and with names
FIXED = re.compile(r"\w+|[-+*/]=?|\*\*")  # tokens other than brackets
LONG = 30  # characters of a line of a hidden check
ARCHIVES = {".zip", ".whl"}
MARKED = re.compile(r"### BEGIN (SOLUTION|HIDDEN TESTS)\n(.*?)### END \1", re.S)


@dataclass(frozen=True)
class Secret:
    what: str  # such as: TODO 4
    text: str  # its text in the kit
    pattern: re.Pattern[str]  # its pattern in a Row
    anchor: str  # the longest part that all copies share

    def find_in(self, row: "Row") -> Iterator[re.Match[str]]:
        return self.pattern.finditer(row.words) if self.anchor in row.words else iter(())


@dataclass(frozen=True)
class Leak:
    file: str
    line: int
    what: str
    text: str

    def __str__(self) -> str:
        return f"{self.file}, line {self.line}, gives away {self.what}: {self.text}"


def find_leaks(folder: Path, secrets: list[Secret]) -> Iterator[Leak]:
    """Yield every place below a folder with a secret; copies of a file are reported once."""
    seen = set()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            name = path.relative_to(folder).as_posix()
            for file, text in read_texts(name, path.read_bytes()):
                if text not in seen:
                    seen.add(text)
                    yield from find_leaks_in_text(file, text, secrets)


def find_leaks_in_text(file: str, text: str, secrets: list[Secret]) -> Iterator[Leak]:
    row = Row(text)
    for secret in secrets:
        for match in secret.find_in(row):
            yield Leak(file, row.line(match.start()), secret.what, secret.text)


class Row:
    """A text as one row of tokens, separated by spaces."""

    def __init__(self, text: str) -> None:
        self.words = f" {' '.join(WORD.findall(text))} "
        self.text = text

    def line(self, position: int) -> int:
        """Return the line of the text that a position in the row belongs to."""
        number = self.words.count(" ", 0, position + 1) - 1
        word = next(islice(WORD.finditer(self.text), number, None))
        return self.text.count("\n", 0, word.start()) + 1


def read_texts(name: str, data: bytes) -> Iterator[tuple[str, str]]:
    """Yield the readable text of a file, or of each file in an archive."""
    suffix = Path(name).suffix.lower()
    if suffix in ARCHIVES:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for each in archive.namelist():
                yield from read_texts(f"{name}/{each}", archive.read(each))
        return
    text = data.decode("utf-8", "replace").replace("\r\n", "\n")
    if suffix in (".html", ".svg"):  # as written and as displayed
        yield name, html.unescape(re.sub(r"<[^>]*>", "", text))
    elif suffix in (".json", ".ipynb"):
        text = "\n".join(read_strings(json.loads(text)))
    yield name, text


def read_strings(document: Any) -> Iterator[str]:
    """Yield the strings of a JSON document in order."""
    match document:
        case str():
            yield document.removesuffix("\n")
        case dict():
            for name, value in document.items():
                yield name
                yield from read_strings(value)
        case list():
            for value in document:
                yield from read_strings(value)


# ---------------------------------------------------------------- what is secret


def find_secrets(kit: Path, course: Course = FULL) -> list[Secret]:
    """Find the statements that the release of a course must not contain."""
    solution = kit / "solution"
    asked = {todo.id for todo in course.rubric.todos}
    given = read_given(solution, asked)
    programs = Row("\n".join(text for name, text in given if not is_laid_in(name)))
    everything = Row("\n".join(text for _, text in given))
    found: dict[str, list[Secret]] = {}
    for known, searched in (
        (everything, find_notebook_secrets(solution / "notebooks", course)),
        (
            programs,
            find_region_secrets(solution, asked),
        ),  # added files must contain none of it
    ):
        for candidates in searched:
            for each in candidates:
                if not any(each.find_in(known)):
                    found.setdefault(each.pattern.pattern, []).append(each)
                    break
    merged = [  # code shared by several TODOs is one secret
        replace(alike[0], what=" and ".join(dict.fromkeys(each.what for each in alike)))
        for alike in found.values()
    ]
    return [*merged, *find_hidden_secrets(course.rubric)]


def find_given_answers(kit: Path, course: Course) -> Iterator[str]:
    """Yield warnings of given TODOs that contain a line of an asked TODO."""
    asked = {todo.id for todo in course.rubric.todos}
    for secret in find_secrets(kit):
        shared = [each for each in secret.what.split(" and ") if each.startswith("TODO ")]
        tasks = [each for each in shared if each.removeprefix("TODO ") in asked]
        given = [each for each in shared if each not in tasks]
        if tasks and given:
            yield (
                f"{' and '.join(given)} is given, and has a line that {' and '.join(tasks)} asks "
                f"for, {secret.text}: ask for both or for neither"
            )


def read_given(solution: Path, asked: set[str]) -> list[tuple[str, str]]:
    """Return the sources that students get: files without the asked regions, notebooks, stubs."""
    found = []
    for path in python_files(solution):
        text = read_source(path)
        around = replace_regions(
            text, {each.id: () for each in regions_in(text) if each.id in asked}
        )
        found.append((path.relative_to(solution).as_posix(), around))
    for path in sorted(solution.glob("notebooks/*.ipynb")):
        found += [(path.name, MARKED.sub("", text)) for _, text in read_cells(path)]
    stubs = json.loads((CHECKS / "stubs.json").read_bytes())
    return [*found, *stubs.items()]


def find_region_secrets(solution: Path, asked: set[str]) -> Iterator[list[Secret]]:
    """Yield the secrets of each statement in the regions, the most general first."""
    for path in python_files(solution):
        text = read_source(path)
        functions = list(find_functions(text))
        for region in (each for each in regions_in(text) if each.id in asked):
            within = range(region.start + 1, region.stop + 1)
            for function in functions:
                if function.lineno < within.stop and within.start <= (function.end_lineno or 0):
                    yield from find_statement_secrets(f"TODO {region.id}", text, function, within)


def find_functions(text: str) -> Iterator[ast.FunctionDef]:
    for node in statements(text):
        yield from (each for each in ast.walk(node) if isinstance(each, ast.FunctionDef))


def read_cells(path: Path) -> list[tuple[Any, str]]:
    """Return a notebook's cells of code, each with its source."""
    cells = json.loads(path.read_bytes())["cells"]
    return [(cell, "".join(cell["source"])) for cell in cells if cell["cell_type"] == "code"]


def find_notebook_secrets(folder: Path, course: Course) -> Iterator[list[Secret]]:
    """Yield the lines that nbgrader takes out of the students' notebooks."""
    for path in sorted(folder.glob("*.ipynb")):
        for cell, source in read_cells(path):
            if not is_in_course(cell, course):
                continue
            whole = ast.Module(statements(source), [])
            for marked in MARKED.finditer(source):
                first, last = (source.count("\n", 0, place) for place in marked.span())
                what = f"{marked[1].lower()} of {path.name}"
                yield from find_statement_secrets(what, source, whole, range(first + 1, last + 2))


def find_statement_secrets(
    what: str, source: str, scope: ast.FunctionDef | ast.Module, within: range
) -> Iterator[list[Secret]]:
    """Yield each statement's secrets: its value, and itself with and without its names."""
    chosen = find_chosen_names(scope)
    for node in ast.walk(scope):
        if isinstance(node, ast.stmt) and node.lineno in within:
            parts = [
                ast.get_source_segment(source, part) or "" for part in find_telling_parts(node)
            ]
            forms = [(text, chosen) for text in parts] + [(text, set()) for text in parts[-1:]]
            yield [
                make_secret(what, text, names) for text, names in forms if is_telling(text, names)
            ]


def is_telling(text: str, chosen: set[str]) -> bool:
    """Return whether code is long enough to be recognized when the chosen names change."""
    words = WORD.findall(text)
    if not chosen:
        return len(words) >= TELLING
    fixed = [word for word in words if word not in chosen and FIXED.fullmatch(word)]
    return len(words) >= NAMELESS and len(fixed) >= 2


def find_telling_parts(node: ast.stmt) -> list[ast.AST]:
    """Return a statement and its value, or only the head of a compound one."""
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


def find_chosen_names(scope: ast.FunctionDef | ast.Module) -> set[str]:
    """Return the names of parameters and variables, which a student may choose."""
    names = {each.arg for each in ast.walk(scope) if isinstance(each, ast.arg)}
    for each in ast.walk(scope):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Store):
            names.add(each.id)
    return names - set(vars(builtins))


def make_secret(what: str, text: str, chosen: set[str]) -> Secret:
    """Return a secret that matches code with any names in place of the chosen ones."""
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


def find_hidden_secrets(rubric: Rubric) -> Iterator[Secret]:
    """Yield the names of the hidden checks, and lines that only they use."""
    for name in list_hidden_checks(rubric):
        yield make_secret("a hidden check", name, set())
    whole = cut_checks(rubric, read_checks())
    for file, kept in cut_checks(drop_hidden(rubric)).items():
        # Code of other TODOs' checks is no secret; closed forms always are.
        source = read_source(CHECKS / file) if file == "exact.py" else whole[file]
        shown = {ast.dump(function) for function in find_functions(kept)}
        for function in find_functions(source):
            if ast.dump(function) not in shown:
                body = source.splitlines()[function.body[0].lineno - 1 : function.end_lineno]
                for line in map(str.strip, body):
                    if len(line) >= LONG and line not in kept:
                        yield make_secret(f"{function.name}, which is hidden", line, set())
