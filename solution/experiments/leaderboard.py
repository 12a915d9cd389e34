"""The leaderboard: every engine on every row, at equal substeps and at equal time.

    python -m experiments.leaderboard [--quick] [--only WORDS] [--markdown FILE]
    python -m experiments.leaderboard --renew [ENGINE ...] --markdown FILE

At equal substeps each engine makes four substeps of 1/480 s in each step of 1/120 s. At equal time
each makes as many as fit into a millisecond of processor time per frame of 1/60 s: at least one,
at most 64. All engines run a row before the next one begins, so a slow minute hits them alike.
The exit status is 1 when the stable engine loses a row, at equal substeps, for no known reason.

Rows that every engine holds show nothing, so they are not counted. After a change of one engine,
--renew asks that engine alone, and the others keep their results.
"""

import argparse
import json
import math
from pathlib import Path

from .engines import SUBSTEPS
from .engines.contestants import Contestant, list_contestants
from .measures import GaveUp
from .rows import make_rows
from .rows.reasons import find_reason
from .table import Progress, Table, number, write_markdown

BUDGET = 1.0  # ms of each frame
MOST_SUBSTEPS = 64
PATIENCE = 20.0  # s of processor time for a row
TRIES = 2  # tries to find how many substeps fit
FRAMES = 60  # per second
MODES = {"substeps": "at equal substeps", "time": "at equal time"}
PAGE = "hard-cases.md"  # the handout, and the name of its lines in results.json
HELD = "rows that every engine holds"  # kept apart in results.json


class Trial:
    """Build engines for a row, and add up the cost of their steps."""

    def __init__(self, contestant, substeps):
        self.make, self.substeps = contestant.make, substeps
        self.seconds, self.frames = 0.0, 0.0

    def build(self, scene):
        engine = self.make(scene, substeps=self.substeps)
        step, spent = engine.step, engine.spent

        def timed(dt):
            start = spent()
            step(dt)
            self.seconds += spent() - start
            self.frames += FRAMES * dt
            if self.seconds > PATIENCE:
                raise GaveUp("too slow")

        engine.step = timed
        return engine

    def ms(self):
        """Return the processor time per frame (ms)."""
        return 1000 * self.seconds / self.frames if self.frames else math.inf


def ask(row, contestant, substeps):
    """Return an engine's error in a row, or a word if it gives up, and its ms per frame."""
    trial = Trial(contestant, substeps)
    try:
        error = float(row.measure(trial, row.make()))
    except GaveUp as reason:
        error = str(reason)
    except Exception:  # a student's engine, or one that refuses the scene
        error = "stopped"
    else:
        error = error if math.isfinite(error) else "NaN"
    return error, trial.ms()


def holds(row, error):
    return not isinstance(error, str) and error <= row.bound.limit


def ask_at_equal_time(row, contestant, substeps, first):
    """Return the error with as many substeps as fit into the budget, and their number."""
    (error, ms), tried = first, {substeps}
    for _ in range(TRIES):
        fitting = min(max(int(substeps * BUDGET / ms), 1), MOST_SUBSTEPS)
        if fitting in tried or BUDGET / 1.2 < ms <= BUDGET:
            break
        substeps = fitting
        tried.add(substeps)
        error, ms = ask(row, contestant, substeps)
    return error, substeps


def ask_all(row, contestants, untimed=()):
    """Return engines' errors in a row, in both modes. Skip those that lack what it needs.

    Ask engines in `untimed` at equal substeps only.
    """
    cells = {}
    for one in contestants:
        if not set(one.lacks) & {*row.needs, *row.make().effects}:
            substeps = one.its_own or SUBSTEPS
            first = ask(row, one, substeps)
            cells[one.name] = {"substeps": first[0]}
            if one.name not in untimed:
                error, fitting = ask_at_equal_time(row, one, substeps, first)
                cells[one.name] |= {"time": error, "fitting": fitting}
    return cells


def run(rows, contestants, recorded=None):
    """Return the cells of all rows by title; engines keep their `recorded` modes, if any."""
    found, progress = {}, Progress(len(rows))
    for row in rows:
        progress.step(1, row.title)
        texts = (recorded or {}).get(row.title, {})
        untimed = [name for name, text in texts.items() if "/" not in text]
        found[row.title] = ask_all(row, contestants, untimed)
    progress.end()
    return found


