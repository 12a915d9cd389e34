"""The results of accuracy.py as tables, and as lines that the handouts rest on.

A line has a name and one number, or a word. A range is two lines, least and most. A quick run has
the lines of a full one that it measured.
"""

from .runs import EXACT, FRAMES, is_number
from .smooth import ENERGY_CALLS, ENERGY_ROUNDS
from .table import Table, as_range, number, span

SHOWN_AS = {"compiled": "stable compiled"}


def name_engine(engine):
    return SHOWN_AS.get(engine, engine)


def make_tables(results):
    return [
        tabulate_budgets(results["budgets"]),
        tabulate_orders(results["smooth"]["systems"]),
        tabulate_energy(results["smooth"]["energy"]),
        *map(tabulate_dials, results["dials"].values()),
        tabulate_piles(results["piles"]),
    ]


def make_lines(results):
    lines = {}
    for scene in results["budgets"].values():
        lines |= list_budgets(scene)
    lines |= list_smooth(results["smooth"])
    for study in results["dials"].values():
        lines |= list_dials(study)
    for study in results["piles"]:
        lines |= list_pile(study)
    return lines


# ---------------------------------------------------------------- all engines


def tabulate_budgets(budgets):
    """Show the smallest error of each engine in each budget, a row per scene and budget."""
    engines, rows = list(next(iter(budgets.values()))["within"]), []
    for scene in budgets.values():
        for i, first in enumerate(scene["within"][engines[0]]):
            cells = [scene["within"][engine][i] for engine in engines]
            name = f"{scene['title']}: {scene['error']} ({scene['unit']})"
            rows.append([name, f"{first['budget']:g} ms", *map(say_reached, cells)])
    heads = ["scene: error", "a frame", *map(name_engine, engines)]
    note = (
        f"The smallest error within so many ms of each frame of 1/{FRAMES} s, with steps of "
        "1/120 s in 1, 2, 4, 8 ... substeps. In brackets: from the fastest repeat to the slowest, "
        "where they differ. Too slow: one step alone takes longer."
    )
    return Table("What error each engine reaches in a frame", heads, rows, note)


def say_reached(cell):
    """Say an error, and its range where the repeats differ."""
    error, ends = say_error(cell["error"]), [say_error(end) for end in cell["range"]]
    return error if ends[0] == ends[1] else f"{error} ({ends[0]} to {ends[1]})"


def say_error(error):
    """Say an error in two digits, or that it is too small to matter."""
    if not is_number(error):
        return error
    return f"< {number(EXACT)}" if error < EXACT else number(float(f"{error:.2g}"))


def list_budgets(scene):
    lines = {}
    for engine, cells in scene["within"].items():
        for cell in cells:
            name = f"{scene['title']}, {engine}: {scene['error']} within {cell['budget']:g} ms"
            lines |= as_range(name, [*filter(is_number, [*cell["range"], cell["error"]])])
    return lines


# ---------------------------------------------------------------- integrators


def tabulate_orders(systems):
    """Show the measured order of convergence beside the expected one."""
    rows = []
    for system in systems:
        for row in system["methods"]:
            finest, order = row["points"][-1], row["order"]
            measured = "not reached" if order is None else f"{order:.2f}"
            step, error = f"1/{1 / finest['dt']:.0f} s", number(finest["error"])
            cells = [measured, step, finest["calls"], f"{error} {system['unit']}"]
            rows.append([system["title"], row["method"], row["expected"], *cells])
    heads = ["system", "method", "order", "measured", "finest step", "calls", "error there"]
    note = "At order 2, half the step means a quarter of the error."
    return Table("Integrators: order of convergence", heads, rows, note)


def tabulate_energy(study):
    rows = [
        [row["method"], *(number(row["peaks"][i]) for i in (0, -1)), "yes" * row["bounded"] or "no"]
        for row in study
    ]
    heads = ["method", "first round", "last round", "bounded"]
    words = f"{ENERGY_ROUNDS} rounds of {ENERGY_CALLS} evaluations"
    return Table(f"Orbit: largest energy error (share), {words}", heads, rows)


