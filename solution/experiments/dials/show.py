"""A scene in an engine, with dials and figures: the contents of the window, without it.

Dials (passes, substeps, step) turn while the scene runs on; another engine, scene or effect starts
it again.
"""

import time
from collections import deque, namedtuple
from dataclasses import replace

import pygame

from mini_engine import ITERATIONS, MAX_STEPS, STEP

from ..engines import ENGINES, SUBSTEPS, Stable
from ..engines.box2d import PASSES as BOX2D_PASSES
from ..engines.chipmunk import PASSES
from ..measures import deepest_overlap, energy, finite, states, worst_stretch
from ..scenes import NAMED, NEED_CONTACTS, Ball

MAX_FRAME = MAX_STEPS * STEP  # s, the most time one frame may add
MEASURE_EVERY = 6  # frames
STEPS = (1 / 30, 1 / 60, 1 / 120, 1 / 240, 1 / 480)  # s
RATES = (0.1, 0.25, 0.5, 1)  # simulated seconds per real second
MOST = 128  # passes or substeps
MOST_BALLS = 120
KEPT = 200  # measurements kept
SHARE = 0.05  # weight of a new time in the smoothed one

EFFECT_KEYS = {
    "C": "Contacts",
    "F": "Friction",
    "B": "Bounce",
    "R": "Rods",
    "G": "Springs",
    "D": "Damping",
    "U": "Bullets",
    "Z": "Sleep",
}
CANNOT = {  # effects that each builder in engines/ leaves out
    "lesson": ("Springs", "Bullets", "Sleep"),
    "stable": (),
    "pymunk": ("Bullets", "Sleep"),
    "box2d": (),
}
LOOK_FOR = {
    "lab": "The lesson's scene. Does the rod keep its length?",
    "tower": "20 equal balls in a slot. How far do they sink into each other?",
    "stack": "A ball of 100 kg on one of 1 kg. Who gives way?",
    "pile": "60 balls rained into a bin. How deep do they overlap, and do they come to rest?",
    "silo": "A pile in a tall bin: much weight on the lowest.",
    "pendulum": "A bob let go at 90°. Does it come back as high?",
    "chain": "20 rods, swinging. Which one stretches most?",
    "cradle": "One ball in. Does exactly one come out?",
    "squeeze": "Two balls with too little room. Are they thrown about?",
    "overlap": "Two balls that start overlapping. How fast do they part?",
    "coincident": "Ten balls with one centre. Do they part, and calmly?",
    "bullet": "2448 px/s towards a ledge of 20 px. Pause, start again, and go step by step.",
    "spring": "A ball on a spring. Does the swing keep its size?",
    "box": "Masses up to 1000 to 1 in a closed box. Does anybody escape?",
}

Figures = namedtuple("Figures", "rod_error drift overlap contacts asleep")


