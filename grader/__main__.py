"""Run `python -m grader`. Nothing is imported from the current folder, which may be a
submission."""

import os
import signal
import sys

here = os.getcwd()
kit = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:] = [kit, *(each for each in sys.path if os.path.abspath(each or here) != here)]

try:
    from grader.cli.main import main

    main()
except KeyboardInterrupt:  # while it starts, or between two commands' own words for it
    print("stopped before the end", file=sys.stderr)
    sys.exit(2)
finally:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the output is complete: there is nothing to stop
