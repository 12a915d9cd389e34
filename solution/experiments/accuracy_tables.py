"""The results of accuracy.py as tables."""

from .answers import EXACT, best_dial
from .race import growth
from .smooth import ENERGY_CALLS, ENERGY_ROUNDS
from .table import Table, number, times


def all_tables(results):
    return [
        order_table(results["smooth"]["systems"]),
        energy_table(results["smooth"]["energy"]),
        fall_table(results["smooth"]["fall"]),
        *(
            answer_table(answers, e)
            for answers in results["dials"].values()
            for e in answers["units"]
        ),
        first_dial_table(results["dials"]),
        equal_table(results["equal"]),
        pile_table(results["piles"]),
        same_step_table(results["same step"]),
    ]


def short_tables(results):
    """Those that the handout shows."""
    shown = (
        ("tower", "sink"),
        ("stack", "sink"),
        ("pendulum", "stretch"),
        ("swinging", "worst link"),
    )
    return [
        order_table(results["smooth"]["systems"]),
        energy_table(results["smooth"]["energy"]),
        fall_table(results["smooth"]["fall"]),
        first_dial_table(results["dials"]),
        *(answer_table(results["dials"][name], error) for name, error in shown),
        equal_table(results["equal"]),
        pile_table(results["piles"]),
        same_step_table(results["same step"]),
    ]


# ---------------------------------------------------------------- integrators


def order_table(systems):
    """Measured order of convergence beside the expected one."""
    rows = []
    for system in systems:
        for method in system["methods"]:
            finest = method["points"][-1]
            order = method["order"]
            rows.append(
                [
                    system["title"],
                    method["method"],
                    method["expected"],
                    "not reached" if order is None else f"{order:.2f}",
                    f"1/{1 / finest['dt']:.0f} s",
                    finest["calls"],
                    f"{number(finest['error'])} {system['unit']}",
                ]
            )
    heads = ["system", "method", "order", "measured", "finest step", "calls", "error there"]
    note = "At order 2, half the step means a quarter of the error."
    return Table("Integrators: order of convergence", heads, rows, note)


def energy_table(study):
    rows = [
        [
            row["method"],
            number(row["peaks"][0]),
            number(row["peaks"][-1]),
            "yes" if row["bounded"] else "no",
            "-" if row["passes Verlet"] is None else row["passes Verlet"],
        ]
        for row in study
    ]
    heads = ["method", "first round", "last round", "bounded", "above Verlet's from round"]
    words = f"{ENERGY_ROUNDS} rounds of {ENERGY_CALLS} evaluations"
    return Table(f"Orbit: largest energy error (share), {words}", heads, rows)


def fall_table(rows):
    cells = [
        [row["name"], number(row["error"]), number(row["expected"]), near(row)] for row in rows
    ]
    heads = ["method or engine", "error, px", "its own sum, px", "is its own sum"]
    note = "All engines fall as their integrator does; the stable engine has smaller steps inside."
    return Table("Free fall of 1 s at 1/120 s against g t²/2 = 490 px", heads, cells, note)


def near(row):
    off = row["off the sum"]
    share = 1e-6 if row["name"] == "box2d" else 1e-9  # Box2D has floats of 32 bits
    return "yes" if not isinstance(off, str) and abs(off) < share * 490 else "no"


# ---------------------------------------------------------------- dials


def answer_table(answers, error):
    """One error: each dial's values, errors, time and verdict, a row per engine and dial."""
    rows = []
    for dial in answers["dials"]:
        runs = [answers["runs"][i] for i in dial["runs"]]
        rows.append(
            [
                dial["engine"],
                dial["dial"],
                " · ".join(dial["values"]),
                " · ".join(number(run["errors"][error]) for run in runs),
                " · ".join(number(run["ratio"]) for run in runs),
                " · ".join(number(millions(run["opcodes"])) for run in runs),
                says(dial["verdicts"][error]),
            ]
        )
    heads = ["engine", "dial", "values", "errors", "time", "M opcodes/s", "work for a digit"]
    title = f"{answers['title']}: {error} ({answers['units'][error]})"
    note = (
        f"{number(answers['seconds'])} s simulated. Time: shares of the lesson's engine at its "
        "defaults (8 passes, 1/120 s). Shared substeps share the 8 passes of one step."
    )
    return Table(title, heads, rows, note)