def renew(rows, contestants, recorded):
    """Ask these engines anew, and keep the recorded cells of all others.

    An engine is asked in the modes in which it was recorded. Other engines have no cell in new
    rows. Return the cells of all rows, and the engines, recorded ones included.
    """
    cells = recorded["rows"] | recorded.get(HELD, {})
    asked = run(rows, contestants, cells)
    found = {title: {**read_cells(cells.get(title, {})), **new} for title, new in asked.items()}
    words = {key.removesuffix(": name"): words for key, words in recorded[PAGE].items()
             if key.endswith(": name")}  # fmt: skip
    names = {one.name for one in contestants}
    others = [Contestant(name, words[name], None) for name in words if name not in names]
    return found, [*contestants, *others]


def read_cells(row):
    """Return a row of results.json as cells, the inverse of list_cells."""
    return {
        name: dict(zip((*MODES, "fitting"), map(read_number, text.split(" / ")), strict=False))
        for name, text in row.items()
        if name not in ("physics", "may be off by")
    }


def read_number(text):
    """Return a number, or a word as it is, such as NaN."""
    return float(text) if text[0].isdigit() else text


def find_losers(row, found, mode="substeps"):
    """Return the errors of the engines that lose a row."""
    errors = {name: cell[mode] for name, cell in found[row.title].items() if mode in cell}
    return {name: error for name, error in errors.items() if not holds(row, error)}


def count_held(rows, found, name, mode="substeps"):
    """Return how many of its rows an engine holds, and how many rows it has."""
    mine = [row for row in rows if mode in found[row.title].get(name, {})]
    return sum(name not in find_losers(row, found, mode) for row in mine), len(mine)


def tell_count(rows, found, name, mode="substeps"):
    held, asked = count_held(rows, found, name, mode)
    return f"{held} of {asked}" if asked else "-"


def find_lost(rows, found):
    """Return the rows that the stable engine loses at equal substeps."""
    return [row for row in rows if "stable" in find_losers(row, found)]


def make_tables(subjects, found, contestants):
    """Return tables: rows held by each engine, rows that the stable one loses, if any, subjects."""
    rows = [row for some in subjects.values() for row in some]
    words = {one.name: one.words for one in contestants}
    counts = {name: count_held(rows, found, name) for name in words}
    ranked = sorted(words, key=lambda name: -counts[name][0] / (counts[name][1] or 1))
    held = [[words[name], *(tell_count(rows, found, name, mode) for mode in MODES)]
            for name in ranked]  # fmt: skip
    by_subject = [
        [f"{subject} ({len(some)})", *(tell_count(some, found, name) for name in ranked)]
        for subject, some in subjects.items()
        if some
    ]
    heads = ["why, and the row", "off by", "may be", "best other"]
    losses = list_losses(rows, found)
    lost = [Table("Rows that the stable engine loses at equal substeps", heads, losses)]
    return [
        Table("Rows held", ["engine", *MODES.values()], held),
        *(lost if losses else []),
        Table("Rows held at equal substeps, by subject", ["subject", *ranked], by_subject),
    ]


def list_losses(rows, found):
    """Return a line for each row that the stable engine loses, below the reason for it."""
    lost, lines = find_lost(rows, found), []
    for why in dict.fromkeys(find_reason(row.title) for row in lost):
        lines.append([f"**{why or 'Not known yet.'}**", "", "", ""])
        lines += [tell_loss(row, found[row.title]) for row in lost if find_reason(row.title) == why]
    return lines


def tell_loss(row, cells):
    """Return the cells of a row that the stable engine loses."""
    others = {
        name: cell["substeps"]
        for name, cell in cells.items()
        if name not in ("stable", "compiled") and not isinstance(cell["substeps"], str)
    }
    best = min(others, key=others.get, default="")
    told = f"{best} {number(others[best])}" if best else "-"
    return [row.title, number(cells["stable"]["substeps"]), number(row.bound.limit), told]


