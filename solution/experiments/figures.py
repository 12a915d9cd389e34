"""The figures of accuracy.py: error against cost on logarithmic axes, one message in each title.

Failures are crosses at the top edge, errors too small to matter triangles at the bottom edge.
Colours stay apart for colour-blind eyes, and every curve has a marker of its own as well.
"""

import io
import math
import re
import textwrap
from collections import Counter
from functools import partial
from itertools import pairwise
from statistics import median

from .accuracy_tables import digit_price, needs, shown
from .answers import EXACT
from .budgets import winners
from .costs import spread
from .dials import SHARED
from .smooth import ENERGY_CALLS, slope
from .table import number, span

FRAME = 1000 / 60  # ms: the time of one frame at 60 frames a second


def look(colour, marker, line):
    """How a curve looks: it can be told by its marker and by its line, without its colour."""
    return {"color": colour, "marker": marker, "linestyle": line}


METHOD_LOOKS = {
    "explicit_euler": look("#D55E00", "o", "-"),
    "semi_implicit_euler": look("#0072B2", "s", "--"),
    "velocity_verlet": look("#009E73", "^", "-."),
    "rk4": look("#CC79A7", "D", ":"),
}
ENGINE_LOOKS = {
    "lesson": look("#D55E00", "o", "-"),
    "stable": look("#0072B2", "s", "--"),
    "compiled": look("#56B4E9", "P", (0, (3, 1, 1, 1))),
    "pymunk": look("#009E73", "^", "-."),
    "box2d": look("#CC79A7", "D", ":"),
}
DIAL_LOOKS = {
    "passes": look("#D55E00", "o", "-"),
    "step": look("#0072B2", "s", "--"),
    SHARED: look("#009E73", "v", ":"),
    "edits": look("#CC79A7", "D", "none"),
}
ONLY_IN_TABLES = ("time",)
STYLE = {
    "axes.grid": True,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "figure.dpi": 110,
    "font.sans-serif": ["DejaVu Sans"],
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
            figure.savefig(folder / f"{name}.png")
            with io.StringIO() as drawn:
                figure.savefig(drawn, format="svg", metadata={"Date": None})
                (folder / f"{name}.svg").write_text(slim(drawn.getvalue()), encoding="utf-8")
            pyplot.close(figure)
            names.append(name)
    return names


def slim(svg):
    """The same picture in a third of the bytes: no names, short numbers, each style said once."""
    svg = re.sub(r' id="(?:\w+_\d+|matplotlib\.axis_\d+)"| transform="rotate\(-0 [^"]*"', "", svg)
    svg = re.sub(r'"[^"]*"', lambda value: re.sub(r"(\d\.\d\d)\d+", r"\1", value[0]), svg)
    svg = re.sub(r"<g>\s*(<use [^>]*/>)\s*</g>", r"\1", svg)
    styles = Counter(re.findall(r' style="([^"]*)"', svg))
    rules = ""
    for i, style in enumerate(style for style, count in styles.items() if count > 2):
        svg = svg.replace(f' style="{style}"', f' class="s{i}"')
        rules += f".s{i}{{{style}}}"
    svg = svg.replace("</style>", f"{rules}</style>", 1)
    return re.sub(r"\n\s*", "\n", svg)


def plans(results):
    """(name, draw) of each figure that the results can fill; draw(pyplot) returns the figure."""
    smooth = results["smooth"]
    found = []
    if len(results["budgets"]) == PANELS:
        found.append(("budgets", partial(budget_figure, scenes=results["budgets"])))
    for name, scene in results["budgets"].items():
        found.append((f"engines-{name}".replace(" ", "-"), partial(ladder_figure, scene=scene)))
    found += [
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
    return any(not isinstance(e, str) and e > EXACT for e in errors_of_lesson(answers, error))


# ---------------------------------------------------------------- all engines


PANELS = 6  # of the first figure
SMALLEST = 1e-9  # errors below it are drawn there


def budget_figure(plot, scenes):
    """What error each engine reaches in a frame: a panel per scene, a curve per engine."""
    figure, panels = plot.subplots(2, 3, figsize=(11, 7))
    figure.subplots_adjust(left=0.075, right=0.985, bottom=0.15, top=0.86, wspace=0.27, hspace=0.36)
    for axes, scene in zip(panels.flat, scenes.values(), strict=True):
        budget_panel(axes, scene)
    for axes in panels[1]:
        axes.set_xlabel("time for a frame of 1/60 s")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=len(labels))
    title(figure, textwrap.fill(budget_message(scenes), 110))
    return figure


def budget_panel(axes, scene):
    """One scene: the least error of each engine in each budget, with the range of its repeats."""
    bottom, top = panel_ends(scene)
    engines = list(scene["within"])
    budgets = [cell["budget"] for cell in scene["within"][engines[0]]]
    for place, engine in enumerate(engines):
        aside = 0.1 * (place - (len(engines) - 1) / 2)
        points, lost = [], []
        how = ENGINE_LOOKS[engine]
        for i, cell in enumerate(scene["within"][engine]):
            if isinstance(cell["error"], str):
                lost.append(i + aside)
                continue
            points.append((i + aside, max(cell["error"], SMALLEST)))
            ends = [top if isinstance(end, str) else max(end, SMALLEST) for end in cell["range"]]
            if ends[0] != ends[1]:
                axes.plot([i + aside] * 2, ends, marker="_", markersize=9, color=how["color"])
        axes.plot(*split(points), label=shown(engine), **how)
        cross = {"marker": "x", "markersize": 8, "markeredgewidth": 2, "clip_on": False}
        axes.plot(lost, [top] * len(lost), linestyle="none", color=how["color"], **cross)
    axes.set_yscale("log")
    axes.set_ylim(bottom / 1.5, top * 1.5)
    plain_ticks(axes, "y")
    axes.set_xticks(range(len(budgets)), [f"{ms:g} ms" for ms in budgets])
    axes.set_xlim(-0.5, len(budgets) - 0.5)
    axes.set_title(scene["title"], fontsize=10, loc="left")
    axes.set_ylabel(f"{scene['error']} ({scene['unit']})")


def panel_ends(scene):
    """Powers of ten around all errors of a panel."""
    cells = [cell for row in scene["within"].values() for cell in row]
    ends = [end for cell in cells for end in (cell["error"], *cell["range"])]
    known = [max(error, SMALLEST) for error in ends if not isinstance(error, str)] or [1.0]
    return around(min(known), max(known))


def around(low, high):
    """Powers of ten below the lower and above the higher."""
    return 10 ** (math.ceil(math.log10(low)) - 1), 10 ** (math.floor(math.log10(high)) + 1)


def budget_message(scenes):
    """How often an engine is best with the largest budget, beyond the range of repeats."""
    wins = {}
    for scene in scenes.values():
        best = winners(scene)
        for engine in best:
            wins[engine] = wins.get(engine, 0) + 1
    most = max(
        cell["budget"] for row in next(iter(scenes.values()))["within"].values() for cell in row
    )
    parts = [f"{shown(engine)} in {count}" for engine, count in sorted(wins.items(), key=by_count)]
    return (
        f"The smallest error within {most:g} ms of a frame, of {len(scenes)} scenes (who cannot be "
        f"told apart count both): {', '.join(parts) or 'nobody'}"
    )


def by_count(pair):
    return -pair[1], pair[0]


def ladder_figure(plot, scene):
    """The error of one scene against time, a curve per engine: what is better costs more."""
    figure, axes = plot.subplots(figsize=(7.6, 4.6))
    figure.subplots_adjust(left=0.13, right=0.74, bottom=0.12, top=0.84)
    fronts = {engine: front(scene["runs"], engine) for engine in scene["within"]}
    known = [error for points in fronts.values() for _, error in points]
    bottom, top = around(min(known, default=1.0), max(known, default=1.0))
    for engine, points in fronts.items():
        curve(axes, points, top, label=shown(engine), **ENGINE_LOOKS[engine])
    mark_frame(axes, bottom)
    axes.set_ylim(bottom / 1.5, top * 1.5)
    axes.set_ylabel(f"{scene['error']} ({scene['unit']})")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    title(figure, textwrap.fill(ladder_message(scene), 80))
    return figure


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


def smooth_figure(plot, system):
    """Error against step size and against calls of the force, one curve per method."""
    figure, (left, right) = plot.subplots(1, 2, figsize=(10, 4.4), sharey=True)
    figure.subplots_adjust(left=0.09, right=0.97, bottom=0.13, top=0.84, wspace=0.06)
    top = 10 * system["size"]
    for method in system["methods"]:
        for axes, cost in ((left, "dt"), (right, "calls")):
            points = [(p[cost], p["error"]) for p in method["points"]]
            curve(axes, points, top, label=method["method"], **METHOD_LOOKS[method["method"]])
    for order in (1, 2, 4):
        slope_triangle(left, system["methods"], order, top)
    left.set_xlabel("step size (s)")
    right.set_xlabel("how often the force was asked for")
    left.set_ylabel(f"error at the end ({system['unit']})")
    left.set_ylim(top=1.6 * top)
    right.legend(loc="lower left")
    title(figure, smooth_message(system))
    return figure


def curve(axes, points, top, bottom=0.0, **how):
    """A curve; words and errors above top become crosses there, those below bottom triangles."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    plain_ticks(axes)
    inside = [(x, y) for x, y in points if not isinstance(y, str) and bottom < y < top]
    high = [x for x, y in points if isinstance(y, str) or y >= top]
    low = [x for x, y in points if not isinstance(y, str) and y <= bottom]
    axes.plot(*split(inside), **how)
    edge = {"linestyle": "none", "color": how["color"], "clip_on": False, "zorder": 4}
    axes.plot(high, [top] * len(high), marker="x", markersize=8, markeredgewidth=2, **edge)
    axes.plot(low, [bottom] * len(low), marker="v", markersize=7, fillstyle="none", **edge)


def plain_ticks(axes, which="xy"):
    """A line of the grid for every power of ten, written as a plain number.

    matplotlib's own powers of ten take most of the time of a figure.
    """
    from matplotlib import ticker

    axes.minorticks_off()
    for axis in [{"x": axes.xaxis, "y": axes.yaxis}[name] for name in which]:
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
        rounds = [(i + 1, peak) for i, peak in enumerate(row["peaks"])]
        peaks = [pair for pair in rounds if pair[0] in SHOWN_ROUNDS or pair == rounds[-1]]
        curve(axes, peaks, 10.0, label=row["method"], **METHOD_LOOKS[row["method"]])
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
    """One error of the lesson's engine against time and against solves, a curve per dial."""
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
    """A curve per dial of the lesson's engine, and a star where it stands as it is."""
    bottom, top = ends
    for row in dials_of_lesson(answers):
        runs = [answers["runs"][i] for i in row["runs"]]
        points = [(cost(run), run["errors"][error]) for run in runs if cost(run)]
        curve(axes, points, top, bottom, label=row["dial"], **DIAL_LOOKS[row["dial"]])
    run = next(run for run in answers["runs"] if run["default"])
    found = run["errors"][error]
    height = top if isinstance(found, str) else min(max(found, bottom), top)
    star = {"marker": "*", "markersize": 15, "color": "#F0E442", "markeredgecolor": "black"}
    if cost(run):
        label = "as it is"
        axes.plot([cost(run)], [height], linestyle="none", zorder=5, label=label, **star)


def dials_of_lesson(answers):
    return [row for row in answers["dials"] if row["engine"] == "lesson"]


def errors_of_lesson(answers, error):
    return [run["errors"][error] for run in answers["runs"] if run["engine"] == "lesson"]


def mark_frame(axes, bottom):
    """A line at the time of one frame."""
    axes.axvline(FRAME, color="0.35", linewidth=1)
    place = {"rotation": 90, "va": "bottom", "ha": "right", "fontsize": 8, "color": "0.35"}
    axes.text(FRAME * 0.95, bottom * 1.3, "a frame, 16.7 ms", **place)
    axes.set_xlabel("time per frame of 1/60 s (ms)")


def tick_narrow(axes):
    """More ticks along x where it spans few powers of ten."""
    from matplotlib import ticker

    low, high = axes.get_xlim()
    between = (1, 2, 5) if high / low < 30 else (1,)
    axes.xaxis.set_major_locator(ticker.LogLocator(subs=between))


def explain_edges(axes, answers, error, bottom):
    """Legend entries for what stands at the edges of the axes."""
    found = errors_of_lesson(answers, error)
    grey = {"linestyle": "none", "color": "0.3"}
    if any(isinstance(e, str) for e in found):
        axes.plot([], [], marker="x", markeredgewidth=2, label="gave up", **grey)
    if any(not isinstance(e, str) and e <= bottom for e in found):
        label = f"below {bottom:g}"
        axes.plot([], [], marker="v", fillstyle="none", label=label, **grey)


def frame_cost(run):
    return median(run["ms"]) if run["ms"] else None


def solve_cost(run):
    return run["solves"]


def edges(answers, error):
    """The lowest and the highest error of the axes: powers of ten around the known ones."""
    known = [e for e in errors_of_lesson(answers, error) if not isinstance(e, str)]
    low, high = min(e for e in known if e > EXACT), max(known)
    below = min(known) <= EXACT  # a decade more, for the triangles
    return 10 ** (math.floor(math.log10(low)) - below), 10 ** (math.floor(math.log10(high)) + 1)


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


PILE_LOOKS = ENGINE_LOOKS | {"asleep": look("#E69F00", "v", ":")}
PILE_NAMES = {"asleep": "stable, asleep"}


def pile_figure(plot, rows):
    """Time per ball against the number of balls, one curve per engine."""
    figure, axes = plot.subplots(figsize=(7.4, 4.4))
    figure.subplots_adjust(left=0.11, right=0.76, bottom=0.13, top=0.88)
    for name, how in PILE_LOOKS.items():
        known = [(row["balls"], row.get(name, {}).get("ms")) for row in rows]
        points = [(balls, *spread(ms)) for balls, ms in known if ms]
        if not points:
            continue
        balls, least, middle, most = zip(*points, strict=True)
        axes.fill_between(balls, least, most, color=how["color"], alpha=0.15, linewidth=0)
        axes.loglog(balls, middle, label=PILE_NAMES.get(name) or shown(name), **how)
    axes.axhline(FRAME, color="0.35", linewidth=1, label="a frame, 16.7 ms")
    plain_ticks(axes)
    axes.set_xticks([row["balls"] for row in rows], [str(row["balls"]) for row in rows])
    axes.set_xlabel("balls in the settled pile")
    axes.set_ylabel("time per frame of 1/60 s (ms)")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    last = rows[-1]
    faster = span(last["stable"]["ratio"])
    title(
        figure,
        f"{last['balls']} balls: the stable engine is {faster} times as fast as the lesson's",
    )
    return figure


def title(figure, text):
    """One message, above all panels and to the left."""
    figure.suptitle(text, x=0.02, y=0.98, ha="left", fontsize=11, fontweight="bold")
