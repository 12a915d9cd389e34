"""Rapier and planck, engines in JavaScript that node runs, where they are installed.

npm install @dimforge/rapier2d-compat planck, in the folder you run from.
"""

import atexit
import json
import math
import shutil
import subprocess
from dataclasses import asdict
from pathlib import Path

from .box2d import PX_PER_M, spring_as_oscillator
from .builder import SUBSTEPS, Builder, State


class Node:
    """A node process that runs engines of npm, and answers lines of JSON."""

    def __init__(self):
        program = ["node", str(Path(__file__).with_name("npm.cjs"))]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(program, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL)
        atexit.register(self.process.kill)
        self.versions = json.loads(self.process.stdout.readline() or "{}")

    def ask(self, **what):
        self.process.stdin.write(json.dumps(what).encode() + b"\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())


NODE = Node() if shutil.which("node") else None


class InNode(Builder):
    """A scene that runs in node, which also measures its time."""

    def __init__(self, scene, substeps=SUBSTEPS):
        self.scene, self.substeps, self.seconds = scene, substeps, 0.0
        data = asdict(scene)
        springs = [spring_as_oscillator(scene, s) for s in scene.springs]
        build = {"do": "build", "engine": self.name, "metre": PX_PER_M * scene.unit}
        answer = NODE.ask(**build, scene=data, springs=springs, substeps=substeps)
        self.id, self.states = answer["id"], answer["states"]

    def spent(self):
        return self.seconds

    def step(self, dt):
        answer = NODE.ask(do="step", id=self.id, dt=dt)
        self.states = answer["states"]
        self.seconds += answer["seconds"]

    def read(self, i):
        return State(*(math.nan if number is None else number for number in self.states[i]))

    def throw(self, i, velocity):
        NODE.ask(do="throw", id=self.id, body=i, velocity=list(velocity))


class Rapier(InNode):
    """The same scene in Rapier."""

    name = "rapier"


class Planck(InNode):
    """The same scene in planck, a Box2D 2 in JavaScript, in metres."""

    name = "planck"
