"""A film of the window as one HTML page, on the player that replays of failed checks use.

The player comes with the grader. Where that is not installed, the window runs all the same and says
what is missing.
"""

import math

from .scenes import Ball

try:
    from grader.player.film import Both, Replay, Scene, thinned
    from grader.player.page import page
    from grader.protocol import BodyLook, BodyRow, ShapeLook, Shot, TouchRow
except ImportError:  # a folder with the engines alone
    page = None

EVERY = 2  # frames from one shot to the next
MOST = 1800  # shots, a minute

SCRIPT = """\
from experiments.engines import ENGINES
from experiments.scenes import NAMED

scene = NAMED["{scene}"]()
engine = ENGINES["{engine}"](scene, {settings})
for step in range({steps}):
    engine.step(1 / {rate})
for i in scene.moving():
    print(i, engine.read(i))
"""


def cannot_record(path):
    """Why no film can be written there, as a sentence; empty where one can."""
    if page is None:
        return "--record needs the grader's player: install the grader as README.md says."
    if path.suffix.lower() not in (".html", ".htm"):
        return f"--record is {path}, but a film is a page: give it a name that ends in .html."
    if not path.absolute().parent.is_dir():
        return f"--record is {path}, but there is no folder {path.absolute().parent}."
    return ""


class Recorder:
    """Takes shots of every engine that is shown; each start of a scene is a new reel."""

    def __init__(self):
        self.frames = self.shots = 0
        self.reels = {}  # by engine: the show's words, the looks and the shots
        self.script = ""

    def look(self, shows):
        self.frames += 1
        if self.frames % EVERY or self.shots >= MOST:
            return
        for show in shows:
            self.shoot(show)
        self.shots += 1
        self.script = script_of(shows[0])

    def shoot(self, show):
        engine = show.engine
        if engine not in self.reels:
            self.reels[engine] = (f"{show.scene_name} in {show.engine_name}", {}, [])
        _, looks, shots = self.reels[engine]
        for i, body in enumerate(engine.scene.bodies):
            if i + 1 not in looks:
                looks[i + 1] = look_of(body)
        states = [engine.read(i) for i in range(len(engine.scene.bodies))]
        if not all(math.isfinite(number) for state in states for number in state):
            return
        rows = [BodyRow(i + 1, *state) for i, state in enumerate(states)]
        touches = [
            TouchRow(x, y, nx, ny, 0.0, impulse or 0.0, 0.0)
            for x, y, nx, ny, impulse in engine.touches()
        ]
        rods = [(states[a].x, states[a].y, states[b].x, states[b].y) for a, b in engine.scene.rods]
        shots.append(Shot(show.time, 1, rows, touches, rods))

    def write(self, path):
        """Write the page; returns what to say of it."""
        scenes = [
            scene_of(words, looks, shots) for words, looks, shots in self.reels.values() if shots
        ]
        if not scenes:
            return f"Nothing was recorded: the window was open for less than {EVERY} frames."
        said = [("Recorded", ", ".join(words for words, _, _ in self.reels.values()))]
        text = page(
            "What the engines did",
            said,
            Replay(scenes, None, False, "Recorded from the window with dials."),
            self.script,
        )
        path.write_text(text, encoding="utf-8", newline="\n")
        full = " The film ends after a minute." if self.shots >= MOST else ""
        return f"The film is in {path}: open it in a browser.{full}"


def look_of(body):
    """A body of a scene as the player draws it."""
    if isinstance(body, Ball):
        mass = body.mass or None
        moment = None if mass is None else 0.5 * mass * body.radius**2
        return BodyLook(0, [ShapeLook([(0.0, 0.0)], float(body.radius))], mass, moment)
    x, y = body.half
    return BodyLook(0, [ShapeLook([(-x, -y), (x, -y), (x, y), (-x, y)], 0.0)], None, None)


def scene_of(words, looks, shots):
    names = {number: f"body {number}" for number in looks}
    line = Both(words, "", "", 0, len(shots))
    return Scene(words, False, names, looks, {}, [line], list(thinned(shots)), [])


def script_of(show):
    """What runs the same scene in the same engine, without the hand."""
    settings = ", ".join(f"{name}={value}" for name, value in show.settings().items())
    rate, steps = round(1 / show.dt), round(show.time / show.dt)
    names = {"scene": show.scene_name, "engine": show.engine_name, "settings": settings}
    return SCRIPT.format(**names, steps=steps, rate=rate)
