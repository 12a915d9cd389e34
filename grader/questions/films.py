"""Predict a film: films of the student's own scene, some with one thing changed.

Each change is made in the student's program and in the reference. It is used only if its two films
are more similar to each other than to those of any other change. At home there is no reference, and
cheating gains nothing.

Differing films are not enough: soon after a first impact everything differs. Each change has a sign
that follows from the lesson: without friction, nothing turns. Its film must show this sign clearly
more, or less, than all others. The unchanged program has no sign and is found by elimination.

Some changes do not show in the lab scene within two seconds: one pass of the solver, no push-out,
rods before contacts. Friction without a limit has no sign.
"""

import math
import random
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

from grader.judge.decode import Thing
from grader.judge.failures import Broke, NotYet
from grader.judge.lab import STEP
from grader.protocol import MAX_BODIES, MAX_RODS
from grader.questions.pictures import Film, Look, draw_film, find_bounds, measure_difference
from grader.questions.program import CannotAsk, Program, Tree
from grader.questions.question import Question
from grader.questions.scene import SEEDS, Scene

COUNT = 4  # films
SECONDS, EVERY = 2.0, 4  # of a film, and steps between its pictures
VISIBLE = 30.0  # px, the smallest difference between two films
CLEAR = 1.5  # times as much of its sign as any other film, or as little
SEEN = 12.0  # px, of one rise that a picture shows beside the way down
TRIES = 2  # scenes
MOST_RADIUS = 200.0  # px


@dataclass(frozen=True)
class Change:
    """One thing that is changed in a program, and its visible sign."""

    name: str
    words: str
    why: str
    todos: tuple[str, ...]
    texts: Callable[[Tree], Mapping[str, str]]
    sign: Callable[[Film], float]  # the sign that is largest in its film; negative: smallest
    restitution: float | None = None  # of all bodies of the scene


def measure_rise(film: Film) -> float:
    """Return the sum of the balls' visible rises, in units of 100 px."""
    return sum(each for ball in film.loose for each in list_rises(film, ball) if each > SEEN) / 100


def list_rises(film: Film, ball: int) -> Iterator[float]:
    """Yield the height of each rise of a ball, px."""
    heights = [-film.place(row, ball)[1] for row in range(len(film.rows))]
    up = 0.0
    for before, after in pairwise(heights):
        if after > before:
            up += after - before
        elif up:
            yield up
            up = 0.0
    yield up


def measure_turning(film: Film) -> float:
    """Return the sum of the balls' turns in both directions, in whole turns."""
    angles = ([film.angle(row, ball) for row in range(len(film.rows))] for ball in film.loose)
    return sum(abs(b - a) for each in angles for a, b in pairwise(each)) / (2 * math.pi)


NO_SPIN = "def effective_mass(a, b, ra, rb, axis):\n    return a.inv_mass + b.inv_mass\n"
ICE = "def friction_limit(c):\n    return 0.0\n"


def set_constant(name: str, value: str) -> Callable[[Tree], Mapping[str, str]]:
    return lambda tree: tree.replace_constant(name, value)


def set_function(target: str, source: str) -> Callable[[Tree], Mapping[str, str]]:
    return lambda tree: tree.replace_function(f"mini_engine:{target}", source)


AS_IT_IS = Change("as-it-is", "your program as it is", "", (), lambda tree: {}, lambda film: 0.0)
CHANGES = (
    Change(
        "all-at-once",
        "`BETA = 1`: the whole overlap is taken away in one step",
        "The push-out becomes a speed, which stays: what overlaps is thrown apart.",
        ("1",),
        set_constant("BETA", "1.0"),
        measure_rise,
    ),
    Change(
        "bouncy",
        "`restitution = 0.8` of every body",
        "Each bounce keeps 0.8 of the speed, so 0.64 of the height: balls go up again, and high.",
        ("1",),
        lambda tree: {},
        measure_rise,
        0.8,
    ),
    Change(
        "no-spin",
        "`effective_mass` without its spin terms",
        "Friction then treats a ball that can turn as one that cannot, and pushes three times too "
        "hard: slips turn round from pass to pass.",
        ("1", "2", "4"),
        set_function("effective_mass", NO_SPIN),
        measure_turning,
    ),
    Change(
        "ice",
        "`friction_limit` always 0",
        "Without friction no ball is ever turned: its spoke stays as it was, and it slides on.",
        ("1", "4"),
        set_function("friction_limit", ICE),
        lambda film: -measure_turning(film),
    ),
    Change(
        "no-bounce",
        "`RESTING_SPEED = 5000`: no impact counts as a bounce",
        "Balls stop dead where they land, and only roll on.",
        ("1",),
        set_constant("RESTING_SPEED", "5000"),
        lambda film: -measure_rise(film),
    ),
)


def ask_films(program: Program, seed: str, points: int) -> Question:
    """Ask about four films of a scene; raises CannotAsk if they are too similar."""
    rng = random.Random(f"{seed}/film")
    why = ""
    for _ in range(TRIES):
        try:
            return make_question(program, rng, rng.choice(SEEDS), points)
        except CannotAsk as error:
            why = str(error)
    raise CannotAsk(why)


