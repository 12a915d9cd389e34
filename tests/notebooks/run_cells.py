"""Run a notebook's code cells in order, as Jupyter does, and print what failed as JSON.

The output of the last cell is printed too.

    python run_cells.py NOTEBOOK [--draw]

A failing cell does not stop the next one. Figures are drawn only with --draw and if matplotlib is
installed, since it takes longer to load than most notebooks to run.
"""

import io
import json
import os
import sys
from contextlib import redirect_stdout
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from unittest.mock import MagicMock


def stand_in():
    """Replace pyplot by a stub that draws nothing."""

    def subplots(rows=1, columns=1, **look):
        axes = [MagicMock() for _ in range(rows * columns)]
        return MagicMock(), axes[0] if len(axes) == 1 else axes

    package, pyplot = ModuleType("matplotlib"), MagicMock()
    pyplot.subplots = subplots
    package.pyplot = pyplot
    sys.modules.update({"matplotlib": package, "matplotlib.pyplot": pyplot})


def main(path, draws):
    os.environ["MPLBACKEND"] = "agg"
    if not draws or find_spec("matplotlib") is None:
        stand_in()
    os.chdir(path.parent)
    sys.path.insert(0, "")
    space, failed, said = {"__name__": "__main__"}, {}, ""
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] != "code":
            continue
        out = io.StringIO()
        try:
            with redirect_stdout(out):
                exec(compile("".join(cell["source"]), cell["id"], "exec"), space)
        except Exception as error:
            failed[cell["id"]] = f"{type(error).__name__}: {error}"
        said = out.getvalue()
    kept = {name: space.get(name) for name in ("by_step", "by_passes", "spring_curves")}
    print(json.dumps({"failed": failed, "kept": kept, "said": said}))


main(Path(sys.argv[1]).resolve(), "--draw" in sys.argv)
