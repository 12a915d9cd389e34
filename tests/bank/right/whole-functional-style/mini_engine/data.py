"""Numbers and plain data."""

from types import SimpleNamespace

from pygame import Vector2

__all__ = ["WIDTH", "HEIGHT", "STEP", "MAX_STEPS", "ITERATIONS", "BETA", "SLOP", "RESTING_SPEED", "MAX_BALLS",
           "Circle", "Box", "Body", "Contact"]

WIDTH, HEIGHT = 900, 600
STEP = 1 / 120
MAX_STEPS = 8
ITERATIONS = 8
BETA = 0.2
SLOP = 0.5
RESTING_SPEED = 30
MAX_BALLS = 40


def Circle(radius):
    return SimpleNamespace(kind="circle", radius=radius)


def Box(half):
    return SimpleNamespace(kind="box", half=Vector2(half))


class Record(SimpleNamespace):
    """Compares by identity, so that it can be a key."""

    __eq__ = object.__eq__
    __hash__ = object.__hash__
    is_static = property(lambda self: self.inv_mass == 0)


def Body(shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(170, 190, 220)):
    if shape.kind == "box" and mass != 0:
        raise ValueError("Box bodies are static: mass must be 0")
    inverses = (1 / mass, 2 / (mass * shape.radius**2)) if mass else (0.0, 0.0)
    return Record(
        shape=shape, pos=Vector2(pos), vel=Vector2(0, 0), angle=0.0, omega=0.0,
        inv_mass=inverses[0], inv_inertia=inverses[1],
        restitution=restitution, friction=friction, color=color,
    )


def Contact(a, b, normal, depth, point):
    return Record(a=a, b=b, normal=normal, depth=depth, point=point, jn=0.0, jt=0.0, target=0.0)
