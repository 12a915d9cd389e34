"""Draw the computed figures of the lesson and of the leaderboard, as SVG in handouts/figures.

    python handouts/make_figures.py

The solution's own engine computes them, or results.json has their numbers. The same run gives the
same files. Figures without numbers, such as step-order.svg, are edited by hand.
"""

import json
import math
import sys
from pathlib import Path

from pygame import Vector2

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "solution"))

import integrators  # noqa: E402  (found in the folder above)
import mini_engine  # noqa: E402
from mini_engine import MAX_STEPS, STEP, Body, Box, Circle, World, advance  # noqa: E402

FIGURES = HERE / "figures"
INK, GREY, PALE = "#23272f", "#8a909c", "#eceef2"
BLUE, ORANGE, GREEN, RED = "#2f6db5", "#d07a1a", "#2f8f57", "#c2384a"
FRAMES = [17, 17, 24, 12, 140, 17]  # ms, in the figure of the accumulator
SWING = 12  # steps per swing of the spring in the figure of the integrators


class Svg:
    """A drawing on white paper. Positions are in px, y grows down."""

    def __init__(self, width, height, title):
        self.size = width, height
        self.parts = [f"<title>{title}</title>"]
        self.rect(0, 0, width, height, "white")

    def add(self, name, text="", **attributes):
        words = " ".join(f'{k.replace("_", "-")}="{say(v)}"' for k, v in attributes.items())
        self.parts.append(f"<{name} {words}>{text}</{name}>" if text else f"<{name} {words}/>")

    def rect(self, x, y, width, height, fill, stroke="none", rx=0):
        box = {"x": x, "y": y, "width": width, "height": height, "rx": rx}
        self.add("rect", **box, fill=fill, stroke=stroke)

    def circle(self, x, y, r, fill="none", stroke="none"):
        self.add("circle", cx=x, cy=y, r=r, fill=fill, stroke=stroke, stroke_width=2)

    def line(self, *points, color=INK, width=2, dash=None):
        more = {"stroke_dasharray": dash} if dash else {}
        path = " ".join(f"{say(x)},{say(y)}" for x, y in points)
        self.add("polyline", points=path, fill="none", stroke=color, stroke_width=width, **more)

    def arrow(self, start, end, color=INK, width=2):
        """Draw a line with a head at its end."""
        (x, y), back = end, math.atan2(start[1] - end[1], start[0] - end[0])
        self.line(start, end, color=color, width=width)
        sides = [(x + 9 * math.cos(back + t), y + 9 * math.sin(back + t)) for t in (-0.45, 0.45)]
        path = " ".join(f"{say(a)},{say(b)}" for a, b in [sides[0], end, sides[1]])
        self.add("polygon", points=path, fill=color)

    def text(self, x, y, words, color=INK, size=15, anchor="start", weight="normal"):
        place = {"x": x, "y": y, "fill": color, "font_size": size}
        self.add("text", words, **place, text_anchor=anchor, font_weight=weight)

    def save(self, name):
        width, height = self.size
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            f'width="{width}" height="{height}" font-family="sans-serif" role="img">'
        )
        text = "\n".join([head, *self.parts, "</svg>", ""])
        (FIGURES / name).write_text(text, encoding="utf-8", newline="\n")


def say(value):
    """Return a number with at most one decimal, and anything else unchanged."""
    return f"{value:.1f}".removesuffix(".0") if isinstance(value, float) else str(value)


class Plot:
    """Axes on a drawing, from (x0, y0) at the lower left to (x1, y1) in their own units."""

    def __init__(self, svg, left, top, width, height, x, y):
        self.svg, self.left, self.top, self.width, self.height = svg, left, top, width, height
        self.x, self.y = x, y

    def at(self, x, y):
        (x0, x1), (y0, y1) = self.x, self.y
        right = self.left + self.width * (x - x0) / (x1 - x0)
        return right, self.top + self.height * (1 - (y - y0) / (y1 - y0))

    def axes(self, xs, ys, x_name, y_name, x_text="{:g}", y_text="{:g}"):
        """Draw a grid with numbers, and the names of the axes."""
        svg, bottom = self.svg, self.top + self.height
        for y in ys:
            svg.line(self.at(self.x[0], y), self.at(self.x[1], y), color=PALE, width=1)
            place = self.at(self.x[0], y)
            svg.text(place[0] - 8, place[1] + 5, y_text.format(y), GREY, 13, "end")
        for x in xs:
            place = self.at(x, self.y[0])
            svg.text(place[0], bottom + 19, x_text.format(x), GREY, 13, "middle")
        corners = [(self.left, self.top), (self.left, bottom), (self.left + self.width, bottom)]
        svg.line(*corners, color=GREY, width=1)
        svg.text(self.left + self.width / 2, bottom + 40, x_name, INK, 14, "middle")
        svg.text(self.left - 8, self.top - 12, y_name, INK, 14)

    def curve(self, points, color, width=2, dash=None):
        self.svg.line(*(self.at(x, y) for x, y in points), color=color, width=width, dash=dash)


# ---------------------------------------------------------------- the accumulator


