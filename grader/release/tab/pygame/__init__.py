"""pygame for a page: the parts of pygame-ce that the lab uses, in Python, without a window.

The page puts it first on `sys.path` of its Python, which runs in a web worker. It sets:

- `pygame.display.state.sink = show`: `show(surface)` is called for each picture. `surface.ops` is
  the list of its draw commands, `surface.size` its (width, height) in px. None shows nothing.
- `pygame.Clock.wait_hook = rest`: `rest(fps, last)` rests until 1/fps seconds after `last`, a time
  of `perf_counter` in s, or not at all where fps is 0. Meanwhile it posts new events,
  with `pygame.event.post(pygame.event.Event(type, {name: value}))`. It is called by `tick`, by
  `pygame.time.wait` and `delay`, and by `flip` in programs without a Clock.
- `pygame.event.wait_hook = rest_a_frame`: called without arguments while `wait` has no event.
- `pygame.event.pump_hook = look`: called by `event.get`, `poll`, `peek` and `pump`; may be None.

While there is a sink, events that are posted also say which keys and buttons are down and where the
mouse is. Needed are `key` and, if known, `mod` and `unicode` of KEYDOWN (768) and KEYUP (769), `pos`
and `button` of MOUSEBUTTONDOWN (1025) and MOUSEBUTTONUP (1026), `pos` of MOUSEMOTION (1024), `y` of
MOUSEWHEEL (1027); QUIT (256) has nothing. A click at a place (x, y) of the canvas, in its own
pixels, has `pos` (x, y).

The draw commands are tuples; lengths in px, colours as #RRGGBB or #RRGGBBAA, a width of 0 fills:

    ("rect", x, y, w, h, colour, width)         with a radius of the corners behind it, if any
    ("circle", x, y, radius, colour, width)     a width lies inside the radius
    ("line", x, y, to_x, to_y, colour, width)
    ("poly", [x, y, x, y, ...], colour, 0)
    ("text", x, y, text, colour, size)          (x, y) is left and top; pygame's font of 26 px is as
                                                wide as a bold 18 px of Arial or Helvetica
    ("at", x, y, commands)                      commands moved by (x, y)
    ("within", x, y, w, h, commands)            commands clipped to this rectangle

The first command of a window fills it: ("rect", 0, 0, width, height, colour, 0).
"""

from . import display, draw, event, font, image, key, math, missing, mouse, sysfont, time, version
from .color import Color
from .constants import *
from .errors import error
from .event import Event
from .font import Font
from .math import Vector2
from .rect import Rect
from .surface import Surface
from .time import Clock
from .version import ver

__version__ = ver
missing.install()


def init():
    """Start all of pygame; return the numbers of parts that started and failed."""
    display.init()
    font.init()
    return 4, 0


def quit():
    """End all of pygame, and close the window."""
    display.quit()
    font.quit()
    event.queue.clear()


def get_init():
    """Return whether pygame has been started."""
    return display.get_init()
