"""Record a check: run it again and store each request, its answer and the moments of the bodies.

The recorder is the `send` of a lab's connection: all requests and answers pass through it.
"""

import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import islice
from string import ascii_letters

import msgspec

from grader.judge.failures import Failing
from grader.judge.lab import Lab
from grader.judge.wall.children import Child
from grader.player.runs import Line, Mark, Run, describe_body, describe_reply
from grader.player.script import Step, Translator, signature_of
from grader.protocol import (
    MAX_BODIES,
    MAX_RODS,
    MAX_TOUCHES,
    Answered,
    BodyRow,
    Call,
    Get,
    Import,
    Integrate,
    Items,
    MakeBody,
    MakeWorld,
    Missing,
    Moment,
    Piece,
    Play,
    Played,
    Record,
    Ref,
    Reply,
    Request,
    Returned,
    Set,
    Value,
    Vec,
    WithMoments,
)

MAX_PER_REQUEST = 200  # moments
MAX_MOMENTS = 1200  # of one check

OpenChild = Callable[[int], Child]  # takes the budget in CPU seconds


@dataclass
class Recorder:
    """Records the requests of a lab: a line of a run for each."""

    translator: Translator
    most_scenes: int  # further ones are not recorded
    experiment: str = ""
    scenes: list[list[Run]] = field(default_factory=lambda: [[]])
    steps: list[list[Step]] = field(default_factory=lambda: [[]])  # by scene
    _new_scene: bool = True
    _new_run: bool = True
    _count: int = 0
    _is_full: bool = False

    def begin_scene(self, text: str) -> None:
        """Begin the scene of another experiment, described by `text`."""
        self.experiment = text
        self._new_scene = self._new_run = True
        self.translator.begin_scene()

    def send(self, child: Child, request: Request) -> Answered:
        """Ask the child; record the request unless it only imports or reads."""
        if isinstance(request, Import):
            self._new_run = True
            self.translator.begin_child()
            return child.ask(request)
        if isinstance(request, Get):
            return self._ask_only(child, request)
        return self._record(child, request)

    def _ask_only(self, child: Child, request: Request) -> Answered:
        answered = child.ask(request)
        self._add_step(request, answered)
        return answered

    def _record(self, child: Child, request: Request) -> Answered:
        cut = self._new_run
        if cut:
            self._begin_run()
        if self._count >= MAX_MOMENTS or self._is_full:
            return self._ask_only(child, request)
        answered = child.ask(Record(let_steps_run(request), MAX_PER_REQUEST, cut))
        if not isinstance(answered.reply, WithMoments):
            return msgspec.structs.replace(answered, reply=Missing("a recording was asked for"))
        recorded = answered.reply
        answered = msgspec.structs.replace(answered, reply=recorded.reply)
        self._add_line(request, answered, recorded)
        return answered

    def _begin_run(self) -> None:
        if self._new_scene and self.scenes[-1]:
            self._is_full = len(self.scenes) == self.most_scenes
            if self._is_full:
                return
            self._leave_room()
            self.scenes.append([])
            self.steps.append([])
        self._new_scene = self._new_run = False
        self.scenes[-1].append(Run(self.experiment))

    def _leave_room(self) -> None:
        """Forget the latest scene once half of all moments are used: the last needs room."""
        if self._count > MAX_MOMENTS // 2:
            lines = [line for run in self.scenes[-1] for line in run.lines]
            self._count -= sum(len(line.moments) for line in lines)
            self.scenes[-1], self.steps[-1] = [], []

    def _add_line(self, request: Request, answered: Answered, recorded: WithMoments) -> None:
        run = self.scenes[-1][-1]
        step = self._add_step(request, answered)
        moments = limit_moments(recorded.moments)
        answer = describe_reply(recorded.reply) if isinstance(request, Call | Play) else ""
        if isinstance(request, Integrate):
            run.curve, run.names = True, {1: "it"}
            answers = list_answers(recorded.reply)
            moments = draw_curve(request, answers)
            answer = describe_reply(Returned(answers[-1]) if answers else recorded.reply)
        for number, look in islice(recorded.looks.items(), MAX_BODIES):
            run.looks[number] = look
            name = self.translator.names.get(look.ref, "")
            own = name.lstrip(ascii_letters) if name.isidentifier() else str(number)
            run.names[number] = describe_body(look, own)
        self._count += len(moments)
        if is_setup(request) and run.lines and run.lines[-1].is_setup:
            run.lines[-1].moments = []  # only the last request of a setup is shown
        line = Line(
            signature_of(request),
            answer,
            moments,
            is_setup(request),
            "\n".join(step.code),
            find_marks(request, run),
            isinstance(request, Call) and request.work,
        )
        run.lines.append(line)

    def _add_step(self, request: Request, answered: Answered) -> Step:
        reply = answered.reply
        assert not isinstance(reply, WithMoments)
        code = self.translator.translate(request, reply)
        value = reply.value if isinstance(reply, Returned) else reply
        watched = self.translator.watched_names(request)
        paced = isinstance(reply, Played) and reply.paced
        step = Step(request, code, value is None, self.translator.recalled, watched, paced)
        self.steps[-1].append(step)
        return step

    def scenes_to_show(self) -> slice:
        """Return the last scene, or all if the check fails between scenes."""
        is_between = self._new_scene and self.scenes[-1] != []
        return slice(None) if is_between else slice(-1, None)