class StepCounter:
    """A world that has a step and nothing else."""

    def step(self, dt):
        pass


def accumulator():
    """Draw frames of several lengths, the steps each one runs, and the time left for the next."""
    svg = Svg(860, 280, "Frames, steps and the remainder that waits")
    scale, x, waiting = 3.3, 84.0, 0.0  # px per ms, px, s
    for name, y in (("frame", 62), ("counted", 112), ("steps", 162), ("waiting", 212)):
        svg.text(14, y, name, INK, 15)
    for length in FRAMES:
        width = scale * length
        counted = min(length, 1000 * MAX_STEPS * STEP)
        rest, steps = advance(StepCounter(), waiting, length / 1000)
        svg.rect(x, 44, width - 4, 26, PALE, GREY, rx=3)
        svg.text(x + width / 2 - 2, 62, f"{length} ms", INK, 13, "middle")
        svg.rect(x, 94, scale * counted - 4, 26, "#dbe8f7", BLUE, rx=3)
        if counted < length:
            svg.text(x + scale * counted + 6, 112, "given up: the cap", RED, 14)
        for i in range(steps):
            svg.rect(x + 10.5 * i, 146, 8, 22, BLUE, rx=2)
        svg.rect(x, 198, max(scale * 1000 * rest, 1.0), 18, ORANGE, rx=2)
        svg.text(x, 234, f"{1000 * rest:.1f}", INK, 13)
        x, waiting = x + width, rest
    svg.text(
        84, 262, f"One blue bar is one step of {1000 * STEP:.2f} ms. Orange: ms that wait.", GREY
    )
    svg.save("accumulator.svg")


# ---------------------------------------------------------------- damping


