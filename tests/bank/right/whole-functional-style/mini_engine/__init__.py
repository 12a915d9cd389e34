"""Mini engine, functional style: data in simple objects, everything else functions."""

from .data import *
from .data import __all__ as _data
from .physics import *
from .physics import __all__ as _physics
from .app import advance, ball, main, make_world

__all__ = [*_data, *_physics, "advance", "ball", "main", "make_world"]
