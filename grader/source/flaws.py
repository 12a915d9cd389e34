"""Find code that Python refuses in a file, and say what to do about it.

The judge's own Python decides. The advice names syntax that only a newer Python has.
"""

import ast
import re
import sys
import tokenize
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from io import BytesIO

from grader.source.regions import CHAIN, MAX_SOURCE, is_usual, number_lines

UNDECODED = "\ufffd"  # replaces undecodable bytes
UNUSUAL = "the file says that it is in {encoding}: save it as UTF-8, and leave that out"
MAX_LINE = 80  # characters of a line that are quoted
MAX_SAID = 300  # characters of Python's message: it may quote a name of any length
Version = tuple[int, int]

# Syntax by the first Python that has it, and the form for older ones.
NEWER: tuple[tuple[Version, re.Pattern[str], str], ...] = (
    ((3, 12), re.compile(r"^\s*type\s+\w+\s*(\[.*\])?\s*="), "leave out the word type"),
    ((3, 12), re.compile(r"^\s*(async\s+)?(def|class)\s+\w+\["), "leave out the [...]"),
    (
        (3, 12),
        re.compile(
            r"(?<![\"'\w])[fF][rR]?(?P<quote>[\"'])(?:(?!(?P=quote))[^{])*\{[^}]*((?P=quote)|\\)"
        ),
        "inside the braces of an f-string use the other kind of quote, and no backslash",
    ),
    ((3, 14), re.compile(r"^\s*except\*?\s+[\w.]+\s*,"), "put the exceptions into brackets"),
    ((3, 14), re.compile(r"(?<![\"'\w])[tT][rR]?[\"']"), "use an f-string"),
)

ELSE_IF = re.compile(r"\belse if\b")

ADVICE = (  # by a part of Python's message
    (r"was never closed", "Add the bracket that is missing there."),
    (r"unmatched|does not match opening", "Remove that bracket, or add its partner."),
    (r"unterminated", "Add the quote that ends the text."),
    (r"indent", "Begin the lines of one block alike, with four spaces for each level."),
    (r"outside (function|loop)", "Indent the line, so that it stands in its block."),
    (r"expected ':'", "Is a colon missing at the end of the line?"),
    (r"'==' or ':='", "A comparison is written with ==."),
    (r"invalid (non-printable )?character", "Type that sign anew: it was copied from a text."),
    (r"UTF-8|encoding|null bytes", "Save the file as UTF-8."),
)
LOOK = "Look at this line and the one above: a sign may be missing, or one too many."


@dataclass(frozen=True)
class Flaw:
    """A line that Python refuses, and its message."""

    line: int
    message: str
    text: str = ""  # the line
    file: str = ""
    undecoded: bool = False  # the file cannot be decoded

    @property
    def words(self) -> str:
        text = f": {self.text}" if self.text else ""
        return f"SyntaxError: {self.message} (in {self.file}, line {self.line}{text})"

    @property
    def advice(self) -> str:
        for version, pattern, instead in NEWER:
            if version > sys.version_info[:2] and pattern.search(self.text):
                ours, theirs = (".".join(map(str, v)) for v in (sys.version_info[:2], version))
                return (
                    f"Python {ours} marks this, and the line needs Python {theirs} or newer: "
                    f"{instead}."
                )
        if ELSE_IF.search(self.text):
            return "Python writes elif, not else if."
        return next((say for said, say in ADVICE if re.search(said, self.message)), LOOK)

    def in_file(self, file: str) -> "Flaw":
        return replace(self, file=file)


def find_flaw(text: str) -> Flaw | None:
    """Return the first line of a text that Python refuses; None if it accepts all.

    A text that is too long counts as accepted. It is parsed and not compiled, since compiling can
    take hours. Only the usual errors that a compiler finds are searched for.
    """
    if len(text) > MAX_SOURCE or CHAIN.search(text):
        return None
    try:
        with warnings.catch_warnings(action="ignore"):
            tree = ast.parse(text)
    except SyntaxError as error:
        return flaw_at(text, error.lineno or 1, error.msg)
    except ValueError as error:
        return flaw_at(text, 1, str(error))
    except (RecursionError, MemoryError):
        return None
    return next((flaw_at(text, line, why) for line, why in find_misplaced(tree)), None)


def quote(text: str, most: int = MAX_LINE) -> str:
    """Return a text, cut to the length of a quote."""
    return text if len(text) <= most else f"{text[: most - 1]}…"


def flaw_at(text: str, line: int, message: str) -> Flaw:
    lines = text.splitlines()
    line = min(max(line, 1), max(len(lines), 1))
    there = lines[line - 1].strip() if lines else ""
    return Flaw(line, quote(message, MAX_SAID), quote(there))


def find_misplaced(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield the lines of statements outside the block that they need, with a message."""
    waiting: list[tuple[ast.AST, bool, bool]] = [(tree, False, False)]
    while waiting:
        node, in_function, in_loop = waiting.pop()
        match node:
            case ast.expr() if in_function:  # nothing in it can be misplaced
                continue
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.Lambda():
                in_function, in_loop = True, False
            case ast.ClassDef():
                in_function, in_loop = False, False
            case ast.For() | ast.AsyncFor() | ast.While():
                waiting += [(each, in_function, in_loop) for each in node.orelse]
                waiting += [(each, in_function, True) for each in node.body]
                continue
            case ast.Return() | ast.Yield() | ast.YieldFrom() if not in_function:
                kind = "return" if isinstance(node, ast.Return) else "yield"
                yield node.lineno, f"'{kind}' outside function"
            case ast.Break() | ast.Continue() if not in_loop:
                yield node.lineno, f"'{type(node).__name__.lower()}' outside loop"
        waiting += [(each, in_function, in_loop) for each in ast.iter_child_nodes(node)]


def find_bad_bytes(data: bytes) -> Flaw | None:
    """Return the first line of a file that cannot be decoded."""
    text = number_lines(data.decode("utf-8-sig", "replace"))
    try:
        encoding, _ = tokenize.detect_encoding(BytesIO(data).readline)
        if not is_usual(encoding):
            return replace(flaw_at(text, 1, UNUSUAL.format(encoding=encoding)), undecoded=True)
        data.decode(encoding)
    except (UnicodeError, LookupError, SyntaxError) as error:
        if UNDECODED not in text:
            return flaw_at(text, 1, str(error))
        line = text.partition(UNDECODED)[0].count("\n") + 1
        found = flaw_at(text, line, "this line is not in UTF-8, in which Python reads files")
        shown = found.text.replace(UNDECODED, "?") if found.text.isprintable() else ""
        return replace(found, text=shown, undecoded=True)
    return None
