"""Connect a check to its child: open it, ask, and fail the check when it is gone."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NoReturn, TypeVar

from grader.judge.failures import Broke, NotYet
from grader.judge.wall.children import Child, ChildEnded
from grader.protocol import (
    MAX_OUTPUT,
    Answered,
    Import,
    Missing,
    Piece,
    Played,
    Raised,
    Remembered,
    Request,
    Returned,
    Simulated,
    WithMoments,
)

Answer = Returned | Simulated | Played | WithMoments
Send = Callable[[Child, Request], Answered]
Result = TypeVar("Result")


def ask_child(child: Child, request: Request) -> Answered:
    """Ask without recording: the usual `send` of a connection."""
    return child.ask(request)


@dataclass
class Connection:
    """Asks a child; opens it when first needed, and has it import the submission.

    All requests and answers pass through `send`; a replay puts a recorder there. `ran` describes
    the experiment that a request belongs to, and becomes the line *We ran* of a failure.
    """

    module: str  # to import
    open_child: Callable[[], Child]
    pieces: list[Piece]  # pieces of the reference that replace functions of the submission
    send: Send = ask_child
    output: str = ""
    child: Child | None = None
    cpu: float = 0.0  # s, of processor time that its children used
    rested: float = 0.0  # s, for which they slept
    heard: int = 0  # bytes of their answers
    over: NotYet | Broke | None = None  # the reason why no more requests are possible
    watched: bool = False  # whether the child notes names that keep a value from call to call
    deal: int = 0  # added to the seeds of the submission's random generators

    def ask(self, request: Request, ran: str) -> Answer:
        """Return the answer; raises NotYet or Broke if the submission gave none."""
        child = self.child or self.begin(ran)
        return self._ask(child, request, ran)

    def answer_at_once(self, request: Request, ran: str) -> Answer | None:
        """Return the answer to a request that needs no message of its own, or None."""
        child = self.child or self.begin(ran)
        if self.send is not ask_child:  # a recorder needs an answer to each request
            return self._ask(child, request, ran)
        answered = self._try(lambda: child.answer_at_once(request), ran)
        return None if answered is None else self._read(answered, ran)

    def post(self, request: Request, ran: str) -> Callable[[], Answer]:
        """Post a question to send with later ones; return a function that waits for the answer."""
        child = self.child or self.begin(ran)
        if self.send is not ask_child:
            reply = self._ask(child, request, ran)
            return lambda: reply
        asked = self._try(lambda: child.post(request), ran)
        return lambda: self._read(self._try(lambda: child.answer(asked), ran), ran)

    def begin(self, ran: str) -> Child:
        """Open a child and import the submission in it."""
        try:
            self.child = self.open_child()
        except ChildEnded as error:
            self._stop(ran, error)
        try:
            wanted = Import(self.module, self.pieces, self.watched, self.deal)
            self._ask(self.child, wanted, ran)
        except (Broke, NotYet) as failure:
            self.over = failure
            raise
        return self.child

    def remembered(self) -> list[str]:
        """Return the names in the submission whose values have changed since the first request."""
        if self.child is None or self.over is not None or not self.watched:
            return []
        try:
            reply = self._ask(self.child, Remembered(), "")
        except (Broke, NotYet):
            return []
        names = str(reply.value).split(",") if isinstance(reply, Returned) else []
        return [name for name in names if name.replace(".", "").isidentifier()]

    def restart(self) -> None:
        """End the child; the next request opens another one."""
        if self.over is None:
            self.end()

    def end(self) -> None:
        if self.child is not None:
            self.child.end()
            self.cpu += self.child.cpu
            self.rested += self.child.rested
            self.heard += self.child.heard
            self.child = None

    def _ask(self, child: Child, request: Request, ran: str) -> Answer:
        return self._read(self._try(lambda: self.send(child, request), ran), ran)

    def _try(self, act: Callable[[], Result], ran: str) -> Result:
        """Return the result of `act`, which asks a child; raises Broke if it is gone."""
        if self.over is not None:
            raise self.over
        try:
            return act()
        except ChildEnded as error:
            self._stop(ran, error)

    def _read(self, answered: Answered, ran: str) -> Answer:
        """Return the reply in an answer; raises Broke or NotYet if it is a failure."""
        self.output += answered.output[: MAX_OUTPUT - len(self.output)]
        match answered.reply:
            case Raised() as raised:
                raise Broke(ran, f"{raised.error}: {raised.message}".removesuffix(": "), raised)
            case Missing(what):
                raise NotYet(ran, "the names and types of the lesson", what)
            case reply:
                return reply

    def _stop(self, ran: str, why: ChildEnded) -> NoReturn:
        """End the check, since its child is gone."""
        self.over = Broke(ran, str(why), late=why.late)
        raise self.over