class Show:
    """A scene in an engine, with its dials and figures."""

    def __init__(self, scene="lab", engine="stable"):
        self.scene_name, self.engine_name = scene, engine
        self.hand = None  # of a person, which may hold a ball: see hand.py
        self.paused = False
        self.usual_dials()
        self.choose_scene(0)

    def usual_dials(self):
        self.passes = {"lesson": ITERATIONS, "pymunk": PASSES, "box2d": BOX2D_PASSES}
        self.substeps = {"lesson": 1, "stable": SUBSTEPS, "pymunk": 1, "box2d": 1}
        self.dt = STEP  # s
        self.rate = 1  # simulated seconds per real second

    # ------------------------------------------------------------ starting

    def start(self, note=""):
        """Build the scene anew with the chosen effects; say which ones this engine lacks."""
        on = self.effects_on()
        scene = replace(
            self.scene,
            bodies=list(self.scene.bodies),
            effects=on,
            rods=self.scene.rods if "Rods" in on else [],
            springs=self.scene.springs if "Springs" in on else [],
        )
        self.engine = ENGINES[self.engine_name](scene, **self.settings())
        missing = [n.lower() for n in self.chosen if n in CANNOT[self.engine_name]]
        if missing:
            note = f"{self.engine_name} runs without {' and '.join(missing)}."
        self.note = " ".join(filter(None, [note, self.complaint()]))
        self.failed = False
        self.time = self.owed = 0.0  # s
        self.frames = 0
        self.milliseconds = 0.0  # per step, smoothed
        self.history = deque(maxlen=KEPT)  # of (time, figures)
        self.begin_measuring()
        self.measure()

    def begin_measuring(self):
        """Measure energy from now on; called again when a person adds energy."""
        self.begun_with = energy(self.engine, self.dt)
        self.lowest = self.depths()
        self.begun_at = sum(self.lowest)
        self.motion = self.begun_with + self.begun_at

    def complaint(self):
        """Return the stable engine's complaint about a needed effect that is switched off."""
        called_for = [f"calls for {name}()" for name in self.scene.effects]
        for sentence in Stable(self.engine.scene).complaints:
            if any(words in sentence for words in called_for):
                return sentence.partition(":")[0] + "."
        return ""

    def settings(self):
        settings = {"substeps": self.substeps[self.engine_name]}
        if self.engine_name in self.passes:
            settings["passes"] = self.passes[self.engine_name]
        return settings

    def effects_on(self):
        """Return chosen effects that this engine has, without any lacking Contacts."""
        can = [name for name in self.chosen if name not in CANNOT[self.engine_name]]
        return tuple(n for n in can if n not in NEED_CONTACTS or "Contacts" in can)

    # ------------------------------------------------------------ time

    def advance(self, seconds):
        """Run the whole steps due in one frame, and measure now and then."""
        if not self.paused:
            seconds = min(seconds, MAX_FRAME) * self.rate
            steps, self.owed = divmod(self.owed + seconds, self.dt)
            for _ in range(int(steps)):
                if not self.paused:
                    self.step()
        self.frames += 1
        if self.frames % MEASURE_EVERY == 0:
            self.measure()

    def step(self):
        """Run one step. An engine that gives up says why, and the scene pauses."""
        if self.failed:
            return
        held = self.hand is not None and self.hand.pull(self.engine)
        start = time.perf_counter()
        try:
            self.engine.step(self.dt)
        except ValueError as error:
            self.give_up(str(error))
            return
        taken = (time.perf_counter() - start) * 1000
        self.milliseconds += (taken - self.milliseconds) * (SHARE if self.milliseconds else 1)
        self.time += self.dt
        if not finite(self.engine):
            self.give_up("A body has a number that is NaN or infinite.")
            return
        if held:
            self.begin_measuring()
            return
        self.lowest = [max(pair) for pair in zip(self.lowest, self.depths(), strict=True)]

    def give_up(self, reason):
        self.failed = self.paused = True
        self.note = f"The engine gave up. {reason}"

    # ------------------------------------------------------------ figures

    def depths(self):
        """Return the depth of each ball as energy (kg px²/s²): mass x gravity x position."""
        scene = self.engine.scene
        gx, gy = scene.gravity
        now = states(self.engine)
        return [scene.bodies[i].mass * (gx * now[i].x + gy * now[i].y) for i in scene.moving()]

    def drift(self):
        """Return the energy gained since the start, in % of the scene's, or None.

        The scene's energy is motion, springs, and the height that balls have fallen so far.
        """
        had = self.motion + sum(self.lowest) - self.begun_at
        if had < 1e-9:
            return None
        return 100 * (energy(self.engine, self.dt) - self.begun_with) / had

    def measure(self):
        """Renew the figures, unless the engine gave up."""
        if not self.failed:
            engine = self.engine
            drift, deepest = self.drift(), deepest_overlap(engine)
            counts = engine.contacts(), engine.asleep()
            self.figures = Figures(worst_stretch(engine), drift, deepest, *counts)
            self.history.append((self.time, self.figures))

    # ------------------------------------------------------------ dials

    def choose_engine(self, name):
        if name not in ENGINES:
            self.note = "Box2D is not installed: python -m pip install Box2D"
            return
        self.engine_name = name
        self.start("Another engine: the scene starts again.")

    def next_engine(self):
        names = list(ENGINES)
        self.choose_engine(names[(names.index(self.engine_name) + 1) % len(names)])

    def choose_scene(self, way):
        """Choose the scene `way` further in the list, with its own effects."""
        names = list(NAMED)
        self.scene_name = names[(names.index(self.scene_name) + way) % len(names)]
        self.scene = NAMED[self.scene_name]()
        self.chosen = self.scene.effects
        self.start()

    def turn_passes(self, factor):
        name = self.engine_name
        if name not in self.passes:
            self.note = "The stable engine has no passes. Turn the substeps."
            return
        self.passes[name] = min(max(int(self.passes[name] * factor), 1), MOST)
        if name == "lesson":
            self.engine.world.iterations = self.passes[name]
        elif name == "pymunk":
            self.engine.space.iterations = self.passes[name]
        else:
            self.engine.passes = self.passes[name]

    def turn_substeps(self, factor):
        name = self.engine_name
        self.substeps[name] = min(max(int(self.substeps[name] * factor), 1), MOST)
        self.engine.substeps = self.substeps[name]
        if name == "stable":
            self.engine.world.substeps = self.substeps[name]

    def turn_step(self, way):
        place = min(max(STEPS.index(self.dt) + way, 0), len(STEPS) - 1)
        self.dt = STEPS[place]

    def turn_rate(self, way):
        """Make the motion slower or faster."""
        place = min(max(RATES.index(self.rate) + way, 0), len(RATES) - 1)
        self.rate = RATES[place]

    def reset(self):
        """Reset all dials and effects."""
        self.usual_dials()
        self.chosen = self.scene.effects
        self.start("All dials are as in the beginning.")

    def drop(self, ball):
        """Add a ball to the running scene."""
        if len(self.engine.scene.moving()) >= MOST_BALLS:
            self.note = f"{MOST_BALLS} balls are enough. Press Enter to start again."
            return
        self.engine.drop(ball)
        self.begin_measuring()
        self.measure()

    def toggle(self, effect):
        """Switch an effect and start again; say so if it would change nothing."""
        name = self.engine_name
        if effect in CANNOT[name]:
            self.note = f"{name} has no {effect.lower()} here."
        elif name == "lesson" and effect == "Contacts":
            self.note = "The lesson's engine always looks for contacts."
        elif effect in NEED_CONTACTS and "Contacts" not in self.chosen:
            self.note = f"{effect} needs contacts. Press C first."
        elif not self.users(effect):
            self.note = f"{effect}: nothing in this scene uses it."
        elif effect in self.chosen:
            self.chosen = tuple(other for other in self.chosen if other != effect)
            self.start(f"Without {effect.lower()}, the scene starts again.")
        else:
            self.chosen = (*self.chosen, effect)
            self.start(f"With {effect.lower()}, the scene starts again.")

    def effects(self):
        """Return all effects as (key, name, whether it is on)."""
        on = self.effects_on()
        return [(letter, name, name in on) for letter, name in EFFECT_KEYS.items()]

    def users(self, effect):
        """Return true if the effect would change anything in the scene."""
        balls = [body for body in self.scene.bodies if isinstance(body, Ball)]
        use = {
            "Rods": self.scene.rods,
            "Springs": self.scene.springs,
            "Bounce": any(body.restitution > 0 for body in balls),
            "Friction": any(body.friction > 0 for body in balls),
            "Bullets": any(body.bullet for body in balls),
            "Damping": any(self.scene.damping),
        }
        return bool(use.get(effect, True))

    def pause(self):
        self.paused = not self.paused or self.failed

    def single_step(self):
        self.paused = True
        self.step()
        self.measure()

    def restart(self):
        self.paused = False
        self.start()

    def press(self, key, shift=False):
        """Do what this key does."""
        letter = chr(key).upper() if key < 128 else ""  # pygame's keys of letters are their codes
        if key in KEYS:
            KEYS[key](self)
        elif key == pygame.K_s:
            self.turn_substeps(0.5 if shift else 2)
        elif letter in EFFECT_KEYS:
            self.toggle(EFFECT_KEYS[letter])


