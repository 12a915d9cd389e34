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

LACKS = """cannot start: {package} is not installed for {python}
Grading needs Python 3.11 or newer, and the packages of .venv. In the kit, type make setup, then use
.venv/bin/python -m grader (on Windows, .venv\\Scripts\\python -m grader). In the folder of the lab,
activate .venv as README.md says, and type python -m pip install -r requirements.txt."""

try:
    if not sys.argv[1:] or sys.argv[1] in ("check", "hand-in"):
        from grader.judge.wall.starting import count_cores, start_ahead

        start_ahead(count_cores())  # it loads while this process does

    from grader.cli.main import main

    main()
except ModuleNotFoundError as error:
    if (error.name or "grader").partition(".")[0] == "grader":
        raise
    print(LACKS.format(package=error.name, python=sys.executable), file=sys.stderr)
    sys.exit(2)
except KeyboardInterrupt:  # while it starts, or between two commands' own words for it
    print("stopped before the end", file=sys.stderr)
    sys.exit(2)
finally:
    gc.freeze()  # nothing is left to collect: saves a tenth of a check
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the output is complete: there is nothing to stop
