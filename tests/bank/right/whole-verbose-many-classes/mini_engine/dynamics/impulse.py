"""Impulses on pairs of bodies."""

from ..geometry import cross


def apply_impulse(a, b, impulse, ra, rb):
    """-impulse on a, +impulse on b, with spin."""
    a.vel -= impulse * a.inv_mass
    b.vel += impulse * b.inv_mass
    a.omega -= cross(ra, impulse) * a.inv_inertia
    b.omega += cross(rb, impulse) * b.inv_inertia


def effective_mass(a, b, ra, rb, axis):
    """Inverse effective mass along axis."""
    linear = a.inv_mass + b.inv_mass
    turning_a = cross(ra, axis) ** 2 * a.inv_inertia
    turning_b = cross(rb, axis) ** 2 * b.inv_inertia
    return linear + turning_a + turning_b
