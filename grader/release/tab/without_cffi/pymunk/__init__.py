"""Stand in for pymunk on a page made without cffi: none of its classes can be used."""

REASON = "this page was made without pymunk: do TODO 7 and B4 on a computer with Python"


class Missing:
    """A class that explains, when used, what is missing."""

    DYNAMIC, KINEMATIC, STATIC = range(3)

    def __init__(self, *_, **__):
        raise ImportError(REASON)


SHAPES = ("Circle", "Poly", "Segment", "Shape", "ShapeFilter")
for each in ("Arbiter", "BB", "Body", "Constraint", "Space", *SHAPES):
    globals()[each] = type(each, (Missing,), {"step": lambda self, dt: None})
Vec2d = type("Vec2d", (Missing,), {})
from . import constraints  # noqa: E402, F401 - as pymunk itself does, before __getattr__


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    raise ImportError(REASON)
