"""The figures of accuracy.py: error against cost on logarithmic axes, one message in each title.

Failures are crosses at the top edge, errors too small to matter triangles at the bottom edge.
Colours stay apart for colour-blind eyes, and every curve has a marker of its own as well.
"""

import math
import textwrap
from functools import partial
from itertools import pairwise

from .accuracy_tables import digit_price
from .answers import EXACT
from .dials import SHARED
from .smooth import ENERGY_CALLS, slope
from .table import number

FRAME = 1000 / 60  # ms: the time of one frame at 60 frames a second
METHOD_LOOKS = {
    "explicit_euler": ("#D55E00", "o"),
    "semi_implicit_euler": ("#0072B2", "s"),
    "velocity_verlet": ("#009E73", "^"),
    "rk4": ("#CC79A7", "D"),
}
ENGINE_COLOURS = {"lesson": "#D55E00", "stable": "#0072B2", "pymunk": "#009E73", "box2d": "#CC79A7"}
DIAL_LOOKS = {
    "passes": ("o", "-"),
    "step": ("s", "--"),
    "substeps": ("^", ":"),
    SHARED: ("v", ":"),
    "edits": ("D", "none"),
}
ONLY_IN_TABLES = ("late speed", "time")
STYLE = {
    "axes.grid": True,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "figure.dpi": 110,
    "font.size": 10,
    "grid.alpha": 0.25,
    "legend.fontsize": 9,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
    "lines.markersize": 5,
    "svg.fonttype": "none",
    "svg.hashsalt": "accuracy",
}


def draw_all(results, folder, tick=lambda name: None):
    """Write every figure as SVG and PNG; returns their names. Raises ImportError, no matplotlib."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    names = []
    with pyplot.rc_context(STYLE):
        for name, draw in plans(results):
            tick(name)
            figure = draw(pyplot)
            for ending, extra in (("svg", {"metadata": {"Date": None}}), ("png", {})):
                figure.savefig(folder / f"{name}.{ending}", **extra)
            pyplot.close(figure)
            names.append(name)
    return names


def plans(results):
    """(name, draw) of each figure that the results can fill; draw(pyplot) returns the figure."""
    smooth = results["smooth"]
    found = [
        (f"smooth-{system['title']}", partial(smooth_figure, system=system))
        for system in smooth["systems"]
    ]
    found.append(("smooth-energy", partial(energy_figure, study=smooth["energy"])))
    for name, answers in results["dials"].items():
        for error in answers["units"]:
            if worth_drawing(answers, error):
                draw = partial(dial_figure, answers=answers, error=error)
                found.append((f"dials-{name}-{error}".replace(" ", "-"), draw))
    if len(results["piles"]) > 1:
        found.append(("piles", partial(pile_figure, rows=results["piles"])))
    return found


def worth_drawing(answers, error):
    """Whether the lesson's engine has an error to speak of; some stay in the tables."""
    if error in ONLY_IN_TABLES:
        return False
    known = [run["errors"][error] for run in answers["runs"] if run["engine"] == "lesson"]
    return any(not isinstance(e, str) and e > EXACT for e in known)


# ---------------------------------------------------------------- integrators


def smooth_figure(plot, system):
    """Error against step size and against calls of the force, one curve per method."""
    figure, (left, right) = plot.subplots(1, 2, figsize=(10, 4.4), sharey=True)
    figure.subplots_adjust(left=0.09, right=0.97, bottom=0.13, top=0.84, wspace=0.06)
    top = 10 * system["size"]
    for method in system["methods"]:
        colour, marker = METHOD_LOOKS[method["method"]]
        for axes, cost in ((left, "dt"), (right, "calls")):
            points = [(p[cost], p["error"]) for p in method["points"]]
            curve(axes, points, top, color=colour, marker=marker, label=method["method"])
    for order in (1, 2, 4):
        slope_triangle(left, system["methods"], order, top)
    left.set_xlabel("step size (s)")
    right.set_xlabel("how often the force was asked for")
    left.set_ylabel(f"error at the end ({system['unit']})")
    left.set_ylim(top=1.6 * top)
    right.legend(loc="lower left")
    title(figure, smooth_message(system))
    return figure


