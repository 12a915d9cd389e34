"""Ask a submission questions, several in one message, and judge the answers in order."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeVar

from grader.judge.decode import Decoder
from grader.judge.failures import Broke, NotYet
from grader.judge.wall.connection import Answer, Connection
from grader.protocol import Request, Returned, Value

TOGETHER = 100  # questions in one message
MAX_OBSERVATIONS = 400  # kept observations: shrinking a counterexample makes many
Judge = Callable[[Value], None]  # fails the check if the answer is wrong
Noted = tuple[str, tuple[Any, ...]]  # kind of question and inputs, to recognise known mistakes
Result = TypeVar("Result")


@dataclass(frozen=True)
class Observation:
    """One question put to the submission and its answer, to recognise known mistakes."""

    about: str
    inputs: tuple[Any, ...]
    answer: Any


class Asker(Decoder):
    """Asks a child.

    A question with `then`, a function that judges its answer, is posted: one message has several.
    Their answers are judged in order: before a question without `then`, and as the check ends.
    """

    together = TOGETHER

    def __init__(self, connection: Connection) -> None:
        super().__init__()
        self.connection = connection
        self.observations: list[Observation] = []
        self.posted: list[Callable[[], None]] = []  # functions that wait for an answer and judge it
        self.is_judging = False  # while an answer is judged, no question is sent

    @contextmanager
    def settled(self) -> Iterator[None]:
        """Judge all posted answers on exit; after a failure, drop them."""
        try:
            yield
            self.settle()
        finally:
            self.posted.clear()

    def saw(self, about: str, inputs: tuple[Any, ...], answer: Any) -> None:
        """Remember an answer, to recognise known mistakes by their numbers."""
        if len(self.observations) < MAX_OBSERVATIONS:
            self.observations.append(Observation(about, inputs, answer))

    def _ask(
        self,
        request: Request,
        read: Callable[[Returned], Value],
        noted: Noted | None = None,
        then: Judge | None = None,
    ) -> Value:
        """Return the answer, converted by `read`; with `then`, post the question instead."""
        running, wait = self.running, self._post(request)

        def answer() -> Value:
            self.running = running
            try:
                return read(self._expect_value(self._guard(wait)))
            except Broke as failure:
                if failure.raised is not None and noted is not None:
                    self.saw(*noted, failure.raised.error)
                raise

        if then is None:
            self.settle()
            return answer()
        self.posted.append(lambda: then(answer()))
        if len(self.posted) >= self.together:
            self.settle()
        return None

    def settle(self) -> None:
        """Judge the answers to all posted questions, each by its function `then`."""
        posted, self.posted, running = self.posted, [], self.running
        self.is_judging = True
        try:
            for judge_it in posted:
                judge_it()
        finally:
            self.is_judging = False
        self.running = running

    def _value(self, request: Request) -> Value:
        return self._returned(request).value

    def _returned(self, request: Request) -> Returned:
        return self._expect_value(self._reply(request))

    def _expect_value(self, reply: Answer) -> Returned:
        if not isinstance(reply, Returned):
            self.fail("a value", "something else")
        return reply

    def _reply(self, request: Request) -> Answer:
        reply = self._guard(lambda: self.connection.answer_at_once(request, self.running))
        if reply is None:
            wait = self._post(request)
            self.settle()
            reply = self._guard(wait)
        return reply

    def _post(self, request: Request) -> Callable[[], Answer]:
        """Return a function that waits for the answer to a question."""
        if self.is_judging:
            raise RuntimeError("a question about the answer to an earlier one, which is too late")
        return self._guard(lambda: self.connection.post(request, self.running))

    def _guard(self, act: Callable[[], Result]) -> Result:
        """Return the result of `act`; remember a failure that it raises."""
        try:
            return act()
        except (Broke, NotYet) as failure:
            self.remember(failure)
            raise
