"""Test which layer stops which attack: each layer alone, and none. walls.toml has the answers.

The members are those of the bank that answer right if their attack succeeds, and wrong if it is
refused. `make verify` grades them with all layers.
"""

import os
import shutil
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from test_security import SWITCHES, expected_layers

from grader.bank.members import list_attacks, put_regions
from grader.judge.submission import Submission
from grader.judge.task import KIT, Options, sandbox_for
from grader.judge.wall.children import Worker, start_worker
from grader.protocol import Import, Integrate, Items, Returned, Vec

pytestmark = pytest.mark.skipif(
    sys.platform != "linux"
    or not {"system-calls", "own-root", "landlock-scope"} <= expected_layers(),
    reason="walls.toml is about a Linux that has all layers",
)

STOPPED_BY = tomllib.loads(Path(__file__).with_name("walls.toml").read_text("utf-8"))["stopped_by"]
MEMBERS = {
    each.name: each
    for each in list_attacks()
    if "refused: no points" in "\n".join(each.regions["8a"])
}
NAMESPACES = {"user-namespace", "network-namespace", "pid-namespace"}
ALONE = {  # a name for each layer, and what its world has
    "filter": {"system-calls"},
    "own root": {"user-namespace", "own-root"},
    "Landlock": {"landlock-files"},
    "namespaces": NAMESPACES,
}
# What root's capabilities would allow: every child that is confined at all has given them up.
NEEDS_RIGHTS = {
    "mounts-a-folder",
    "pins-itself-to-every-core",
    "poisons-the-bytecode",
    "reads-the-graders-memory",
    "slows-the-grader-down",
    "traces-the-grader",
}


@pytest.fixture(scope="module")
def workers() -> Iterator[dict[str, Worker]]:
    worlds = ALONE | {"nothing": set(), "everything": SWITCHES}
    started = {name: start_worker(without=SWITCHES - has) for name, has in worlds.items()}
    yield started
    for worker in started.values():
        worker.close()


def goes_through(member: str, worker: Worker, work: Path) -> bool:
    """Return whether the attack works in the second of two children: the first may leave data."""
    tree = work / "tree"
    tree.mkdir(parents=True)
    shutil.copy(KIT / "solution" / "integrators.py", tree)
    put_regions(MEMBERS[member].regions, tree)
    sandbox = sandbox_for(Submission(member, tree), work, worker, Options(trusted=True))
    reply: object = None
    for _ in range(2):
        child = sandbox.open_child(10)
        child.ask(Import("integrators"))
        question = Integrate("integrators:semi_implicit_euler", 1.0, 0.0, 0.5, [-4.0])
        reply = child.ask(question).reply
        child.end()
    assert isinstance(reply, Returned) and isinstance(reply.value, Items), reply
    (answer,) = reply.value.items
    assert answer in (Vec(1.0, 0.0), Vec(0.0, -2.0))
    return answer == Vec(0.0, -2.0)


@pytest.mark.soak
@pytest.mark.parametrize("member", MEMBERS)
def test_the_layers_named_for_an_attack_stop_it(member: str, workers, tmp_path: Path):
    through = {
        world: goes_through(member, worker, tmp_path / world) for world, worker in workers.items()
    }
    assert not through["everything"]
    assert through["nothing"] or member in NEEDS_RIGHTS, "this is no attack: nothing refuses it"
    stopped = [world for world in ALONE if not through[world]]
    if member in NEEDS_RIGHTS and os.geteuid() != 0:
        return  # an ordinary user may do some of these to processes of the same account
    assert STOPPED_BY[member] == stopped


def test_every_attack_has_its_layers_named():
    assert set(STOPPED_BY) == set(MEMBERS)
    assert all(STOPPED_BY.values())
