"""Keys: names, codes and which are down."""

from .constants import key_names
from .naming import Named
from .state import State, need_window

CODES = {name: code for code, name in reversed(key_names.items())}


class ScancodeWrapper(metaclass=Named):
    """Says for each key whether it is down."""

    def __init__(self, down):
        self.down = frozenset(down)

    def __getitem__(self, key):
        return key in self.down

    def __len__(self):
        return 512


def get_pressed():
    """Return which keys are down, by their codes."""
    need_window()
    return ScancodeWrapper(State.keys)


def get_mods():
    """Return the modifiers that are down, as a sum of KMOD numbers."""
    need_window()
    return State.mods


def set_mods(mods):
    """Set the modifiers that count as down."""
    need_window()
    State.mods = int(mods)


def key_code(name):
    """Return the code of a key by its name."""
    need_window()
    try:
        return CODES[name.lower()]
    except KeyError:
        raise ValueError("unknown key name") from None


def name(key, use_compat=True):
    """Return the name of a key."""
    return key_names.get(key, "")


def set_repeat(delay=0, interval=0):
    """Do nothing: the page's keys do not repeat."""
