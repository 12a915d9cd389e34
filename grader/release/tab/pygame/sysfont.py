"""Fonts of the system: a page has none."""

from .font import SysFont


def initsysfonts():
    """Do nothing."""
