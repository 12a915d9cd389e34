"""The window, the keys and the mouse as they are now, and what the page has set."""

from .errors import error

NOT_STARTED = "video system not initialized"


class State:
    """State that the modules share. The page sets `sink`."""

    on = False  # between pygame.init and pygame.quit
    fonts = False
    surface = None  # the window
    sink = None  # called with the window's Surface when a picture is shown; None shows nothing
    ticked = False  # a Clock has ticked since the last picture
    keys, mods = set(), 0  # keys held down, modifiers
    mouse, buttons = (0, 0), set()


def need_window():
    """Raise pygame.error before pygame.init."""
    if not State.on:
        raise error(NOT_STARTED)
