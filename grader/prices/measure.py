"""Measuring one engine: its error and its opcodes at each setting of each scene, in the sandbox.

Both come from one and the same run, whose positions are compared here with what is exact: who does
less while opcodes are counted gets the error of that. A second process runs everything once more
uncounted. Its processor seconds are the kernel's; opcodes that fall far short of them are no price.
"""

import math
from collections.abc import Callable, Collection, Sequence
from contextlib import suppress
from itertools import zip_longest
from pathlib import Path

from msgspec import Struct, structs

from grader.judge.children import Child, Worker
from grader.judge.failures import Broke, NotYet
from grader.judge.grade import Options, load_stubs, sandbox_for
from grader.judge.lab import Lab, Run
from grader.judge.rubric import load_rubric
from grader.judge.submission import Submission, take_in
from grader.judge.workplace import work_folder
from grader.prices.scenes import AWAY, LOOKS, RATE, Built, G, Scene, Setting
from grader.words import listed

MODULE = "mini_engine"
BANS = ["numpy", "pymunk", "cffi", "_cffi_backend", "ctypes", "_ctypes"]  # they work in C
CPU_SECONDS = 20  # of one scene, all settings counted; the lesson's engine needs a tenth
LEAST = 1e-3  # px: nobody sees less, and digits below it say nothing
LOST = 1000.0  # px: bodies that are farther off are not in the scene any more
MOST_WORDS = 300
UNTOLD = 5.0  # times the lesson's processor seconds per opcode
SPARE = 0.5  # of the lesson's processor seconds, for starting and for a busy machine
ALIKE, NEAR = 0.2, 0.01  # share and px, by which a run that is not counted may differ


class Point(Struct, frozen=True):
    """One setting: what it costs, and how wrong it is."""

    setting: str
    opcodes: int  # per simulated second
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
    counted: int = 0  # opcodes in all
    seconds: float = 0.0  # of a processor, to run the same uncounted

    def curve(self, scene: str) -> Curve:
        """What is known of it in this scene."""
        return next((each for each in self.curves if each.scene == scene), Curve(scene, []))

    def checked(self, lesson: "Prices | None") -> "Prices":
        """The same, at the edge where its opcodes tell too little of its processor time.

        Without its seconds, which are never the same twice.
        """
        plain = structs.replace(self, seconds=0.0)
        if lesson is None or not (lesson.counted and lesson.seconds):
            return plain
        usual = lesson.seconds / lesson.counted
        if self.seconds <= UNTOLD * usual * self.counted + SPARE * lesson.seconds:
            return plain
        why = (
            f"its opcodes tell less than a {UNTOLD:g}th of what the processor had to do: "
            "something works that nobody counts"
        )
        at_the_edge = [
            Curve(each.scene, [], why if each.points else each.gave_up) for each in self.curves
        ]
        return structs.replace(plain, curves=at_the_edge)


class GaveUp(Exception):
    """An engine did not get to what is measured; the message says how."""


# ---------------------------------------------------------------- one submission


def measure(
    path: Path,
    scenes: Sequence[Scene],
    options: Options,
    worker: Worker,
    bans: Collection[str] | None = None,
) -> Prices:
    """The prices of the submission at `path`; raises CannotGrade where there is nothing to run."""
    with work_folder() as work:
        submission = take_in(path, work / "submission", load_rubric(), load_stubs())
        sandbox = sandbox_for(submission, work, worker, options)
        sandbox.bans = list(BANS if bans is None else bans)
        seconds, curves = 0.0, []
        for scene in scenes:
            curve = Curve(scene.id, [], not_begun(scene, submission))
            if not curve.gave_up:
                curve = curve_of(scene, sandbox.open_child)
                taken, errors = uncounted(scene, len(curve.points), sandbox.open_child)
                curve = compared(curve, errors)
                seconds += taken if curve.points else 0.0
            curves.append(curve)
    counted = sum(
        round(point.opcodes * scene.seconds)
        for scene, curve in zip(scenes, curves, strict=True)
        for point in curve.points
    )
    return Prices(submission.name, curves, counted, seconds)


def not_begun(scene: Scene, submission: Submission) -> str:
    """Which TODOs the scene needs that nobody has begun, in words."""
    left = [id for id in scene.needs if not submission.begun.get(id, True)]
    if not left:
        return ""
    return f"TODO {listed(left)} {'is' if len(left) == 1 else 'are'} not begun"


def curve_of(scene: Scene, open_child: Callable[[int], Child]) -> Curve:
    """The scene at each setting, in a process of its own; it ends with the first that fails."""
    points = []
    with Lab(MODULE, lambda: open_child(CPU_SECONDS), []).opened() as lab:
        try:
            for setting in scene.settings:
                points.append(point_of(lab, scene, setting))
        except (Broke, NotYet, GaveUp) as failure:
            at = f" ({setting.words})"
            return Curve(scene.id, points, in_words(failure) + at)
    return Curve(scene.id, points)


def point_of(lab: Lab, scene: Scene, setting: Setting) -> Point:
    built, run = run_of(lab, scene, setting, priced=True)
    error = error_of(scene, built, run)
    if built.floor is not None:
        falls(lab, built)
    return Point(setting.words, round(run.opcodes / scene.seconds), in_digits(error))


def run_of(lab: Lab, scene: Scene, setting: Setting, priced: bool) -> tuple[Built, Run]:
    """Build the scene anew and run it."""
    lab.ran(f"{scene.title}, {setting.words}")
    built = scene.build(lab)
    lab.put(built.world, iterations=setting.passes)
    steps, every = round(scene.seconds * setting.rate), setting.rate // LOOKS
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


def uncounted(
    scene: Scene, many: int, open_child: Callable[[int], Child]
) -> tuple[float, list[float]]:
    """Processor seconds to run the first so many settings, and their errors as far as it gets."""
    errors: list[float] = []
    lab = Lab(MODULE, lambda: open_child(CPU_SECONDS), [])
    with lab.opened(), suppress(Broke, NotYet, GaveUp):
        for setting in scene.settings[:many]:
            built, run = run_of(lab, scene, setting, priced=False)
            errors.append(in_digits(error_of(scene, built, run)))
    return lab.connection.cpu, errors


def compared(curve: Curve, errors: Sequence[float]) -> Curve:
    """The curve, unless the engine does something else when nobody counts."""
    for point, other in zip_longest(curve.points, errors):
        if other is None or not math.isclose(point.error, other, rel_tol=ALIKE, abs_tol=NEAR):
            found = "none" if other is None else f"{other:.3g} px"
            why = (
                f"at {point.setting} its error is {point.error:.3g} px where opcodes are counted "
                f"and {found} where they are not"
            )
            return Curve(curve.scene, [], why)
    return curve
