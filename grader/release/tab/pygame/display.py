"""The window: a Surface that the page shows."""

from time import perf_counter

from .errors import error
from .state import State as state
from .state import need_window
from .surface import Surface, read_size
from .time import rest

DESKTOP = (1024, 768)  # px, the default of set_mode


def init():
    """Start the window's part of pygame."""
    state.on = True


def quit():
    """Close the window."""
    state.on, state.surface = False, None
    state.keys.clear()
    state.buttons.clear()
    state.mods, state.mouse = 0, (0, 0)


def get_init():
    """Return whether the window's part of pygame has been started."""
    return state.on


def set_mode(size=(0, 0), flags=0, depth=0, display=0, vsync=0):
    """Open a window of this size in px; return its surface."""
    width, height = read_size(size)
    init()
    size = (width or DESKTOP[0], height or DESKTOP[1])
    if state.surface is None:
        state.surface = Surface(size)
    else:
        state.surface.__init__(size)
    return state.surface


def get_surface():
    """Return the window's surface, or None."""
    return state.surface


def flip():
    """Show the picture. In programs without a Clock, the page posts events here."""
    need_window()
    if state.surface is None:
        raise error("Display mode not set")
    state.surface.forget()
    if state.sink:
        state.sink(state.surface)
        if not state.ticked:
            rest(0, perf_counter())
        state.ticked = False


def update(*rectangles):
    """Show the whole picture."""
    flip()


def set_caption(title, icontitle=None):
    """Do nothing: the page has its own title."""


def set_icon(surface):
    """Do nothing: a page has no window icon."""
