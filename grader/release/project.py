"""Make the pyproject.toml by which uv sets up a student's folder: `uv run grader check`."""

import re

PINNED = re.compile(r"^([\w.-]+==[^\s;]+)(?:\s*;\s*([^\\\n]+?))?\s*\\?$", re.MULTILINE)
PROJECT = """\
# For uv: `uv run grader check` installs what is needed and runs the check. pip needs no more
# than requirements.txt.

[project]
name = "physics-lab"
version = "1"
requires-python = ">=3.11,<3.15"
dependencies = ["physics-grader"]

[tool.uv]
package = false
constraint-dependencies = [ # the versions of requirements.txt
{pins}]

[tool.uv.sources]
physics-grader = {{ path = "{wheel}" }}
"""


def make_project(requirements: str, wheel: str) -> str:
    """Return the file; `wheel` is the name of the grader's wheel beside it.

    It pins what `requirements` pins, and records no address: uv makes its own lock from it.
    """
    pins = ["; ".join(filter(None, found)) for found in PINNED.findall(requirements)]
    return PROJECT.format(pins="".join(f'  "{pin}",\n' for pin in pins), wheel=wheel)