class RecordingLab(Lab):
    together = 1  # nothing runs after a question that gets a wrong answer

    def __init__(
        self,
        module: str,
        open_child: Callable[[], Child],
        pieces: list[Piece],
        secret: str | None,
        most_scenes: int,
    ) -> None:
        super().__init__(module, open_child, pieces, secret)
        self.recorder = Recorder(Translator(module), most_scenes)
        self.connection.send = self.recorder.send

    def ran(self, text: str) -> None:
        super().ran(text)
        self.recorder.begin_scene(text)


def let_steps_run(request: Request) -> Request:
    """Run steps that the check only counts, so that the replay shows motion."""
    if isinstance(request, Play) and not request.trail_every:
        return msgspec.structs.replace(request, physics=True)
    return request


def limit_moments(moments: list[Moment]) -> list[Moment]:
    """Cut the moments to the limits of our recorder, since a submission may send anything."""
    return [
        Moment(
            each.time,
            each.steps,
            each.bodies[:MAX_BODIES],
            each.touches[:MAX_TOUCHES],
            each.rods[:MAX_RODS],
        )
        for each in moments[:MAX_PER_REQUEST]
    ]


def find_marks(request: Request, run: Run) -> list[Mark]:
    """Return the arms and the axis of a question about the effective mass."""
    match request:
        case Call(target, [Ref(id=a), Ref(id=b), Vec() as ra, Vec() as rb, Vec() as axis]):
            if not target.endswith(":effective_mass"):
                return []
            numbers = {look.ref: number for number, look in run.looks.items()}
            arms = [
                (numbers[ref], *arm, *axis) for ref, arm in ((a, ra), (b, rb)) if ref in numbers
            ]
            return [Mark(*each) for each in arms]
    return []


def is_setup(request: Request) -> bool:
    """Return whether a request sets up a scene; only the last of several is shown."""
    return isinstance(request, MakeBody | MakeWorld | Set)


def list_answers(reply: Reply) -> list[Value]:
    """Return the answers of an integrator, step by step."""
    match reply:
        case Returned(Items(answers)):
            return answers
    return []


def draw_curve(request: Integrate, answers: list[Value]) -> list[Moment]:
    """Draw an integrator's x and v over time: the curve is the picture's only body."""
    states = [Vec(request.x, request.v)]
    states += [each for each in answers[: request.steps] if isinstance(each, Vec)]
    return [
        Moment(number * request.dt, number, [BodyRow(1, x, 0.0, v, 0.0, 0.0, 0.0)], [], [])
        for number, (x, v) in enumerate(states)
    ]


def record_again(
    failing: Failing,
    open_child: OpenChild,
    pieces: list[Piece],
    most_scenes: int = sys.maxsize,
) -> RecordingLab:
    """Run a failed check again and record its first scenes."""
    todo, check = failing.todo, failing.check
    module = check.module or todo.module
    lab = RecordingLab(
        module, lambda: open_child(check.cpu_seconds), pieces, failing.secret, most_scenes
    )
    with lab.opened(), suppress(Exception):
        failing.again(lab=lab)
    return lab
