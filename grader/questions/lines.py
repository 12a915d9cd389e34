"""Find the line: a function of the student's own with one line changed.

The effect is shown by a film of the lab scene or, where a film would not show it, by numbers. The
changed function runs in the student's program and, where there is one, in the reference, and both
must give the same.
"""

import ast
import difflib
import math
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

from grader.judge.decode import Thing
from grader.judge.failures import Broke, NotYet
from grader.judge.lab import Lab
from grader.questions.films import (
    SECONDS,
    VISIBLE,
    compare_with_reference,
    film_unchanged,
    make_film,
)
from grader.questions.pictures import draw_film, find_bounds, measure_difference
from grader.questions.program import FUNCTIONS, CannotAsk, Program, Text, Tree
from grader.questions.question import Picture, Question
from grader.questions.scene import SEEDS
from grader.source.operators import make_changes, names_in
from grader.source.regions import RegionError, parsed, regions_in
from grader.text import digits

MOST_CODE_TO_CHANGE = 4000  # characters of a function; each change of it costs a look at all of it
TRIES = 12  # changes of one function
FAR = 3 * VISIBLE  # px, by which rounding may have led two films apart
LEAST = 0.02  # of a number, by which it must change
SIMILAR = 0.6  # only one thing in a line was changed, so that it does not stand out
ENDLESS = ("while", "for")  # changed heads of loops may never end
FILMS = ("3", "4", "2", "1")  # TODOs whose changes a film shows
Values = dict[str, float]  # by what they are


@dataclass(frozen=True)
class Changed:
    """A function with one line changed."""

    code: str
    line: int  # counted from 1
    was: str
    now: str


def list_line_todos(program: Program) -> list[str]:
    """List the TODOs to ask about, the best one first, in a fixed order."""
    return [todo for todo in (*FILMS, *EXPERIMENTS) if todo in program.right]


def ask_line(todo: str, program: Program, seed: str, points: int) -> Question:
    """Ask about one TODO; raises CannotAsk where no change of it shows."""
    rng = random.Random(f"{seed}/line/{todo}")
    text = program.own.find_function(FUNCTIONS[todo])
    if text is None or len(text.source) > MOST_CODE_TO_CHANGE:
        raise CannotAsk("the function is not found in its text, or is too long to be read")
    scene = random.Random(f"{seed}/line").choice(SEEDS)  # one for all TODOs: its films are kept
    if todo in FILMS and measure_gap(program, scene) > FAR:
        raise CannotAsk("its film of the program as it is is not that of the reference")
    possible = list(change_lines(program.own, todo, text))
    rng.shuffle(possible)
    for change in possible[:TRIES]:
        try:
            show = show_films if todo in FILMS else show_numbers
            words, pictures = show(todo, program, change, scene)
        except (CannotAsk, NotYet):
            continue
        except Broke as failure:
            if failure.raised is None:  # its process is gone: one is enough
                raise CannotAsk(f"a change of it ended the program: {failure.got}") from failure
            continue
        return make_question(todo, change, words, pictures, points)
    raise CannotAsk("no change of one line shows, in their program and the reference alike")


def measure_gap(program: Program, scene: int) -> float:
    """Return how far the films of a program and of the reference, if any, are apart."""
    if program.reference is None:
        return 0.0
    return measure_difference(
        *(film_unchanged(tree, scene) for tree in (program.own, program.reference))
    )


def make_question(
    todo: str, change: Changed, words: str, pictures: tuple[Picture, ...], points: int
) -> Question:
    name = FUNCTIONS[todo].partition(":")[2]
    return Question(
        f"line-of-{todo}",
        "line",
        (todo,),
        f"This is your `{name}`, in Python's own layout and without comments. One line of it was "
        f"changed.\n{words}\n"
        "Which line is it? Write its number, and in one sentence what it does now.",
        points,
        str(change.line),
        why=f"In the program the line is `{change.was.strip()}`, and here `{change.now.strip()}`.",
        code=tuple(change.code.splitlines()),
        pictures=pictures,
        rubric=("The sentence says what the changed line does to the numbers or to the motion.",),
        by_hand=min(1, points - 1),
    )


# ---------------------------------------------------------------- changing a line


def change_lines(tree: Tree, todo: str, text: Text) -> Iterator[Changed]:
    """Yield every change of one line of a TODO, in a function that keeps its number of lines."""
    module = parsed(text.source)
    function = module.body[0] if module and module.body else None
    if not isinstance(function, ast.FunctionDef):
        return
    if ast.get_docstring(function) is not None:
        function.body = function.body[1:] or [ast.Pass()]
    code = ast.unparse(function)
    own = find_own_lines(tree, todo, text, function, code)
    before = code.splitlines()
    for _, after in make_changes(code, names_in(function)):
        lines = after.splitlines()
        pairs = enumerate(zip(before, lines, strict=False), 1)
        differ = [(number, *pair) for number, pair in pairs if len(set(pair)) > 1]
        if len(lines) != len(before) or len(differ) != 1:
            continue
        number, was, now = differ[0]
        similar = difflib.SequenceMatcher(None, was, now).ratio() > SIMILAR
        if number in own and not was.strip().startswith(ENDLESS) and similar:
            yield Changed(after, number, was, now)


