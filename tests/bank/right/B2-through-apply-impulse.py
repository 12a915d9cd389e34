"""Hands the impulse to the solver's function."""

# TODO B2: pull the ends together
from ..solver import apply_impulse

if dt > 0:
    stretch = distance - self.length
    closing = axis.dot(self.a.vel) - axis.dot(self.b.vel)
    impulse = -dt * (self.stiffness * stretch - self.damping * closing)
    apply_impulse(self.a, self.b, axis * impulse, Vector2(), Vector2())
# END TODO B2
