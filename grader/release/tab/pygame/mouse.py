"""The mouse: where it is, and which buttons are down."""

from .state import State, need_window


def get_pos():
    """Return the pointer's position in the window, in px."""
    need_window()
    return State.mouse


def set_pos(*place):
    """Set the pointer's position for get_pos; the page cannot move it."""
    need_window()
    x, y = place if len(place) == 2 else place[0]
    State.mouse = int(x), int(y)


def get_pressed(num_buttons=3):
    """Return for each of the first three or five buttons whether it is down."""
    need_window()
    if num_buttons not in (3, 5):
        raise ValueError("Number of buttons needs to be 3 or 5.")
    return tuple(number in State.buttons for number in range(1, num_buttons + 1))


def set_visible(value):
    """Do nothing: the page shows the pointer."""
    return True
