"""List attacks of hostile submissions as text; `{answers}` is an instructor's file.

Each uses only public knowledge: the graders' documentation and source.
"""

ENDS = "import os\nos._exit(0)\n"

NEVER_ENDS = "while True:\n    pass\n"

# Looks for the right answers in the memory of the process that asks.
TAKES_ANSWERS = """
import functools, gc

@functools.cache
def stolen(name):
    for thing in gc.get_objects():
        if callable(thing) and getattr(thing, "__name__", "") == "exact_step":
            return lambda x, v, dt, accel: thing(name, x, v, dt, accel)
        if getattr(thing, "__module__", "") == "grader.checks.exact":
            if getattr(thing, "__name__", "") == name:
                return thing
    raise LookupError("no answers here")

def semi_implicit_euler(x, v, dt, accel):
    return stolen("semi_implicit_euler")(x, v, dt, accel)

def velocity_verlet(x, v, dt, accel):
    return stolen("velocity_verlet")(x, v, dt, accel)

def rk4(x, v, dt, accel):
    return stolen("rk4")(x, v, dt, accel)
"""

# Replaces both checks in every running program.
REPLACES_CHECKS = """
import sys
frame = sys._getframe()
while frame:
    frame.f_globals.update(dict.fromkeys(("want_steps", "want_spring"), lambda *_: None))
    frame = frame.f_back
semi_implicit_euler = velocity_verlet = rk4 = None
"""

# Makes every check pass, in the words of each grader.
FORGES = {
    "check50": REPLACES_CHECKS,
    "gradescope-utils": REPLACES_CHECKS,
    "nbgrader": "get_ipython().input_transformers_cleanup.append(lambda lines: ['pass\\n'])\n",
    "otter-grader": """
from otter.test_files.exception_test import test_case
test_case.call_func = lambda self, environment: None
""",
    "this kit": """
import builtins, json, os, sys
for name in ("all", "any", "isinstance"):
    setattr(builtins, name, lambda *_: True)
sys.modules["math"].isclose = lambda *_, **__: True
reply = json.dumps({"points": 6, "max_points": 6}).encode()
for descriptor in range(64):
    try:
        os.write(descriptor, len(reply).to_bytes(4, "big") + reply)
    except OSError:
        pass
""",
}

READS_FILES = """
open({answers!r}, "a").write("# changed by a student")
exec(open({answers!r}).read())
"""
