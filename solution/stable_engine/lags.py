"""Velocities that lag behind positions in a step, by half a substep, as in a leapfrog."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from .body import Body
from .effect import Push

if TYPE_CHECKING:
    from .world import World


class Lags:
    """What half a substep adds to the velocity of each body: lag_x and lag_y, in px/s.

    In the substeps, velocities are those of the moves. Between steps they belong to the same time
    as the positions: so a step takes its lags off, and adds them at its end. What is pressed, by
    contacts or stiff springs, does not lag.
    """

    __slots__ = ("h", "pushed", "world")

    def __init__(self, world: World) -> None:
        self.world = world
        self.h = 0.0  # s, the substep for which lags are known, or 0
        self.pushed: dict[Body, Push] = {}  # the forces of the step before

    def forget(self) -> None:
        """Let the next step find lags anew, as something has changed."""
        self.h = 0.0

    def take_off(self, h: float) -> bool:
        """Take the lags of the step before off. Return whether they are those of this step."""
        forces, pushed = self.world.forces, self.pushed
        is_known = h == self.h and forces.keys() == pushed.keys()
        if pushed and forces != pushed:
            self.end_pushes()
            is_known = is_known and self.world.substep_count == 1  # else no impulse would be whole
        if is_known:
            for body in self.world.awake:
                body.vx -= body.lag_x
                body.vy -= body.lag_y
                body.is_pressed = False
        return is_known

    def take_off_new(self, h: float) -> None:
        """Find lags and take them off, once contacts are known."""
        self.change(-h / 2)
        for body in self.world.awake:
            body.is_pressed = body.is_fresh = False

    def add(self, h: float) -> None:
        """Find lags at the end of a step and add them."""
        self.h = h
        self.change(h / 2)

    def change(self, seconds: float) -> None:
        """Change velocities as so many seconds would (below 0: back) where bodies are now."""
        world = self.world
        gx, gy = world.g[0] * seconds, world.g[1] * seconds
        for body in world.awake:
            body.lag_x, body.lag_y = gx, gy
        for body, (fx, fy, _) in world.forces.items():
            body.lag_x += fx * body.inv_mass * seconds
            body.lag_y += fy * body.inv_mass * seconds
        for press in world.hooks["press"]:
            press(2 * abs(seconds))
        for lag in world.hooks["lag"]:
            lag(seconds)
        for body in world.awake:
            if body.is_pressed:
                body.lag_x = body.lag_y = 0.0
            else:
                body.vx += body.lag_x
                body.vy += body.lag_y

    def end_pushes(self) -> None:
        """Tell effects of forces that are less than in the step before."""
        for body, (before_x, before_y, _) in self.pushed.items():
            fx, fy, _ = self.world.forces.get(body, (0.0, 0.0, 0.0))
            lost = before_x - fx, before_y - fy
            if body.world is self.world and lost[0] * before_x + lost[1] * before_y > 0:
                self.world.call("unload", {body: hypot(*lost)}, lost)
