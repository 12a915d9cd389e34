"""Hold all that a child has for its submission: modules, clock, output and recorder."""

from collections.abc import Collection, Iterable
from pathlib import Path

from grader.worker.imports import ImportRule
from grader.worker.output import Output
from grader.worker.recorder import Recorder
from grader.worker.scripted import ScriptedClock
from grader.worker.subject import Subject


class Session:
    """The surroundings of one submission, installed before a line of it runs.

    A submission imported earlier would keep the real clock.
    """

    def __init__(self, folder: Path, files: Iterable[str], bans: Collection[str]) -> None:
        """Prepare for the submission in `folder`, with these files, which may not import `bans`."""
        self.output, self.clock = Output(), ScriptedClock()
        self.output.install()
        self.clock.install()
        ImportRule(files, bans).install()
        self.subject = Subject(folder)
        self.recorder = Recorder(self.subject)
