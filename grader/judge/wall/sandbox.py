"""Open children of one tree, and limit the files that they may reach."""

import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

from grader.judge.submission import CannotGrade
from grader.judge.wall.children import Child, ChildEnded, Worker
from grader.judge.wall.isolation import ONE_PROCESS, Isolation, find_refusal
from grader.judge.wall.workplace import remove
from grader.protocol import ChildSetup, Limits
from grader.source.regions import encode

COMPILING_SECONDS = 5  # of processor time, for all files of a submission
LATER = 10  # s


@contextmanager
def require_child() -> Iterator[None]:
    """Raise CannotGrade if no child can start."""
    try:
        yield
    except (ChildEnded, OSError) as error:
        raise CannotGrade(f"{error}. Is the disk full, or the memory?") from error


@dataclass
class Sandbox:
    """Opens children that import one tree, a submission or the reference, and reach no other."""

    tree: Path  # a read-only copy
    work: Path  # the judge's folder, for the files that children write
    worker: Worker
    isolation: Isolation
    hidden: list[str]  # folders that children cannot reach
    loads: list[str] = field(default_factory=list)  # libraries that are slow to load, by name
    trusted: bool = False  # whether it is the user's own work
    layers: list[str] = field(default_factory=list)  # layers of isolation around the last child
    bans: list[str] = field(default_factory=list)  # modules that children may not import, by name
    shown: list[str] = field(default_factory=list)  # folders that children need not copy
    programs: list[str] = field(default_factory=list)  # modules that checks import
    unseen: str = ""  # a scratch folder that no child has seen
    used: list[tuple[Child, str]] = field(default_factory=list)  # children, and their folders

    def open_child(self, cpu_seconds: int) -> Child:
        """Return a child with this budget, in processor seconds.

        Raises CannotGrade if none can start. No line of the submission has run then, so it is not
        the cause.
        """
        self._clear()
        self.compile()
        with require_child():
            setup = self._setup(cpu_seconds)
            child = self.worker.open(setup)
        self.layers = self._layers_around(child)
        # In a mount namespace the child sees a file system of its own: the next may use the folder.
        self.unseen = setup.scratch if "mount-namespace" in self.layers else ""
        if not self.unseen:
            self.used.append((child, setup.scratch))
        return child

    def _clear(self) -> None:
        """Remove the files of children that have ended: each may write gigabytes."""
        for child, scratch in self.used:
            if child.over:
                remove(Path(scratch))
        self.used = [each for each in self.used if not each[0].over]

    def changed(self, texts: Mapping[str, str]) -> "Sandbox":
        """Return the sandbox of a copy of the tree, in which some files have another text.

        Both share compiled files. A changed file gets a time more than a second later, since Python
        compares whole seconds.
        """
        tree = Path(tempfile.mkdtemp(dir=self.work)) / "tree"
        shutil.copytree(self.tree, tree)
        copy = replace(self, tree=tree, used=[])
        for name, text in texts.items():
            copy.write(name, text)
        return copy

    def write(self, name: str, text: str) -> None:
        """Give a file of this copy another text, for all children that are opened from now on."""
        path = self.tree / name
        later = path.stat().st_mtime + LATER
        path.chmod(0o644)
        path.write_bytes(encode(text))
        os.utime(path, (later, later))
        path.chmod(0o444)

    def beside(self, count: int) -> list["Sandbox"]:
        """Return at most `count` other sandboxes of the same tree, to work at the same time."""
        workers = self.worker.helpers(count) if count > 0 else ()
        return [replace(self, worker=each, used=[], unseen="") for each in workers]

    @property
    def bytecode(self) -> Path:
        """Return the folder of compiled files: compiling takes longer than most checks."""
        return self.work / "bytecode"

    def compile(self) -> None:
        """Compile the files, once, in a child that never runs the submission.

        File modes keep other children from writing them on machines where no layer confines files.
        """
        if self.bytecode.exists():
            return
        with require_child():
            self.bytecode.mkdir()
            self.worker.open(self._setup(COMPILING_SECONDS, compiles=True)).finish()
            for path in [self.bytecode, *self.bytecode.rglob("*")]:
                path.chmod(0o555 if path.is_dir() else 0o444)

    def _setup(self, cpu_seconds: int, compiles: bool = False) -> ChildSetup:
        return ChildSetup(
            submission=str(self.tree),
            scratch=self.unseen or tempfile.mkdtemp(dir=self.work),
            limits=Limits(cpu_seconds=cpu_seconds),
            confine=self.isolation != "none",
            hidden=self.hidden,
            bytecode=str(self.bytecode),
            compiles=compiles,
            loads=self.loads,
            bans=self.bans,
            shown=self.shown,
            programs=self.programs,
        )

    def _layers_around(self, child: Child) -> list[str]:
        """Return the layers around a new child; raises CannotGrade if they are not enough."""
        if ONE_PROCESS in self.worker.layers:
            layers = self.worker.layers
        elif self.isolation == "none":
            return ["processes"]
        else:
            layers = ["processes", *child.ready.layers, *self.worker.layers]
        if why := find_refusal(self.isolation, layers, self.trusted):
            child.end()
            raise CannotGrade(why)
        return layers
