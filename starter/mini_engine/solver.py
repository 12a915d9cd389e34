"""Impulses at contacts.

ra and rb are the arms: from each body's centre to the contact point, in px.
"""

import math

from pygame import Vector2

from .constants import BETA, RESTING_SPEED, SLOP
from .shapes import cross, spin_velocity


def apply_impulse(a, b, impulse, ra, rb):
    """Push B by impulse (kg px/s) and A by the opposite, and turn both."""
    a.vel -= impulse * a.inv_mass
    a.omega -= cross(ra, impulse) * a.inv_inertia
    b.vel += impulse * b.inv_mass
    b.omega += cross(rb, impulse) * b.inv_inertia


def effective_mass(a, b, ra, rb, axis):
    """Return the change of speed along axis per unit of impulse, in 1/kg.

    This is the inverse of the effective mass:
    1/m_a + 1/m_b + (ra x axis)²/I_a + (rb x axis)²/I_b.
    """
    total = a.inv_mass + b.inv_mass
    # TODO 2: add the spin terms
    # Add (ra x axis)²/I_a and (rb x axis)²/I_b to total.
    # END TODO 2
    return total


def arms(c):
    """The arms of contact c, (ra, rb)."""
    return c.point - c.a.pos, c.point - c.b.pos


def relative_velocity(a, b, ra, rb):
    """Velocity (px/s) of B as seen from A at the contact point, spin included."""
    return b.vel + spin_velocity(b.omega, rb) - a.vel - spin_velocity(a.omega, ra)


def target_speed(c, dt):
    """The speed (px/s) at which B should leave A: the larger of bounce and push-out.

    The bounce is for bodies closing faster than RESTING_SPEED; the push-out takes away the share
    BETA of the overlap beyond SLOP in one step of dt seconds (Baumgarte's method).
    """
    closing = -relative_velocity(c.a, c.b, *arms(c)).dot(c.normal)
    bounce = min(c.a.restitution, c.b.restitution) * closing if closing > RESTING_SPEED else 0.0
    push_out = BETA / dt * max(c.depth - SLOP, 0.0)
    return max(bounce, push_out)


def solve_normal(c):
    """One pass over the normal impulse: bring the speed along the normal to c.target.

    The accumulated total is clamped, not the change, so a later pass can take back too much.
    """
    a, b = c.a, c.b
    ra, rb = arms(c)
    speed = relative_velocity(a, b, ra, rb).dot(c.normal)
    total = c.jn + (c.target - speed) / effective_mass(a, b, ra, rb, c.normal)
    total = max(total, 0.0)
    apply_impulse(a, b, c.normal * (total - c.jn), ra, rb)
    c.jn = total


def friction_limit(c):
    """The largest friction impulse (kg px/s) in either direction, by Coulomb's law."""
    return math.sqrt(c.a.friction * c.b.friction) * c.jn


def solve_friction(c):
    """One pass over the friction impulse: bring the slip to 0 as far as the limit allows."""
    a, b = c.a, c.b
    ra, rb = arms(c)
    tangent = Vector2(-c.normal.y, c.normal.x)
    slip = relative_velocity(a, b, ra, rb).dot(tangent)
    total = c.jt - slip / effective_mass(a, b, ra, rb, tangent)
    # TODO 4: clamp the friction total
    # Keep total within friction_limit(c) in both directions.
    # END TODO 4
    apply_impulse(a, b, tangent * (total - c.jt), ra, rb)
    c.jt = total
