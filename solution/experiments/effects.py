"""Measure the price of each effect: `python -m experiments.effects [--quick] [--markdown FILE]`.

Takes a pile of balls at rest, declares one effect after the other, and counts the opcodes of a step
and the engine's work (pairs, contacts, solves ...). The price of an effect is the
difference between two such runs. Prints the tables, and writes them with a figure to build/effects.
"""

import argparse
import json
import math
import platform
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path
from unittest import mock

from mini_engine import contacts as lesson_contacts
from mini_engine import joints, solver, world
from mini_engine.bonus.world import with_bonus
from stable_engine import contact, contacts, friction, rods, sleep, springs, sweep

from . import effects_report
from .engines import Lesson, Stable, State
from .figures import draw_figures
from .measures import overlap, run, states
from .opcodes import count_calls, count_opcodes
from .scenes import BOUNCE, DT, EFFECTS, TOUCH, Ball, Scene, Spring, pile, slot
from .table import Progress, write_markdown

SIZES = (10, 40, 200)  # balls
HEAPS = (40, 200, 400)  # balls, for the two bonus tasks that save work
LULL = 30.0  # s, after which a pile is asleep; until then a ball may roll alone on the floor
USERS = 10  # rods, springs, bullets
WARM_UP = 45  # steps before counting: rooms adapt to motion. A sweep is then in each count
COUNTED = sleep.TWO_LOOKS  # steps: Sleep looks at two of them
DAMPING = (0.05, 0.3)  # 1/s
OUT = Path("build/effects")


@dataclass
class Row:
    """One line of the price list: a scene's cost with `effects`, minus that with `base`."""

    title: str
    effects: tuple
    base: tuple | None = TOUCH  # None: minus nothing
    scene: str = "pile"


TOGETHER = "all of them together"
ROWS = [
    Row("move only", (), None),
    Row("contacts", ("Contacts",), ()),
    Row("contacts, nobody moves", ("Contacts",), (), "still"),
    Row("friction", TOUCH, ("Contacts",)),
    Row("bounce", BOUNCE),
    Row("10 rods", (*TOUCH, "Rods")),
    Row("10 springs", (*TOUCH, "Springs")),
    Row("damping", (*TOUCH, "Damping")),
    Row("10 bullets, slow", (*TOUCH, "Bullets")),
    Row("10 bullets, fast", (*TOUCH, "Bullets"), TOUCH, "flying"),
    Row("sleep, all awake", (*TOUCH, "Sleep")),
    Row(TOGETHER, EFFECTS, None),
    Row("all asleep", (*TOUCH, "Sleep"), None, "asleep"),
]
APART = ("contacts, nobody moves", "10 bullets, fast", TOGETHER, "all asleep")
STACKED = [row.title for row in ROWS if row.title not in APART]  # these prices add up


# ---------------------------------------------------------------- scenes


def settled(count):
    """Return a pile at rest. Rods, springs and bullets count only with their effect."""
    width = 26.0 * max(4, round(math.sqrt(2.5 * count)))
    engine = Stable(replace(pile(count, width), effects=(*TOUCH, "Damping"), damping=(1.0, 1.0)))
    run(engine, 4)
    bodies = [
        replace(body, pos=(now.x, now.y), restitution=0.3)
        for body, now in zip(engine.scene.bodies, states(engine), strict=True)
    ]
    pairs = neighbours(bodies)
    for i in engine.scene.moving()[:USERS]:
        bodies[i].bullet = True
    ties = [Spring(a, b, 50.0, length=math.dist(bodies[a].pos, bodies[b].pos)) for a, b in pairs]
    return Scene(bodies, TOUCH, pairs, ties, damping=DAMPING)


def neighbours(bodies):
    """Return the closest pairs of balls that do not touch; joints do not move them."""
    balls = [(i, body) for i, body in enumerate(bodies) if isinstance(body, Ball)]
    gaps = []
    for (i, a), (j, b) in combinations(balls, 2):
        at, there = (State(*body.pos, 0, 0, 0, 0) for body in (a, b))
        gaps.append((-overlap(a, at, b, there), i, j))
    return [(i, j) for gap, i, j in sorted(gaps) if gap > 1][:USERS]


