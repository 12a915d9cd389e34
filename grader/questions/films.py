"""Predict a film: films of the student's own scene, some with one thing changed; which is which?

Each change is made in the student's program and in the reference. It is asked only where the two
films of a change are nearer to each other than to those of any other one, so that no film lies. At
home there is no reference, and nothing to be had by a lie.

That films differ is not enough: soon after a first blow everything differs, and nobody can say why.
Each change has a sign that the lesson lets one expect, as that nothing turns without friction, and
is asked only where its film shows this sign clearly more, or clearly less, than all the others do,
on paper as well. The program as it is has none, and is what is left.

What the lab scene does not show is none of the changes: with one pass of the solver, without
push-out, or with rods before contacts, no body of it is seen anywhere else after two seconds; and
friction without a limit has no sign.
"""

import math
import random
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

from grader.judge.decode import Thing
from grader.judge.failures import Broke, NotYet
from grader.judge.lab import STEP
from grader.protocol import MAX_BODIES, MAX_RODS
from grader.questions.pictures import Film, Look, difference, frame_of, picture
from grader.questions.program import Program, Tree, Unlike
from grader.questions.question import Question
from grader.questions.scene import SEEDS, Scene

COUNT = 4  # films
SECONDS, EVERY = 2.0, 4  # of a film, and steps between its pictures
VISIBLE = 30.0  # px, by which two films must differ somewhere
CLEAR = 1.5  # times as much of its sign as any other film, or as little
SEEN = 12.0  # px, of one rise that a picture shows beside the way down
TRIES = 2  # scenes
MOST_RADIUS = 200.0  # px


@dataclass(frozen=True)
class Change:
    """One thing that is changed in a program, and what it is right to expect of it."""

    name: str
    words: str
    why: str
    todos: tuple[str, ...]
    texts: Callable[[Tree], Mapping[str, str]]
    sign: Callable[[Film], float]  # of what there is most in its film; negative: least
    restitution: float | None = None  # of all bodies of the scene

    def film(self, tree: Tree, scene: int) -> Film:
        """The lab scene of a tree with this change."""
        return filmed(tree, self.texts(tree), scene, self.restitution)


def rise(film: Film) -> float:
    """How far the balls go up in all, where one can see it; 1 is 100 px."""
    return sum(each for ball in film.loose for each in rises(film, ball) if each > SEEN) / 100


def rises(film: Film, ball: int) -> Iterator[float]:
    """How far a ball goes up each time, px."""
    heights = [-film.place(row, ball)[1] for row in range(len(film.rows))]
    up = 0.0
    for before, after in pairwise(heights):
        if after > before:
            up += after - before
        elif up:
            yield up
            up = 0.0
    yield up


def turning(film: Film) -> float:
    """How far the balls turn in all, to and fro; 1 is a turn."""
    angles = ([film.angle(row, ball) for row in range(len(film.rows))] for ball in film.loose)
    return sum(abs(b - a) for each in angles for a, b in pairwise(each)) / (2 * math.pi)


NO_SPIN = "def effective_mass(a, b, ra, rb, axis):\n    return a.inv_mass + b.inv_mass\n"
ICE = "def friction_limit(c):\n    return 0.0\n"


def constant(name: str, value: str) -> Callable[[Tree], Mapping[str, str]]:
    return lambda tree: tree.with_constant(name, value)


def function(target: str, source: str) -> Callable[[Tree], Mapping[str, str]]:
    return lambda tree: tree.with_function(f"mini_engine:{target}", source)


AS_IT_IS = Change("as-it-is", "your program as it is", "", (), lambda tree: {}, lambda film: 0.0)
CHANGES = (
    Change(
        "all-at-once",
        "`BETA = 1`: the whole overlap is taken away in one step",
        "The push-out becomes a speed, which stays: what overlaps is thrown apart.",
        ("1",),
        constant("BETA", "1.0"),
        rise,
    ),
    Change(
        "bouncy",
        "`restitution = 0.8` of every body",
        "Each bounce keeps 0.8 of the speed, so 0.64 of the height: balls go up again, and high.",
        ("1",),
        lambda tree: {},
        rise,
        0.8,
    ),
    Change(
        "no-spin",
        "`effective_mass` without its spin terms",
        "Friction then takes a ball that can turn for one that cannot, and pushes three times too "
        "hard: slips turn round from pass to pass.",
        ("1", "2", "4"),
        function("effective_mass", NO_SPIN),
        turning,
    ),
    Change(
        "ice",
        "`friction_limit` always 0",
        "Without friction no ball is ever turned: its spoke stays as it was, and it slides on.",
        ("1", "4"),
        function("friction_limit", ICE),
        lambda film: -turning(film),
    ),
    Change(
        "no-bounce",
        "`RESTING_SPEED = 5000`: no impact counts as a bounce",
        "Balls stop dead where they land, and only roll on.",
        ("1",),
        constant("RESTING_SPEED", "5000"),
        lambda film: -rise(film),
    ),
)


def film_question(program: Program, seed: str, points: int) -> Question:
    """Four films of a scene of their own; raises Unlike where they cannot be told apart."""
    rng = random.Random(f"{seed}/film")
    why = ""
    for _ in range(TRIES):
        try:
            return posed(program, rng, rng.choice(SEEDS), points)
        except Unlike as error:
            why = str(error)
    raise Unlike(why)


