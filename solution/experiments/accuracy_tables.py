"""The results of accuracy.py as tables."""

from .answers import EXACT, best_dial
from .costs import spread
from .race import growth
from .smooth import ENERGY_CALLS, ENERGY_ROUNDS
from .table import Table, number, span


def all_tables(results):
    return [
        budget_table(results["budgets"]),
        equal_table(results["budgets"]),
        chain_table(results["chain"]),
        order_table(results["smooth"]["systems"]),
        energy_table(results["smooth"]["energy"]),
        fall_table(results["smooth"]["fall"]),
        *(
            answer_table(answers, e)
            for answers in results["dials"].values()
            for e in answers["units"]
        ),
        first_dial_table(results["dials"]),
        pile_table(results["piles"]),
        same_step_table(results["same step"]),
    ]


def short_tables(results):
    """Those that the handout shows."""
    asked = (
        ("tower", "sink"),
        ("stack", "sink"),
        ("pendulum", "stretch"),
        ("swinging", "worst link"),
    )
    return [
        budget_table(results["budgets"]),
        equal_table(results["budgets"]),
        chain_table(results["chain"]),
        order_table(results["smooth"]["systems"]),
        energy_table(results["smooth"]["energy"]),
        fall_table(results["smooth"]["fall"]),
        first_dial_table(results["dials"]),
        *(answer_table(results["dials"][name], error) for name, error in asked),
        pile_table(results["piles"]),
        same_step_table(results["same step"]),
    ]


# ---------------------------------------------------------------- all engines


SHOWN_AS = {"compiled": "stable compiled"}


def shown(engine):
    return SHOWN_AS.get(engine, engine)


def engines_of(budgets):
    """The engines that took part, in their order."""
    return list(next(iter(budgets.values()))["within"])


def budget_table(budgets):
    """The smallest error of each engine in each budget, a row per scene and budget."""
    engines, rows = engines_of(budgets), []
    for scene in budgets.values():
        for i, first in enumerate(scene["within"][engines[0]]):
            cells = [scene["within"][engine][i] for engine in engines]
            name = f"{scene['title']}: {scene['error']} ({scene['unit']})"
            rows.append([name, f"{first['budget']:g} ms", *map(reached, cells)])
    heads = ["scene: error", "a frame", *map(shown, engines)]
    note = (
        "The smallest error within so many ms of each frame of 1/60 s, with steps of 1/120 s in "
        "1, 2, 4, 8 ... substeps. In brackets: from the fastest repeat to the slowest, where they "
        "differ. Too slow: one step alone takes longer."
    )
    return Table("What error each engine reaches in a frame", heads, rows, note)


def reached(cell):
    """An error, and its range where the repeats differ."""
    error, ends = below(cell["error"]), [below(end) for end in cell["range"]]
    return error if ends[0] == ends[1] else f"{error} ({ends[0]} to {ends[1]})"


def below(error):
    """An error in two digits, or that it is too small to matter."""
    if isinstance(error, str):
        return error
    return f"< {number(EXACT)}" if error < EXACT else number(float(f"{error:.2g}"))


def equal_table(budgets):
    """The time each engine takes for the stable engine's error, a row per scene."""
    engines, rows = engines_of(budgets), []
    for scene in budgets.values():
        known = {row["engine"]: row for row in scene["equal"]["rows"]}
        name = f"{scene['title']}: {scene['error']} ({scene['unit']})"
        cells = [known[engine] for engine in engines]
        rows.append([name, below(scene["equal"]["goal"]), *map(needs, cells)])
    heads = ["scene: error", "to reach", *map(shown, engines)]
    most = max(cell["budget"] for cell in scene["within"][engines[0]])
    note = (
        f"Time in shares of the stable engine's at its defaults (4 substeps), whose error is to "
        f"be reached, or a smaller one: from the least share of a repeat to the most. not: not "
        f"within {most:g} ms of a frame."
    )
    return Table("The same error: how much time each engine takes for it", heads, rows, note)


def needs(row):
    if row["reached"]:
        return span(row["ratio"], "x")
    return f"not (comes to {below(row['error'])})" if "error" in row else "not"