KEYS = {
    pygame.K_TAB: Show.next_engine,
    pygame.K_1: lambda show: show.choose_engine("lesson"),
    pygame.K_2: lambda show: show.choose_engine("stable"),
    pygame.K_3: lambda show: show.choose_engine("pymunk"),
    pygame.K_4: lambda show: show.choose_engine("box2d"),
    pygame.K_LEFT: lambda show: show.choose_scene(-1),
    pygame.K_RIGHT: lambda show: show.choose_scene(1),
    pygame.K_UP: lambda show: show.turn_passes(2),
    pygame.K_DOWN: lambda show: show.turn_passes(0.5),
    pygame.K_LEFTBRACKET: lambda show: show.turn_substeps(0.5),
    pygame.K_RIGHTBRACKET: lambda show: show.turn_substeps(2),
    pygame.K_MINUS: lambda show: show.turn_step(1),
    pygame.K_EQUALS: lambda show: show.turn_step(-1),
    pygame.K_PLUS: lambda show: show.turn_step(-1),
    pygame.K_KP_MINUS: lambda show: show.turn_step(1),
    pygame.K_KP_PLUS: lambda show: show.turn_step(-1),
    pygame.K_SPACE: Show.pause,
    pygame.K_n: Show.single_step,
    pygame.K_BACKSPACE: Show.restart,
    pygame.K_RETURN: Show.restart,
    pygame.K_COMMA: lambda show: show.turn_rate(-1),
    pygame.K_PERIOD: lambda show: show.turn_rate(1),
    pygame.K_0: Show.reset,
}
