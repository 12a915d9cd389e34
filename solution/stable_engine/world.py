"""The world and its step."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from .body import Body
from .effect import Effect
from .joint import Joint
from .validate import pair, require

Thing = TypeVar("Thing", bound=Body | Joint)
Kind = TypeVar("Kind", bound=Effect)


class World:
    """Bodies, and the effects that the scene declares. No other effect runs a line of code.

    gravity in px/s². Each step is made of that many substeps. Raises ValueError when a value makes
    no sense, or when an effect needs another one that is not declared.
    """

    def __init__(
        self,
        gravity: Iterable[float] = (0, 980),
        substeps: int = 4,
        effects: Iterable[Effect] = (),
    ) -> None:
        whole = isinstance(substeps, int) and substeps >= 1
        require(whole, "World.substeps", substeps, "a whole number, 1 or more")
        self.gravity = pair("World.gravity", gravity)
        self.substeps = substeps
        self.bodies: list[Body] = []
        self.awake: list[Body] = []  # the balls that can move now
        self.effects: list[Effect] = []
        for effect in effects:
            require(isinstance(effect, Effect), "World.effects", effect, "made of effects")
            once = self.find(type(effect)) is None
            require(once, "World.effects", f"naming {type(effect).__name__}() twice", "once each")
            self.effects.append(effect)
        self.effects.sort(key=lambda effect: effect.rank)
        for effect in self.effects:
            effect.join(self)
        self.detect_hooks = self.hooks("detect")
        self.impact_hooks = self.hooks("impact")
        self.prepare_hooks = self.hooks("prepare")
        self.force_hooks = self.hooks("force")
        self.warm_start_hooks = self.hooks("warm_start")
        self.solve_hooks = self.hooks("solve")
        self.relax_hooks = self.hooks("relax")
        self.finish_hooks = self.hooks("finish")

    def hooks(self, name: str) -> list[Callable[..., Any]]:
        """The hooks of this name that the scene's effects override."""
        base = getattr(Effect, name)
        return [getattr(e, name) for e in self.effects if getattr(type(e), name) is not base]

    def find(self, kind: type[Kind]) -> Kind | None:
        """The scene's effect of a kind, or None."""
        return next((effect for effect in self.effects if isinstance(effect, kind)), None)

    def need(self, kind: type[Kind], user: Effect) -> Kind:
        """The scene's effect of a kind. Raises ValueError when it is not declared."""
        found = self.find(kind)
        if found is None:
            raise ValueError(undeclared(f"{type(user).__name__}() needs", kind.__name__))
        return found

    def add(self, thing: Thing) -> Thing:
        """Add a body, rod or spring and return it.

        Raises ValueError when it is here already, when it ties a body that is not, or when the
        scene does not declare the effect it needs.
        """
        if isinstance(thing, Body):
            self.add_body(thing)
        else:
            for body in (thing.a, thing.b):
                name = f"World.add's {type(thing).__name__}"
                require(body in self.bodies, name, f"tied to a body at {body.pos}", "in this world")
                body.wake()
            self.effect_for(thing.effect, f"a {type(thing).__name__}").take(thing)
        return thing

    def add_body(self, body: Body) -> None:
        """Add a body. Balls are numbered from 1 up, static bodies from -1 down."""
        found = f"in a world already (at {body.pos})"
        require(body.id == 0, "World.add's body", found, "a new one")
        if body.bullet:
            self.effect_for("Bullets", "a bullet").take(body)
        self.bodies.append(body)
        body.id = -len(self.bodies) if body.is_static else len(self.bodies)
        if not body.is_static:
            self.awake.append(body)

    def step(self, dt: float) -> None:
        """Advance by dt seconds. Raises ValueError on a bad dt or a body with NaN or infinity."""
        h = dt / self.substeps
        require(0 < h < math.inf, "World.step's dt", dt, "a finite number of seconds above 0")
        for body in self.awake:
            body.check()
        if not self.awake:
            return

        # 1 detect
        for detect in self.detect_hooks:
            detect(h)
        for impact in self.impact_hooks:
            impact(h)
        for prepare in self.prepare_hooks:
            prepare(h)

        for _ in range(self.substeps):
            # 2 forces
            self.apply_gravity(h)
            for force in self.force_hooks:
                force(h)

            # 3 solve
            for warm_start in self.warm_start_hooks:
                warm_start(h)
            for solve in self.solve_hooks:
                solve(h)

            # 4 move
            self.move(h)

            # 5 relax
            for relax in self.relax_hooks:
                relax(h)

        for finish in self.finish_hooks:
            finish(h)

    def apply_gravity(self, h: float) -> None:
        """Let balls fall faster."""
        gx, gy = self.gravity[0] * h, self.gravity[1] * h
        for body in self.awake:
            body.vx += gx
            body.vy += gy

    def move(self, h: float) -> None:
        """Move and turn balls with their new velocities (semi-implicit Euler)."""
        for body in self.awake:
            body.x += body.vx * h
            body.y += body.vy * h
            body.angle += body.w * h

    def effect_for(self, name: str, thing: str) -> Effect:
        """The scene's effect of that name. Raises ValueError when it is not declared."""
        for effect in self.effects:
            if type(effect).__name__ == name:
                return effect
        raise ValueError(undeclared(f"World.add was given {thing}, which needs", name))


def undeclared(what_needs: str, name: str) -> str:
    return (
        f"{what_needs} {name}(), but this scene does not declare it. "
        f"Declare it: World(effects=[..., {name}()])."
    )