def list_lines(rows, found, contestants):
    """Return the counts by name, for results.json and the claims of the page."""
    timed = [row for row in rows if any("time" in cell for cell in found[row.title].values())]
    hopeless = [r for r in rows if len(find_losers(r, found)) == len(found[r.title])]
    lines = {
        "rows": len(rows),
        "rows at equal time": len(timed),
        "rows that no engine holds at equal substeps": len(hopeless),
        HELD: len(found) - len(rows),
    }
    for one in contestants:
        lines[f"{one.name}: name"] = one.words
        for mode, words in MODES.items():
            held, asked = count_held(rows, found, one.name, mode)
            lines |= {f"{one.name}: rows held {words}": held, f"{one.name}: rows {words}": asked}
    return lines


def say_counts(lines):
    """Return a sentence for each of the counts."""
    return (
        f"{lines['rows']} rows count: some engine loses each. {lines['rows at equal time']} of "
        f"them were asked at equal time too. Every engine holds {lines[HELD]} more rows. Those "
        "show nothing, so they do not count; tests still ask them of the stable engine."
    )


def list_cells(rows, found):
    """Return each row with its physics, its bound and each engine's errors."""
    return {
        row.title: {
            "physics": row.physics,
            "may be off by": f"{number(row.bound.limit)}: {row.bound.why}",
            **{name: " / ".join(number(cell[key]) for key in (*MODES, "fitting") if key in cell)
               for name, cell in found[row.title].items()},
        }
        for row in rows
    }  # fmt: skip


def print_rows(rows, found):
    """Print rows with their physics, their bounds, and the engines that lose them."""
    for row in rows:
        print(f"{row.title}\n    {row.physics}")
        for mode, words in MODES.items():
            losers = find_losers(row, found, mode).items()
            told = ", ".join(f"{name} {number(error)}" for name, error in losers)
            if told:
                print(f"    more than {number(row.bound.limit)} off {words}: {told}")


def main(arguments=None):
    """Run the rows, and print or write how many each engine holds. Return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="only some rows of each subject")
    parser.add_argument("--only", default="", metavar="WORDS", help="rows with this in the title")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="put the tables into FILE")
    parser.add_argument("--renew", nargs="*", metavar="ENGINE", help="ask these engines alone")
    options = parser.parse_args(arguments)
    if options.renew is not None and not options.markdown:
        parser.error("--renew needs --markdown FILE: results.json beside it has the other engines.")
    if options.markdown and (options.only or options.quick):
        parser.error("--markdown needs all rows: leave out --only and --quick.")
    subjects = {
        subject: [r for r in some if options.only in r.title and (r.quick or not options.quick)]
        for subject, some in make_rows().items()
    }
    rows = [row for some in subjects.values() for row in some]
    contestants, missing = list_contestants()
    if options.renew is not None:
        contestants = [one for one in contestants if one.name in options.renew]
        results = options.markdown.with_name("results.json")
        recorded = json.loads(results.read_text(encoding="utf-8"))
        return report(subjects, *renew(rows, contestants, recorded), [], options.markdown)
    return report(subjects, run(rows, contestants), contestants, missing, options.markdown)


def report(subjects, found, contestants, missing, markdown=None):
    """Print the results, or write them too. Count the rows that some engine loses."""
    counted = {
        subject: [row for row in some if any(find_losers(row, found, mode) for mode in MODES)]
        for subject, some in subjects.items()
    }
    rows = [row for some in counted.values() for row in some]
    held = [row for some in subjects.values() for row in some if row not in rows]
    lines = list_lines(rows, found, contestants)
    tables = make_tables(counted, found, contestants)
    tables[1].note = " ".join([say_counts(lines), *(f"Not installed: {one}." for one in missing)])
    print_rows(rows, found)
    print("\n".join(table.text() for table in tables))
    if markdown:
        cells = {"rows": list_cells(rows, found), HELD: list_cells(held, found)}
        write_markdown(markdown, [tables[1]], lines, **cells)
    return int(not all(find_reason(row.title) for row in find_lost(rows, found)))


if __name__ == "__main__":
    raise SystemExit(main())
