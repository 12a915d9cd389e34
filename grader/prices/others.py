"""Engines to compare with: the lesson's own, the stable one, and pymunk."""

import shutil
from collections.abc import Sequence
from pathlib import Path

from msgspec import structs

from grader.judge.children import Worker
from grader.judge.grade import KIT, Options
from grader.judge.workplace import work_folder
from grader.prices.measure import Measured, measure
from grader.prices.scenes import Scene

ENGINES = Path(__file__).with_name("engines")
LESSON, STABLE, PYMUNK = "the lesson's", "stable_engine", "pymunk"
IN_C = (PYMUNK,)  # of these no opcode tells what they cost


def others(
    scenes: Sequence[Scene], options: Options, worker: Worker, tree: Path | None = None
) -> list[Measured]:
    """What these cost, as far as they are here.

    Students have the lesson's in no other form than their own, and the stable one in their `tree`.
    """
    ours = Options(isolation=options.isolation, trusted=True)
    found = []
    if options.reference is not None:
        found.append(named(measure(options.reference, scenes, ours, worker), LESSON))
    places = [folder / "stable_engine" for folder in (KIT / "solution", tree) if folder]
    stable = next((place for place in places if place.is_dir()), None)
    with work_folder() as work:
        if stable is not None:
            shutil.copytree(stable, work / STABLE / "stable_engine")
            adapted(work / STABLE, "stable.py")
            found.append(named(measure(work / STABLE, scenes, ours, worker), STABLE))
        adapted(work / PYMUNK, "chipmunk.py")
        found.append(named(measure(work / PYMUNK, scenes, ours, worker, bans=()), PYMUNK))
    return found


def adapted(folder: Path, adapter: str) -> None:
    """Make an engine in this folder one with the lesson's names."""
    folder.mkdir(exist_ok=True)
    shutil.copyfile(ENGINES / adapter, folder / "mini_engine.py")


def named(found: Measured, name: str) -> Measured:
    return structs.replace(found, prices=structs.replace(found.prices, name=name))


def lesson_in(found: Sequence[Measured]) -> Measured | None:
    """The lesson's engine, where it is among them."""
    return next((each for each in found if each.prices.name == LESSON), None)