def with_fliers(scene):
    """Add bullets far above the pile that move more than their radius in a step."""
    below = [replace(b, bullet=False) if isinstance(b, Ball) else b for b in scene.bodies]
    places = [(100.0 * i, -5000.0 - 100.0 * i) for i in range(USERS)]
    fliers = [Ball(place, vel=(3000.0, 0.0), bullet=True) for place in places]
    return replace(scene, bodies=[*below, *fliers])


def packed(count):
    """Return five rows of balls in a bin, each ball on two of the row below, and the rest on top.

    They overlap as in a pile at rest: by less than the solver corrects.
    """
    wide, half = math.ceil(count / 5), Ball.radius - 0.2  # px, half the way to the next ball
    places = [
        (half * (2 * i + 1 + row % 2 - wide), -half * (1 + row * math.sqrt(3)))
        for row in range(count)
        for i in range(wide - row % 2)
    ]
    return Scene([*slot(2 * half * wide, 1000.0), *map(Ball, places[:count])])


class RepeatedStep:
    """An engine that starts every step from the scene's positions: each step costs the same.

    `kind` "still": no step ends elsewhere than the one before, so it finds no contacts anew.
    "asleep": it runs freely until all sleep.
    """

    def __init__(self, engine, kind="pile"):
        self.engine, self.kind = engine, kind
        if kind == "asleep":
            run(engine, LULL)
        for _ in range(WARM_UP):
            self.reset()
            engine.step(DT)
        for _ in range(2 if kind == "still" else 0):  # after the first, normals stay as well
            with mock.patch.object(contacts.Contacts, "note_moved", lambda _: False):
                self.reset()
                engine.step(DT)

    def reset(self):
        """Put every body back to its position in the scene, and reset its time at rest."""
        if self.kind == "asleep":
            return
        for i in self.engine.scene.moving():
            body = self.engine.bodies[i]
            if self.kind == "still":
                body.last_x, body.last_y = body.x, body.y  # where this step will end as well
            elif hasattr(body, "last_x"):
                body.last_x += 0.001  # px, so it looks for contacts anew
            put_back(body, self.engine.scene.bodies[i])
        for each in getattr(self.engine.world, "effects", {}).values():
            if isinstance(each, contacts.Contacts):
                each.crowd = {}  # they rest, so none has to be parted
            for found in getattr(each, "touching", []) if self.kind == "still" else []:
                found.jn = 0.0


def put_back(body, data):
    """Give a body of either engine its position and velocity in the scene."""
    if hasattr(body, "still"):
        (body.x, body.y), (body.vx, body.vy) = data.pos, data.vel
        body.w = body.still = body.lag_x = body.lag_y = 0.0
    else:
        body.pos.update(data.pos)
        body.vel.update(data.vel)
        body.omega = body.still_for = 0.0


# ---------------------------------------------------------------- counting


def rows_of(effect):
    """Count the contacts that one pass solves."""
    return sum(len(group.contacts) for group in effect.groups)


def rough_rows_of(effect):
    """Count the contacts that have friction: one pass solves them."""
    return sum(c.mu > 0 for group in effect.contacts.groups for c in group.contacts)


def awake(effect):
    """Count the joints that one pass solves."""
    return len(effect.awake)


STABLE_WORK = [
    ("pairs", contact.collide, 1),
    ("contact solves", contacts.Contacts.solve, rows_of),
    ("contact solves", contacts.Contacts.relax, rows_of),
    ("friction solves", friction.Friction.solve, rough_rows_of),  # relax calls it as well
    ("rod solves", rods.Rods.solve, awake),
    ("rod solves", rods.Rods.relax, awake),
    ("spring forces", springs.Springs.solve, awake),
    ("sweeps", sweep.first_hit, 1),
]
LESSON_WORK = [
    ("pairs", lesson_contacts.collide, 1),
    ("solver runs", world.World.solve, lambda world: bool(world.contacts or world.joints)),
    ("contact solves", solver.solve_normal, 1),
    ("friction solves", solver.solve_friction, 1),
    ("rod solves", joints.DistanceJoint.solve, 1),
    ("damping runs", world.World.apply_damping, 1),
]


def count(repeated, work, steps=1):
    """Return the opcodes of a step, the mean of so many, and the work that one more step does."""
    engine, opcodes = repeated.engine, 0
    for _ in range(steps):
        repeated.reset()
        opcodes += sum(count_opcodes(lambda: engine.world.step(DT)).values())
    repeated.reset()
    done = count_calls(lambda: engine.world.step(DT), work)
    done = {"contacts": engine.contacts() if done["contact solves"] else 0, **done}
    return {"opcodes": round(opcodes / steps), "done": done}


