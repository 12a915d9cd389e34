"""Film a tower of ten balls in the lesson's engine, the stable engine and pymunk, by settings.

    python film_tower.py

It prints the films as JSON. `make_films.py` starts it in the folder of the engines.
"""

import json
from itertools import product

from experiments.engines import Lesson, Pymunk, Stable
from experiments.scenes import Ball, tower

BALLS, SECONDS, SHOTS = 10, 2, 30  # shots are per second
STEPS = (30, 60, 120)  # per second
PASSES, SUBSTEPS = (2, 8, 30), (1, 4)
STILL = (  # what the still picture shows: a film of each engine
    ("lesson's engine", "lesson/8/1/60"),
    ("stable engine", "stable/1/4/60"),
    ("pymunk", "pymunk/8/1/60"),
)


def engines():
    """Yield each engine with each setting: its name, passes, substeps, and a maker."""
    for passes, substeps in product(PASSES, SUBSTEPS):
        yield "lesson", passes, substeps, lambda s, p=passes, n=substeps: Lesson(s, p, n)
        yield "pymunk", passes, substeps, lambda s, p=passes, n=substeps: Pymunk(s, p, n)
    for substeps in SUBSTEPS:
        yield "stable", 1, substeps, lambda s, n=substeps: Stable(s, n)


def film(engine, scene, rate):
    """Return the shots of a tower, the deepest sink of its top, and the contacts solved."""
    top, last, solved, sink = scene.moving()[-1], {}, 0, 0.0
    start, frames = engine.read(top).y, []
    for step in range(SECONDS * rate + 1):
        if step:
            engine.step(1 / rate)
            solved += engine.contacts()
            sink = max(sink, engine.read(top).y - start)
        if step % (rate // SHOTS) == 0:
            rows = {place + 1: row(engine.read(place)) for place in scene.moving()}
            changed = [[n, *each] for n, each in rows.items() if last.get(n) != each]
            frames.append([round(step / rate, 3), 1, changed, None, None, []])
            last = rows
    return frames, sink, solved


def row(state):
    """Round a state to a tenth of a px. Nothing turns here, and no speed is drawn."""
    return [round(state.x, 1) + 0.0, round(state.y, 1) + 0.0, 0, 0, 0, 0]


def main():
    scene = tower(BALLS)
    films, first = {}, None
    for (name, passes, substeps, make), rate in product(engines(), STEPS):
        frames, sink, solved = film(make(scene), scene, rate)
        first = first or frames[0]
        work = solved * passes * substeps / SECONDS
        films[f"{name}/{passes}/{substeps}/{rate}"] = {
            "sink": round(sink, 2),
            "work": round(work),  # contacts solved in a second
            "frames": frames[1:],
        }
    looks, still = {}, []
    for place, data in enumerate(scene.bodies):
        if isinstance(data, Ball):
            shape, mass = [[[0, 0]], data.radius], data.mass
        else:
            x, y = data.half
            shape, mass = [[[-x, -y], [x, -y], [x, y], [-x, y]], 0], None
            still.append([place + 1, *data.pos, 0, 0, 0, 0])
        looks[place + 1] = {"ref": 0, "shapes": [shape], "mass": mass, "moment": None}
    first[2] = [*still, *first[2]]
    scene_data = {"curve": False, "looks": looks, "view": [-110, -215, 110, 15], "names": {}}
    settings = {"passes": PASSES, "substeps": SUBSTEPS, "rates": STEPS}
    print(
        json.dumps(
            {"scene": scene_data, "first": first, "films": films, "still": STILL, **settings}
        )
    )


if __name__ == "__main__":
    main()
