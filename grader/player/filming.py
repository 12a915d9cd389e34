"""Filming a check: it runs once more, and each request is recorded with what it does to the bodies.

The recorder is the `send` of a lab's connection, so that all requests and answers pass through it.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import islice

import msgspec

from grader.judge.children import Child
from grader.judge.failures import Failing
from grader.judge.lab import Lab
from grader.player.film import Line, Mark, Take, called, in_words
from grader.player.script import Step, Translator, sign
from grader.protocol import (
    MAX_BODIES,
    MAX_RODS,
    MAX_TOUCHES,
    Answered,
    BodyRow,
    Call,
    Film,
    Filmed,
    Get,
    Import,
    Integrate,
    Items,
    MakeBody,
    MakeWorld,
    Missing,
    Piece,
    Play,
    Ref,
    Reply,
    Request,
    Returned,
    Set,
    Shot,
    Value,
    Vec,
)

MOST_PER_REQUEST = 200  # shots
MOST_SHOTS = 1200  # of one check

OpenChild = Callable[[int], Child]  # takes the budget in CPU seconds


@dataclass
class Recorder:
    """Records what passes through the connection of a lab: a line of a take for every request."""

    translator: Translator
    said: str = ""  # the experiment
    scenes: list[list[Take]] = field(default_factory=lambda: [[]])
    steps: list[list[Step]] = field(default_factory=lambda: [[]])  # by scene
    _new_scene: bool = True
    _new_take: bool = True
    _taken: int = 0

    def begin_scene(self, text: str) -> None:
        """Another experiment begins, which is described by `text`."""
        self.said = text
        self._new_scene = self._new_take = True

    def send(self, child: Child, request: Request) -> Answered:
        """Ask the child, and film what the request does unless it only loads or reads."""
        if isinstance(request, Import):
            self._new_take = True
            self.translator.forget()
            return child.ask(request)
        if isinstance(request, Get):
            return self._unfilmed(child, request)
        return self._film(child, request)

    def _unfilmed(self, child: Child, request: Request) -> Answered:
        answered = child.ask(request)
        self._note(request, answered)
        return answered

    def _film(self, child: Child, request: Request) -> Answered:
        cut = self._new_take
        if cut:
            self._begin_take()
        if self._taken >= MOST_SHOTS:
            return self._unfilmed(child, request)
        answered = child.ask(Film(moving(request), MOST_PER_REQUEST, cut))
        if not isinstance(answered.reply, Filmed):
            return msgspec.structs.replace(answered, reply=Missing("a film was asked for"))
        filmed = answered.reply
        answered = msgspec.structs.replace(answered, reply=filmed.reply)
        self._keep(request, answered, filmed)
        return answered

    def _begin_take(self) -> None:
        if self._new_scene and self.scenes[-1]:
            self.scenes.append([])
            self.steps.append([])
        self._new_scene = self._new_take = False
        self.scenes[-1].append(Take(self.said))

    def _keep(self, request: Request, answered: Answered, filmed: Filmed) -> None:
        take = self.scenes[-1][-1]
        step = self._note(request, answered)
        step.place = take, len(take.lines)
        shots = bounded(filmed.shots)
        answer = in_words(filmed.reply) if isinstance(request, Call | Play) else ""
        if isinstance(request, Integrate):
            take.curve, take.names = True, {1: "it"}
            answers = answers_in(filmed.reply)
            shots = on_a_curve(request, answers)
            answer = in_words(Returned(answers[-1]) if answers else filmed.reply)
        for number, look in islice(filmed.looks.items(), MAX_BODIES):
            take.looks[number] = look
            take.names[number] = called(look, str(number))
        self._taken += len(shots)
        if sets_up(request) and take.lines and take.lines[-1].sets_up:
            take.lines[-1] = msgspec.structs.replace(take.lines[-1], shots=[])
        take.lines.append(
            Line(
                sign(request),
                answer,
                shots,
                sets_up(request),
                "\n".join(step.code),
                marks_of(request, take),
                isinstance(request, Call) and request.work,
            )
        )
        if shots:
            step.bodies = {self._named(take, row.number): row for row in shots[-1].bodies}
        elif len(take.lines) == 1:
            step.bodies = {}  # those of another process

    def _named(self, take: Take, number: int) -> str:
        """What a script calls a body; one that it does not name is called as on the page."""
        ref = take.looks[number].ref if number in take.looks else 0
        name = self.translator.names.get(ref, "")
        return name if name.isidentifier() else take.names.get(number, "")

    def _note(self, request: Request, answered: Answered) -> Step:
        reply = answered.reply
        assert not isinstance(reply, Filmed)
        code = self.translator.code(request, reply)
        before = self.steps[-1][-1].bodies if self.steps[-1] else {}
        value = reply.value if isinstance(reply, Returned) else reply
        watched = self.translator.watched(request)
        step = Step(request, code, value is None, watched, before)
        self.steps[-1].append(step)
        return step

    def shown(self, every_scene: bool) -> slice:
        """The scenes to show: the last, or all where only all of them together say something."""
        summed_up = self._new_scene and self.scenes[-1] != []
        return slice(None) if every_scene or summed_up else slice(-1, None)


class FilmingLab(Lab):
    """A lab whose connection is recorded."""

    def __init__(
        self,
        module: str,
        open_child: Callable[[], Child],
        pieces: list[Piece],
        secret: str | None = None,
    ) -> None:
        self.recorder = Recorder(Translator(module))
        super().__init__(module, open_child, pieces, self.recorder.send, secret)

    def ran(self, text: str) -> None:
        super().ran(text)
        self.recorder.begin_scene(text)


def moving(request: Request) -> Request:
    """Where steps are only counted, let them run: there is more to see."""
    if isinstance(request, Play) and not request.trail_every:
        return msgspec.structs.replace(request, physics=True)
    return request


def bounded(shots: list[Shot]) -> list[Shot]:
    """No more than what a camera of ours takes: a submission may send anything."""
    return [
        Shot(
            each.time,
            each.steps,
            each.bodies[:MAX_BODIES],
            each.touches[:MAX_TOUCHES],
            each.rods[:MAX_RODS],
        )
        for each in shots[:MOST_PER_REQUEST]
    ]


def marks_of(request: Request, take: Take) -> list[Mark]:
    """The arms and the axis that a question about the effective mass is asked with."""
    match request:
        case Call(target, [Ref(id=a), Ref(id=b), Vec() as ra, Vec() as rb, Vec() as axis]):
            if not target.endswith(":effective_mass"):
                return []
            numbers = {look.ref: number for number, look in take.looks.items()}
            arms = [
                (numbers[ref], *arm, *axis) for ref, arm in ((a, ra), (b, rb)) if ref in numbers
            ]
            return [Mark(*each) for each in arms]
    return []


def sets_up(request: Request) -> bool:
    """Whether it puts something in its place; of several such in a row only the last is shown."""
    return isinstance(request, MakeBody | MakeWorld | Set)


def answers_in(reply: Reply) -> list[Value]:
    """What an integrator answered, step by step."""
    match reply:
        case Returned(Items(answers)):
            return answers
    return []


def on_a_curve(request: Integrate, answers: list[Value]) -> list[Shot]:
    """An integrator's x and v over the time, as the one body of the picture."""
    states = [Vec(request.x, request.v)]
    states += [each for each in answers[: request.steps] if isinstance(each, Vec)]
    return [
        Shot(number * request.dt, number, [BodyRow(1, x, 0.0, v, 0.0, 0.0, 0.0)], [], [])
        for number, (x, v) in enumerate(states)
    ]


def filmed(failing: Failing, open_child: OpenChild, pieces: list[Piece]) -> FilmingLab:
    """The same once more, before the camera; it fails again, or ends where it did."""
    todo, check = failing.todo, failing.check
    module = check.module or todo.module
    lab = FilmingLab(module, lambda: open_child(check.cpu_seconds), pieces, failing.secret)
    with lab.opened(), suppress(Exception):
        failing.again(lab=lab)
    return lab
