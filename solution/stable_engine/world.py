"""The world and its step."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from .body import Body
from .effect import Effect, Joint
from .validate import pair, require

Thing = TypeVar("Thing", bound=Body | Joint)
Kind = TypeVar("Kind", bound=Effect)

MOMENTS = ("detect", "impact", "prepare", "force", "warm_start", "solve", "relax", "finish")


class World:
    """Bodies, and the effects the scene declares. Only those run.

    gravity in px/s²; every step is made of that many substeps. Raises ValueError when a value makes
    no sense or an effect lacks another one that it needs.
    """

    def __init__(
        self,
        gravity: Iterable[float] = (0, 980),
        substeps: int = 4,
        effects: Iterable[Effect] = (),
    ) -> None:
        self.gravity = pair("World.gravity", gravity)
        require(substeps >= 1, "World.substeps", substeps, "1 or more")
        self.substeps = substeps
        self.bodies: list[Body] = []
        self.awake: list[Body] = []  # the balls that move
        self.effects = {type(effect).__name__: effect for effect in effects}
        self.stages = {moment: self.hooks(moment) for moment in MOMENTS}
        for effect in self.effects.values():
            effect.join(self)

    def hooks(self, name: str) -> list[Callable[..., Any]]:
        effects = sorted(self.effects.values(), key=lambda effect: effect.rank)
        return [
            getattr(effect, name)
            for effect in effects
            if getattr(type(effect), name) is not getattr(Effect, name)
        ]

    def need(self, kind: type[Kind], user: Effect) -> Kind:
        found = self.effects.get(kind.__name__)
        assert isinstance(found, kind)
        return found

    def add(self, thing: Thing) -> Thing:
        if isinstance(thing, Body):
            self.bodies.append(thing)
            if thing.inv_mass:
                self.awake.append(thing)
            thing.id = len(self.bodies) * (1 if thing.inv_mass else -1)
            if thing.bullet: self.effects["Bullets"].take(thing)
        else:
            self.effects[thing.effect].take(thing)
        return thing

    def step(self, dt: float) -> None:
        """Advance by dt seconds. Raises ValueError on a bad dt or a body with NaN or infinity."""
        require(0 < dt < math.inf, "World.step's dt", dt, "a finite number of seconds above 0")
        for body in self.awake:
            body.check()
        h = dt / self.substeps
        stages = self.stages
        for moment in ("detect", "impact", "prepare"):
            for hook in stages[moment]:
                hook(h)
        for _ in range(self.substeps):
            self.apply_gravity(h)
            for hook in stages["force"]: hook(h)
            for hook in stages["warm_start"]: hook(h)
            for hook in stages["solve"]: hook(h)
            self.move(h)
            for hook in stages["relax"]: hook(h)
        for hook in stages["finish"]:
            hook(h)

    def apply_gravity(self, h):
        gx, gy = self.gravity
        gx *= h
        gy *= h
        for body in self.awake:
            body.vx += gx
            body.vy += gy

    def move(self, h):
        for body in self.awake:
            body.x += body.vx * h
            body.y += body.vy * h
            body.angle += body.w * h
