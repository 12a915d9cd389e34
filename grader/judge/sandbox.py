"""The sandbox of one tree: what its children may reach, and which layers of isolation hold them."""

import tempfile
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from grader.judge.children import Child, Worker
from grader.judge.isolation import STRICT, Isolation, unconfined
from grader.judge.submission import CannotGrade
from grader.protocol import ChildSetup, Limits


@dataclass
class Sandbox:
    """Opens children that import one tree, a submission or the reference, and reach no other."""

    tree: Path  # a read-only copy
    work: Path  # a folder of ours, for what they write
    worker: Worker
    isolation: Isolation
    hidden: list[str]  # folders that must be out of reach
    loads: list[str] = field(default_factory=list)  # libraries that are slow to load, by name
    layers: list[str] = field(default_factory=list)  # of isolation around the last child

    def open_child(self, cpu_seconds: int, compiles: bool = False) -> Child:
        """A child with this budget; one that `compiles` keeps its bytecode for the others."""
        scratch = Path(tempfile.mkdtemp(dir=self.work))
        child = self.worker.open(
            ChildSetup(
                submission=str(self.tree),
                scratch=str(scratch),
                limits=Limits(cpu_seconds=cpu_seconds),
                confine=self.isolation != "none",
                hidden=self.hidden,
                bytecode=str(shared_bytecode(self.work, scratch)),
                compiles=compiles,
                loads=self.loads,
            )
        )
        self.layers = self._layers_around(child)
        return child

    def _layers_around(self, child: Child) -> list[str]:
        """The layers around this child; raises CannotGrade, before it runs, if they are too few."""
        if self.isolation == "none":
            return ["processes"]
        layers = ["processes", *child.ready.layers, *self.worker.layers]
        open_to_it = [what for what in unconfined(layers) if what in STRICT]
        if self.isolation == "strict" and open_to_it:
            child.end()
            raise CannotGrade(
                f"--isolation=strict: this machine cannot confine {' and '.join(open_to_it)} "
                f"(it has {', '.join(layers)}). Use a Linux with Landlock, or --isolation=auto."
            )
        return layers


def shared_bytecode(work: Path, scratch: Path) -> Path:
    """A folder of compiled files in which all copies of one submission find the same.

    Python looks under it for the path of the source, and each child's copy has a path of its own:
    so each gets a link to what they share.
    """
    bytecode = work / "bytecode"
    shared = bytecode / "shared"
    shared.mkdir(parents=True, exist_ok=True)
    link = bytecode / scratch.relative_to(scratch.anchor)
    link.parent.mkdir(parents=True, exist_ok=True)
    with suppress(OSError):  # Windows may not allow it: then each compiles for itself
        link.symlink_to(shared, target_is_directory=True)
    return bytecode
