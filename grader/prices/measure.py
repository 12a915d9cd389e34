"""Measuring one engine: its error and its opcodes at each setting of each scene, in the sandbox.

Both come from one and the same run, whose positions are compared here with what is exact: who does
less while opcodes are counted gets the error of that. Another process runs each setting once more
uncounted. Its processor seconds are the kernel's; opcodes that fall far short of them are no price.
"""

import math
from collections.abc import Collection, Sequence
from contextlib import suppress
from pathlib import Path

from msgspec import Struct, structs

from grader.judge.children import Worker, worked_seconds
from grader.judge.failures import Broke, NotYet
from grader.judge.grade import Options, load_stubs, sandbox_for
from grader.judge.lab import Lab, Run
from grader.judge.rubric import load_rubric
from grader.judge.submission import Submission, take_in
from grader.judge.workplace import work_folder
from grader.prices.scenes import AWAY, LOOKS, RATE, Built, G, Scene, Setting
from grader.text import listed

MODULE, OPEN = "mini_engine", "open_engine"  # the second goes before, where there is one
BANS = ["numpy", "pymunk", "cffi", "_cffi_backend", "ctypes", "_ctypes"]  # they work in C
CPU_SECONDS = 20  # of one scene, all settings counted; the lesson's engine needs a tenth
LEAST = 1e-3  # px: nobody sees less, and digits below it say nothing
LOST = 1000.0  # px: bodies that are farther off are not in the scene any more
MOST_OPCODES = 1e9  # in one run: more than CPU_SECONDS have room for
MOST_WORDS = 300
UNTOLD = 5.0  # times the lesson's processor seconds per opcode
SPARE = 0.5  # of the lesson's processor seconds, for what is no opcode and a busy machine
ALIKE, NEAR = 0.2, 0.01  # share and px, by which a run that is not counted may differ


class Point(Struct, frozen=True):
    """One setting: what it costs, and how wrong it is."""

    setting: str
    opcodes: int  # per simulated second, 1 at least
    error: float  # px, at least LEAST, in three digits


class Curve(Struct, frozen=True):
    """One engine in one scene; why it stands at the edge, if it does."""

    scene: str
    points: list[Point]
    gave_up: str = ""


class Prices(Struct, frozen=True):
    """One engine in all scenes."""

    name: str
    curves: list[Curve]

    def curve(self, scene: str) -> Curve:
        """What is known of it in this scene."""
        return next((each for each in self.curves if each.scene == scene), Curve(scene, []))


class Measured(Struct, frozen=True):
    """The prices of one engine, and what is never the same twice.

    `seconds` are those of a processor for the points of each scene, in their order, uncounted.
    """

    prices: Prices
    seconds: dict[str, list[float]]

    def checked(self, lesson: "Measured | None") -> Prices:
        """The prices, at the edge where opcodes tell too little of the processor's time."""
        if lesson is None:
            return self.prices
        curves = [
            Curve(curve.scene, [], why) if (why := self.untold(curve, lesson)) else curve
            for curve in self.prices.curves
        ]
        return structs.replace(self.prices, curves=curves)

    def untold(self, curve: Curve, lesson: "Measured") -> str:
        """Where more works than opcodes tell, in words."""
        usual = lesson.prices.curve(curve.scene).points
        theirs = zip(usual, lesson.seconds.get(curve.scene, []), strict=False)
        known = {point.setting: (point.opcodes, seconds) for point, seconds in theirs}
        for point, seconds in zip(curve.points, self.seconds.get(curve.scene, []), strict=False):
            opcodes, taken = known.get(point.setting, (1, 0.0))
            if taken and seconds > (UNTOLD * point.opcodes / opcodes + SPARE) * taken:
                return (
                    f"at {point.setting} its opcodes tell less than a {UNTOLD:g}th of what the "
                    "processor had to do: something works that nobody counts"
                )
        return ""


class GaveUp(Exception):
    """An engine did not get to what is measured; the message says how."""


# ---------------------------------------------------------------- one submission


def measure(
    path: Path,
    scenes: Sequence[Scene],
    options: Options,
    worker: Worker,
    bans: Collection[str] | None = None,
) -> Measured:
    """The prices of the submission at `path`; raises CannotGrade where there is nothing to run.

    An engine that is only to be measured, for the open task, goes before the one that is graded.
    """
    with work_folder() as work:
        submission = take_in(path, work / "submission", load_rubric(), load_stubs())
        sandbox = sandbox_for(submission, work, worker, options)
        sandbox.bans = list(BANS if bans is None else bans)
        own = (submission.folder / OPEN).is_dir()

        def lab() -> Lab:
            return Lab(OPEN if own else MODULE, lambda: sandbox.open_child(CPU_SECONDS), [])

        curves, seconds = [], {}
        for scene in scenes:
            curve = Curve(scene.id, [], "" if own else not_begun(scene, submission))
            if not curve.gave_up:
                curve = curve_of(scene, lab())
                again = [
                    uncounted(scene, setting, lab())
                    for setting, _ in zip(scene.settings, curve.points, strict=False)
                ]
                seconds[scene.id] = [each for each, _ in again]
                curve = compared(curve, [error for _, error in again])
            curves.append(curve)
    return Measured(Prices(submission.name, curves), seconds)


