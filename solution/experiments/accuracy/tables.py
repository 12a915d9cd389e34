"""The results of accuracy.py as tables, and as lines that support claims of the handouts.

A line has a name and one number, or a word. A range is two lines, least and most. A quick run has
some lines of a full one.
"""

from ..table import Table, as_range, number, span
from .questions import plural
from .runs import EXACT, FRAMES, is_number
from .smooth import ENERGY_CALLS, ENERGY_ROUNDS

SUBSTEPPED = ("stable", "compiled")
LEAST_ORDER = 0.2  # below it, smaller steps do not help


def name_engine(engine):
    return "stable compiled" if engine == "compiled" else engine


def make_tables(results):
    return [
        tabulate_budgets(results["budgets"]),
        tabulate_orders(results["smooth"]),
        tabulate_dials(results["dials"].values()),
        tabulate_crowds(results["crowds"]),
    ]


def make_lines(results):
    lines = {}
    for scene in results["budgets"].values():
        lines |= list_budgets(scene)
    lines |= list_smooth(results["smooth"])
    for study in results["dials"].values():
        lines |= list_dials(study)
    for study in results["crowds"]:
        lines |= list_crowd(study)
    return lines


def list_errors(title, error, runs):
    """Return the lines of single runs, by name."""
    return {f"{title}, {run['setting']}: {error}": run["error"] for run in runs if run["setting"]}


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
        "1/120 s in 1, 2, 4, 8 ... substeps. In brackets: the range of the repeats."
    )
    return Table("What error each engine reaches in a frame", heads, rows, note)


def say_reached(cell):
    """Say an error, with its range if the repeats differ."""
    fast, middle, slow = (say_error(pick["error"]) for pick in cell["picks"])
    return middle if fast == slow else f"{middle} ({fast} to {slow})"


def say_error(error):
    """Say an error in two digits, or that it is too small to matter."""
    if not is_number(error):
        return error
    return f"< {number(EXACT)}" if error < EXACT else number(float(f"{error:.2g}"))


def list_budgets(scene):
    """List the range of each cell of the table, and its settings."""
    lines, title, error = {}, scene["title"], scene["error"]
    for engine, cells in scene["within"].items():
        for cell in cells:
            lines |= list_errors(title, error, cell["picks"])
            name = f"{title}, {engine}: {error} within {cell['budget']:g} ms"
            lines |= as_range(name, [*filter(is_number, [pick["error"] for pick in cell["picks"]])])
    return lines


def tabulate_orders(smooth):
    """Show each method's order and price on a spring, and its energy error on an orbit."""
    rows = []
    for row, orbit in zip(smooth["spring"], smooth["energy"], strict=True):
        peaks = [number(orbit["peaks"][i]) for i in (0, -1)]
        rows.append([row["method"], row["expected"], *say_order(row["order"]), *peaks])
    heads = ["method", "order", "measured", "calls for a digit"]
    heads += ["orbit: first round", f"round {ENERGY_ROUNDS}"]
    note = (
        "Orders on a spring, by the worst place in its last swing. On the right the largest energy "
        f"error (share) in a round of an orbit, with {ENERGY_CALLS} calls of the force each."
    )
    return Table("Integrators", heads, rows, note)


def say_order(order):
    """Return the measured order, and the factor of calls for a tenth of the error."""
    if order is None:
        return ["not reached", "-"]
    return [f"{order:.2f}", f"{10 ** (1 / order):.2g}x" if order > LEAST_ORDER else "-"]


def list_smooth(smooth):
    lines = {
        f"spring, {row['method']}: order": row["order"] or "not reached" for row in smooth["spring"]
    }
    for row in smooth["energy"]:
        name = f"orbit, {row['method']}: energy error"
        lines[f"{name} of the first round"] = row["peaks"][0]
        lines[f"{name} of the last round"] = row["peaks"][-1]
    return lines


def tabulate_dials(studies):
    """Show the effect of each dial from its first value to its last, a row per scene."""
    heads, rows = ["scene: error"], []
    for study in studies:
        name = f"{study['title']}: {study['error']} ({study['unit']})"
        rows.append([name, *map(say_dial, study["dials"])])
    for dial in study["dials"]:
        heads.append(f"{dial['dial']} {dial['runs'][0]['value']} to {dial['runs'][-1]['value']}")
    note = (
        "From the first value to the last; in brackets, how many times the work (in opcodes) a "
        "tenth of the error takes. Shared substeps share the 8 passes of a step."
    )
    return Table("Every dial of the lesson's engine", heads, rows, note)


def say_dial(dial):
    """Say the errors at a dial's ends, and the cost of one more digit."""
    first, last = (say_error(dial["runs"][i]["error"]) for i in (0, -1))
    return f"{first} to {last} ({say_verdict(dial['verdict'])})"


def say_verdict(verdict):
    """Say the factor of work for one more digit, or why there is none."""
    factor = verdict["digit"]
    if not factor:
        return verdict["says"]
    return "over 1000x" if factor > 1000 else f"{number(float(f'{factor:.2g}'))}x"


def list_dials(study):
    """List the error and the work of each run, and the effect of each dial."""
    lines, title, error = {}, study["title"], study["error"]
    for dial in study["dials"]:
        lines |= list_errors(title, error, dial["runs"])
        lines |= list_errors(title, "work", [{**run, "error": run["work"]} for run in dial["runs"]])
        lines[f"{title}, {dial['dial']}: what it does"] = dial["verdict"]["says"]
    return lines


def tabulate_crowds(crowds):
    """Show each engine's error and time, a row per setting and two columns per crowd."""
    heads, rows = ["engine"], []
    for study in crowds:
        heads += [f"{study['title']}: {study['error']} ({study['unit']})", "time"]
    for runs in zip(*[study["runs"] for study in crowds], strict=True):
        row = [name_run(runs[0])]
        for run in runs:
            row += [say_error(run["error"]), span(run["ratio"], "x")]
        rows.append(row)
    return Table("Piles and a gas, in steps of 1/120 s", heads, rows, "Time: pymunk takes 1.")


def name_run(run):
    """Name an engine, with its substeps if it has them."""
    name = name_engine(run["engine"])
    return f"{name}, {plural(run['substeps'], 'substep')}" if run["engine"] in SUBSTEPPED else name


def list_crowd(study):
    lines = list_errors(study["title"], study["error"], study["runs"])
    for run in study["runs"]:
        lines |= as_range(f"{study['title']}, {run['setting']}: time in pymunk's", run["ratio"])
    return lines
