"""What the figures of accuracy.py show, as plain data: figures.py draws it, and the pages do too.

A chart is a dictionary: "says" is its message, "y" and each panel's "x" are what the axes say,
"ends" the least and the largest value along y, "slopes" places [order, x, y] where a curve has
settled to an order. A curve has "points" [x, y], perhaps the "range" [least, most] of each, and the
places along x of what lies beyond the ends: "high" (or given up) and "low". All axes are
logarithmic.
"""

import math
from itertools import pairwise
from statistics import median

from .accuracy_tables import digit_price, needs, shown
from .answers import EXACT
from .costs import spread
from .smooth import ENERGY_CALLS, slope
from .table import number, span

FRAME = 1000 / 60  # ms: the time of one frame at 60 frames a second
FRAME_TIME = "time per frame of 1/60 s (ms)"
SMALLEST = 1e-9  # errors below it are drawn there
ONLY_IN_TABLES = ("time",)


def all_charts(results):
    """(name, chart) of each chart that the results can fill."""
    smooth = results["smooth"]
    for name, scene in results["budgets"].items():
        yield f"engines-{name}".replace(" ", "-"), ladder_chart(scene)
    for system in smooth["systems"]:
        yield f"smooth-{system['title']}", smooth_chart(system)
    yield "smooth-energy", energy_chart(smooth["energy"])
    for name, answers in results["dials"].items():
        for error in answers["units"]:
            if worth_drawing(answers, error):
                yield f"dials-{name}-{error}".replace(" ", "-"), dial_chart(answers, error)
    if len(results["piles"]) > 1:
        yield "piles", pile_chart(results["piles"])


def chart(says, y, ends, panels, frame=""):
    """frame is the axis on which the time of a frame is to be marked, if any."""
    return {"says": says, "y": y, "ends": list(ends), "frame": frame, "panels": panels}


def curve(look, name, points, ends=(0.0, math.inf)):
    """A curve of (x, y); words and what lies beyond the ends are told by their place alone."""
    bottom, top = ends
    high = [x for x, y in points if isinstance(y, str) or y >= top]
    low = [x for x, y in points if not isinstance(y, str) and y <= bottom]
    inside = [[x, y] for x, y in points if x not in high and x not in low]
    return {"look": look, "name": name, "points": inside, "high": high, "low": low}


def around(low, high):
    """Powers of ten below the lower and above the higher."""
    return 10.0 ** (math.ceil(math.log10(low)) - 1), 10.0 ** (math.floor(math.log10(high)) + 1)