def list_prices(balls):
    """Return the rows of the price list for a pile of so many balls."""
    heap = settled(balls)
    scenes = {"pile": heap, "still": heap, "asleep": heap, "flying": with_fliers(heap)}
    counted, listed = {}, []
    for kind, effects in {(row.scene, each) for row in ROWS for each in (row.effects, row.base)}:
        if effects is not None:
            engine = Stable(replace(scenes[kind], effects=effects))
            counted[kind, effects] = count(RepeatedStep(engine, kind), STABLE_WORK, COUNTED)
    for row in ROWS:
        key, base = (row.scene, row.effects), (row.scene, row.base)
        less = counted[base]["opcodes"] if row.base is not None else 0
        now = {"title": row.title, "effects": row.effects, "base": row.base, **counted[key]}
        listed.append(now | {"price": now["opcodes"] - less})
    return listed


def list_lesson(balls):
    """Return the work of the lesson's engine on the same pile, and on scenes with less."""
    heap = settled(balls)
    scenes = {
        "balls far apart": Scene([Ball((100.0 * i, 0.0)) for i in range(balls)], ()),
        "a pile without friction": replace(heap, effects=("Contacts",)),
        "with friction": heap,
        "with friction and 10 rods": replace(heap, effects=(*TOUCH, "Rods")),
        "with friction and damping": replace(heap, effects=(*TOUCH, "Damping")),
    }
    cases = {title: RepeatedStep(Lesson(scene)) for title, scene in scenes.items()}
    return [{"title": title, **count(case, LESSON_WORK)} for title, case in cases.items()]


def list_bonus(balls):
    """Return the work of the lesson's engine on a pile at rest, before and after B3 and B1."""
    scene = packed(balls)
    cases = {
        "before": RepeatedStep(Lesson(scene)),
        "B3: a grid": RepeatedStep(make_bonus_engine(scene, grid=True)),
        "B1: sleep, all awake": RepeatedStep(make_bonus_engine(scene, sleeping=True)),
        # Pairs of sleepers are skipped: the grid only makes this faster.
        "B1: asleep": RepeatedStep(make_bonus_engine(scene, sleeping=True, grid=True), "asleep"),
    }
    return [
        {"title": title, "asleep": case.engine.asleep(), **count(case, LESSON_WORK)}
        for title, case in cases.items()
    ]


def make_bonus_engine(scene, sleeping=False, grid=False):
    """Return a lesson's engine with these bonus tasks switched on."""
    engine = Lesson(scene)
    engine.world = with_bonus(engine.world)
    engine.world.sleeping, engine.world.grid = sleeping, grid
    return engine


def measure(sizes=SIZES, heaps=HEAPS):
    """Return all lists, as plain data."""
    middle = sizes[len(sizes) // 2]
    progress = Progress(sum(sizes) + middle + sum(heaps))
    results = {"python": platform.python_version(), "steps": COUNTED, "middle": str(middle)}
    results |= {"stacked": STACKED, "prices": {}, "bonus": {}}
    for balls in sizes:
        progress.step(balls, f"{balls} balls")
        results["prices"][str(balls)] = list_prices(balls)
    progress.step(middle, "the lesson's engine")
    results["lesson"] = list_lesson(middle)
    for balls in heaps:
        progress.step(balls, f"bonus tasks, {balls} balls")
        results["bonus"][str(balls)] = list_bonus(balls)
    progress.end()
    return results


def main(arguments=None):
    """Run from the command line."""
    parser = argparse.ArgumentParser(prog="python -m experiments.effects", description="Prices.")
    parser.add_argument("--quick", action="store_true", help="the smallest piles only")
    parser.add_argument("--out", type=Path, default=OUT, help="folder for results and figures")
    parser.add_argument("--markdown", type=Path, help="file whose block of tables is renewed")
    options = parser.parse_args(arguments)
    results = measure(SIZES[:1], HEAPS[:1]) if options.quick else measure()
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "results.json").write_text(json.dumps(results, indent=1) + "\n", "utf-8")
    tables = effects_report.make_tables(results)
    print("\n".join(table.text() for table in tables))
    print(draw_figures([("effects-stacked", effects_report.make_bars(results))], options.out))
    if options.markdown:
        write_markdown(options.markdown, tables, effects_report.make_lines(results))


if __name__ == "__main__":
    main()
