"""Fonts of the system: a page has none."""

from .font import SysFont, get_fonts, match_font

__all__ = ["SysFont", "get_fonts", "initsysfonts", "match_font"]


def initsysfonts():
    """Do nothing."""