def find_own_lines(
    tree: Tree, todo: str, text: Text, function: ast.FunctionDef, code: str
) -> frozenset[int]:
    """Return the lines of the function, in Python's layout, that are in the student's region."""
    again = ast.parse(code).body[0]
    pairs = zip(ast.walk(function), ast.walk(again), strict=True)
    lines = [
        (a.lineno, b.lineno)
        for a, b in pairs
        if isinstance(a, ast.stmt) and isinstance(b, ast.stmt)
    ]
    first, last = 2, text.last - text.first + 1  # all but its head
    try:
        region = next((r for r in regions_in(tree.texts[text.file]) if r.id == todo), None)
    except RegionError:
        region = None
    if region is not None and text.first <= region.start + 1 <= text.last:
        first, last = region.start + 2 - text.first + 1, region.stop - text.first + 1
    return frozenset(new for old, new in lines if first <= old <= last)


# ---------------------------------------------------------------- what a change does


def show_films(
    todo: str, program: Program, change: Changed, scene: int
) -> tuple[str, tuple[Picture, ...]]:
    target, own, reference = FUNCTIONS[todo], program.own, program.reference
    before = film_unchanged(own, scene)
    after = make_film(own, own.replace_function(target, change.code), scene)
    if measure_difference(before, after) < VISIBLE:
        raise CannotAsk("the film does not show it")
    films = {"the program": before, "the change": after}
    if reference:
        right = make_film(reference, reference.replace_function(target, change.code), scene)
        compare_with_reference(
            {"the program": film_unchanged(reference, scene), "the change": right}, films
        )
    titles = ("film 1, as it is", "film 2, with the change")
    frame = find_bounds(list(films.values()))
    pictures = tuple(
        draw_film(film, name, f"The lab scene for {SECONDS:g} s", frame)
        for name, film in zip(titles, films.values(), strict=True)
    )
    words = f"The films show your lab scene of `random.Random({scene})` without and with it."
    return words, pictures


def show_numbers(
    todo: str, program: Program, change: Changed, scene: int
) -> tuple[str, tuple[Picture, ...]]:
    changed = change.code
    without, with_it = (run_experiment(program.own, todo, code) for code in ("", changed))
    if reference := program.reference:
        right, wrong = (run_experiment(reference, todo, code) for code in ("", changed))
        if not (are_equal(without, right) and are_equal(with_it, wrong)):
            raise CannotAsk("the program and the reference differ")
    shown = [name for name in without if not is_close(without[name], with_it[name], LEAST)]
    if not shown:
        raise CannotAsk("the numbers do not show it")
    lines = [
        f"{name}: {digits(without[name])} without it, {digits(with_it[name])} with it."
        for name in without
    ]
    return "\n".join([f"What comes out of `{FUNCTIONS[todo].partition(':')[2]}`:", *lines]), ()


def are_equal(one: Values, other: Values) -> bool:
    return one.keys() == other.keys() and all(
        is_close(one[each], other[each], 1e-6) for each in one
    )


def is_close(one: float, other: float, share: float) -> bool:
    return math.isclose(one, other, rel_tol=share, abs_tol=1e-9)


def run_experiment(tree: Tree, todo: str, code: str) -> Values:
    """Run an experiment with a TODO; `code` replaces its function unless empty."""
    texts = tree.replace_function(FUNCTIONS[todo], code) if code else {}
    with tree.lab(FUNCTIONS[todo].partition(":")[0], texts) as lab:
        return EXPERIMENTS[todo](lab)


def measure_damping(lab: Lab) -> Values:
    ball = lab.circle((0.0, 0.0), vel=(400.0, 0.0), omega=10.0)
    world = lab.world(ball, linear_damping=0.5, angular_damping=0.25)
    last = lab.simulate(world, [ball], 120, every=120).body(0)[-1]
    return {"400 px/s after a second (px/s)": last.speed, "10 rad/s after a second": last.omega}


FRAMES = (10, 30, 150)  # ms


def run_frames(lab: Lab, world: Thing) -> Values:
    found: Values = {}
    for each in FRAMES:
        advance = lab.advance(world, 0.002, each / 1000)
        found[f"steps of a frame of {each} ms, with 2 ms in the accumulator"] = advance.said
        found[f"ms that a frame of {each} ms leaves"] = advance.rest * 1000
    return found


def measure_method(method: str, lab: Lab) -> Values:
    states = lab.integrate(method, (100.0, 20.0), 0.05, (0.0, -40.0), 20)
    return {
        "x after one step, from x = 100 and v = 20": states[0][0],
        "v after one step": states[0][1],
        "x after 20 steps": states[-1][0],
    }


EXPERIMENTS: dict[str, Callable[[Lab], Values]] = {
    "8b": partial(measure_method, "velocity_verlet"),
    "6": lambda lab: run_frames(lab, lab.world()),
    "5": measure_damping,
    "8c": partial(measure_method, "rk4"),
    "8a": partial(measure_method, "semi_implicit_euler"),
    "7d": lambda lab: run_frames(lab, lab.thing(lab.call("empty_space"))),
}
