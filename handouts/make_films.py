"""Record the films of the handouts, into handouts/touch/films, and draw their still pictures.

    python handouts/make_films.py [--out DIR] [--only predict-3]

Predictions: the scene of a TODO, run by the solution, by the solution with that TODO as in the
starter, and by one with a known mistake from the bank. Tower: ten balls in a slot, in three engines
with many settings. Engines run in processes of their own; the same engines give the same files.
"""

import argparse
import ast
import hashlib
import io
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import tokenize
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pymunk
from make_figures import BLUE, GREY, INK, Svg
from make_pictures import environment_in

from grader.bank.members import make_mistake
from grader.source.regions import python_files, regions_in, replace_regions

KIT = Path(__file__).resolve().parents[1]
FILMS = KIT / "handouts" / "touch" / "films"
PREDICTIONS = tomllib.loads((KIT / "handouts" / "predictions.toml").read_text(encoding="utf-8"))
STUB, RIGHT = "stub", "right"
DOCUMENTED = ast.Module, ast.ClassDef, ast.FunctionDef

# ---------------------------------------------------------------- trees and runs


def tree_of(todo, variant, folder):
    """Copy the solution with `todo` in this variant; return the folder."""
    tree = folder / "tree"
    shutil.copytree(
        KIT / "solution", tree, ignore=shutil.ignore_patterns("__pycache__", "notebooks")
    )
    if variant == STUB:
        for path in python_files(KIT / "starter"):
            target = tree / path.relative_to(KIT / "starter")
            stubs = {r.id: r.lines for r in regions_in(path.read_text("utf-8")) if r.id == todo}
            if stubs:
                text = replace_regions(target.read_text(encoding="utf-8"), stubs)
                target.write_text(text, encoding="utf-8", newline="\n")
    elif variant != RIGHT:
        make_mistake(f"{todo}-{variant}", tree)
    return tree


def run_in(tree, program, *arguments):
    """Run a program of this folder with the code of a tree; return its output."""
    command = [sys.executable, str(Path(__file__).with_name(program)), *arguments]
    done = subprocess.run(
        command, cwd=tree, env=environment_in(tree), capture_output=True, text=True
    )
    if done.returncode:
        sys.exit(f"{' '.join([program, *arguments])} failed in {tree}:\n{done.stderr}")
    return json.loads(done.stdout)


def recorded(todo, variant):
    with tempfile.TemporaryDirectory() as folder:
        return run_in(tree_of(todo, variant, Path(folder)), "film_scenes.py", todo)


def prediction(todo):
    """Return the three films of a TODO in order, and the number of the right one."""
    at = "ABC".index(PREDICTIONS[todo]["right"])
    made = [(each["of"], each["says"]) for each in PREDICTIONS[todo]["mistake"]]
    made.insert(at, (RIGHT, "is right"))
    films = [{"says": words, "scene": recorded(todo, variant)} for variant, words in made]
    return {"right": at, "films": films}


def tower():
    return run_in(KIT / "solution", "film_tower.py")


# ---------------------------------------------------------------- still pictures

SHOWN = 7  # shots of a film in a still picture
WIDE, TALL, GAP = 230, 200, 15  # px, of one of three pictures


def still_of(name, data):
    """Draw three pictures side by side, each with some positions of all that moves."""
    svg = Svg(3 * WIDE + 4 * GAP, TALL + 2 * GAP + 20, "Three films, A, B and C")
    for number, film in enumerate(data["films"]):
        left = GAP + number * (WIDE + GAP)
        svg.add("rect", x=left, y=GAP + 20, width=WIDE, height=TALL, fill="none", stroke=GREY)
        svg.text(left, 24, "ABC"[number], weight="bold")
        draw_still(svg, film["scene"], left, GAP + 20)
    svg.save(f"{name}.svg")


def draw_still(svg, scene, left, top):
    x0, y0, x1, y1 = scene["view"]
    if scene["curve"]:
        points = [(frame[0], row[1]) for frame in scene["yours"] for row in frame[2] or ()]
        inside = [(t, y) for t, y in points if y0 < y < y1]
        places = [
            (left + (t - x0) / (x1 - x0) * WIDE, top + (y1 - y) / (y1 - y0) * TALL)
            for t, y in inside
        ]
        svg.line(*places, color=BLUE)
        return
    scale = min(WIDE / (x1 - x0), TALL / (y1 - y0))
    dx, dy = left + (WIDE - scale * (x0 + x1)) / 2, top + (TALL - scale * (y0 + y1)) / 2
    rows, every = {}, max(1, math.ceil(len(scene["yours"]) / SHOWN))
    for number, frame in enumerate(scene["yours"]):
        rows |= {row[0]: row[1:] for row in frame[2]}
        if number % every:
            continue
        for body, (x, y, *_, angle, _) in rows.items():
            look = scene["looks"][str(body)]
            place = dx + x * scale, dy + y * scale
            if look["mass"] is not None or not number:
                draw_body(svg, look, place, angle, scale, (left, top))


