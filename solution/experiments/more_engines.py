"""Builders of the engines that only the leaderboard runs, where they are installed.

- Box2D v3.1: python -m pip install pyb2d3
- Rapier and planck: npm install @dimforge/rapier2d-compat planck, in the folder you run from
"""

import atexit
import json
import math
import shutil
import subprocess
from dataclasses import asdict
from pathlib import Path

try:
    import pyb2d3
except ImportError:  # python -m pip install pyb2d3
    pyb2d3 = None

from .engines import NO_COLLISIONS, PX_PER_M, SUBSTEPS, Builder, State, spring_as_oscillator
from .scenes import Ball

NODE_PROGRAM = Path(__file__).with_name("node_engines.cjs")
ANY_SPEED = 1e9  # m/s; Box2D v3 would cut speeds at 400


class Box2d3(Builder):
    """The same scene in Box2D v3.1, in metres. It finds contacts once a step, for all substeps."""

    name = "box2d3"

    def __init__(self, scene, substeps=SUBSTEPS):
        self.scene, self.substeps = scene, substeps
        self.metre = PX_PER_M * scene.unit
        gravity = tuple(g / self.metre for g in scene.gravity)
        self.world = pyb2d3.World(gravity=gravity, maximum_linear_speed=ANY_SPEED)
        self.fill()

    def add(self, data):
        effects = self.scene.effects
        material = pyb2d3.surface_material(
            friction=data.friction if "Friction" in effects else 0.0,
            restitution=data.restitution if "Bounce" in effects else 0.0,
        )
        group = 0 if "Contacts" in effects else NO_COLLISIONS
        surface = {"material": material, "filter": pyb2d3.make_filter(group_index=group)}
        place = tuple(x / self.metre for x in data.pos)
        if isinstance(data, Ball):
            shape = pyb2d3.circle(radius=data.radius / self.metre)
        else:
            shape = pyb2d3.box(*(half / self.metre for half in data.half))
        if not isinstance(data, Ball) or data.mass == 0:
            body = self.world.create_static_body(position=place)
            body.create_shape(pyb2d3.shape_def(**surface), shape)
            return body
        damping = self.scene.damping if "Damping" in effects else (0.0, 0.0)
        body = self.world.create_dynamic_body(
            position=place,
            linear_velocity=tuple(v / self.metre for v in data.vel),
            angular_velocity=data.omega,
            linear_damping=damping[0],
            angular_damping=damping[1],
            is_bullet=data.bullet and "Bullets" in effects,
            enable_sleep="Sleep" in effects,
        )
        area = math.pi * (data.radius / self.metre) ** 2
        body.create_shape(pyb2d3.shape_def(density=data.mass / area, **surface), shape)
        return body

    def rod(self, a, b):
        self.tie(a, b, math.dist(self.scene.bodies[a].pos, self.scene.bodies[b].pos))

    def spring(self, s):
        hertz, ratio = spring_as_oscillator(self.scene, s)
        self.tie(s.a, s.b, s.length, enable_spring=True, hertz=hertz, damping_ratio=ratio)

    def tie(self, a, b, length, **soft):
        """Join two centres. The two bodies do not collide."""
        ends = self.bodies[a], self.bodies[b]
        self.world.create_distance_joint(*ends, length=length / self.metre, **soft)

    def step(self, dt):
        self.world.step(dt, self.substeps)

    def read(self, i):
        body = self.bodies[i]
        (x, y), (vx, vy) = body.position, body.linear_velocity
        metres = [self.metre * float(number) for number in (x, y, vx, vy)]
        return State(*metres, float(body.angle), float(body.angular_velocity))

    def throw(self, i, velocity):
        self.bodies[i].linear_velocity = tuple(v / self.metre for v in velocity)
        self.bodies[i].awake = True


class Node:
    """A node process that runs engines of npm. It takes lines of JSON, and answers each."""

    def __init__(self):
        program = ["node", str(NODE_PROGRAM)]
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
    """A scene that runs in node. Its time is the one that node measures."""

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
