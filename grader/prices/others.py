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
    """What these cost, as far as they are here: students have the lesson's in no other form than
    their own, and the stable one in their `tree`."""
    found = []
    ours = Options(isolation=options.isolation, trusted=True)
    if options.reference is not None:
        lesson = measure(options.reference, scenes, ours, worker)
        found.append(named(lesson, LESSON))
    folders = [folder / "stable_engine" for folder in (KIT / "solution", tree) if folder]
    stable = next((folder for folder in folders if folder.is_dir()), None)
    for name, adapter, package in ((STABLE, "stable", stable), (PYMUNK, "chipmunk", None)):
        if name == STABLE and package is None:
            continue
        with work_folder() as work:
            folder = work / "engine"
            folder.mkdir()
            shutil.copyfile(ENGINES / f"{adapter}.py", folder / "mini_engine.py")
            if package is not None:
                shutil.copytree(package, folder / "stable_engine")
            bans = () if name in IN_C else None
            found.append(named(measure(folder, scenes, ours, worker, bans), name))
    return found


def named(found: Measured, name: str) -> Measured:
    return structs.replace(found, prices=structs.replace(found.prices, name=name))


def lesson_in(found: Sequence[Measured]) -> Measured | None:
    """The lesson's engine, where it is among them."""
    return next((each for each in found if each.prices.name == LESSON), None)