def rounded(data):
    """The same data, its numbers in four digits."""
    if isinstance(data, dict):
        return {key: rounded(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [rounded(value) for value in data]
    return float(f"{data:.4g}") if isinstance(data, float) else data


# ---------------------------------------------------------------- engines


def ladder_chart(scene):
    """The error of one scene against time, a curve per engine: what is better costs more."""
    fronts = {engine: front(scene["runs"], engine) for engine in scene["within"]}
    known = [error for points in fronts.values() for _, error in points]
    ends = around(min(known, default=1.0), max(known, default=1.0))
    curves = [curve(engine, shown(engine), points, ends) for engine, points in fronts.items()]
    y = f"{scene['error']} ({scene['unit']})"
    return chart(ladder_message(scene), y, ends, [{"x": FRAME_TIME, "curves": curves}], "x")


def front(runs, engine):
    """The settings of an engine of which no other is both faster and better, as (ms, error)."""
    known = [
        (median(run["ms"]), max(run["error"], SMALLEST))
        for run in runs
        if run["engine"] == engine and run["ms"] and not isinstance(run["error"], str)
    ]
    points = []
    for ms, error in sorted(known):
        if not points or error < points[-1][1]:
            points.append((ms, error))
    return points


def ladder_message(scene):
    """What an error as small as the stable engine's costs in the other engines."""
    name = f"{scene['title'][0].upper()}{scene['title'][1:]}, {scene['error']}"
    parts = [
        f"{shown(row['engine'])} {needs(row)}"
        for row in scene["equal"]["rows"]
        if row["engine"] != "stable"
    ]
    return f"{name}: time for the stable engine's error, in shares of its own: {', '.join(parts)}"


# ---------------------------------------------------------------- integrators


def smooth_chart(system):
    """Error against step size and against calls of the force, one curve per method."""
    top = 10 * system["size"]
    known = [
        point["error"]
        for method in system["methods"]
        for point in method["points"]
        if not isinstance(point["error"], str)
    ]
    ends = around(min(known), top)[0], top
    panels = []
    for cost, x in (("dt", "step size (s)"), ("calls", "how often the force was asked for")):
        curves = []
        for method in system["methods"]:
            points = [(point[cost], point["error"]) for point in method["points"]]
            curves.append(curve(method["method"], method["method"], points, ends))
        panels.append({"x": x, "curves": curves})
    y = f"error at the end ({system['unit']})"
    slopes = [slope for order in (1, 2, 4) for slope in settled(system["methods"], order, top)]
    return chart(smooth_message(system), y, ends, panels) | {"slopes": slopes}


def settled(methods, order, top):
    """[[order, step, error]], a place where the last curve of that order has settled to it."""
    curves = [m["points"] for m in methods if m["order"] and m["expected"] == order]
    known = [
        [order, point["dt"], point["error"]]
        for point in (curves[-1] if curves else [])
        if not isinstance(point["error"], str) and point["error"] < top / 200
    ]
    return known[-2:-1] if len(known) >= 3 else []


def smooth_message(system):
    """What one tenth of a percent costs with the cheapest and the dearest method."""
    goal = system["size"] / 1000
    calls = [(calls_for(m["points"], goal), m["method"]) for m in system["methods"]]
    calls = sorted(pair for pair in calls if pair[0] is not None)
    name = system["title"].capitalize()
    if len(calls) < 2:
        return f"{name}: hardly a method gets an error below {number(goal)} {system['unit']}"
    (few, cheap), (many, dear) = calls[0], calls[-1]
    return (
        f"{name}: for an error of {number(goal)} {system['unit']}, {cheap} asks for the force "
        f"{few:.0f} times, {dear} {many:.0f} times"
    )


def calls_for(points, goal):
    """Calls at which the error goes through the goal, between two runs on logarithmic axes."""
    known = [(p["calls"], p["error"]) for p in points if not isinstance(p["error"], str)]
    for (calls, error), (more, less) in pairwise(known):
        if error >= goal > less:
            steep = slope([(calls, error), (more, less)])
            return calls * (goal / error) ** (1 / steep)
    return None


SHOWN_ROUNDS = {round(1.25**i) for i in range(30)}  # evenly on a logarithmic axis


def energy_chart(study):
    """The energy error of an orbit, round by round."""
    known = [peak for row in study for peak in row["peaks"] if not isinstance(peak, str)]
    ends = around(min(known), 5.0)
    curves = []
    for row in study:
        rounds = [(i + 1, peak) for i, peak in enumerate(row["peaks"])]
        peaks = [pair for pair in rounds if pair[0] in SHOWN_ROUNDS or pair == rounds[-1]]
        curves.append(curve(row["method"], row["method"], peaks, ends))
    x = f"round of the orbit ({ENERGY_CALLS} evaluations each)"
    y = "largest energy error in that round (share)"
    return chart(energy_message(study), y, ends, [{"x": x, "curves": curves}])


def energy_message(study):
    """Which methods keep their error, and where RK4's becomes larger than Verlet's."""
    bounded = [row["method"] for row in study if row["bounded"]]
    says = f"only {' and '.join(bounded)} keep" if bounded else "no method keeps"
    crossing = next((row["passes Verlet"] for row in study if row["method"] == "rk4"), None)
    passed = f". RK4's is larger than Verlet's from round {crossing} on" if crossing else ""
    return f"Orbit: {says} the energy error of the first round{passed}"


# ---------------------------------------------------------------- contacts and rods


def worth_drawing(answers, error):
    """Whether the lesson's engine has an error to speak of; some stay in the tables."""
    if error in ONLY_IN_TABLES:
        return False
    return any(not isinstance(e, str) and e > EXACT for e in errors_of_lesson(answers, error))


def dial_chart(answers, error):
    """One error of the lesson's engine against time and against solves, a curve per dial."""
    ends = dial_ends(answers, error)
    costs = [(FRAME_TIME, lambda run: median(run["ms"]) if run["ms"] else None)]
    if any(run["solves"] for run in answers["runs"]):
        costs.append(("solves of contacts and rods per second", lambda run: run["solves"]))
    panels = [
        {"x": x, "curves": list(dial_curves(answers, error, cost, ends))} for x, cost in costs
    ]
    y = f"{error} ({answers['units'][error]})"
    return chart(dial_message(answers, error), y, ends, panels, "x")


def dial_curves(answers, error, cost, ends):
    """A curve per dial of the lesson's engine, and one point where it stands as it is."""

    def points(runs):
        return [(cost(run), run["errors"][error]) for run in runs if cost(run)]

    for row in dials_of_lesson(answers):
        runs = [answers["runs"][i] for i in row["runs"]]
        yield curve(row["dial"], row["dial"], points(runs), ends)
    default = next(run for run in answers["runs"] if run["default"])
    yield curve("as it is", "as it is", points([default]), ends)


def dials_of_lesson(answers):
    return [row for row in answers["dials"] if row["engine"] == "lesson"]


def errors_of_lesson(answers, error):
    return [run["errors"][error] for run in answers["runs"] if run["engine"] == "lesson"]


def dial_ends(answers, error):
    """The lowest and the highest error of the axes: powers of ten around the known ones."""
    known = [e for e in errors_of_lesson(answers, error) if not isinstance(e, str)]
    low, high = min(e for e in known if e > EXACT), max(known)
    below = min(known) <= EXACT  # a decade more, for what lies below
    return 10.0 ** (math.floor(math.log10(low)) - below), 10.0 ** (math.floor(math.log10(high)) + 1)


def dial_message(answers, error):
    """What one more digit costs with each dial of the lesson's engine, cheapest first."""
    verdicts = [(row["verdicts"][error], row["dial"]) for row in dials_of_lesson(answers)]
    helping = sorted((v["digit"], dial) for v, dial in verdicts if v["says"] == "helps")
    useless = [dial for v, dial in verdicts if v["says"] == "cannot help"]
    name = f"{answers['title'][0].upper()}{answers['title'][1:]}, {error}"
    costs = [f"{digit_price(digit)} by {dial}" for digit, dial in helping]
    says = f"the work for one digit more is {', '.join(costs)}" if costs else "no dial helps"
    hopeless = f"; {' and '.join(useless)} cannot help" if useless else ""
    return f"{name}: with the lesson's engine {says}{hopeless}"


# ---------------------------------------------------------------- piles


PILE_NAMES = {"asleep": "stable, asleep"}
PILED = ("lesson", "stable", "compiled", "asleep", "pymunk", "box2d")


def pile_chart(rows):
    """Time per frame against the number of balls, a curve per engine with its range of repeats."""
    curves = []
    for engine in PILED:
        known = [(row["balls"], row.get(engine, {}).get("ms")) for row in rows]
        runs = [(balls, *spread(ms)) for balls, ms in known if ms]
        if runs:
            points = [(balls, middle) for balls, _, middle, _ in runs]
            one = curve(engine, PILE_NAMES.get(engine) or shown(engine), points)
            curves.append(one | {"range": [[least, most] for _, least, _, most in runs]})
    times = [time for one in curves for ends in one["range"] for time in ends]
    last = rows[-1]
    faster = span(last["stable"]["ratio"])
    says = f"{last['balls']} balls: the stable engine is {faster} times as fast as the lesson's"
    panel = {"x": "balls in the settled pile", "curves": curves}
    return chart(says, FRAME_TIME, around(min(times), max(times)), [panel], "y")
