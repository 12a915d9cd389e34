"""Test that the page's pygame equals pygame-ce where the lab uses it: values, errors, positions."""

import ast
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import KIT

PAGE = KIT / "grader" / "release" / "tab"

CALLS = """
import sys, json, random
sys.path[:0] = sys.argv[2:]
import pygame
from pygame import Vector2
rng = random.Random(7)
numbers = [0.0, -0.0, 1.0, 1e-9, 1e20, 3.0] + [rng.uniform(-90, 90) for _ in range(14)]
pygame.init()
for line in json.loads(sys.argv[1]):
    for _ in range(12):
        a, b, c, d, e = (rng.choice(numbers) for _ in range(5))
        v, w, share = Vector2(a, b), Vector2(c, d), rng.random()
        S = pygame.Surface((40, 30))
        try:
            result = eval(line)
            number = isinstance(result, (Vector2, tuple))
            said = list(map(float.hex, map(float, result))) if number else repr(result)
        except Exception as error:
            words = str(error)  # the grader reads those of operators
            said = words if words.startswith("unsupported operand") else type(error).__name__
        print(line, said)
"""
EXACT = """
v + w|v - w|v * c|c * v|v * w|v / c|-v|+v|v + (c, d)|(c, d) - v|[c, d] + v|v * 2|v / 3
Vector2().dot((-1, -1))|Vector2() * Vector2(-1, -1)|v / 0|v / w
v.__iadd__(w)|v.__isub__(w)|v.__imul__(c)|v.__itruediv__(d)
v.dot(w)|v.cross(w)|v.length()|v.length_squared()|v.normalize()|v.lerp(w, share)
v.distance_to(w)|v.distance_squared_to(w)|v.rotate(e)|v.rotate_rad(e)|v.rotate_ip(e) or v
v.rotate(90)|v.rotate(-180)|v.rotate(270.0)|v.rotate_rad(1e-8)|v.project(w)|v.reflect(w)
v.angle_to(w)|v.as_polar()|v.normalize_ip() or v|v.scale_to_length(c) or v
v == w|v == (a, b)|v != w|v < w|v < 3|v + 1|1 + v|c - v|v * "a"|v * None
abs(v)|hash(v)|repr(v)|str(v)|f"{v}"|bool(v)|len(v)|v[0]|v[-1]|v[2]|v["a"]|v[::-1]
list(v)|v.xy|v.yx|v.foo|Vector2()|Vector2(2)|Vector2("a")|Vector2(None)|Vector2((1, 2, 3))
Vector2(1, None)|Vector2([c, d])|v.dot(1)|v.lerp(w, 2)|v.lerp(1, 0.5)|v.rotate("a")|v.copy()
setattr(v, "x", "a")|setattr(v, "x", 3) or v.x|v.update(c, d) or v|Vector2(0, 0).normalize()
pygame.math.clamp(a, -1, 1)|pygame.math.lerp(a, b, share)|pygame.Color("red")|pygame.Color(1, 2, 3)
pygame.Color("nope")|pygame.Rect(a % 99, b % 99, c % 9, d % 9)|pygame.Rect(v, (3, 4)).center
pygame.Rect(1, 2, 30, 40).clip((20, 3, 90, 9))|pygame.Rect(1, 2, 3, 4).inflate(3, 3)
pygame.Rect(1, 2, 3, 4).collidepoint(v)|pygame.draw.circle(S, "red", (5.7, 5.2), 3.9)
pygame.draw.circle(S, None, v, 3)|pygame.draw.aacircle(S, "red", (5, 5), 3)
pygame.draw.circle(S, "red", 5, 3)|pygame.draw.line(S, "red", 1, (5, 7))
pygame.draw.rect(S, (1, 2, 3), (1, 1, 50, 7))|pygame.draw.polygon(S, "red", [(1, 1), (5, 1)])
S.fill("red")|S.fill((1, 2, 300))|S.get_at((99, 0))|pygame.event.post(3)|pygame.time.wait("a")
pygame.key.key_code("left shift")|pygame.key.key_code("zz")|pygame.K_LSHIFT
pygame.key.name(pygame.K_SPACE)|pygame.font.Font(None, 26).render(3, True, "red")
"""
RUN = """
import sys, random
sys.path[:0] = sys.argv[1:]
from mini_engine.game_loop import Window
import pygame
window = Window()
for frame in range(120):
    if frame % 20 == 0:
        window.drop_ball((100 + 5 * frame, 60))
    window.world.step(1 / 120)
    window.draw()
print([(b.pos.x.hex(), b.pos.y.hex()) for b in window.world.bodies])
import pymunk_scene
space = pymunk_scene.make_space(random.Random(12))[0]
screen, font = pygame.Surface((900, 600)), pygame.font.Font(None, 26)
for frame in range(120):
    space.step(1 / 120)
    for shape in space.shapes:
        pymunk_scene.draw_shape(screen, shape)
print([(b.position.x.hex(), b.position.y.hex()) for b in space.bodies])
"""