def posed(program: Program, rng: random.Random, scene: int, points: int) -> Question:
    able = [each for each in CHANGES if program.can_show(each.todos)]
    if len(able) < COUNT - 1:
        raise Unlike("too few of the TODOs that films show are right")
    rng.shuffle(able)
    films = chosen(program, [AS_IT_IS, *able], scene)
    if right := program.reference:
        held_against(
            {each.name: each.film(right, scene) for each in films},
            {each.name: film for each, film in films.items()},
        )
    shown = list(films)
    rng.shuffle(shown)
    options = sorted(films, key=lambda each: (each is not AS_IT_IS, CHANGES_IN_ORDER[each.name]))
    letters = "abcd"
    answer = "".join(letters[options.index(each)] for each in shown)
    frame = frame_of(list(films.values()))
    pictures = tuple(
        picture(films[each], f"film {number}", f"The lab scene for {SECONDS:g} s", frame)
        for number, each in enumerate(shown, 1)
    )
    return Question(
        "films",
        "film",
        tuple(dict.fromkeys(todo for each in films for todo in each.todos)),
        f"Four films of your lab scene, made by `make_world(random.Random({scene}))`, for "
        f"{SECONDS:g} s. Each picture shows the bodies at four moments, the last one darkest; the "
        "thick pale line is the way of a centre, the thin one that of the tip of the white spoke. "
        "On a screen a click plays it. In three of the films one thing was changed, in one nothing."
        "\nWhich film belongs to which? Write a letter for film 1, 2, 3 and 4.",
        points,
        answer,
        choices=tuple(each.words for each in options),
        pictures=pictures,
        why="\n".join(f"{each.words}: {each.why}" for each in options if each.why),
    )


CHANGES_IN_ORDER = {each.name: number for number, each in enumerate((AS_IT_IS, *CHANGES))}


def chosen(program: Program, able: list[Change], scene: int) -> dict[Change, Film]:
    """The first changes whose films differ visibly, each by its own sign."""
    films: dict[Change, Film] = {}
    for each in able:
        try:
            film = each.film(program.own, scene)
        except (Unlike, NotYet, Broke):
            if each is AS_IT_IS:
                raise
            continue
        apart = all(difference(film, other) >= VISIBLE for other in films.values())
        if apart and all_told(films | {each: film}):
            films[each] = film
        if len(films) == COUNT:
            return films
    raise Unlike(f"only {len(films)} of its films can be told from each other")


def all_told(films: Mapping[Change, Film]) -> bool:
    """Whether each film has clearly more, or clearly less, of its sign than all the others."""
    return all(
        clear(change.sign(film), change.sign(other))
        for change, film in films.items()
        for name, other in films.items()
        if change is not AS_IT_IS and name is not change
    )


def clear(most: float, other: float) -> bool:
    """Whether one sign is so much more than another that one sees it; negative: so much less."""
    less, more = sorted((abs(most), abs(other)))
    return most - other > 1 and more > CLEAR * less


def held_against(right: Mapping[str, Film], films: Mapping[str, Film]) -> None:
    """Raise Unlike where a film is not most like that of the same name by the reference."""
    for name, film in films.items():
        if len(film.looks) != len(right[name].looks):
            raise Unlike("its scene has other bodies than that of the lesson")
        nearest = min(right, key=lambda other: difference(film, right[other]))
        if nearest != name:
            raise Unlike(f"its film of {name} is not that of the reference")


@lru_cache(maxsize=8)
def film_as_it_is(tree: Tree, seed: int) -> Film:
    """The lab scene of a tree, once for all questions."""
    return filmed(tree, {}, seed)


def filmed(
    tree: Tree, texts: Mapping[str, str], seed: int, restitution: float | None = None
) -> Film:
    """The lab scene of a tree, some of its files with other text; all may bounce alike."""
    with tree.lab("mini_engine", texts) as lab:
        scene = Scene(lab, seed)
        if restitution is not None:
            for thing, _ in scene.bodies:
                lab.put(thing, restitution=restitution)
        bodies = [thing for thing, _ in scene.bodies]
        joints = lab.items(lab.get(scene.world, "joints"), "the joints")
        if len(bodies) > MAX_BODIES or len(joints) > MAX_RODS:
            raise Unlike("its scene has more bodies or rods than a film shows")
        looks = []
        for thing, state in scene.bodies:
            half = (0.0, 0.0) if state.radius else lab.pair(lab.get(thing, "shape.half"), "half")
            place = (state.pos.x, state.pos.y)
            if not 0 <= state.radius < MOST_RADIUS:
                raise Unlike("a body of its scene has no radius that could be drawn")
            looks.append(Look(state.radius, half, state.inv_mass > 0, place))
        rods = []
        for joint in joints:
            ends = [lab.thing(lab.get(lab.thing(joint), end)) for end in ("a", "b")]
            rods.append(tuple(bodies.index(Thing(each.ref)) for each in ends))
        run = lab.simulate(scene.world, bodies, round(SECONDS / STEP), every=EVERY)
    return Film(looks, run.frames, SECONDS, [(a, b) for a, b in rods])