def list_smooth(smooth):
    lines = {
        f"{system['title']}, {row['method']}: order": row["order"] or "not reached"
        for system in smooth["systems"]
        for row in system["methods"]
    }
    for row in smooth["energy"]:
        name = f"orbit, {row['method']}: energy error"
        lines[f"{name} of the first round"] = row["peaks"][0]
        lines[f"{name} of the last round"] = row["peaks"][-1]
    return lines


# ---------------------------------------------------------------- dials


def tabulate_dials(study):
    """Show each dial's values, errors, time and verdict, a row per engine and dial."""
    rows = []
    for dial in study["dials"]:
        runs = [study["runs"][i] for i in dial["runs"]]
        columns = [
            [number(run["error"]) for run in runs],
            [span(run["ratio"] and run["ratio"][1:2]) for run in runs],
            [number(run["opcodes"] and run["opcodes"] / 1e6) for run in runs],
        ]
        joined = map(" · ".join, [dial["values"], *columns])
        rows.append([dial["engine"], dial["dial"], *joined, say_verdict(dial["verdict"])])
    heads = ["engine", "dial", "values", "errors", "time", "M opcodes/s", "work for a digit"]
    title = f"{study['title']}: {study['error']} ({study['unit']})"
    note = (
        f"{number(study['seconds'])} s simulated. Time: shares of the lesson's engine at its "
        "defaults (8 passes, 1/120 s). Shared substeps share the 8 passes of one step."
    )
    return Table(title, heads, rows, note)


def say_verdict(verdict):
    return say_digit(verdict["digit"]) if verdict["digit"] else verdict["says"]


def say_digit(factors):
    """Say the factors of work for a digit, the least and the most that it may be."""
    if factors[0] > 1000:
        return "over 1000x"
    return span([min(factor, 1000.0) for factor in factors], "x")


def list_dials(study):
    """List the errors at each dial's first and last value, its verdict, and the work it takes."""
    title, error, default = study["title"], study["error"], study["default"]
    lines = {f"{title}: {error}, lesson as it is": default["error"]}
    for row in study["dials"]:
        which, values = f"{row['engine']}, {row['dial']}", row["values"]
        first, last = (study["runs"][row["runs"][i]] for i in (0, -1))
        lines[f"{title}: {error}, {which} {values[0]}"] = first["error"]
        lines[f"{title}: {error}, {which} {values[-1]}"] = last["error"]
        lines[f"{title}: {error}, {which}: what it does"] = row["verdict"]["says"]
        if last["opcodes"] and default["opcodes"]:
            work = last["opcodes"] / default["opcodes"]
            lines[f"{title}, {which}: work of the last value in that of lesson as it is"] = work
    known = [run["error"] for run in study["runs"] if run["engine"] == "lesson"]
    if known := [*filter(is_number, known)]:
        lines[f"{title}: {error}, lesson: least with any dial"] = max(min(known), EXACT)
    return lines


# ---------------------------------------------------------------- piles


def tabulate_piles(piles):
    rows = []
    for study in piles:
        for run in study["runs"]:
            substeps = run["substeps"] if run["engine"] in ("stable", "compiled") else "-"
            cells = [number(run["error"]), span(run["ratio"], "x")]
            rows.append([study["balls"], name_engine(run["engine"]), substeps, *cells])
    heads = ["balls", "engine", "substeps", "overlap, px", "time"]
    note = (
        "Steps of 1/120 s; pymunk with its 10 iterations has the time 1. The fewest substeps that "
        "are accurate enough tell what plain Python costs beside compiled code."
    )
    return Table("Settled piles: the same step as pymunk's", heads, rows, note)


def list_pile(study):
    lines = {}
    for run in study["runs"]:
        name = f"pile of {study['balls']} in the same step, {run['engine']} with "
        name += f"{run['substeps']} substeps"
        lines[f"{name}: overlap"] = run["error"]
        lines |= as_range(f"{name}: time in pymunk's", run["ratio"])
    return lines
