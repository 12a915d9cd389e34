"""Damping: whatever moves slows down, as if in air or water."""

from math import exp, expm1

from .body import Body
from .effect import Effect
from .validate import not_negative


class Damping(Effect):
    """Each second a ball keeps the share exp(-rate) of its velocity and spin, whatever the step.

    A force that acts on it gives an acceleration a and, in the end, the speed a / rate. Drag also
    slows what the force of this substep adds. So drag of a substep is split: `force` takes its part
    before forces act, and `solve` takes the rest once all have acted, before bodies move.

    Rates are per second. Raises ValueError when one is negative, NaN or infinite.
    """

    __slots__ = ("angular_rate", "linear_rate")
    rank = 8  # solves after all other effects

    def __init__(self, linear: float = 0.05, angular: float = 0.3) -> None:
        self.linear_rate = self.angular_rate = 0.0
        self.linear, self.angular = linear, angular

    @property
    def linear(self) -> float:
        """Return the rate of velocity, in 1/s."""
        return self.linear_rate

    @linear.setter
    def linear(self, value: float) -> None:
        self.linear_rate = not_negative("Damping.linear", value)
        self.update()

    @property
    def angular(self) -> float:
        """Return the rate of spin, in 1/s."""
        return self.angular_rate

    @angular.setter
    def angular(self, value: float) -> None:
        self.angular_rate = not_negative("Damping.angular", value)
        self.update()

    def is_used(self) -> bool:
        return self.linear > 0 or self.angular > 0

    def update(self) -> None:
        """Tell the world, if there is one, to ask again whether damping is idle."""
        if hasattr(self, "world"):
            self.world.update_hooks()

    def is_idle(self) -> bool:
        return not self.is_used()

    def force(self, h: float) -> None:
        taken, taken_spin = taken_last(self.linear, h), taken_last(self.angular, h)
        self.slow(exp(-self.linear * h) / taken, exp(-self.angular * h) / taken_spin)

    def lag(self, seconds: float) -> None:
        lost, taken = expm1(-self.linear * seconds), taken_last(self.linear, seconds)
        for body in self.world.awake:
            body.lag_x = taken * body.lag_x + lost * body.vx
            body.lag_y = taken * body.lag_y + lost * body.vy

    def solve(self, h: float) -> None:
        self.slow(taken_last(self.linear, h), taken_last(self.angular, h))

    def slow(self, kept: float, kept_spin: float) -> None:
        """Leave these shares of all velocities and spins."""
        for body in self.world.awake:
            body.vx *= kept
            body.vy *= kept
            body.w *= kept_spin

    def drag(self, rates: dict[Body, float]) -> None:
        for body in self.world.awake if self.linear else ():
            rates[body] = rates.get(body, 0.0) + self.linear


def taken_last(rate: float, h: float) -> float:
    """Return the share that drag leaves, in h seconds, of what a steady force adds."""
    lost = rate * h
    return -expm1(-lost) / lost if lost else 1.0
