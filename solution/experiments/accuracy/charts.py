"""Charts of accuracy.py as plain data: figures.py draws them, and the handouts' pages do too.

A chart is a dictionary: "says" is its message, "y" and each panel's "x" name the axes, "ends" are
the least and the largest value along y. A curve has "points" [x, y]. Points beyond the ends have
x alone, in "high" (or given up) or "low". All axes are logarithmic. "frame" is the axis on which
the time of one frame is marked, if any.
"""

import math
from statistics import median

from .questions import LESSON
from .runs import EXACT, is_number
from .smooth import ENERGY_CALLS
from .tables import name_engine

FRAME_TIME = "time per frame of 1/60 s (ms)"
WORK = "work (the engine as it is: 1)"
SHOWN_ROUNDS = {round(1.25**i) for i in range(30)}  # evenly on a logarithmic axis


def make_charts(results):
    """Yield (name, chart) of each chart that the results can fill."""
    for name, scene in results["budgets"].items():
        yield f"engines-{name}", chart_budgets(scene)
    yield "smooth-spring", chart_spring(results["smooth"]["spring"])
    yield "smooth-energy", chart_energy(results["smooth"]["energy"])
    for name, study in results["dials"].items():
        yield f"dials-{name}", chart_dials(study)


def make_chart(says, y, ends, panels, frame=""):
    return {"says": says, "y": y, "ends": list(ends), "frame": frame, "panels": panels}


def make_curve(look, name, points, ends):
    """Return a curve of points (x, y), with x alone for words and points beyond the ends."""
    bottom, top = ends
    high = [x for x, y in points if not is_number(y) or y >= top]
    low = [x for x, y in points if is_number(y) and y <= bottom]
    inside = [[x, y] for x, y in points if x not in high and x not in low]
    return {"look": look, "name": name, "points": inside, "high": high, "low": low}


def find_ends(errors):
    """Return powers of ten below the smallest error that matters and above the largest."""
    known = [max(error, EXACT) for error in errors if is_number(error)] or [1.0]
    low, high = math.ceil(math.log10(min(known))), math.floor(math.log10(max(known)))
    return 10.0 ** (low - 1), 10.0 ** (high + 1)


def round_numbers(data):
    """Return the same data with its numbers in four digits."""
    if isinstance(data, dict):
        return {key: round_numbers(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [round_numbers(value) for value in data]
    return float(f"{data:.4g}") if isinstance(data, float) else data


def chart_study(study, which, x, curves, ends, frame=""):
    says = f"{study['title'][0].upper()}{study['title'][1:]}: {study['error']} in {which}"
    panels = [{"x": x, "curves": curves}]
    return make_chart(says, f"{study['error']} ({study['unit']})", ends, panels, frame)


def chart_budgets(scene):
    """Chart the error of one scene against time, a curve per engine."""
    fronts = {engine: find_front(scene["runs"], engine) for engine in scene["within"]}
    ends = find_ends([error for points in fronts.values() for _, error in points])
    curves = [make_curve(one, name_engine(one), points, ends) for one, points in fronts.items()]
    return chart_study(scene, "every engine", FRAME_TIME, curves, ends, "x")


def find_front(runs, engine):
    """Return (ms, error) of each run that no other run of its engine beats in both."""
    known = [
        (median(run["ms"]), max(run["error"], EXACT))
        for run in runs
        if run["engine"] == engine and run["ms"] and is_number(run["error"])
    ]
    points = []
    for ms, error in sorted(known):
        if not points or error < points[-1][1]:
            points.append((ms, error))
    return points


def chart_spring(methods):
    """Chart the error against step size and against calls of the force, a curve per method."""
    errors = [point["error"] for row in methods for point in row["points"]]
    ends = min(filter(is_number, errors), default=1.0) / 10, 1000.0
    panels = []
    for cost, x in (("dt", "step size (s)"), ("calls", "how often the force was asked for")):
        curves = []
        for row in methods:
            points = [(point[cost], point["error"]) for point in row["points"]]
            curves.append(make_curve(row["method"], row["method"], points, ends))
        panels.append({"x": x, "curves": curves})
    says = "Spring: half the step divides the error by 2, 4 or 16"
    return make_chart(says, "worst error of the last swing (px)", ends, panels)


def chart_energy(study):
    """Chart the energy error of an orbit, round by round."""
    ends = min(find_ends([peak for row in study for peak in row["peaks"]])[0], 0.1), 10.0
    curves = []
    for row in study:
        rounds = list(enumerate(row["peaks"], 1))
        shown = [pair for pair in rounds if pair[0] in SHOWN_ROUNDS or pair == rounds[-1]]
        curves.append(make_curve(row["method"], row["method"], shown, ends))
    bounded = " and ".join(row["method"] for row in study if row["bounded"])
    says = f"Orbit: {f'only {bounded} keep' if bounded else 'no method keeps'} the energy error"
    x = f"round of the orbit ({ENERGY_CALLS} evaluations each)"
    y = "largest energy error in that round (share)"
    return make_chart(f"{says} of the first round", y, ends, [{"x": x, "curves": curves}])


def chart_dials(study):
    """Chart the error of the lesson's engine against work, a curve per dial."""
    runs = {dial["dial"]: dial["runs"] for dial in study["dials"]}
    passes = next(iter(runs.values()))
    runs["as it is"] = [run for run in passes if run["setting"] == str(LESSON)]
    ends = find_ends([run["error"] for dial in runs.values() for run in dial])
    curves = []
    for dial, ran in runs.items():
        points = [(run["work"], run["error"]) for run in ran if run["work"]]
        curves.append(make_curve(dial, dial, points, ends))
    return chart_study(study, "the lesson's engine, dial by dial", WORK, curves, ends)
