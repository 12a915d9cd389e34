"""A battery of cases: each one runs on all engines, and all figures make one table.

hard_cases.py and published.py hold the cases, trials.py what is done in them. Here is what a case
is, how it is run, and how the table is written.
"""

import argparse
import math
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from .engines import ENGINES, SUBSTEPS
from .measures import GaveUp, finite
from .scenes import DT
from .table import Progress, Table, write_markdown

LENGTHS = ("quick", "full", "soak")
NO_ANSWER = "\N{EN DASH}"

LEGEND = f"""\
"must hold" is for the stable engine: how far its figure may be from the exact answer, as a share of
that answer where it says so. A figure that misses has MISSED behind it.
{NO_ANSWER}: the engine does not have what the case is about. NaN: numbers that are none any more.
stopped: the engine raised an error. never: what was waited for did not happen."""


# ---------------------------------------------------------------- what a case is


@dataclass
class Figure:
    """One number of a case: its key in what the trial returns, and what is asked of it."""

    key: str
    words: str  # what it is, with its unit
    exact: float = 0.0
    rule: str = ""  # one of RULES; "" for a number that is only reported
    limit: float = 0.0


RULES = {  # rule: whether a figure keeps to it
    "": lambda figure, exact, limit: True,
    "<": lambda figure, exact, limit: abs(figure - exact) < limit,
    "<=": lambda figure, exact, limit: abs(figure - exact) <= limit,
    "share": lambda figure, exact, limit: abs(figure - exact) < limit * abs(exact),
    ">": lambda figure, exact, limit: figure > limit,
}


@dataclass
class Case:
    """Scenes, what is done to each, and the figures that come of it.

    scenes holds functions that make a scene. trial(bench, scene) returns the figures by their keys.
    Of several scenes the figure farthest from the exact answer counts, or their total.
    """

    title: str
    scenes: list
    trial: object
    figures: list
    seconds: float = 10.0
    dt: float = DT
    substeps: int = SUBSTEPS  # of the stable engine
    total: bool = False
    quick: bool = True  # whether it belongs to the quick run
    engines: tuple = tuple(ENGINES)
    longer: dict = field(default_factory=dict)  # "full" or "soak": the fields that differ then

    def at(self, length):
        """The case for a quick, full or soak run: each takes over what the shorter one has."""
        case = self
        for name in LENGTHS[: LENGTHS.index(length) + 1]:
            case = replace(case, **self.longer.get(name, {}))
        return case


def each(make, key, values, **fixed):
    """Makers of a scene, one for each value of one of its settings."""
    return [partial(make, **{key: value}, **fixed) for value in values]


def chosen(cases, length):
    """The cases of a run of that length."""
    return [case.at(length) for case in cases if case.quick or length != "quick"]


class Bench:
    """What a trial works with: engines as the case wants them, and how long to run them."""

    def __init__(self, case, name):
        self.seconds, self.dt = case.seconds, case.dt
        self.engine = ENGINES[name]
        self.dials = {"substeps": case.substeps} if name == "stable" else {}
        self.built = []

    def build(self, scene):
        engine = self.engine(scene, **self.dials)
        self.built.append(engine)
        return engine


# ---------------------------------------------------------------- running it


def run_case(case, name):
    """What an engine does in a case: for each figure a number, or a word when it gives up."""
    if name not in case.engines:
        return [NO_ANSWER] * len(case.figures)
    results = [run_scene(case, name, make()) for make in case.scenes]
    return [combine(case, f, [result[f.key] for result in results]) for f in case.figures]


def run_scene(case, name, scene):
    """The figures of one scene by their keys."""
    bench = Bench(case, name)
    try:
        result = case.trial(bench, scene)
    except GaveUp as reason:
        word = str(reason)
    except ValueError:
        word = "stopped"
    else:
        if all(finite(engine) for engine in bench.built):
            return result
        word = "NaN"
    return dict.fromkeys([f.key for f in case.figures], word)


