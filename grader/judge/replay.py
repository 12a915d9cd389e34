"""Replays: a failed check once more, before the camera, beside the run that should have been.

All marks are decided by then. A replay that cannot be made is left out and changes nothing else.
"""

import importlib
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from itertools import islice
from pathlib import Path
from typing import Any

import msgspec

from grader.judge.children import Child
from grader.judge.lab import Lab
from grader.judge.plugin import Failing
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.rubric import CHECKS, load_rubric
from grader.player.film import Line, Take, in_words
from grader.player.page import page
from grader.player.pairing import replay
from grader.player.script import Step, Translator, script, sign, step_of
from grader.protocol import (
    Answered,
    BodyLook,
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
MOST_BODIES, MOST_TOUCHES, MOST_RODS = 80, 120, 20  # in one shot
MOST_CHARACTERS = 3_000_000  # of a page
MOST_DEATHS = 3  # of children, after which no more replays are made of a submission
RECORDED = CHECKS / "expected_runs.json"

OpenChild = Callable[[int], Child]  # takes the budget in CPU seconds
Runs = dict[str, list[list[Take]]]  # by TODO and check: the takes of each scene


# ---------------------------------------------------------------- filming


@dataclass
class FilmingLab(Lab):
    """A lab with a camera: every request becomes a line of a take, with its shots."""

    scenes: list[list[Take]] = field(default_factory=lambda: [[]])
    steps: list[list[Step]] = field(default_factory=lambda: [[]])  # by scene
    translator: Translator = field(init=False)
    _new_scene: bool = True
    _new_take: bool = True
    _taken: int = 0

    def __post_init__(self) -> None:
        self.translator = Translator(self.module)

    def ran(self, text: str) -> None:
        super().ran(text)
        self._new_scene = self._new_take = True

    def _send(self, request: Request) -> Answered:
        if isinstance(request, Import):
            self._new_take = True
            self.translator.forget()
            return super()._send(request)
        if isinstance(request, Get):
            answered = super()._send(request)
            self._note(request, answered)
            return answered
        return self._film(request)

    def _film(self, request: Request) -> Answered:
        cut = self._new_take
        if cut:
            self._begin_take()
        if self._taken >= MOST_SHOTS:
            answered = super()._send(request)
            self._note(request, answered)
            return answered
        assert self._child is not None
        answered = self._child.ask(Film(moving(request), MOST_PER_REQUEST, cut))
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
        self.scenes[-1].append(Take(self.running))

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
        for number, look in islice(filmed.looks.items(), MOST_BODIES):
            take.looks[number] = look
            name = self.translator.names.get(look.ref, "")
            take.names[number] = name if name.isidentifier() else called(look, number)
        self._taken += len(shots)
        if sets_up(request) and take.lines and take.lines[-1].sets_up:
            take.lines[-1] = msgspec.structs.replace(take.lines[-1], shots=[])
        take.lines.append(
            Line(sign(request), answer, shots, sets_up(request), "\n".join(step.code))
        )
        if shots:
            step.bodies = {take.names.get(row.number, ""): row for row in shots[-1].bodies}

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
            each.bodies[:MOST_BODIES],
            each.touches[:MOST_TOUCHES],
            each.rods[:MOST_RODS],
        )
        for each in shots[:MOST_PER_REQUEST]
    ]


def called(look: BodyLook, number: int) -> str:
    """The name of a body that no request names."""
    corners = [len(shape.points) for shape in look.shapes]
    kind = "ball" if corners == [1] else "box" if corners == [4] else "body"
    return f"{kind} {number}"


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
    lab = FilmingLab(check.module or todo.module, lambda: open_child(check.cpu_seconds), pieces)
    with lab.opened(), suppress(Exception):
        failing.again(lab=lab)
    return lab


# ---------------------------------------------------------------- the files


