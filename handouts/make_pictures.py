"""Take the before and after pictures of the lab sheet, and those of the lesson.

    python handouts/make_pictures.py [--only 4]

Before: the starter with all earlier TODOs done. After: with this one done as well. Each picture is
taken by the student's own drawing code, in a process of its own, without a window.
"""

import argparse
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

KIT = Path(__file__).resolve().parents[1]
FIGURES = KIT / "handouts" / "figures"
ENGINE = ["1", "2", "3", "4", "5", "6"]
PYMUNK = ["7a", "7b", "7c", "7d"]
TRAIL_EVERY = 2  # frames between two dots of a trail
STROBE_EVERY = 0.25  # s between two places of a thrown ball

# What is shown of each TODO: the scene of the window after some frames of so many seconds. Only the
# limit of friction is seen better on a ball thrown along a slippery floor, all other TODOs done.
SHOTS = {
    "1": {"frames": 165, "frame": 1 / 60},
    "2": {"frames": 165, "frame": 1 / 60},
    "3": {"frames": 165, "frame": 1 / 60},
    "4": {"thrown": {"friction": 0.02}},
    "5": {"frames": 165, "frame": 1 / 60},
    "6": {"frames": 40, "frame": 1 / 30},
    "7a": {"frames": 80, "frame": 1 / 60},
    "7b": {"frames": 160, "frame": 1 / 60},
    "7c": {"frames": 160, "frame": 1 / 60},
    "7d": {"frames": 40, "frame": 1 / 30},
}

# ---------------------------------------------------------------- trees with some TODOs done


def tree_with(done, folder):
    """Copy the starter with these TODOs solved; return the folder."""
    from grader.source.regions import python_files, regions_in, replace_regions

    tree = folder / "tree"
    shutil.rmtree(tree, ignore_errors=True)
    shutil.copytree(KIT / "starter", tree, ignore=shutil.ignore_patterns("__pycache__"))
    for path in python_files(tree):
        solved = (KIT / "solution" / path.relative_to(tree)).read_text(encoding="utf-8")
        contents = {r.id: r.lines for r in regions_in(solved) if r.id in done}
        text = replace_regions(path.read_text(encoding="utf-8"), contents)
        path.write_text(text, encoding="utf-8", newline="\n")
    return tree


def done_before(todo):
    """Return the TODOs that are solved in the before picture."""
    program = ENGINE if todo in ENGINE else PYMUNK
    if "thrown" in SHOTS[todo]:
        return [other for other in program if other != todo]
    return program[: program.index(todo)]


def environment_in(tree):
    """Return the environment of a process without a window that imports this tree alone."""
    return {
        **os.environ,
        "SDL_VIDEODRIVER": "dummy",
        "SDL_AUDIODRIVER": "dummy",
        "PYGAME_HIDE_SUPPORT_PROMPT": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
        "PYTHONPATH": str(tree),
    }


def take(tree, picture, shot):
    """Take one picture in a fresh process that imports this tree alone."""
    order = json.dumps({**shot, "picture": str(picture)})
    command = [sys.executable, str(Path(__file__).resolve()), "--shoot", order]
    subprocess.run(command, cwd=tree, env=environment_in(tree), check=True)


def take_all(only):
    with tempfile.TemporaryDirectory() as folder:
        for todo, shot in SHOTS.items():
            if only and todo not in only:
                continue
            shot = {**shot, "module": "pymunk_scene" if todo in PYMUNK else "mini_engine"}
            before = done_before(todo)
            for name, done in (("before", before), ("after", [*before, todo])):
                picture = FIGURES / f"todo-{todo}-{name}.png"
                take(tree_with(done, Path(folder)), picture, shot)
                print(f"{picture.name}: {picture.stat().st_size / 1024:.0f} KB")


# ---------------------------------------------------------------- the camera, inside such a tree


def shoot(order):
    """Take one picture with the code of the current folder."""
    import pygame

    pygame.display.init()
    pygame.font.init()
    screen = pygame.display.set_mode((900, 600))
    if "thrown" in order:
        shoot_thrown(screen, **order["thrown"])
    else:
        shoot_scene(screen, order)
    pygame.image.save(screen, order["picture"])


def shoot_scene(screen, order):
    """Draw the scene of the window after some frames, with a dot where each body has been."""
    import pygame

    advance, world, draw, places = open_scene(order["module"], screen)
    accumulator, trail = 0.0, []
    for frame in range(order["frames"]):
        accumulator, _ = advance(world, accumulator, order["frame"])
        if frame % TRAIL_EVERY == 0:
            trail.append(places())
    draw()
    for bodies in trail:
        for place, color in bodies:
            pygame.draw.circle(screen, color, place, 2)


def open_scene(module, screen):
    """Return its `advance`, its world, and functions that draw it and list moving bodies."""
    import pygame

    if module == "pymunk_scene":
        import pymunk_scene

        space, _ = pymunk_scene.make_space(random.Random(12))

        def in_space():
            return [(body.position, next(iter(body.shapes)).color) for body in space.bodies]

        def draw():
            pymunk_scene.draw(screen, pygame.font.Font(None, 26), space)

        return pymunk_scene.advance, space, draw, in_space
    from mini_engine import BonusWindow, advance

    window = BonusWindow()
    world = window.world

    def in_world():
        return [(body.pos.xy, body.color) for body in world.moving_bodies()]

    return advance, world, window.draw, in_world


def shoot_thrown(screen, friction):
    """Draw a ball thrown along the floor at 300 px/s, every quarter of a second."""
    import pygame

    from mini_engine import STEP, Body, Box, Circle, Window, World
    from mini_engine.game_loop import BACKGROUND

    window, world = Window(), World()
    floor = world.add(Body(Box((450, 20)), (450, 200), friction=friction, color=(84, 90, 104)))
    ball = world.add(Body(Circle(22), (60, 158), mass=4.84, friction=friction))
    ball.vel.x, ball.color = 300, (235, 190, 80)
    screen.fill(BACKGROUND)
    window.draw_body(floor, floor.color)
    for step in range(round(2.6 / STEP)):
        if step % round(STROBE_EVERY / STEP) == 0:
            window.draw_body(ball, ball.color)
        world.step(STEP)
    cut = screen.subsurface((0, 90, 900, 150)).copy()
    pygame.display.set_mode((900, 150)).blit(cut, (0, 0))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", choices=list(SHOTS), help="only these TODOs")
    parser.add_argument("--shoot", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.shoot:
        shoot(json.loads(options.shoot))
    else:
        sys.path.insert(0, str(KIT))
        take_all(options.only)


if __name__ == "__main__":
    main()
