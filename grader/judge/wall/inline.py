"""Run children inside the judge's own process, in a browser tab, which has no other.

This confines nothing, so it is only for the user's own work; `grade` refuses it for others'.
"""

import os
from collections.abc import Callable, Sequence

from grader.judge.wall.children import Child, Worker
from grader.judge.wall.isolation import ONE_PROCESS
from grader.protocol import ChildSetup, InnerChannel


class InlineWorker:
    """Opens children by `connect`; while one answers, the judge waits."""

    def __init__(self, connect: Callable[[ChildSetup], InnerChannel]) -> None:
        self.connect = connect
        self.layers = [ONE_PROCESS]
        self.channels: dict[int, InnerChannel] = {}  # by id() of the child

    def helpers(self, count: int) -> Sequence[Worker]:
        """Return none: there is one interpreter."""
        return ()

    def open(self, setup: ChildSetup) -> Child:
        channel = self.connect(setup)
        child = Child(channel, self, setup.limits.cpu_seconds)
        self.channels[id(child)] = channel
        return child

    def pid_of(self, child: Child) -> int:
        return os.getpid()

    def end(self, child: Child, gone: bool) -> int | None:
        channel = self.channels.pop(id(child))
        channel.close()
        child.cpu = channel.cpu
        return channel.status

    def hang_up(self) -> None:
        self.close()

    def close(self) -> None:
        for channel in self.channels.values():
            channel.close()
        self.channels.clear()
