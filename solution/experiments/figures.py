"""The figures of accuracy.py: error against cost on logarithmic axes, one message in each title.

What they show is in charts.py. Failures are crosses at the top edge, errors too small to matter
triangles at the bottom edge. Colours stay apart for colour-blind eyes, and every curve has a marker
of its own as well.
"""

import io
import math
import re
import textwrap
from collections import Counter
from functools import partial

from .accuracy_tables import shown
from .budgets import winners
from .charts import FRAME, SMALLEST, all_charts, around
from .dials import SHARED


def look(colour, marker, line):
    """How a curve looks: it can be told by its marker and by its line, without its colour."""
    return {"color": colour, "marker": marker, "linestyle": line}


ENGINE_LOOKS = {
    "lesson": look("#D55E00", "o", "-"),
    "stable": look("#0072B2", "s", "--"),
    "compiled": look("#56B4E9", "P", (0, (3, 1, 1, 1))),
    "asleep": look("#E69F00", "v", ":"),
    "pymunk": look("#009E73", "^", "-."),
    "box2d": look("#CC79A7", "D", ":"),
}
METHOD_LOOKS = {
    "explicit_euler": look("#D55E00", "o", "-"),
    "semi_implicit_euler": look("#0072B2", "s", "--"),
    "velocity_verlet": look("#009E73", "^", "-."),
    "rk4": look("#CC79A7", "D", ":"),
}
STAR = {"markersize": 15, "markeredgecolor": "black", "zorder": 5}
DIAL_LOOKS = {
    "passes": look("#D55E00", "o", "-"),
    "step": look("#0072B2", "s", "--"),
    SHARED: look("#009E73", "v", ":"),
    "edits": look("#CC79A7", "D", "none"),
    "as it is": look("#F0E442", "*", "none") | STAR,
}
LOOKS = ENGINE_LOOKS | METHOD_LOOKS | DIAL_LOOKS
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
    if len(results["budgets"]) == PANELS:
        yield "budgets", partial(budget_figure, scenes=results["budgets"])
    for name, chart in all_charts(results):
        yield name, partial(chart_figure, chart=chart)


# ---------------------------------------------------------------- a chart


def chart_figure(plot, chart):
    """Draw a chart: its panels side by side, its message above, its names on the right."""
    count = len(chart["panels"])
    size = (3 + 4.4 * count, 4.6)
    figure, panels = plot.subplots(1, count, figsize=size, sharey=True, squeeze=False)
    right = 1 - 2 / size[0]
    figure.subplots_adjust(left=0.9 / size[0], right=right, bottom=0.12, top=0.83, wspace=0.06)
    bottom, top = chart["ends"]
    for axes, panel in zip(panels[0], chart["panels"], strict=True):
        for one in panel["curves"]:
            draw_curve(axes, one, bottom, top)
        axes.set_xlabel(panel["x"])
        tick_narrow(axes)
    panels[0][0].set_ylabel(chart["y"])
    panels[0][0].set_ylim(bottom / 1.3, top * 1.3)
    for order, x, y in chart.get("slopes", []):
        draw_slope(panels[0][0], order, x, y)
    mark_frame(panels[0], chart)
    explain_edges(panels[0][-1], chart)
    panels[0][-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    title(figure, textwrap.fill(chart["says"], 46 + 32 * count))
    return figure


def draw_curve(axes, curve, bottom, top):
    """A curve, crosses above and triangles below it, and the range of its repeats."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    plain_ticks(axes)
    how = LOOKS[curve["look"]]
    axes.plot(*split(curve["points"]), label=curve["name"], **how)
    if "range" in curve:
        ends = {"color": how["color"], "alpha": 0.15, "linewidth": 0}
        axes.fill_between(split(curve["points"])[0], *split(curve["range"]), **ends)
    edge = {"linestyle": "none", "color": how["color"], "clip_on": False, "zorder": 4}
    high, low = curve["high"], curve["low"]
    axes.plot(high, [top] * len(high), marker="x", markersize=8, markeredgewidth=2, **edge)
    axes.plot(low, [bottom] * len(low), marker="v", markersize=7, fillstyle="none", **edge)


def draw_slope(axes, order, x, y):
    """A triangle of the slope of that order, under the point (x, y) of a curve."""
    right, low = x * 2.5, y / 3
    high = low * 2.5**order
    axes.plot([x, right, right, x], [low, low, high, low], color="0.3", linewidth=0.9)
    axes.text(right * 1.08, math.sqrt(low * high), f"order {order}", fontsize=9, va="center")


def mark_frame(panels, chart):
    """A line at the time of one frame, on the axis that is a time."""
    line = {"color": "0.35", "linewidth": 1}
    if chart["frame"] == "x":
        panels[0].axvline(FRAME, **line)
        place = {"rotation": 90, "va": "bottom", "ha": "right", "fontsize": 8, "color": "0.35"}
        panels[0].text(FRAME * 0.95, chart["ends"][0] * 1.3, "a frame, 16.7 ms", **place)
    elif chart["frame"] == "y":
        panels[0].axhline(FRAME, label="a frame, 16.7 ms", **line)


def explain_edges(axes, chart):
    """Names for what stands at the edges of the axes."""
    curves = [curve for panel in chart["panels"] for curve in panel["curves"]]
    grey = {"linestyle": "none", "color": "0.3"}
    if any(curve["high"] for curve in curves):
        axes.plot([], [], marker="x", markeredgewidth=2, label="beyond, or gave up", **grey)
    if any(curve["low"] for curve in curves):
        label = f"below {chart['ends'][0]:g}"
        axes.plot([], [], marker="v", fillstyle="none", label=label, **grey)


# ---------------------------------------------------------------- all engines


PANELS = 6  # of the first figure


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


# ---------------------------------------------------------------- axes and titles


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


def tick_narrow(axes):
    """More ticks along x where it spans few powers of ten."""
    from matplotlib import ticker

    low, high = axes.get_xlim()
    between = (1, 2, 5) if high / low < 30 else (1,)
    axes.xaxis.set_major_locator(ticker.LogLocator(subs=between))


def title(figure, text):
    """One message, above all panels and to the left."""
    figure.suptitle(text, x=0.02, y=0.98, ha="left", fontsize=11, fontweight="bold")