def combine(case, figure, cells):
    """One cell of those of several scenes; a word counts more than any number."""
    words = [cell for cell in cells if isinstance(cell, str) or not math.isfinite(cell)]
    if words:
        return words[0] if isinstance(words[0], str) else "NaN"
    if case.total:
        return sum(cells)
    if figure.rule == ">":
        return min(cells)
    return max(cells, key=lambda cell: abs(cell - figure.exact))


def holds(figure, cell):
    """Whether a cell of the stable engine keeps to the figure's rule. No word ever does."""
    if isinstance(cell, str):
        return False
    return RULES[figure.rule](cell, figure.exact, figure.limit)


# ---------------------------------------------------------------- writing it down


def number(value, digits=2):
    """A number in few characters; a word stays as it is."""
    if isinstance(value, str):
        return value
    if value in (0, math.inf):
        return "∞" if value else "0"
    if 100 <= abs(value) < 1e6 and digits < 6:
        return f"{value:.0f}"
    shown, _, power = f"{value:.{digits}g}".partition("e")
    return f"{shown}e{int(power)}" if power else shown


def must_hold(figure):
    """A figure's rule in a few characters."""
    if figure.rule == "":
        return NO_ANSWER
    if figure.rule == "<=" and figure.limit == 0:
        return f"= {number(figure.exact, 6)}"
    rule = "share <" if figure.rule == "share" else figure.rule
    return f"{rule} {number(figure.limit, 3)}"


def table_rows(case, cells):
    """The rows of a case, one per figure. cells holds the answers by the engines' names."""
    rows = []
    for i, figure in enumerate(case.figures):
        digits = 6 if figure.exact and math.isfinite(figure.exact) else 2
        row = [f"{case.title}: {figure.words}"]
        for name, answers in cells.items():
            missed = name == "stable" and not holds(figure, answers[i])
            row.append(number(answers[i], digits) + " MISSED" * missed)
        rows.append([*row, number(figure.exact, 6), must_hold(figure)])
    return rows


def lines_of(case, cells):
    """What each engine came to, by names for results.json, and what must hold. cells as above."""
    lines = bounds_of(case)
    for i, figure in enumerate(case.figures):
        for name, answers in cells.items():
            known = not isinstance(answers[i], str) and math.isfinite(answers[i])
            lines[f"{case.title}: {figure.words}: {name}"] = (
                answers[i] if known else number(answers[i], 6)
            )
    return lines


def bounds_of(case):
    """What must hold of those figures that have a rule, by names for results.json."""
    ruled = [figure for figure in case.figures if figure.rule]
    return {f"{case.title}: {figure.words}: must hold": figure.limit for figure in ruled}


# ---------------------------------------------------------------- the program


def run_all(cases):
    """All cases on all engines: the table's rows, how often the stable engine misses, all lines."""
    rows, missed, lines, progress = [], 0, {}, Progress(len(cases))
    for case in cases:
        progress.step(1, case.title)
        cells = {name: run_case(case, name) for name in ENGINES}
        rows += table_rows(case, cells)
        lines |= lines_of(case, cells)
        answers = zip(case.figures, cells["stable"], strict=True)
        missed += sum(not holds(figure, cell) for figure, cell in answers)
    progress.end()
    return rows, missed, lines


def main(title, cases, arguments=None):
    """Run the cases as the command line asks; the exit status is 1 if the stable engine misses."""
    parser = argparse.ArgumentParser(description=f"{title}: all engines in one table.")
    parser.add_argument("--quick", action="store_true", help="shorter runs, fewer scenes")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="put the table into FILE")
    options = parser.parse_args(arguments)
    rows, missed, lines = run_all(chosen(cases, "quick" if options.quick else "full"))
    table = Table(title, ["case", *ENGINES, "exact", "must hold"], rows, LEGEND)
    print(table.text())
    if options.markdown:
        write_markdown(options.markdown, [table], lines)
    if missed:
        print(f"The stable engine misses {missed} of its figures.")
    return 1 if missed else 0
