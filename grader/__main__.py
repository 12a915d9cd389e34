"""`python -m grader`: the current folder is no place to import from, it may be a submission."""

import os
import sys

here = os.getcwd()
kit = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:] = [entry for entry in sys.path if os.path.abspath(entry or here) != here or entry == kit]
if kit not in sys.path:
    sys.path.insert(0, kit)

from grader.cli import main  # noqa: E402

main()
