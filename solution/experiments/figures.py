"""Draw figures by matplotlib: the charts of accuracy.py, and the prices of effects as bars.

In a chart, crosses at the top edge are failures. Triangles at the bottom edge are errors too small
to matter. Colour-blind readers can tell the colours apart, and every curve has its own marker.
"""

import io
import re
import textwrap
from collections import Counter

from .accuracy.questions import SHARED
from .accuracy.runs import FRAMES

FRAME = 1000 / FRAMES  # ms
NO_MATPLOTLIB = "To draw the figures, install matplotlib: python -m pip install matplotlib"


def make_look(colour, marker, line):
    """Return the colour, marker and line of a curve."""
    return {"color": colour, "marker": marker, "linestyle": line}


LOOKS = {
    "lesson": make_look("#c2384a", "o", "-"),
    "stable": make_look("#2f6db5", "s", "--"),
    "compiled": make_look("#23272f", "P", (0, (3, 1, 1, 1))),
    "pymunk": make_look("#d07a1a", "^", "-."),
    "box2d": make_look("#2f8f57", "D", ":"),
    "explicit_euler": make_look("#c2384a", "o", "-"),
    "semi_implicit_euler": make_look("#2f6db5", "s", "--"),
    "velocity_verlet": make_look("#2f8f57", "^", "-."),
    "rk4": make_look("#d07a1a", "D", ":"),
    "passes": make_look("#c2384a", "o", "-"),
    "step": make_look("#2f6db5", "s", "--"),
    SHARED: make_look("#2f8f57", "v", ":"),
    "as it is": make_look("#23272f", "*", "none") | {"markersize": 13, "zorder": 5},
}
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
    "svg.hashsalt": "experiments",  # so that equal numbers give equal files
}
BARS = ("#bbbbbb", "#0072b2", "#56b4e9", "#009e73", "#d55e00", "#e69f00", "#f0e442", "#cc79a7",
        "#444444")  # fmt: skip


def draw_figures(named, folder):
    """Write each of the (name, data) as SVG and PNG. Return a sentence about where they are."""
    try:
        import matplotlib
    except ImportError:
        return NO_MATPLOTLIB
    matplotlib.use("Agg")
    from matplotlib import pyplot

    names = []
    with pyplot.rc_context(STYLE):
        for name, data in named:
            figure = draw_bars(pyplot, data) if "bars" in data else draw_chart(pyplot, data)
            figure.savefig(folder / f"{name}.png")
            with io.StringIO() as drawn:
                figure.savefig(drawn, format="svg", metadata={"Date": None})
                (folder / f"{name}.svg").write_text(shorten(drawn.getvalue()), encoding="utf-8")
            pyplot.close(figure)
            names.append(name)
    return f"Figures in {folder}: {', '.join(names)}."


def shorten(svg):
    """Return the picture in a third of the bytes: without names, with short numbers."""
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


def draw_chart(plot, chart):
    """Draw a chart: its panels side by side, its message above, its names on the right."""
    count = len(chart["panels"])
    size = (3 + 4.4 * count, 4.6)
    figure, panels = plot.subplots(1, count, figsize=size, sharey=True, squeeze=False)
    right = 1 - 2 / size[0]
    figure.subplots_adjust(left=0.9 / size[0], right=right, bottom=0.12, top=0.83, wspace=0.06)
    bottom, top = chart["ends"]
    for axes, panel in zip(panels[0], chart["panels"], strict=True):
        axes.set_xscale("log")
        axes.set_yscale("log")
        for curve in panel["curves"]:
            draw_curve(axes, curve, bottom, top)
        axes.set_xlabel(panel["x"])
        axes.set_ylim(bottom / 1.3, top * 1.3)
        set_ticks(axes)
    panels[0][0].set_ylabel(chart["y"])
    if chart["frame"]:
        panels[0][0].axvline(FRAME, color="0.35", linewidth=1, label=f"a frame, {FRAME:.1f} ms")
    explain_edges(panels[0][-1], chart)
    panels[0][-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    words = textwrap.fill(chart["says"], 46 + 32 * count)
    figure.suptitle(words, x=0.02, y=0.98, ha="left", fontsize=11, fontweight="bold")
    return figure


def draw_curve(axes, curve, bottom, top):
    """Draw a curve, with crosses above and triangles below it."""
    look, points = LOOKS[curve["look"]], curve["points"]
    axes.plot([x for x, _ in points], [y for _, y in points], label=curve["name"], **look)
    edge = {"linestyle": "none", "color": look["color"], "clip_on": False, "zorder": 4}
    high, low = curve["high"], curve["low"]
    axes.plot(high, [top] * len(high), marker="x", markersize=8, markeredgewidth=2, **edge)
    axes.plot(low, [bottom] * len(low), marker="v", markersize=7, fillstyle="none", **edge)


def set_ticks(axes):
    """Write powers of ten as plain numbers, and more along an axis that spans few of them.

    matplotlib's own powers of ten take most of the time of a figure.
    """
    from matplotlib import ticker

    axes.minorticks_off()
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        between = (1, 2, 5) if high / low < 30 else (1,)
        axis.set_major_locator(ticker.LogLocator(subs=between, numticks=99))
        axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))


def explain_edges(axes, chart):
    """Add names for the marks at the edges of the axes."""
    curves = [curve for panel in chart["panels"] for curve in panel["curves"]]
    grey = {"linestyle": "none", "color": "0.3"}
    if any(curve["high"] for curve in curves):
        axes.plot([], [], marker="x", markeredgewidth=2, label="beyond, or gave up", **grey)
    if any(curve["low"] for curve in curves):
        label = f"below {chart['ends'][0]:g}"
        axes.plot([], [], marker="v", fillstyle="none", label=label, **grey)


def draw_bars(plot, data):
    """Draw a bar for each name in bars, of pieces {title: length} one after the other."""
    figure, axes = plot.subplots(figsize=(8, 3.8), layout="constrained")
    names = list(data["bars"])
    starts = [0.0] * len(names)
    for title, colour in zip(data["bars"][names[0]], BARS, strict=True):
        lengths = [data["bars"][name][title] for name in names]
        axes.barh(names, lengths, left=starts, color=colour, label=title, height=0.62)
        starts = [start + length for start, length in zip(starts, lengths, strict=True)]
    axes.grid(visible=False)
    axes.invert_yaxis()
    axes.set_xlabel(data["x"])
    axes.set_title(data["says"], loc="left")
    figure.legend(loc="outside lower center", ncols=5)
    return figure