def not_begun(scene: Scene, submission: Submission) -> str:
    """Which TODOs the scene needs that nobody has begun, in words."""
    left = [id for id in scene.needs if not submission.begun.get(id, True)]
    if not left:
        return ""
    return f"TODO {listed(left)} {'is' if len(left) == 1 else 'are'} not begun"


def curve_of(scene: Scene, lab: Lab) -> Curve:
    """The scene at each setting, in a process of its own; it ends with the first that fails."""
    points = []
    with lab.opened():
        for setting in scene.settings:
            try:
                points.append(point_of(lab, scene, setting))
            except (Broke, NotYet, GaveUp) as failure:
                return Curve(scene.id, points, f"{in_words(failure)} ({setting.words})")
    return Curve(scene.id, points)


def point_of(lab: Lab, scene: Scene, setting: Setting) -> Point:
    built, run = run_of(lab, scene, setting, priced=True)
    error = error_of(scene, built, run)
    if not 0 < run.opcodes < MOST_OPCODES:
        raise GaveUp(f"it says that {run.opcodes:.3g} opcodes ran, which cannot be")
    if built.floor is not None:
        falls(lab, built)
    return Point(setting.words, max(1, round(run.opcodes / scene.seconds)), in_digits(error))


def run_of(lab: Lab, scene: Scene, setting: Setting, priced: bool) -> tuple[Built, Run]:
    """Build the scene anew and run it."""
    lab.ran(f"{scene.title}, {setting.words}")
    built = scene.build(lab)
    with suppress(NotYet):  # an engine may have no such dial
        lab.get(built.world, "iterations")
        lab.put(built.world, iterations=setting.passes)
    steps, every = scene.steps(setting), setting.rate // LOOKS
    run = lab.simulate(built.world, built.watched, steps, 1 / setting.rate, every, priced=priced)
    return built, run


def error_of(scene: Scene, built: Built, run: Run) -> float:
    error = scene.worst([run.body(number) for number in range(len(built.watched))])
    if error > LOST:
        raise GaveUp(f"a body is {error:.3g} px from where it should be")
    return error


def falls(lab: Lab, built: Built) -> None:
    """A tower whose floor is taken away must fall: who nails it into the air has no tower."""
    assert built.floor is not None
    before = lab.state(built.watched[0]).pos.y
    lab.put(built.floor, pos=(0.0, 1e5))
    lab.simulate(built.world, built.watched, round(AWAY * RATE), 1 / RATE, every=round(AWAY * RATE))
    fallen = lab.state(built.watched[0]).pos.y - before
    if fallen < G * AWAY**2 / 8:
        raise GaveUp(
            f"{AWAY:g} s after the floor was taken away the lowest ball had fallen {fallen:.3g} px"
        )


def in_digits(error: float) -> float:
    """Three digits, which are the same on every machine."""
    return max(LEAST, float(f"{error:.3g}"))


def in_words(failure: Broke | NotYet | GaveUp) -> str:
    """Why an engine gave up, in one line."""
    words = str(failure)
    if isinstance(failure, NotYet):
        words = f"{failure.got}; expected {failure.expected}"
    return " ".join(words.split())[:MOST_WORDS]


# ---------------------------------------------------------------- once more, uncounted


def uncounted(scene: Scene, setting: Setting, lab: Lab) -> tuple[float, float | None]:
    """Processor seconds to run it, and the error; None where it does not get there.

    What takes little time is run again and again. The import does not count.
    """
    seconds, error = 0.0, None
    with lab.opened(), suppress(Broke, NotYet, GaveUp, OSError):
        lab.probe()
        began = worked(lab)
        for _ in range(max(1, round(scene.enough / scene.steps(setting)))):
            built, run = run_of(lab, scene, setting, priced=False)
            error = in_digits(error_of(scene, built, run))
        seconds = worked(lab) - began
    return seconds, error


def worked(lab: Lab) -> float:
    """Processor seconds that the process of this engine has used up so far."""
    child = lab.connection.child
    assert child is not None
    return worked_seconds(child.worker.pid_of(child))


def compared(curve: Curve, errors: Sequence[float | None]) -> Curve:
    """The curve, unless the engine does something else when nobody counts."""
    for point, other in zip(curve.points, errors, strict=True):
        if other is None or not math.isclose(point.error, other, rel_tol=ALIKE, abs_tol=NEAR):
            found = "none" if other is None else f"{other:.3g} px"
            why = (
                f"at {point.setting} its error is {point.error:.3g} px where opcodes are counted "
                f"and {found} where they are not"
            )
            return Curve(curve.scene, [], why)
    return curve