def curve(axes, points, top, bottom=0.0, **look):
    """A curve; words and errors above top become crosses there, those below bottom triangles."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    plain_ticks(axes)
    inside = [(x, y) for x, y in points if not isinstance(y, str) and bottom < y < top]
    high = [x for x, y in points if isinstance(y, str) or y >= top]
    low = [x for x, y in points if not isinstance(y, str) and y <= bottom]
    axes.plot(*split(inside), **look)
    edge = {"linestyle": "none", "color": look["color"], "clip_on": False, "zorder": 4}
    axes.plot(high, [top] * len(high), marker="x", markersize=8, markeredgewidth=2, **edge)
    axes.plot(low, [bottom] * len(low), marker="v", markersize=7, fillstyle="none", **edge)


def plain_ticks(axes):
    """A line of the grid for every power of ten, written as a plain number.

    matplotlib's own powers of ten take most of the time of a figure.
    """
    from matplotlib import ticker

    axes.minorticks_off()
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(ticker.LogLocator(numticks=99))
        axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))


def split(pairs):
    return [x for x, _ in pairs], [y for _, y in pairs]


def slope_triangle(axes, methods, order, top):
    """A triangle of that slope under the last curve that has settled to that order."""
    curves = [m["points"] for m in methods if m["order"] and m["expected"] == order]
    known = [
        (p["dt"], p["error"])
        for p in (curves[-1] if curves else [])
        if not isinstance(p["error"], str) and p["error"] < top / 200
    ]
    if len(known) < 3:
        return
    x, y = known[-2]
    right, low = x * 2.5, y / 3
    high = low * 2.5**order
    axes.plot([x, right, right, x], [low, low, high, low], color="0.3", linewidth=0.9)
    axes.text(right * 1.08, math.sqrt(low * high), f"order {order}", fontsize=9, va="center")


def smooth_message(system):
    """What one tenth of a percent costs with the cheapest and the dearest method."""
    goal = system["size"] / 1000
    needs = [(calls_for(m["points"], goal), m["method"]) for m in system["methods"]]
    needs = sorted(need for need in needs if need[0] is not None)
    name = system["title"].capitalize()
    if len(needs) < 2:
        return f"{name}: hardly a method gets an error below {number(goal)} {system['unit']}"
    (few, cheap), (many, dear) = needs[0], needs[-1]
    return (
        f"{name}: for an error of {number(goal)} {system['unit']}, {cheap} asks for the force\n"
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


def energy_figure(plot, study):
    """The energy error of an orbit, round by round."""
    figure, axes = plot.subplots(figsize=(7.6, 4.2))
    figure.subplots_adjust(left=0.13, right=0.72, bottom=0.13, top=0.84)
    for row in study:
        colour, marker = METHOD_LOOKS[row["method"]]
        rounds = [(i + 1, peak) for i, peak in enumerate(row["peaks"])]
        peaks = [pair for pair in rounds if pair[0] in SHOWN_ROUNDS or pair == rounds[-1]]
        curve(axes, peaks, 10.0, color=colour, marker=marker, label=row["method"])
    axes.set_xlabel(f"round of the orbit ({ENERGY_CALLS} evaluations of the force each)")
    axes.set_ylabel("largest energy error in that round (share)")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    bounded = [row["method"] for row in study if row["bounded"]]
    says = f"only {' and '.join(bounded)} keep" if bounded else "no method keeps"
    crossing = next((row["passes Verlet"] for row in study if row["method"] == "rk4"), None)
    passed = f". RK4's is larger than Verlet's from round {crossing} on" if crossing else ""
    title(figure, textwrap.fill(f"Orbit: {says} the energy error of the first round{passed}", 84))
    return figure


# ---------------------------------------------------------------- contacts and rods


def dial_figure(plot, answers, error):
    """One error against wall time and against solves, a curve per engine and dial."""
    counted = any(run["solves"] for run in answers["runs"])
    figure, panels = plot.subplots(
        1, 1 + counted, figsize=(7.0 + 4 * counted, 4.8), sharey=True, squeeze=False
    )
    panels, (bottom, top) = panels[0], edges(answers, error)
    left, right, high = (0.08, 0.75, 0.85) if counted else (0.13, 0.62, 0.81)
    figure.subplots_adjust(left=left, right=right, bottom=0.12, top=high, wspace=0.06)
    for axes, cost in zip(panels, (frame_cost, solve_cost), strict=False):
        dial_curves(axes, answers, error, cost, (bottom, top))
    mark_frame(panels[0], bottom)
    if counted:
        panels[1].set_xlabel("solves of contacts and rods per second")
    panels[0].set_ylabel(f"{error} ({answers['units'][error]})")
    panels[0].set_ylim(bottom / 1.3, top * 1.3)
    for axes in panels:
        tick_narrow(axes)
    explain_edges(panels[-1], answers, error, bottom)
    panels[-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    title(figure, textwrap.fill(dial_message(answers, error), 62 + 38 * counted))
    return figure


def dial_curves(axes, answers, error, cost, ends):
    """A curve per engine and dial, and a star where the lesson's engine stands as it is."""
    bottom, top = ends
    for row in answers["dials"]:
        runs = [answers["runs"][i] for i in row["runs"]]
        marker, line = DIAL_LOOKS[row["dial"]]
        look = {"color": ENGINE_COLOURS[row["engine"]], "marker": marker, "linestyle": line}
        points = [(cost(run), run["errors"][error]) for run in runs if cost(run)]
        curve(axes, points, top, bottom, label=f"{row['engine']}: {row['dial']}", **look)
    run = next(run for run in answers["runs"] if run["default"])
    found = run["errors"][error]
    height = top if isinstance(found, str) else min(max(found, bottom), top)
    look = {"marker": "*", "markersize": 15, "color": "#F0E442", "markeredgecolor": "black"}
    if cost(run):
        label = "the lesson's defaults"
        axes.plot([cost(run)], [height], linestyle="none", zorder=5, label=label, **look)