@dataclass
class Replays:
    """Writes a page and a script for each failed check of one submission."""

    folder: Path
    open_child: OpenChild
    open_reference: OpenChild | None
    functions: frozenset[str] = frozenset()  # the TODOs whose functions the submission has
    deaths: int = 0

    def of(self, result: Result, failing: Mapping[tuple[str, str], Failing]) -> Result:
        """The result with the paths of its replays in it."""
        if self.folder.is_symlink():
            return result  # it may lead anywhere
        todos = [
            msgspec.structs.replace(
                todo,
                checks=[self._of_check(todo, each, failing) for each in todo.checks],
            )
            for todo in result.todos
        ]
        return msgspec.structs.replace(result, todos=todos)

    def _of_check(
        self, todo: TodoResult, check: CheckResult, failing: Mapping[tuple[str, str], Failing]
    ) -> CheckResult:
        path = self.folder / f"{todo.id}-{check.id}.html"
        for old in (path, path.with_suffix(".py")):
            old.unlink(missing_ok=True)
        found = failing.get((todo.id, check.id))
        if found is None or check.state not in ("not yet", "error") or self.deaths >= MOST_DEATHS:
            return check
        try:
            made = self._made(todo, check, found)
        except Exception:  # whatever a submission makes of it: the marks stand without a picture
            made = None
        if made is None:
            return check
        self.folder.mkdir(parents=True, exist_ok=True)
        for file, text in zip((path, path.with_suffix(".py")), made, strict=True):
            with open(file, "x", encoding="utf-8", newline="\n") as stream:
                stream.write(text)
        return msgspec.structs.replace(check, replay=f"{self.folder.name}/{path.name}")

    def _made(self, todo: TodoResult, check: CheckResult, failing: Failing) -> list[str] | None:
        """The page and the script, or None where nothing is to be seen."""
        lab = filmed(failing, self.open_child, failing.pieces)
        self.deaths += lab.ended
        shown = lab.shown(check.kind == "property")
        yours = [take for takes in lab.scenes[shown] for take in takes]
        if not any(take.lines for take in yours):
            return None
        count = len(lab.scenes)
        right = self._expected(failing)[:count]
        expected = [take for takes in right[shown] for take in takes] if len(right) == count else []
        steps = [step for steps in lab.steps[shown] for step in steps]
        both = replay(yours, expected, exact=self.open_reference is not None)
        parting = step_of(both, yours, steps)
        task = f"TODO {todo.id}, {todo.title}" if failing.todo.function else todo.title
        title = f"{task}: {check.title}"
        words = [f"Expected: {check.expected}", f"Got: {check.got}"]
        again = script(title, lab.translator, steps, parting, words, self._paced(lab.module))
        made = [page(title, check.reasons(), both, again), again]
        return made if len(made[0]) <= MOST_CHARACTERS else None

    def _paced(self, module: str) -> bool:
        """Whether the program has a function that runs the steps of a frame."""
        todos = [todo.id for todo in load_rubric().todos if todo.function == f"{module}:advance"]
        return any(todo in self.functions for todo in todos)

    def _expected(self, failing: Failing) -> list[list[Take]]:
        """The scenes of the right run: the reference's, or what was recorded of it."""
        if self.open_reference is not None:
            return filmed(failing, self.open_reference, []).scenes
        return recorded().get(f"{failing.todo.id}/{failing.check.id}", [])


# ---------------------------------------------------------------- runs recorded for students


@cache
def recorded() -> Runs:
    """The right runs that came with this copy of the checks; the kit itself has none."""
    if not RECORDED.exists():
        return {}
    return msgspec.json.decode(RECORDED.read_bytes(), type=Runs)


def record_expected(reference: Path) -> bytes:
    """The right runs of all checks with fixed inputs, for a copy that comes without a reference."""
    from grader.judge.grade import opened  # it imports this module when replays are wanted

    runs: Runs = {}
    with opened(reference) as open_child:
        for todo in load_rubric().todos:
            checks = importlib.import_module(f"grader.checks.{todo.file}")
            for check in todo.checks:
                if check.kind != "property" and not check.hidden:
                    failing = Failing(todo, check, getattr(checks, check.id), [])
                    scenes = filmed(failing, open_child, []).scenes
                    for take in (take for takes in scenes for take in takes):
                        take.lines = [msgspec.structs.replace(x, code="") for x in take.lines]
                    runs[f"{todo.id}/{check.id}"] = scenes
    return msgspec.json.encode(coarse(msgspec.to_builtins(runs)))


def coarse(value: Any) -> Any:
    """The same with two decimals."""
    match value:
        case float():
            return round(value, 2)
        case list():
            return [coarse(each) for each in value]
        case dict():
            return {name: coarse(each) for name, each in value.items()}
    return value