def make_question(program: Program, rng: random.Random, scene: int, points: int) -> Question:
    able = [each for each in CHANGES if program.can_show(each.todos)]
    if len(able) < COUNT - 1:
        raise CannotAsk("too few of the TODOs that films show are right")
    rng.shuffle(able)
    films = choose_changes(program, [AS_IT_IS, *able], scene)
    if program.reference:
        compare_with_reference(films, program.reference, scene)
    shown = list(films)
    rng.shuffle(shown)
    options = sorted(films, key=(AS_IT_IS, *CHANGES).index)
    letters = "abcd"
    answer = "".join(letters[options.index(each)] for each in shown)
    frame = find_bounds(list(films.values()))
    pictures = tuple(
        draw_film(films[each], f"film {number}", f"The lab scene for {SECONDS:g} s", frame)
        for number, each in enumerate(shown, 1)
    )
    return Question(
        "films",
        "film",
        tuple(dict.fromkeys(todo for each in films for todo in each.todos)),
        f"Four films of your lab scene, made by `make_world(random.Random({scene}))`, for "
        f"{SECONDS:g} s. Each picture shows the bodies at four moments, the last one darkest; the "
        "thick pale line is the way of a centre, the thin one that of the tip of the white spoke. "
        "On a screen a click plays it, or Tab and Enter. In three of the films one thing was "
        "changed, in one nothing."
        "\nWhich film belongs to which? Write a letter for film 1, 2, 3 and 4.",
        points,
        answer,
        choices=tuple(each.words for each in options),
        pictures=pictures,
        why="\n".join(f"{each.words}: {each.why}" for each in options if each.why),
    )


def choose_changes(program: Program, able: list[Change], scene: int) -> dict[Change, Film]:
    """Choose the first changes whose films differ visibly, each by its own sign."""
    films: dict[Change, Film] = {}
    for each in able:
        try:
            film = make_film(program.own, each, scene)
        except (CannotAsk, NotYet, Broke):
            if each is AS_IT_IS:
                raise
            continue
        apart = all(measure_difference(film, other) >= VISIBLE for other in films.values())
        if apart and can_tell_apart(films | {each: film}):
            films[each] = film
        if len(films) == COUNT:
            return films
    raise CannotAsk(f"only {len(films)} films of the scene differ clearly")


def can_tell_apart(films: Mapping[Change, Film]) -> bool:
    """Return whether each film shows its sign clearly more, or clearly less, than the others do."""
    return all(
        is_clear(change.sign(film), change.sign(other))
        for change, film in films.items()
        for another, other in films.items()
        if change is not AS_IT_IS and another is not change
    )


def is_clear(most: float, other: float) -> bool:
    """Return whether the sign `most` is visibly more than the sign `other`."""
    less, more = sorted((abs(most), abs(other)))
    return most - other > 1 and more > CLEAR * less


def compare_with_reference(films: Mapping[Change, Film], reference: Tree, scene: int) -> None:
    """Raise CannotAsk if a film is nearer to another change's film of the reference."""
    right = {each: make_film(reference, each, scene) for each in films}
    for change, film in films.items():
        if len(film.looks) != len(right[change].looks):
            raise CannotAsk("its scene has other bodies than that of the lesson")
        nearest = min(right, key=lambda other: measure_difference(film, right[other]))
        if nearest is not change:
            raise CannotAsk(f"its film of {change.name} is not that of the reference")


def make_film(tree: Tree, change: Change, seed: int, seconds: float = SECONDS) -> Film:
    """Record the lab scene of a tree with one thing changed."""
    with tree.lab("mini_engine", change.texts(tree)) as lab:
        scene = Scene(lab, seed)
        bodies = [thing for thing, _ in scene.bodies]
        if change.restitution is not None:
            for thing in bodies:
                lab.put(thing, restitution=change.restitution)
        joints = lab.items(lab.get(scene.world, "joints"), "the joints")
        if len(bodies) > MAX_BODIES or len(joints) > MAX_RODS:
            raise CannotAsk("its scene has more bodies or rods than a film shows")
        looks = []
        for thing, state in scene.bodies:
            half = (0.0, 0.0) if state.radius else lab.pair(lab.get(thing, "shape.half"), "half")
            place = (state.pos.x, state.pos.y)
            if not 0 <= state.radius < MOST_RADIUS:
                raise CannotAsk("a body of its scene has no radius that could be drawn")
            looks.append(Look(state.radius, half, state.inv_mass > 0, place))
        rods = []
        for joint in joints:
            ends = [lab.thing(lab.get(lab.thing(joint), end)) for end in ("a", "b")]
            rods.append(tuple(bodies.index(Thing(each.ref)) for each in ends))
        run = lab.simulate(scene.world, bodies, round(seconds / STEP), every=EVERY)
    return Film(looks, run.frames, seconds, [(a, b) for a, b in rods])