def run(code: str, *arguments: object) -> list[str]:
    """Return the lines that code prints, headless."""
    headless = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code, *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, **headless, "PYGAME_HIDE_SUPPORT_PROMPT": "1"},
    )
    assert not done.returncode, done.stderr
    return done.stdout.splitlines()


def test_calls_give_what_pygame_ce_gives_to_the_last_bit():
    calls = json.dumps(EXACT.replace("\n", "|").strip("|").split("|"))
    assert run(CALLS, calls, PAGE) == run(CALLS, calls)


def test_the_engine_and_the_pymunk_scene_run_alike():
    assert run(RUN, PAGE, KIT / "solution") == run(RUN, KIT / "solution")


def find_uses(folder: Path, package: str) -> Iterator[str]:
    """Yield the names of a package that sources use or import, as statements."""
    for path in folder.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_bytes())):
            words = ast.unparse(node) if isinstance(node, ast.Attribute | ast.ImportFrom) else ""
            if words.startswith((f"{package}.", f"from {package}")) and "(" not in words:
                yield words


@pytest.mark.parametrize(
    ("package", "place", "folders"),
    [
        ("pygame", ".", ["starter", "solution/mini_engine", "grader/worker"]),
        ("pymunk", "without_cffi", ["grader/worker"]),
    ],
)
def test_every_name_that_the_lab_and_the_worker_use_is_there(package, place, folders):
    uses = {each for folder in folders for each in find_uses(KIT / folder, package)}
    code = f"import sys; sys.path[:0] = sys.argv[2:]; import {package}\n"
    code += "for each in sys.argv[1].split('|'): exec(each)"
    assert len(uses) > 10
    assert run(code, "|".join(uses), PAGE / place) == []


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("pygame.mixer.init()", "pygame.mixer"),
        ("import pygame.mixer", "pygame.mixer"),
        ("round(pygame.Vector2(1, 2))", "round() of a pygame.Vector2"),
        ("type('Own', (pygame.Vector2,), {})", "a subclass of pygame.Vector2"),
        ("pygame.draw.flood_fill", "pygame.draw.flood_fill"),
        ("pygame.Color.from_hsva(0, 1, 1, 1)", "pygame.color.Color.from_hsva"),
    ],
)
def test_a_missing_name_is_explained(line: str, name: str):
    code = (
        "import sys; sys.path[:0] = sys.argv[1:]; import pygame\ntry:\n    {}\nexcept {}: print({})"
    )
    said = run(code.format(line, "Exception as error", "error"), PAGE)
    assert said[0].startswith(f"{name} is not part of the pygame of this page; ")


PICTURE = """
import sys
sys.path[:0] = sys.argv[1:]
from mini_engine.game_loop import Window
import pygame
window = Window()
for frame in range(60):
    window.world.step(1 / 120)
window.draw()
pygame.draw.polygon(window.screen, "red", [(400, 200), (440, 220), (430, 260)])
pygame.draw.circle(window.screen, "blue", (600, 300), 30, 4)
print(pygame.image.tobytes(window.screen, "RGB")[3 * 900 * 60 : 3 * 900 * 540].hex())
"""


def test_the_pixels_below_the_text_are_nearly_those_of_pygame_ce():
    (here,), (real,) = run(PICTURE, PAGE, KIT / "solution"), run(PICTURE, KIT / "solution")
    assert len(here) == len(real)
    pairs = zip(bytes.fromhex(here), bytes.fromhex(real), strict=True)
    assert sum(abs(one - other) > 16 for one, other in pairs) < 3 * 900 * 480 * 0.003
