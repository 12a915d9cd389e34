"""The folder that came with the assignment."""

__version__ = "0"