def chain_table(study):
    rows = [
        [row["engine"], *(share if isinstance(share, str) else f"{100 * share:.0f} %"
                          for share in row["shares"])]
        for row in study["rows"]
    ]  # fmt: skip
    rows = [row + ["-"] * (len(study["looks"]) + 1 - len(row)) for row in rows]
    heads = ["engine", *(f"after {look} s" for look in study["looks"])]
    title = f"Swinging chain of {study['links']}: the energy it still has"
    note = (
        "In shares of what it is let go with, the mean of the second before. Exactly it is 100 %, "
        "for ever. Steps of 1/120 s, each engine at its defaults."
    )
    return Table(title, heads, rows, note)


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
                " · ".join(span(run["ratio"][1:2]) if run["ratio"] else "-" for run in runs),
                " · ".join(number(millions(run["opcodes"])) for run in runs),
                says(dial["verdicts"][error]),
            ]
        )
    heads = ["engine", "dial", "values", "errors", "time", "M opcodes/s", "work for a digit"]
    title = f"{answers['title']}: {error} ({answers['units'][error]})"
    note = (
        f"{number(answers['seconds'])} s simulated. Time: shares of the lesson's engine at its "
        f"defaults (8 passes, 1/120 s); nine in ten repeats lie within {widest(answers)} of these. "
        "Shared substeps share the 8 passes of one step."
    )
    return Table(title, heads, rows, note)


def widest(answers):
    """How far repeats are from the middle one, but for the tenth of the settings that vary most."""
    ratios = [run["ratio"] for run in answers["runs"] if run["ratio"]]
    off = sorted(max(high - middle, middle - low) / middle for low, middle, high in ratios)
    return f"{100 * off[int(0.9 * (len(off) - 1))]:.0f} %" if off else "-"


def millions(count):
    return None if count is None else count / 1e6


def says(verdict):
    digit = verdict["digit"]
    if digit is None:
        return verdict["says"]
    return digit_price(digit)


def digit_price(digit):
    """Factors of work in two digits, the least and the most that it may be."""
    if digit[0] > 1000:
        return "over 1000x"
    return span([min(one, 1000.0) for one in digit], "x")


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


def pile_table(piles):
    rows = []
    for row in piles:
        asleep = row["asleep"]
        rows.append(
            [
                row["balls"],
                span(spread(row["lesson"]["ms"])) if row["lesson"]["ms"] else "-",
                span(row["stable"]["ratio"], "x"),
                span(row["compiled"]["ratio"], "x") if "compiled" in row else "-",
                span(row["pymunk"]["ratio"], "x"),
                f"{span(asleep['ratio'], 'x')} ({asleep['asleep']} asleep)",
                *(number(row[name]["overlap"]) for name in ("lesson", "stable", "pymunk")),
            ]
        )
    heads = ["balls", "lesson, ms", "stable", "stable compiled", "pymunk", "stable asleep",
             "lesson overlap, px", "stable overlap, px", "pymunk overlap, px"]  # fmt: skip
    grown = [(name, growth(piles, name)) for name in ("lesson", "stable", "pymunk")]
    parts = [f"{name} {span(factor, 'x')}" for name, factor in grown if factor]
    note = (
        "The lesson's time for a frame of 1/60 s, and how many times as fast the others are, from "
        "the least of a repeat to the most. lesson 1/120 s, stable 1/60 s with 8 substeps, pymunk "
        "1/120 s with 10 iterations."
    )
    if parts:
        note += f" From 200 to 1000 balls the time per ball grows: {', '.join(parts)}."
    return Table("Settled piles", heads, rows, note)


def same_step_table(races):
    rows = [
        [
            race["balls"],
            shown(row["engine"]),
            row["substeps"] if row["engine"] in ("stable", "compiled") else "-",
            number(row["overlap"]),
            span(row["ratio"], "x"),
        ]
        for race in races
        for row in race["rows"]
    ]
    heads = ["balls", "engine", "substeps", "overlap, px", "time"]
    note = (
        "Steps of 1/120 s; pymunk with its 10 iterations has the time 1. The fewest substeps that "
        "are accurate enough tell what plain Python costs beside compiled code."
    )
    return Table("Settled piles: the same step as pymunk's", heads, rows, note)
