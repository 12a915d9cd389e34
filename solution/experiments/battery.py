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
        """Return the case for a quick, full or soak run: each keeps what the shorter one has."""
        case = self
        for name in LENGTHS[: LENGTHS.index(length) + 1]:
            case = replace(case, **self.longer.get(name, {}))
        return case


def each(make, key, values, **fixed):
    """Return makers of a scene, one for each value of one of its settings."""
    return [partial(make, **{key: value}, **fixed) for value in values]


def chosen(cases, length):
    """Return the cases of a run of that length."""
    return [case.at(length) for case in cases if case.quick or length != "quick"]


class Bench:
    """Hold what a trial works with: engines as the case wants them, and how long to run them."""

    def __init__(self, case, name):
        self.seconds, self.dt = case.seconds, case.dt
        self.engine = ENGINES[name]
        self.dials = {"substeps": case.substeps} if name == "stable" else {}
        self.built = []

    def build(self, scene):
        engine = self.engine(scene, **self.dials)
        self.built.append(engine)
        return engine


def run_case(case, name):
    """Run a case in an engine. Return a number for each figure, or a word if it gives up."""
    if name not in case.engines:
        return [NO_ANSWER] * len(case.figures)
    results = [run_scene(case, name, make()) for make in case.scenes]
    return [combine(case, f, [result[f.key] for result in results]) for f in case.figures]


def run_scene(case, name, scene):
    """Return the figures of one scene by their keys."""
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
    """Combine the cells of several scenes; a word counts more than any number."""
    words = [cell for cell in cells if isinstance(cell, str) or not math.isfinite(cell)]
    if words:
        return words[0] if isinstance(words[0], str) else "NaN"
    if case.total:
        return sum(cells)
    if figure.rule == ">":
        return min(cells)
    return max(cells, key=lambda cell: abs(cell - figure.exact))


def holds(figure, cell):
    """Return true if a cell of the stable engine keeps the figure's rule. No word does."""
    if isinstance(cell, str):
        return False
    return RULES[figure.rule](cell, figure.exact, figure.limit)


def number(value, digits=2):
    """Return a number in few characters; a word stays as it is."""
    if isinstance(value, str):
        return value
    if value in (0, math.inf):
        return "∞" if value else "0"
    if 100 <= abs(value) < 1e6 and digits < 6:
        return f"{value:.0f}"
    shown, _, power = f"{value:.{digits}g}".partition("e")
    return f"{shown}e{int(power)}" if power else shown


def must_hold(figure):
    """Return a figure's rule in a few characters."""
    if figure.rule == "":
        return NO_ANSWER
    if figure.rule == "<=" and figure.limit == 0:
        return f"= {number(figure.exact, 6)}"
    rule = "share <" if figure.rule == "share" else figure.rule
    return f"{rule} {number(figure.limit, 3)}"


def list_rows(case, cells):
    """Return the rows of a case, one per figure. cells holds the answers by engine."""
    rows = []
    for i, figure in enumerate(case.figures):
        digits = 6 if figure.exact and math.isfinite(figure.exact) else 2
        row = [f"{case.title}: {figure.words}"]
        for name, answers in cells.items():
            missed = name == "stable" and not holds(figure, answers[i])
            row.append(number(answers[i], digits) + " MISSED" * missed)
        rows.append([*row, number(figure.exact, 6), must_hold(figure)])
    return rows


def list_lines(case, cells):
    """Return what each engine came to, and what must hold, by names for results.json."""
    lines = {}
    for i, figure in enumerate(case.figures):
        name = f"{case.title}: {figure.words}"
        if figure.rule:
            lines[f"{name}: must hold"] = figure.limit
        for engine, answers in cells.items():
            known = not isinstance(answers[i], str) and math.isfinite(answers[i])
            lines[f"{name}: {engine}"] = answers[i] if known else number(answers[i], 6)
    return lines


def run_all(cases):
    """Run all cases on all engines. Return the table's rows, the number of misses, all lines."""
    rows, missed, lines, progress = [], 0, {}, Progress(len(cases))
    for case in cases:
        progress.step(1, case.title)
        cells = {name: run_case(case, name) for name in ENGINES}
        rows += list_rows(case, cells)
        lines |= list_lines(case, cells)
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
