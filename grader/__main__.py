"""Run `python -m grader`. Nothing is imported from the current folder, which may be a
submission."""

import gc
import os
import signal
import sys

gc.set_threshold(10_000)  # by default, a twentieth of a grade would be collecting
here = os.getcwd()
kit = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:] = [kit, *(each for each in sys.path if os.path.abspath(each or here) != here)]

try:
    if not sys.argv[1:] or sys.argv[1] in ("check", "hand-in"):
        from grader.judge.wall.starting import count_cores, start_ahead

        start_ahead(count_cores())  # it loads while this process does

    from grader.cli.main import main

    main()
except KeyboardInterrupt:  # while it starts, or between two commands' own words for it
    print("stopped before the end", file=sys.stderr)
    sys.exit(2)
finally:
    gc.freeze()  # nothing is left to collect: saves a tenth of a check
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the output is complete: there is nothing to stop
