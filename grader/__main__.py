"""`python -m grader`: the current folder is no place to import from, it may be a submission."""

import os
import sys

here = os.getcwd()
kit = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:] = [kit, *(each for each in sys.path if os.path.abspath(each or here) != here)]

from grader.cli import main  # noqa: E402

main()
