"""The window with dials: `python -m experiments.window [--scene NAME] [--engine NAME]`.

Any scene in any engine. Dials (passes, substeps, step) turn while the scene runs on;
another engine, scene or effect starts it again. How it looks is in drawing.py.
"""

import argparse
import math
import os
import time
from collections import namedtuple
from dataclasses import replace
from pathlib import Path

import pygame

from lab_runtime import frame_budget
from mini_engine import ITERATIONS, MAX_STEPS, STEP

from .compiled import use_compiled
from .drawing import Picture
from .engines import BOX2D_PASSES, ENGINES, PASSES, SUBSTEPS
from .measures import deepest_overlap, energy, finite, states, worst_stretch
from .scenes import NAMED, NEED_CONTACTS, Ball

FRAME = 1 / 60  # s, one frame of a screenshot
MAX_FRAME = MAX_STEPS * STEP  # s, the most time one frame may add
MEASURE_EVERY = 6  # frames
STEPS = (1 / 30, 1 / 60, 1 / 120, 1 / 240, 1 / 480)  # s
MOST = 128  # passes or substeps
SHARE = 0.05  # of a new time in the smoothed one

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
CANNOT = {  # what each builder in engines.py leaves out
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
        self.passes = {"lesson": ITERATIONS, "pymunk": PASSES, "box2d": BOX2D_PASSES}
        self.substeps = {"lesson": 1, "stable": SUBSTEPS, "pymunk": 1, "box2d": 1}
        self.dt = STEP  # s
        self.paused = False
        self.choose_scene(0)

    # ------------------------------------------------------------ starting

    def start(self, note=""):
        """Build the scene anew, with the effects chosen; say what this engine leaves out."""
        on = self.effects_on()
        scene = replace(
            self.scene,
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
        self.begun_with = energy(self.engine, self.dt)
        self.lowest = self.depths()
        self.motion = self.begun_with + sum(self.lowest)
        self.measure()

    def complaint(self):
        """What is said of an effect that the scene calls for and that is switched off."""
        called_for = [f"calls for {name}()" for name in self.scene.effects]
        for sentence in self.engine.complaints:
            if any(words in sentence for words in called_for):
                return sentence.partition(":")[0] + "."
        return ""

    def settings(self):
        settings = {"substeps": self.substeps[self.engine_name]}
        if self.engine_name in self.passes:
            settings["passes"] = self.passes[self.engine_name]
        return settings

    def effects_on(self):
        """The effects chosen that this engine can do, without those that lack contacts."""
        can = [name for name in self.chosen if name not in CANNOT[self.engine_name]]
        return tuple(n for n in can if n not in NEED_CONTACTS or "Contacts" in can)

    # ------------------------------------------------------------ time

    def advance(self, seconds):
        """Run the whole steps that one frame owes, and measure now and then."""
        if not self.paused:
            steps, self.owed = divmod(self.owed + min(seconds, MAX_FRAME), self.dt)
            for _ in range(int(steps)):
                if not self.paused:
                    self.step()
        self.frames += 1
        if self.frames % MEASURE_EVERY == 0:
            self.measure()

    def step(self):
        """One step. An engine that gives up says why, and the scene stands still."""
        if self.failed:
            return
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
        self.lowest = [max(pair) for pair in zip(self.lowest, self.depths(), strict=True)]

    def give_up(self, reason):
        self.failed = self.paused = True
        self.note = f"The engine gave up. {reason}"

    # ------------------------------------------------------------ figures

    def depths(self):
        """How far down each ball is, as energy (kg px²/s²): mass x gravity x place."""
        scene = self.engine.scene
        gx, gy = scene.gravity
        now = states(self.engine)
        return [scene.bodies[i].mass * (gx * now[i].x + gy * now[i].y) for i in scene.moving()]

    def drift(self):
        """Energy gained since the start, in % of what the scene had to give, or None for nothing.

        It had its motion, its springs, and the height that its balls have fallen so far.
        """
        scene = self.engine.scene
        gx, gy = scene.gravity
        begun = [scene.bodies[i] for i in scene.moving()]
        height = sum(self.lowest) - sum(b.mass * (gx * b.pos[0] + gy * b.pos[1]) for b in begun)
        had = self.motion + height
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
        """The scene that is so many places further in the list, with its own effects."""
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

    def toggle(self, effect):
        """Declare an effect or not, and start again; say so where it would change nothing."""
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
        """All effects as (key, name, whether it is on)."""
        on = self.effects_on()
        return [(letter, name, name in on) for letter, name in EFFECT_KEYS.items()]

    def look_for(self):
        """What is to be seen in this scene."""
        return LOOK_FOR.get(self.scene_name, "")

    def users(self, effect):
        """Whether anything in the scene would notice the effect."""
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
        """Do what a key is for."""
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
}


def one_of(names):
    """A type for argparse: a name from the list, or a sentence with the right ones."""

    def check(name):
        if name not in names:
            raise argparse.ArgumentTypeError(f"{name!r} is none of: {', '.join(names)}.")
        return name

    return check


def read_options(arguments):
    parser = argparse.ArgumentParser(prog="python -m experiments.window", description=__doc__)
    parser.add_argument("--scene", type=one_of(NAMED), default="lab", help=", ".join(NAMED))
    parser.add_argument("--engine", type=one_of(ENGINES), default="stable", help=", ".join(ENGINES))
    parser.add_argument("--screenshot", type=Path, help="write this PNG at the end; no window")
    parser.add_argument("--frames", type=int, help="end after so many (a screenshot: 120)")
    options = parser.parse_args(arguments)
    if options.frames is None:
        options.frames = 120 if options.screenshot else math.inf
    if options.frames < 1:
        parser.error(f"--frames is {options.frames}, but it must be 1 or more.")
    return options


def main(arguments=None):
    """Run until the window is closed, or for a number of frames."""
    options = read_options(arguments)
    if options.screenshot:
        os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
        os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
    pygame.init()
    pygame.display.set_caption("Every engine")
    picture = Picture()
    clock = pygame.time.Clock()
    show = Show(options.scene, options.engine)
    frames = 0
    running = True
    while running and frames < options.frames and frame_budget():
        seconds = FRAME if options.screenshot else clock.tick(60) / 1000
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            elif event.type == pygame.KEYDOWN:
                running = event.key != pygame.K_ESCAPE
                show.press(event.key, event.mod & pygame.KMOD_SHIFT)
        show.advance(seconds)
        picture.draw(show, timed=not options.screenshot)
        frames += 1
    if options.screenshot:
        pygame.image.save(picture.screen, options.screenshot)
    pygame.quit()


if __name__ == "__main__":
    print(use_compiled())
    main()
