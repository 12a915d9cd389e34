"""The sandbox of one tree: what its children may reach, and which layers of isolation hold them."""

import tempfile
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
    layers: list[str] = field(default_factory=list)  # of isolation around the last child

    def open_child(self, cpu_seconds: int, compiles: bool = False) -> Child:
        """A child with this budget; one that `compiles` keeps its bytecode for the others."""
        bytecode = self.work / "bytecode"
        bytecode.mkdir(exist_ok=True)
        child = self.worker.open(
            ChildSetup(
                submission=str(self.tree),
                scratch=tempfile.mkdtemp(dir=self.work),
                limits=Limits(cpu_seconds=cpu_seconds),
                confine=self.isolation != "none",
                hidden=self.hidden,
                bytecode=str(bytecode),
                compiles=compiles,
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
