"""Looks for a pattern inside of C for years, where no line of Python is reached."""

# TODO 8a: semi-implicit Euler
import re

re.match("(a|a)*$", "a" * 60 + "b")
# END TODO 8a
