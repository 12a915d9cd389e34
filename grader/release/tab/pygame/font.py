"""Fonts: the page's own letters, in the sizes of pygame's default font."""

from os import getcwd

from .constants import SRCALPHA
from .errors import error
from .naming import Named, full_name
from .state import State
from .surface import Surface

ADVANCES = (  # widths of the characters from space to ~, in thousandths of the size
    "191 229 325 382 382 611 496 163 229 229 267 401 191 229 191 191 417 329 382 435 382 429 420 382 "
    "425 425 229 229 401 401 401 420 669 496 496 496 496 458 420 535 497 191 382 542 420 572 496 534 "
    "458 584 496 458 420 496 458 649 511 458 420 229 192 228 401 385 229 382 457 382 457 382 229 457 "
    "420 191 191 443 191 611 420 420 457 457 267 381 292 420 382 534 443 382 382 267 193 267 401"
)
WIDTHS = dict(zip(map(chr, range(32, 127)), map(int, ADVANCES.split()), strict=True))
AVERAGE = 420  # of other characters


class Font(metaclass=Named):
    """A font of a size in px; there is one family."""

    def __init__(self, name=None, size=20, *_, **__):
        if not State.fonts:
            raise error("font not initialized")
        if not isinstance(size, int):
            raise TypeError(f"{full_name(size)!r} object cannot be interpreted as an integer")
        if isinstance(name, str):
            raise FileNotFoundError(f"No file '{name}' found in working directory '{getcwd()}'.")
        self._size = max(size, 1)

    def render(self, text, antialias=True, color=None, bgcolor=None, wraplength=0):
        """Return a surface with a text on it."""
        if color is None:
            raise TypeError("function missing required argument 'color' (pos 3)")
        if not isinstance(text, str | None):
            raise TypeError("text must be a string")
        text = text or ""
        made = Surface(self.size(text), SRCALPHA)
        css = made.css(color)
        if bgcolor is not None:
            made.fill(bgcolor)
        made.ops.append(("text", 0.0, 0.0, text, css, self._size))
        return made

    def size(self, text):
        """Return (width, height) of a text in px."""
        wide = sum(WIDTHS.get(letter, AVERAGE) for letter in text)
        return round(wide * self._size / 1000), self.get_height()

    def get_height(self):
        """Return the height of a line's letters in px."""
        return int(self._size * 0.69)


def SysFont(name, size, bold=False, italic=False):  # noqa: N802 (its name in pygame)
    """Return a font of a size; the name of a family is ignored."""
    return Font(None, size)


def init():
    """Start the fonts."""
    State.fonts = True


def quit():
    """End the fonts."""
    State.fonts = False


def get_init():
    """Return whether the fonts have been started."""
    return State.fonts