def draw_body(svg, look, place, angle, scale, corner):
    (points, radius), color = look["shapes"][0], GREY if look["mass"] is None else BLUE
    x, y = place
    if len(points) > 1:
        (left, top), (right, low) = points[0], points[2]
        ends = [
            clipped(x + left * scale, corner[0], WIDE),
            clipped(x + right * scale, corner[0], WIDE),
        ]
        rows = [
            clipped(y + top * scale, corner[1], TALL),
            clipped(y + low * scale, corner[1], TALL),
        ]
        svg.rect(ends[0], rows[0], ends[1] - ends[0], rows[1] - rows[0], color)
        return
    reach = radius * scale
    inside = (
        clipped(x, corner[0] + reach, WIDE - 2 * reach),
        clipped(y, corner[1] + reach, TALL - 2 * reach),
    )
    if inside != (x, y):
        return
    svg.circle(x, y, reach, stroke=color)
    if look["mass"] is not None:
        svg.line((x, y), (x + reach * math.cos(angle), y + reach * math.sin(angle)), color=color)


def clipped(value, low, size):
    return min(max(value, low), low + size)


def still_of_tower(data):
    """Draw the towers of three engines at the end of their films."""
    svg = Svg(3 * WIDE + 4 * GAP, TALL + 2 * GAP + 40, "A tower of ten balls in three engines")
    for number, (engine, key) in enumerate(data["still"]):
        left, top = GAP + number * (WIDE + GAP), GAP + 20
        film = data["films"][key]
        svg.text(left, 24, engine, weight="bold")
        svg.text(left, top + TALL + 20, f"sinks by {film['sink']:.1f} px", color=INK, size=13)
        last = whole(data["first"], film["frames"])
        draw_still(svg, {**data["scene"], "yours": [last]}, left, top)
    svg.save("tower.svg")


def whole(first, frames):
    """Return the last shot with all bodies."""
    rows = {row[0]: row for row in first[2]}
    for frame in frames:
        rows |= {row[0]: row for row in frame[2]}
    return [frames[-1][0], 1, list(rows.values()), [], [], []]


# ---------------------------------------------------------------- files


def engines_hash():
    """Hash all code that the films come from, so that a test can tell when they are stale."""
    digest = hashlib.sha256()
    folders = [KIT / "solution" / name for name in ("mini_engine", "stable_engine")]
    files = [path for folder in folders for path in sorted(folder.rglob("*.py"))]
    files += [KIT / "solution" / f"{name}.py" for name in ("pymunk_scene", "integrators")]
    experiments = KIT / "solution" / "experiments"
    files += [experiments / "scenes.py", *sorted((experiments / "engines").glob("*.py"))]
    files += [Path(__file__).with_name(f"film_{name}.py") for name in ("scenes", "tower")]
    digest.update(f"pymunk {pymunk.version}, {pymunk.chipmunk_version}\n".encode())
    for path in files:
        digest.update(f"{path.relative_to(KIT).as_posix()}\n{code_of(path)}\n".encode())
    return digest.hexdigest()


def code_of(path):
    """Return a file without docstrings, comments and empty lines, which change no film."""
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            row, column = token.start
            lines[row - 1] = lines[row - 1][:column].rstrip()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            first, last = node.body[0].lineno, node.body[0].end_lineno
            lines[first - 1 : last] = [""] * (last - first + 1)
    return "\n".join(filter(None, lines))


def write(name, data, folder):
    text = json.dumps(data, separators=(",", ":"))
    path = folder / f"{name}.js"
    path.write_text(f"touch.film({json.dumps(name)}, {text});\n", encoding="utf-8", newline="\n")
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=FILMS, metavar="DIR")
    parser.add_argument("--only", metavar="NAME")
    options = parser.parse_args()
    jobs = {f"predict-{todo}": (prediction, todo) for todo in PREDICTIONS} | {"tower": (tower,)}
    names = [name for name in jobs if options.only in (None, name)]
    if not names:
        sys.exit(f"There is no film {options.only}; there are {', '.join(jobs)}.")
    options.out.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(os.cpu_count()) as crew:
        made = {name: crew.submit(*jobs[name]) for name in names}
        for name, job in made.items():
            path = write(name, job.result(), options.out)
            if options.out == FILMS:
                still_of_tower(job.result()) if name == "tower" else still_of(name, job.result())
            print(f"{path.name}: {path.stat().st_size / 1024:.0f} KB")
    (options.out / "made-of.txt").write_text(f"{engines_hash()}\n", encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