def millions(count):
    return None if count is None else count / 1e6


def says(verdict):
    digit = verdict["digit"]
    if digit is None:
        return verdict["says"]
    return digit_price(digit)


def digit_price(digit):
    """A factor of work in two digits."""
    return "over 1000x" if digit > 1000 else times(float(f"{digit:.2g}"))


def first_dial_table(found):
    """Which dial of the lesson's engine to turn first, and which cannot help."""
    rows = []
    for answers in found.values():
        for error in answers["units"]:
            best, useless = best_dial(answers, error)
            default = next(run for run in answers["runs"] if run["default"])["errors"][error]
            if not isinstance(default, str) and default < EXACT:
                best, useless = None, ["exact already"]
            rows.append(
                [
                    answers["title"],
                    error,
                    number(default),
                    best["dial"] if best else "-",
                    says(best["verdicts"][error]) if best else "-",
                    ", ".join(useless) or "-",
                ]
            )
    heads = ["scene", "error", "at defaults", "turn first", "work for a digit", "cannot help"]
    return Table("The lesson's engine: which dial first", heads, rows)


# ---------------------------------------------------------------- races


def equal_table(found):
    rows = []
    for race in found:
        for row in race["rows"]:
            slop = "its own, 0.1 px" if row["slop"] is None else "0"
            one = row["best"] or row["closest"]
            rows.append(
                [
                    race["title"],
                    number(race["stable"]),
                    slop,
                    "yes" if row["reached"] else "never gets there",
                    f"{number(one['sink'])}" if one else "-",
                    f"{one['passes']} at 1/{one['rate']} s" if one else "-",
                    times(one["ratio"]) if one else "-",
                ]
            )
    heads = ["scene", "stable sinks, px", "pymunk's slop", "as good", "pymunk sinks, px",
             "iterations and step", "its time"]  # fmt: skip
    note = (
        "The stable engine is at its defaults (1/120 s, 4 substeps) and its time is 1. pymunk is "
        "the fastest setting that sinks no more, or the one that sinks least. Slop is the overlap "
        "that pymunk leaves alone."
    )
    return Table(
        "Equal accuracy: pymunk's time in shares of the stable engine's", heads, rows, note
    )


def pile_table(piles):
    rows = []
    for row in piles:
        asleep = row["asleep"]
        rows.append(
            [
                row["balls"],
                number(row["lesson"]["ms"]),
                share(row["stable"]["ratio"]),
                share(row["compiled"]["ratio"]) if "compiled" in row else "-",
                share(row["pymunk"]["ratio"]),
                f"{share(asleep['ratio'])} ({asleep['asleep']} asleep)",
                *(number(row[name]["overlap"]) for name in ("lesson", "stable", "pymunk")),
            ]
        )
    heads = ["balls", "lesson, ms", "stable", "stable compiled", "pymunk", "stable asleep",
             "lesson overlap, px", "stable overlap, px", "pymunk overlap, px"]  # fmt: skip
    grown = [(name, growth(piles, name)) for name in ("lesson", "stable", "pymunk")]
    parts = [f"{name} {times(factor)}" for name, factor in grown if factor]
    note = (
        "Time per simulated second; the other engines in shares of the lesson's. lesson 1/120 s, "
        "stable 1/60 s with 8 substeps, pymunk 1/120 s with 10 iterations."
    )
    if parts:
        note += f" From 200 to 1000 balls the time per ball grows: {', '.join(parts)}."
    return Table("Settled piles", heads, rows, note)


def same_step_table(race):
    rows = [
        [
            "stable compiled" if row["engine"] == "compiled" else row["engine"],
            row["substeps"] if row["engine"] in ("stable", "compiled") else "-",
            number(row["overlap"]),
            "-" if row["ratio"] is None else times(row["ratio"]),
        ]
        for row in race["rows"]
    ]
    heads = ["engine", "substeps", "overlap, px", "time"]
    note = (
        "Steps of 1/120 s; pymunk with its 10 iterations has the time 1. The fewest substeps that "
        "are accurate enough tell what plain Python costs beside compiled code."
    )
    return Table(f"A settled pile of {race['balls']}: the same step as pymunk's", heads, rows, note)


def share(ratio):
    return "-" if ratio is None else f"1/{1 / ratio:.3g}" if ratio < 1 else times(ratio)
