"""Let tests import the compiled stable engine for the plain one: the same bits, in less time.

`make soak` uses it for the longest tests: pytest -p compiled_engine -m "soak and compiled".
"""

import importlib
import pkgutil
import sys
from pathlib import Path

import pytest

NAME, FOLDER = "stable_compiled", Path(__file__).parents[2] / "build" / "compiled"


def use_compiled_engine():
    """Import all its modules, and call them stable_engine. Raises UsageError if it is stale."""
    sys.path.append(str(FOLDER))
    try:
        package = importlib.import_module(NAME)
    except ImportError:
        raise pytest.UsageError(f"There is no compiled engine in {FOLDER}: make compiled") from None
    for module in pkgutil.iter_modules(package.__path__, f"{NAME}."):
        importlib.import_module(module.name)
    for name in [name for name in sys.modules if name.partition(".")[0] == NAME]:
        sys.modules[name.replace(NAME, "stable_engine", 1)] = sys.modules[name]
    from experiments.compiled import load

    if load(FOLDER) is None:
        raise pytest.UsageError(f"The engine in {FOLDER} is of another source: make compiled")


use_compiled_engine()
