"""Limit the total time of a submission's checks, so that it delays no other.

Each question and each child is bounded, but there are thousands of questions: a program may sleep
before each answer, or loop in every check. So seconds are added up, by TODO and in all. The budget
left for each check shrinks as a submission spends it, down to none.

Processor time and sleep are counted apart. Waiting for a processor that others use counts for
neither. The size of the answers is added up as well, since the judge reads and keeps them.
"""

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from grader.judge.wall.children import REST_SECONDS, Child
from grader.judge.wall.connection import Connection

TODO_CPU, SUBMISSION_CPU = 10.0, 40.0  # s of a TODO; then each of its checks gets little
TODO_REST, SUBMISSION_REST = 8.0, 16.0  # s
LITTLE_CPU, LITTLE_REST = 1, 0.25  # s, the little; most checks need a tenth of this
END_CPU, END_REST = 90.0, 32.0  # s of a submission; then no more checks run
WORDS_CPU, WORDS_REST = 20.0, 4.0  # s, for runs that only affect messages
ONE_REST = 2.0  # s, of sleep of one process in these runs
END_HEARD = 64 * 1024 * 1024  # bytes of answers; real ones send 3 to 5 MB


@dataclass
class Budget:
    """The seconds that a submission has used, by the ids of TODOs."""

    cpu: dict[str, float] = field(default_factory=lambda: defaultdict(float))
    rest: dict[str, float] = field(default_factory=lambda: defaultdict(float))
    heard: int = 0  # bytes of answers
    words_cpu: float = 0.0  # s, of runs that only affect messages
    words_rest: float = 0.0

    def copy(self) -> "Budget":
        """Return a copy for one check that runs beside others."""
        return replace(self, cpu=self.cpu.copy(), rest=self.rest.copy())

    def allowance(self, todo: str) -> tuple[int, float, bool, str]:
        """Return the limits that a check would get now."""
        return self.cpu_for(todo, LITTLE_CPU + 1), self.rest_for(todo), self.has_more, self.cut

    def add(self, todo: str, before: "Budget", after: "Budget") -> None:
        """Add the seconds that a check used of its copy."""
        self.cpu[todo] += after.cpu[todo] - before.cpu[todo]
        self.rest[todo] += after.rest[todo] - before.rest[todo]
        self.heard += after.heard - before.heard
        self.words_cpu += after.words_cpu - before.words_cpu
        self.words_rest += after.words_rest - before.words_rest

    def cpu_for(self, todo: str, usual: int) -> int:
        """Return the processor seconds for a process of a check that usually has `usual`."""
        much = self.cpu[todo] >= TODO_CPU or sum(self.cpu.values()) >= SUBMISSION_CPU
        return min(usual, LITTLE_CPU) if much else usual

    def rest_for(self, todo: str) -> float:
        """Return the seconds for which a process of a check may sleep."""
        much = self.rest[todo] >= TODO_REST or sum(self.rest.values()) >= SUBMISSION_REST
        return LITTLE_REST if much else REST_SECONDS

    def charge(self, todo: str, connection: Connection) -> None:
        self.cpu[todo] += connection.cpu
        self.rest[todo] += connection.rested
        self.heard += connection.heard

    def charge_for_words(self, connection: Connection) -> None:
        self.words_cpu += connection.cpu
        self.words_rest += connection.rested

    @property
    def has_more(self) -> bool:
        """Return whether time is left for runs that only affect messages and pictures."""
        left = END_CPU - sum(self.cpu.values())
        return self.words_cpu < min(WORDS_CPU, left) and self.words_rest < WORDS_REST

    @property
    def cut(self) -> str:
        """Return the reason why no more checks run, or an empty text."""
        if sum(self.cpu.values()) >= END_CPU:
            return f"not run: the checks before it used up {END_CPU:g} s of processor time"
        if sum(self.rest.values()) >= END_REST:
            return f"not run: in the checks before it the code rested for {END_REST:g} s"
        if self.heard >= END_HEARD:
            return f"not run: the answers to the checks before it had {END_HEARD >> 20} MB"
        return ""

    def why_little(self, todo: str) -> str:
        """Return the reason why a check had less time than usual, or an empty text."""
        if self.cpu[todo] >= TODO_CPU or self.rest[todo] >= TODO_REST:
            return "; it had less time than usual, because earlier checks of this TODO used much"
        if sum(self.cpu.values()) >= SUBMISSION_CPU or sum(self.rest.values()) >= SUBMISSION_REST:
            return "; it had less time than usual, because earlier checks used much"
        return ""


def for_words(open_child: Callable[[int], Child]) -> Callable[[int], Child]:
    """Return an `open_child` with less time to sleep, for runs that only affect messages."""

    def opened(cpu_seconds: int) -> Child:
        child = open_child(cpu_seconds)
        child.rest_seconds = ONE_REST
        return child

    return opened