def mark_frame(axes, bottom):
    """A line at the time of one frame."""
    axes.axvline(FRAME, color="0.35", linewidth=1)
    place = {"rotation": 90, "va": "bottom", "ha": "right", "fontsize": 8, "color": "0.35"}
    axes.text(FRAME * 0.95, bottom * 1.3, "a frame, 16.7 ms", **place)
    axes.set_xlabel("wall time per frame of 1/60 s (ms)")


def tick_narrow(axes):
    """More ticks along x where it spans few powers of ten."""
    from matplotlib import ticker

    low, high = axes.get_xlim()
    between = (1, 2, 5) if high / low < 30 else (1,)
    axes.xaxis.set_major_locator(ticker.LogLocator(subs=between))


def explain_edges(axes, answers, error, bottom):
    """Legend entries for what stands at the edges of the axes."""
    found = [run["errors"][error] for run in answers["runs"]]
    look = {"linestyle": "none", "color": "0.3"}
    if any(isinstance(e, str) for e in found):
        axes.plot([], [], marker="x", markeredgewidth=2, label="gave up", **look)
    if any(not isinstance(e, str) and e <= bottom for e in found):
        label = f"below {bottom:g}"
        axes.plot([], [], marker="v", fillstyle="none", label=label, **look)


def frame_cost(run):
    return run["ms"] / 60 if run["ms"] else None


def solve_cost(run):
    return run["solves"]


def edges(answers, error):
    """The lowest and the highest error of the axes: powers of ten around the known ones."""
    known = [run["errors"][error] for run in answers["runs"]]
    known = [e for e in known if not isinstance(e, str)]
    low, high = min(e for e in known if e > EXACT), max(known)
    below = min(known) <= EXACT  # a decade more, for the triangles
    return 10 ** (math.floor(math.log10(low)) - below), 10 ** (math.floor(math.log10(high)) + 1)


def dial_message(answers, error):
    """What one more digit costs with each dial of the lesson's engine, cheapest first."""
    rows = [row for row in answers["dials"] if row["engine"] == "lesson"]
    verdicts = [(row["verdicts"][error], row["dial"]) for row in rows]
    helping = sorted((v["digit"], dial) for v, dial in verdicts if v["says"] == "helps")
    useless = [dial for v, dial in verdicts if v["says"] == "cannot help"]
    name = f"{answers['title'][0].upper()}{answers['title'][1:]}, {error}"
    costs = [f"{digit_price(digit)} by {dial}" for digit, dial in helping]
    says = f"the work for one digit more is {', '.join(costs)}" if costs else "no dial helps"
    hopeless = f"; {' and '.join(useless)} cannot help" if useless else ""
    return f"{name}: with the lesson's engine {says}{hopeless}"


# ---------------------------------------------------------------- piles


PILE_LOOKS = {  # in a row: what it is called, its colour and its marker
    "lesson": ("lesson", ENGINE_COLOURS["lesson"], "o"),
    "stable": ("stable", ENGINE_COLOURS["stable"], "s"),
    "compiled": ("stable, compiled", "#E69F00", "v"),
    "pymunk": ("pymunk", ENGINE_COLOURS["pymunk"], "D"),
    "asleep": ("stable, asleep", "#56B4E9", "^"),
}


def pile_figure(plot, rows):
    """Time per ball against the number of balls, one curve per engine."""
    figure, axes = plot.subplots(figsize=(7.4, 4.4))
    figure.subplots_adjust(left=0.11, right=0.76, bottom=0.13, top=0.88)
    for name, (label, colour, marker) in PILE_LOOKS.items():
        known = [(row["balls"], row.get(name, {}).get("ms")) for row in rows]
        points = [(balls, ms / 60) for balls, ms in known if ms]
        if not points:
            continue
        axes.loglog(*split(points), color=colour, marker=marker, label=label)
    axes.axhline(FRAME, color="0.35", linewidth=1, label="a frame, 16.7 ms")
    plain_ticks(axes)
    axes.set_xticks([row["balls"] for row in rows], [str(row["balls"]) for row in rows])
    axes.set_xlabel("balls in the settled pile")
    axes.set_ylabel("wall time per frame of 1/60 s (ms)")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    last = rows[-1]
    faster = last["stable"]["ratio"]
    share = f"{1 / faster:.0f} times as fast as the lesson's engine" if faster else "unmeasured"
    title(figure, f"{last['balls']} balls: the stable engine is {share}")
    return figure


def title(figure, text):
    """One message, above all panels and to the left."""
    figure.suptitle(text, x=0.02, y=0.98, ha="left", fontsize=11, fontweight="bold")
