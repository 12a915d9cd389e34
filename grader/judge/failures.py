"""How a check fails: the exceptions that carry what its result says."""

from grader.protocol import Raised


class NotYet(Exception):
    """The submission gave an answer, and it is not the right one."""

    def __init__(self, ran: str, expected: str, got: str, meaning: str = "") -> None:
        super().__init__(got)
        self.ran, self.expected, self.got, self.meaning = ran, expected, got, meaning


class Broke(Exception):
    """The submission's own code raised, or its process ended without an answer."""

    def __init__(self, ran: str, got: str, raised: Raised | None = None) -> None:
        super().__init__(got)
        self.ran, self.got, self.raised = ran, got, raised