def damping():
    svg = Svg(860, 330, "What is left of a speed: a share per step, and a rate per second")
    halves = [
        ("0.99 in every step", per_step),
        ("exp(-rate · dt), rate 0.6 per second", per_second),
    ]
    for i, (name, share) in enumerate(halves):
        plot = Plot(svg, 60 + 425 * i, 60, 310, 200, (0, 1), (0, 1))
        plot.axes([0, 0.5, 1], [0, 0.25, 0.5, 0.75, 1], "time in s", name, y_text="{:.0%}")
        for hertz, color, dash in ((60, BLUE, None), (120, ORANGE, "9 6"), (240, GREEN, "2 5")):
            points = [(n / hertz, share(n, hertz)) for n in range(0, hertz + 1, hertz // 30)]
            plot.curve(points, color, 3, dash)
            if i == 0:
                place = plot.at(*points[-1])
                svg.text(place[0] + 6, place[1] + 5, f"{hertz} Hz", color, 14)
    svg.text(*plot.at(0.97, 0.82), "60, 120 and 240 Hz", INK, 14, "end")
    svg.save("damping.svg")


def per_step(steps, hertz):
    return 0.99**steps


def per_second(steps, hertz):
    """Return the share of a speed that the solution's world leaves."""
    world = World(gravity=(0, 0), linear_damping=0.6, angular_damping=0)
    ball = world.add(Body(Circle(10), (0, 0), mass=1))
    ball.vel.x = 1.0
    for _ in range(steps):
        world.step(1 / hertz)
    return ball.vel.x


# ---------------------------------------------------------------- integrators


def spirals():
    svg = Svg(860, 300, f"Four integrators on a spring, {SWING} steps per swing")
    colors = {"explicit_euler": RED, "semi_implicit_euler": BLUE}
    colors |= {"velocity_verlet": ORANGE, "rk4": GREEN}
    circle = [math.tau * n / 60 for n in range(61)]
    for i, (name, color) in enumerate(colors.items()):
        plot = Plot(svg, 10 + 212 * i, 50, 200, 200, (-170, 170), (-170, 170))
        plot.curve([(100 * math.cos(t), 100 * math.sin(t)) for t in circle], GREY, 1, "3 3")
        x, v, points = 100.0, 0.0, [(100.0, 0.0)]
        for _ in range(SWING if name == "explicit_euler" else 3 * SWING):
            x, v = getattr(integrators, name)(x, v, 1 / SWING, integrators.spring)
            points.append((x, v / integrators.OMEGA))
        inside = [p for p in points if max(map(abs, p)) <= 190]
        plot.curve(inside, color)
        for point in inside:
            svg.circle(*plot.at(*point), 3, color)
        svg.text(110 + 212 * i, 32, name.replace("_", " "), color, 15, "middle", "bold")
    words = "To the right: the place. Upwards: the speed. Dashed: the exact swing."
    svg.text(430, 282, words, GREY, 14, "middle")
    svg.save("integrators.svg")


# ---------------------------------------------------------------- impulses


def effective_mass():
    """Draw the same impulse at three points of a disc, and how the disc gives way."""
    svg = Svg(860, 300, "How a disc gives way to an impulse, by where it is hit")
    disc, fixed = Body(Circle(60), (0, 0), mass=2), Body(Box((1, 1)), (0, 0))
    push = Vector2(0, 1)
    for i, (name, share) in enumerate([("at the middle", 0), ("half-way", 0.5), ("at the rim", 1)]):
        x, arm = 130 + 290 * i, Vector2(60 * share, 0)
        k = mini_engine.effective_mass(disc, fixed, arm, Vector2(), push)
        svg.circle(x, 150, 60, "#dbe8f7", BLUE)
        svg.circle(x, 150, 3, INK)
        if share:
            svg.line((x, 150), (x + arm.x, 150), color=ORANGE, width=3)
            svg.text(x + arm.x / 2, 172, "arm r", ORANGE, 15, "middle")
        svg.arrow((x + arm.x, 60), (x + arm.x, 144), RED, 3)
        svg.text(x, 30, f"hit {name}", INK, 16, "middle", "bold")
        spin = k - disc.inv_mass
        words = f"1/m + spin term = {disc.inv_mass:.2f} + {spin:.3g} = {k:.3g}"
        svg.text(x, 245, words, INK, 14, "middle")
    svg.text(430, 282, "A disc of 2 kg: per kg, how far it gives way there.", GREY, 14, "middle")
    svg.save("effective-mass.svg")


# ---------------------------------------------------------------- rolling


def rolling():
    svg = Svg(860, 330, "A ball that slides at 300 px/s comes to roll at 200")
    plot = Plot(svg, 80, 50, 700, 210, (0, 0.4), (0, 300))
    plot.axes([0, 0.1, 0.2, 0.3, 0.4], [0, 100, 200, 300], "time in s", "px/s")
    world = World(linear_damping=0, angular_damping=0)
    world.add(Body(Box((5000, 500)), (0, 500)))
    ball = world.add(Body(Circle(20), (0, -19.99), mass=4))
    ball.vel.x = 300
    speeds, spins = [(0, 300)], [(0, 0)]
    for n in range(round(0.4 / STEP)):
        world.step(STEP)
        speeds.append(((n + 1) * STEP, ball.vel.x))
        spins.append(((n + 1) * STEP, ball.omega * 20))
    plot.curve(speeds, BLUE, 3)
    plot.curve(spins, ORANGE, 3)
    svg.text(*plot.at(0.06, 280), "speed", BLUE, 15)
    svg.text(*plot.at(0.09, 80), "spin · radius", ORANGE, 15)
    svg.text(*plot.at(0.25, 215), "from here on it rolls", INK, 15)
    svg.save("rolling.svg")


# ---------------------------------------------------------------- leaderboard


ENGINES = {  # an engine has the same color in every figure
    "lesson": RED,
    "stable": BLUE,
    "compiled": INK,
    "pymunk": ORANGE,
    "pymunk4": ORANGE,
    "box2d": GREEN,
    "box2d3": "#1d6f74",
    "rapier": "#7b4ea3",
    "planck": GREY,
}
BARS = {"at equal substeps": (0, 1.0), "at equal time": (17, 0.4)}  # px down, and how opaque
LEFT, FULL = 284, 380  # px, where bars begin, and how long one of all rows is


def leaderboard():
    """Draw the share of its rows that each engine holds: two bars each, the best on top."""
    lines = json.loads((HERE / "results.json").read_text(encoding="utf-8"))["hard-cases.md"]

    def share(name, words):
        asked = lines[f"{name}: rows {words}"]
        return lines[f"{name}: rows held {words}"] / asked if asked else 0.0

    names = [name for name in ENGINES if f"{name}: name" in lines]
    names.sort(key=lambda name: -share(name, "at equal substeps"))
    svg = Svg(760, 74 + 48 * len(names), "How many rows of physics each engine holds")
    for i, (words, (_, opacity)) in enumerate(BARS.items()):
        svg.add("rect", x=LEFT + 190 * i, y=14, width=26, height=14, fill=INK, opacity=opacity)
        svg.text(LEFT + 34 + 190 * i, 26, words)
    bottom = svg.size[1] - 26
    svg.line((LEFT, 38), (LEFT, bottom), color=GREY, width=1)
    svg.line((LEFT + FULL, 38), (LEFT + FULL, bottom), color=GREY, width=1, dash="3 4")
    svg.text(LEFT + FULL, bottom + 18, "all rows", GREY, 13, "middle")
    for i, name in enumerate(names):
        top = 44 + 48 * i
        svg.text(LEFT - 12, top + 22, lines[f"{name}: name"], INK, 14, "end")
        for words, (down, opacity) in BARS.items():
            asked = lines[f"{name}: rows {words}"]
            if not asked:
                continue
            size = {"width": FULL * share(name, words), "height": 15}
            svg.add("rect", x=LEFT, y=top + down, **size, fill=ENGINES[name], opacity=opacity)
            told = f"{lines[f'{name}: rows held {words}']} of {asked}"
            svg.rect(LEFT + 4 + size["width"], top + down, 72, 15, "white")
            svg.text(LEFT + 8 + size["width"], top + down + 12, told, INK, 13)
    svg.save("hard-cases-leaderboard.svg")


ALL = [accumulator, damping, spirals, effective_mass, rolling, leaderboard]


def main():
    FIGURES.mkdir(exist_ok=True)
    for draw in ALL:
        draw()
    print(f"{len(ALL)} figures are in {FIGURES}.")


if __name__ == "__main__":
    main()
