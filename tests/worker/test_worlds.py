"""Test which attacks succeed if a machine lacks layers. walls.toml has the answers.

The hostile bank is graded without namespaces, without Landlock and without both, by the current
user, root or not.
"""

import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import bare_container
import hostile_bank
import pytest
from test_security import expected_layers
from whole_bank import bank

from grader.judge.task import KIT

pytestmark = [
    pytest.mark.soak,  # 10 minutes of processor time for each world
    pytest.mark.skipif(
        sys.platform != "linux"
        or not {"system-calls", "own-root", "landlock-scope"} <= expected_layers(),
        reason="walls.toml is about a Linux that has all layers",
    ),
]

GOES_THROUGH = tomllib.loads(Path(__file__).with_name("walls.toml").read_text("utf-8"))[
    "goes_through"
]
WORLDS = {  # names in walls.toml, with the features refused
    "no namespaces": "namespaces",
    "no Landlock": "landlock",
    "neither": "namespaces,landlock",
}


@pytest.mark.parametrize("world", WORLDS)
def test_nothing_else_goes_through(world: str) -> None:
    """`make verify` grades the same members with all layers."""
    bare = [sys.executable, bare_container.__file__, WORLDS[world]]
    done = subprocess.run(
        [*bare, sys.executable, hostile_bank.__file__, world],
        cwd=KIT,
        env={**os.environ, "PYTHONPATH": str(KIT)},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    complaints = json.loads(done.stdout.splitlines()[-1])
    assert set(complaints) == {member.name for member in bank() if member.kind == "hostile"}
    through = {name: complaint for name, complaint in complaints.items() if complaint}
    assert set(through) == set(GOES_THROUGH[world]), through
