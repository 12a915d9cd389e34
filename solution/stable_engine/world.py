"""The world and its step."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any, TypeVar

from .body import Body
from .check import missing, odd_gravity, overloaded_rods, unused
from .effect import Effect, Push
from .joint import Joint
from .lags import Lags
from .rays import RayHit, cast_ray
from .validate import pair, positive, refuse, require, whole

HOOKS = [name for name, hook in vars(Effect).items() if callable(hook) and name[0] != "_"]
SUBSTEP = ("force", "warm_start", "solve", "press", "lag", "relax")  # hooks that idle effects skip
STEP = ("detect", "prepare", "finish", "tell")  # hooks that resting effects skip

Thing = TypeVar("Thing", bound=Body | Joint)
Kind = TypeVar("Kind", bound=Effect)
Hooks = dict[str, list[Callable[..., Any]]]  # by name
State = tuple[tuple[bool, bool], ...]  # whether each effect is idle, and at rest


class World:
    """Bodies, and the effects that the scene declares. No other effect runs a line of code.

    `gravity` is in px/s²; `substeps` make up a step. Both can be set later on; effects cannot.
    unit is the length of a pixel in the lengths of the scene: 0.01 for metres at 100 px each. It
    sets which speeds and gaps count as small. Raises ValueError when a value makes no sense, or an
    effect needs another one that is not declared.
    """

    __slots__ = (
        *("lengths", "substep_count", "g", "members", "awake", "statics", "added", "declared"),
        *("ranked", "hooks", "hooks_in", "is_pushed", "are_all_pushed", "has_changed", "lags"),
        *("warned", "forces", "changes", "is_outdated", "steered", "unchecked"),
    )

    def __init__(
        self,
        gravity: Iterable[float] = (0, 980),
        substeps: int = 4,
        effects: Iterable[Effect] = (),
        unit: float = 1.0,
    ) -> None:
        self.lengths = positive("World.unit", unit)
        self.substep_count = whole("World.substeps", substeps)
        self.g = pair("World.gravity", gravity)  # px/s²
        self.members: list[Body] = []
        self.awake: list[Body] = []  # the balls that can move now
        self.statics: list[Body] = []
        self.added = 0  # bodies added so far
        self.changes = 0  # of the hooks
        self.is_outdated = False  # whether effects have become idle or busy since update_hooks
        self.has_changed = True  # whether contacts must be found anew before the next step
        self.steered: list[Body] | None = []  # balls that the program has pushed, if that is all
        self.unchecked: list[Body] = []  # bodies and ends of joints that are new or changed
        self.warned: set[str] = set()  # the effects that a step has warned of
        self.forces: dict[Body, Push] = {}  # of the next step
        self.lags = Lags(self)
        self.declared: dict[str, Effect] = {}
        if not isinstance(effects, Iterable):
            refuse("World.effects", effects, "a list of effects")
        for effect in effects:
            name = type(effect).__name__
            if not isinstance(effect, Effect):
                refuse("World.effects", effect, "a list of effects, as in [Contacts()]")
            found = f"a list with {name}() twice"
            require(name not in self.declared, "World.effects", found, "one of each effect")
            self.declared[name] = effect
        self.ranked = sorted(self.declared.values(), key=lambda effect: effect.rank)
        self.hooks = {name: find_hooks(name, self.ranked) for name in HOOKS}
        # and whether any pushes in substeps, and whether any pushes all bodies
        self.hooks_in: dict[State, tuple[Hooks, bool, bool]] = {}
        for effect in self.declared.values():
            name, found = f"World.effects' {effect!r}", "in another world already"
            require(not hasattr(effect, "world"), name, found, "a new one: each world has its own")
            effect.world = self
            effect.attach()
        self.update_hooks()

    def update_hooks(self) -> None:
        """Skip hooks of idle and resting effects. Lags may be other ones then."""
        self.changes += 1
        self.is_outdated = False
        state = tuple([(effect.is_idle(), effect.is_at_rest()) for effect in self.ranked])
        if state not in self.hooks_in:
            busy = [effect for effect in self.ranked if not effect.is_idle()]
            active = [effect for effect in self.ranked if not effect.is_at_rest()]
            resting = [effect for effect in self.ranked if effect.is_at_rest()]
            pushes = {name: find_hooks(name, busy) for name in SUBSTEP}
            others = {name: find_hooks(name, active) for name in STEP}
            others["finish"] = [*find_hooks("rest", resting), *others["finish"]]
            pushing = [effect for effect in busy if any([find_hooks(n, [effect]) for n in SUBSTEP])]
            are_all = any([effect.pushes_all for effect in pushing])
            self.hooks_in[state] = {**self.hooks, **pushes, **others}, bool(pushing), are_all
        before = self.hooks
        self.hooks, self.is_pushed, self.are_all_pushed = self.hooks_in[state]
        if self.hooks is not before:
            self.lags.forget()

    def call(self, name: str, *arguments: Any) -> None:
        """Call the hooks of this name."""
        for hook in self.hooks[name]:
            hook(*arguments)

    def need(self, name: str, user: object) -> Any:
        """Return the effect of that name. Raises ValueError when the scene does not declare it."""
        if name not in self.declared:
            raise ValueError(
                f"{type(user).__name__} needs {name}(), which this scene does not declare. "
                f"Declare it: World(effects=[..., {name}()])."
            )
        return self.declared[name]

    def find(self, kind: type[Kind]) -> Kind | None:
        """Return the effect of that class, or None if the scene does not declare it."""
        effect = self.declared.get(kind.__name__)
        return effect if isinstance(effect, kind) else None

    def __repr__(self) -> str:
        names = ", ".join(f"{name}()" for name in self.declared)
        moving = len(self.members) - len(self.statics)
        return f"World({moving} moving, {len(self.statics)} static, effects=[{names}])"

    @property
    def bodies(self) -> list[Body]:
        """Return all bodies in a new list, in the order of adding. add and remove change them."""
        return list(self.members)

    @property
    def effects(self) -> Mapping[str, Effect]:
        """Return the declared effects by name, which stay the same: `world.effects["Contacts"]`."""
        return MappingProxyType(self.declared)

    @property
    def gravity(self) -> tuple[float, float]:
        """Return the gravity in px/s². Setting another one wakes all bodies."""
        return self.g

    @gravity.setter
    def gravity(self, value: Iterable[float]) -> None:
        (gx, gy), self.g = self.g, pair("World.gravity", value)
        self.lags.forget()
        lost = gx - self.g[0], gy - self.g[1]
        if lost != (0.0, 0.0):
            size = math.hypot(*lost)
            self.call("unload", {body: body.m * size for body in self.members if body.m}, lost)
            for body in self.members:
                body.wake()

    @property
    def unit(self) -> float:
        """Return the length of a pixel in the lengths of the scene."""
        return self.lengths

    @property
    def substeps(self) -> int:
        """Return how many substeps make a step."""
        return self.substep_count

    @substeps.setter
    def substeps(self, value: int) -> None:
        self.substep_count = whole("World.substeps", value)

    def add(self, thing: Thing) -> Thing:
        """Add a body, rod or spring and return it.

        Raises ValueError if it is in a world already, if it ties bodies that are not in this one,
        or if the scene does not declare the effect it needs.
        """
        if isinstance(thing, Body):
            self.add_body(thing)
        elif isinstance(thing, Joint):
            self.add_joint(thing)
        else:
            refuse("World.add's argument", thing, "a Body, a Rod or a Spring")
        return thing

    def add_body(self, body: Body) -> None:
        found = f"in a world already, at {body.pos}"
        require(body.world is None, "World.add's body", found, "a new one")
        if body.is_bullet:
            self.need("Bullets", body).add(body)
        if body.is_kinematic:
            self.need("Kinematics", body).add(body)
        self.members.append(body)
        self.added += 1
        body.world, body.id = self, -self.added if body.is_static else self.added
        (self.statics if body.is_static else self.awake).append(body)
        self.look_again(body)

    def add_joint(self, joint: Joint) -> None:
        effect = self.need(joint.effect, joint)
        name = f"World.add's {type(joint).__name__}"
        require(joint not in effect.joints, name, "in this world already", "a new one")
        for body in (joint.a, joint.b):
            found = f"tied to a body at {body.pos} that is not in this world"
            require(body.world is self, name, found, "tied to bodies added before")
            body.wake()
        for body in (joint.a, joint.b):
            body.joint_count += 1
        effect.add(joint)
        self.begin_anew()

    def look_again(self, body: Body, steers: bool = False) -> None:
        """Check this new or changed body in the next step: a ball that is only steered moves on."""
        self.begin_anew(body if steers else None)
        self.unchecked.append(body)

    def begin_anew(self, ball: Body | None = None) -> None:
        """Let the next step find contacts and lags anew, as the program has changed something.

        Name a ball if nothing but its motion has changed.
        """
        self.has_changed = True
        self.lags.forget()
        if ball is None:
            self.steered = None
        elif self.steered is not None:
            self.steered.append(ball)

    def remove(self, thing: Body | Joint) -> None:
        """Remove a body, rod or spring; with a body, also the rods and springs tied to it.

        This wakes whatever slept on it or with it. Call it between steps, or in on_hit and on_part.
        You can add it again. Raises ValueError when it is not in this world.
        """
        if isinstance(thing, Body):
            self.remove_body(thing)
        elif isinstance(thing, Joint):
            self.remove_joint(thing)
        else:
            refuse("World.remove's argument", thing, "a Body, a Rod or a Spring")

    def remove_body(self, body: Body) -> None:
        require(body.world is self, "World.remove's body", body, "one that is in this world")
        body.wake()
        self.forces.pop(body, None)
        self.relieve({body: math.inf})
        self.call("forget", body)
        # new lists, so that a hook may remove bodies while it loops over them
        self.members = [other for other in self.members if other is not body]
        self.awake = [other for other in self.awake if other is not body]
        self.statics = [other for other in self.statics if other is not body]
        body.world, body.id = None, 0
        self.begin_anew()

    def remove_joint(self, joint: Joint) -> None:
        effect: Any = self.declared.get(joint.effect)
        ours = joint in getattr(effect, "joints", [])
        require(ours, f"World.remove's {type(joint).__name__}", joint, "one that is in this world")
        for body in (joint.a, joint.b):
            body.wake()
            body.joint_count -= 1
        effect.remove(joint)
        self.begin_anew()

    def bodies_at(self, point: Iterable[float]) -> list[Body]:
        """Return the bodies that a point (px) is in or on the edge of, in the order of adding."""
        at = pair("World.bodies_at's point", point)
        return [body for body in self.members if body.contains(at)]

    def ray_cast(self, start: Iterable[float], end: Iterable[float]) -> RayHit | None:
        """Return where the straight line from start to end (px) first meets a body, or None.

        The hit has the body, the point, the normal out of the body and the distance from start.
        Edges belong to bodies. The ray leaves a body that it starts in without a hit.
        """
        way = pair("World.ray_cast's start", start), pair("World.ray_cast's end", end)
        return cast_ray(self.members, *way)

    def acceleration(self, body: Body) -> tuple[float, float]:
        """Return the acceleration (px/s²) of a ball by gravity and by forces on it alone."""
        x, y = self.g
        if body in self.forces:
            fx, fy, _ = self.forces[body]
            x, y = x + fx * body.inv_mass, y + fy * body.inv_mass
        return x, y

    def anybody_sleeps(self) -> bool:
        """Return whether any body is asleep."""
        return len(self.awake) + len(self.statics) < len(self.members)

    def is_falling(self) -> bool:
        """Return whether gravity alone changes velocities in the substeps of this step."""
        return not (self.is_pushed or self.forces)

    def relieve(self, lost: dict[Body, float]) -> None:
        """Tell effects of masses (kg) that bodies have lost: infinity if they leave."""
        pull = math.hypot(*self.g) or 1.0
        self.call("unload", {body: mass * pull for body, mass in lost.items()}, self.g)

    def check(self) -> list[str]:
        """Return a sentence for each effect that is needed but undeclared, or declared but unused.

        Other sentences name a gravity too weak for the unit, and rods that shake. Without this
        call, a step warns of undeclared effects after bodies were added or changed.
        """
        lacking = missing(self, self.members)
        self.unchecked, self.warned = [], self.warned | lacking.keys()
        return [*lacking.values(), *unused(self), *odd_gravity(self), *overloaded_rods(self)]

    def warn(self) -> None:
        """Warn once of each undeclared effect that new or changed bodies need."""
        bodies = [body for body in dict.fromkeys(self.unchecked) if body.world is self]
        self.unchecked = []
        for name, sentence in missing(self, bodies).items():
            if name not in self.warned:
                self.warned.add(name)
                warnings.warn(sentence, stacklevel=3)

    def cut(self, dt: float) -> float:
        """Return the length (s) of a substep. Raises ValueError on a bad dt."""
        try:
            h = float(dt / self.substep_count)
        except TypeError:
            refuse("World.step's dt", dt, "a number of seconds")
        require(0 < h < math.inf, "World.step's dt", dt, "a finite number of seconds above 0")
        return h

    def step(self, dt: float) -> None:
        """Advance by dt seconds. Raises ValueError on a bad dt or a body with NaN or infinity."""
        h = self.cut(dt)
        for body in self.awake:
            if (body.x + body.y + body.vx + body.vy + body.turn + body.w) * 0.0:  # not 0, but NaN
                body.check()
        if not self.awake:
            for coast in self.hooks["coast"]:
                coast(dt)
            return

        # 1 detect: the step before has, unless the program has changed anything since
        falls = self.g != (0.0, 0.0)
        has_lags = falls or bool(self.hooks["lag"] or self.forces)
        is_known = self.lags.take_off(h)
        has_changed = self.has_changed
        if has_changed:
            if self.unchecked:
                self.warn()
            self.detect(h)
        if has_lags and not is_known:
            self.lags.take_off_new(h)
        for impact in self.hooks["impact"] if has_changed else []:
            impact(h)
        if self.is_outdated:
            self.update_hooks()

        # 2 prepare
        for prepare in self.hooks["prepare"]:
            prepare(h)
        forces, warm_starts = self.hooks["force"], self.hooks["warm_start"]
        solves, relaxes = self.hooks["solve"], self.hooks["relax"]

        substeps = self.substep_count
        if self.is_falling():
            self.fall(h)
            substeps = 0  # nothing to solve
        for _ in range(substeps):
            # 3 forces
            for force in forces:
                force(h)
            if falls or self.forces:
                self.accelerate(h)

            # 4 solve
            for warm_start in warm_starts:
                warm_start(h)
            for solve in solves:
                solve(h)

            # 5 move
            self.move(h)

            # 6 relax
            for relax in relaxes:
                relax(h)

        for finish in self.hooks["finish"]:
            finish(h)
        if self.awake:
            self.detect(h)
            for impact in self.hooks["impact"]:
                impact(h)
            if self.is_outdated:
                self.update_hooks()
        self.lags.forget()
        if has_lags:
            self.lags.add(h)
        self.lags.pushed, self.forces = self.forces, {}
        for tell in self.hooks["tell"]:
            tell(h)

    def detect(self, h: float) -> None:
        """Find out which bodies touch. If the program has changed anything, no effect rests."""
        has_changed = self.has_changed
        if has_changed:
            self.update_hooks()
        self.has_changed = False
        for detect in self.hooks["detect"]:
            detect(h)
        if has_changed:
            self.steered = []
            if self.is_outdated:
                self.update_hooks()

    def fall(self, h: float) -> None:
        """Accelerate by gravity, move and turn awake balls, for all substeps of h seconds at once.

        In n substeps of semi-implicit Euler the velocity grows by n g h, and is g h (n + 1) / 2
        above the first in the mean.
        """
        n, (gx, gy) = self.substep_count, self.g
        dt, mean = n * h, h * (n + 1) / 2
        if not (gx or gy):
            self.move(dt)
            return
        mean_x, mean_y, gx, gy = gx * mean, gy * mean, gx * dt, gy * dt
        for body in self.awake:
            body.x += (body.vx + mean_x) * dt
            body.y += (body.vy + mean_y) * dt
            body.vx += gx
            body.vy += gy
            if body.w:
                body.turn += body.w * dt

    def accelerate(self, h: float) -> None:
        """Accelerate balls for h seconds, by forces on them and by gravity."""
        for body, (fx, fy, torque) in self.forces.items():
            body.vx += fx * body.inv_mass * h
            body.vy += fy * body.inv_mass * h
            body.w += torque * body.inv_inertia * h
        gx, gy = self.g[0] * h, self.g[1] * h
        for body in self.awake if gx or gy else []:
            body.vx += gx
            body.vy += gy

    def move(self, h: float) -> None:
        """Move and turn awake balls with their new velocities (semi-implicit Euler)."""
        for body in self.awake:
            body.x += body.vx * h
            body.y += body.vy * h
            if body.w:
                body.turn += body.w * h


def find_hooks(name: str, effects: list[Effect]) -> list[Callable[..., Any]]:
    """Return the hooks of this name that effects override."""
    base = getattr(Effect, name)
    return [getattr(effect, name) for effect in effects if getattr(type(effect), name) is not base]
