"""Known mistakes in TODO 8a to 8c, as models of what one step then returns."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import product

from grader.checks import exact
from grader.checks.exact import Accel, State, polynomial
from grader.checks.mistakes import Models, look_through, register
from grader.checks.todo_8.checks import formula
from grader.judge.explain.misconceptions import Kind, kinds, mistake

SAMPLES = "samples of accel"
Force = Sequence[float]
Step = Callable[[float, float, float, Accel], State]

METHODS: dict[str, tuple[str, Step]] = {  # by TODO: the kind of question, and the right model
    "8a": ("semi_implicit_euler", exact.semi_implicit_euler),
    "8b": ("velocity_verlet", exact.velocity_verlet),
    "8c": ("rk4", exact.rk4),
}


def take_accel(x: float, v: float, dt: float, force: Force) -> tuple[float, float, float, Accel]:
    return x, v, dt, polynomial(force)


def describe_step(x: float, v: float, dt: float, force: Force) -> dict[str, str]:
    """Describe the start of a step."""
    return {
        "_speed": f"v is {'0' if not v else 'not 0'} at the start",
        "_force": f"{'no' if not polynomial(force)(x) else 'a'} force acts at the start",
        "_case": f"a step of {dt:g} s from x = {x:g}, v = {v:g} with accel(x) = {formula(force)}",
    }


# ---------------------------------------------------------------- any method

SPRING = polynomial((0.0, -((2 * math.pi) ** 2)))  # the lesson's


def with_step(right: Step, seconds: float) -> Step:
    return lambda x, v, dt, a: right(x, v, seconds, a)


def list_common(right: Step) -> Iterator[tuple[str, str, Step]]:
    """Yield mistakes that any method may have: a name, a sentence and a model."""
    spring = "The acceleration of the lesson's spring is used for every force: call accel(x)."
    yield "the-spring-itself", spring, lambda x, v, dt, a: right(x, v, dt, SPRING)
    for rate in (60, 30, 120, 40):
        words = f"Every step is taken to last 1/{rate} s; it lasts dt."
        yield f"step-of-1-{rate}", words, with_step(right, 1 / rate)
    words = "The pair is the wrong way round: return x first, then v."
    yield "velocity-returned-first", words, lambda *step: right(*step)[::-1]
    words = "x is returned unchanged: it must move."
    yield "x-is-not-moved", words, lambda x, v, dt, a: (x, right(x, v, dt, a)[1])
    words = "v is returned unchanged: the acceleration must change it."
    yield "v-is-not-changed", words, lambda x, v, dt, a: (right(x, v, dt, a)[0], v)


from_force = partial(look_through, take_accel)
for about, right in METHODS.values():
    kinds[about] = Kind(from_force(right), describe_step, {"x": [0], "v": [1]}, apart=True)


def midpoint(x: float, v: float, dt: float, accel: Accel) -> State:
    middle = x + v * dt / 2
    return x + (v + accel(x) * dt / 2) * dt, v + accel(middle) * dt


def explicit_euler(x: float, v: float, dt: float, accel: Accel) -> State:
    return x + v * dt, v + accel(x) * dt


def position_first(x: float, v: float, dt: float, accel: Accel) -> State:
    return x + v * dt, v + accel(x + v * dt) * dt


# ---------------------------------------------------------------- 8a

EULER: Models = (
    ("explicit-euler-again", explicit_euler),
    ("position-first", position_first),
    ("velocity-without-the-step", lambda x, v, dt, a: (x + (v + a(x)) * dt, v + a(x))),
    ("old-velocity-returned", lambda x, v, dt, a: (x + (v + a(x) * dt) * dt, v)),
    ("velocity-is-replaced", lambda x, v, dt, a: (x + a(x) * dt * dt, a(x) * dt)),
    ("pair-swapped-and-both-old", lambda x, v, dt, a: explicit_euler(x, v, dt, a)[::-1]),
    ("mean-of-both-velocities", lambda x, v, dt, a: (x + (v + a(x) * dt / 2) * dt, v + a(x) * dt)),
    ("acceleration-of-the-velocity", lambda x, v, dt, a: (x + (v + a(v) * dt) * dt, v + a(v) * dt)),
    ("position-is-replaced", lambda x, v, dt, a: ((v + a(x) * dt) * dt, v + a(x) * dt)),
    ("changes-alone-are-returned", lambda x, v, dt, a: ((v + a(x) * dt) * dt, a(x) * dt)),
    (
        "parabola-with-the-new-velocity",
        lambda x, v, dt, a: (x + (v + a(x) * dt * 3 / 2) * dt, v + a(x) * dt),
    ),
    (
        "velocity-by-the-square-of-the-step",
        lambda x, v, dt, a: (x + (v + a(x) * dt**2) * dt, v + a(x) * dt**2),
    ),
    ("moves-a-whole-second", lambda x, v, dt, a: (x + v + a(x) * dt, v + a(x) * dt)),
    (
        "acceleration-has-the-wrong-sign",
        lambda x, v, dt, a: (x + (v - a(x) * dt) * dt, v - a(x) * dt),
    ),
    ("velocity-is-not-used", lambda x, v, dt, a: (x + v * dt, v)),
)
register("8a", "semi_implicit_euler", EULER, take_accel)


def by_factor(factor: float) -> Step:
    return lambda x, v, dt, a: (x + factor * (v + a(x) * dt) * dt, v + a(x) * dt)


FACTORS = (("half", "half of", 0.5), ("twice", "twice", 2.0), ("opposite", "the opposite of", -1.0))
for name, words, factor in FACTORS:
    words = f"x moves by {words} v * dt; it moves by v * dt, with the new v."
    mistake("8a", "semi_implicit_euler", f"{name}-the-way", words, from_force(by_factor(factor)))


# ---------------------------------------------------------------- 8b


def parabola(x: float, v: float, dt: float, accel: Accel) -> float:
    return x + v * dt + accel(x) * dt**2 / 2


def verlet_with(
    bend: Callable[[float, float], float], kick: Callable[[float, float, float], float]
) -> Step:
    """Return the step with x + v dt + bend(a, dt) and v + kick(a, a at the end, dt)."""

    def model(x: float, v: float, dt: float, accel: Accel) -> State:
        end = x + v * dt + bend(accel(x), dt)
        return end, v + kick(accel(x), accel(end), dt)

    return model


def bend_by(factor: float, a: float, dt: float) -> float:
    return factor * a * dt**2 / 2


def kick_by(factor: float, begin: float, end: float, dt: float) -> float:
    return factor * (begin + end) / 2 * dt


right_bend, right_kick = partial(bend_by, 1.0), partial(kick_by, 1.0)


def at_second(place: Callable[[float, float, float, float], float]) -> Step:
    """Return the step that takes its second acceleration at place(x, v, dt, end)."""

    def model(x: float, v: float, dt: float, accel: Accel) -> State:
        end = parabola(x, v, dt, accel)
        return end, v + right_kick(accel(x), accel(place(x, v, dt, end)), dt)

    return model


def force_at_the_mean_place(x: float, v: float, dt: float, accel: Accel) -> State:
    end = parabola(x, v, dt, accel)
    return end, v + accel((x + end) / 2) * dt


def acceleration_of_the_velocity(x: float, v: float, dt: float, accel: Accel) -> State:
    end = x + v * dt + accel(v) * dt**2 / 2
    return end, v + (accel(v) + accel(end)) / 2 * dt


def speed_missing_in_x(x: float, v: float, dt: float, accel: Accel) -> State:
    end = x + accel(x) * dt**2 / 2
    return end, v + (accel(x) + accel(end)) / 2 * dt


BENDS: dict[str, Callable[[float, float], float]] = {
    "half-is-missing-in-x": lambda a, dt: a * dt**2,
    "straight-line-in-x": lambda a, dt: 0.0,
    "square-is-missing-in-x": lambda a, dt: a * dt / 2,
}
KICKS: dict[str, Callable[[float, float, float], float]] = {
    "old-acceleration-twice": lambda begin, end, dt: begin * dt,
    "new-acceleration-only": lambda begin, end, dt: end * dt,
    "sum-instead-of-mean": lambda begin, end, dt: (begin + end) * dt,
    "step-is-missing-in-v": lambda begin, end, dt: (begin + end) / 2,
}
OTHER_KICKS: tuple[tuple[str, Callable[[float, float, float], float]], ...] = (
    ("old-half-alone", lambda begin, end, dt: begin * dt / 2),
    ("new-half-alone", lambda begin, end, dt: end * dt / 2),
    ("mean-without-brackets", lambda begin, end, dt: begin + end / 2 * dt),
    ("mean-without-brackets", lambda begin, end, dt: (begin + end / 2) * dt),
    ("mean-without-brackets", lambda begin, end, dt: begin + end * dt / 2),
    ("mean-without-brackets", lambda begin, end, dt: begin / 2 + end * dt),
    ("mean-without-brackets", lambda begin, end, dt: begin / 2 + end * dt / 2),
    ("mean-without-brackets", lambda begin, end, dt: (begin / 2 + end) * dt),
    ("mean-by-the-square-of-the-step", lambda begin, end, dt: (begin + end) / 2 * dt**2),
)
VERLET: Models = (
    ("explicit-euler-again", explicit_euler),
    ("position-first", position_first),
    *((name, verlet_with(right_bend, kick)) for name, kick in KICKS.items()),
    *((name, verlet_with(bend, right_kick)) for name, bend in BENDS.items()),
    ("semi-implicit-euler-again", exact.semi_implicit_euler),
    ("end-on-a-straight-line", at_second(lambda x, v, dt, end: x + v * dt)),
    ("force-at-the-mean-place", force_at_the_mean_place),
    ("midpoint-method", midpoint),
    *((name, verlet_with(right_bend, kick)) for name, kick in OTHER_KICKS),
    (
        "acceleration-for-velocity",
        lambda x, v, dt, a: (parabola(x, v, dt, a), a(parabola(x, v, dt, a))),
    ),
    ("acceleration-of-the-velocity", acceleration_of_the_velocity),
    *(
        (f"{bend_name}+{kick_name}", verlet_with(bend, kick))
        for (bend_name, bend), (kick_name, kick) in product(BENDS.items(), KICKS.items())
    ),
    ("velocity-changes-twice", lambda x, v, dt, a: exact.velocity_verlet(x, v + a(x) * dt, dt, a)),
    ("speed-is-missing-in-x", speed_missing_in_x),
)
register("8b", "velocity_verlet", VERLET, take_accel)
mistake(
    "8b",
    "velocity_verlet",
    "acceleration-of-the-velocity",
    "The second acceleration is that at v; accel is asked about the new x.",
    from_force(at_second(lambda x, v, dt, end: v)),
)
for name, words, factor in FACTORS:
    if factor == 2.0:  # twice as much is half too little
        continue
    bends = f"x bends by {words} a * dt² / 2; it bends by a * dt² / 2, with the old a."
    step = verlet_with(partial(bend_by, factor), right_kick)
    mistake("8b", "velocity_verlet", f"{name}-the-bend", bends, from_force(step))
    kicks = f"v changes by {words} the mean of both accelerations * dt; it is that mean * dt."
    step = verlet_with(right_bend, partial(kick_by, factor))
    mistake("8b", "velocity_verlet", f"{name}-the-mean", kicks, from_force(step))


# ---------------------------------------------------------------- 8c

Source = tuple[int, float]  # the sample that another starts from, and the share of the step
Sources = Sequence[Source]
USUAL: tuple[Source, ...] = ((0, 0.5), (1, 0.5), (2, 1.0))
WHOLE_STEPS: tuple[Source, ...] = ((0, 1.0), (1, 1.0), (2, 1.0))
RIGHT_WEIGHTS = (1 / 6, 2 / 6, 2 / 6, 1 / 6)


def take_samples(
    x: float, v: float, dt: float, accel: Accel, sources: Sources, speeds: Sources = ()
) -> tuple[list[State], list[float]]:
    """Return the four samples, and the positions at which accel is called.

    `speeds` replaces `sources` for the velocities.
    """
    samples, places = [(v, accel(x))], [x]
    for (source, share), (other, reach) in zip(sources, speeds or sources, strict=True):
        speed = v + reach * dt * samples[other][1]
        dx = [*(each[0] for each in samples), speed][source]
        places.append(x + share * dt * dx)
        samples.append((speed, accel(places[-1])))
    return samples, places


def find_places(sources: Sources, speeds: Sources = ()) -> Callable[..., tuple[float, ...]]:
    return lambda x, v, dt, a: tuple(dict.fromkeys(take_samples(x, v, dt, a, sources, speeds)[1]))


def weigh_samples(sources: Sources, weights: Sequence[float], speeds: Sources = ()) -> Step:
    """Return the step that adds up the samples with these weights."""

    def model(x: float, v: float, dt: float, accel: Accel) -> State:
        samples = take_samples(x, v, dt, accel, sources, speeds)[0]
        for weight, (dx, dv) in zip(weights, samples, strict=True):
            x, v = x + dt * weight * dx, v + dt * weight * dv
        return x, v

    return model


kinds[SAMPLES] = Kind(
    from_force(find_places(USUAL)),
    describe_step,
    {f"the position of k{n + 1}": [n] for n in range(4)},
)


def samples_lead_on(x: float, v: float, dt: float, accel: Accel) -> State:
    place, speed = x, v
    for share, weight in ((0.5, 1), (0.5, 2), (1.0, 2), (0.0, 1)):
        dx, dv = speed, accel(place)
        x, v = x + dt / 6 * weight * dx, v + dt / 6 * weight * dv
        place, speed = place + share * dt * dx, speed + share * dt * dv
    return x, v


def new_velocity_in_x(x: float, v: float, dt: float, accel: Accel) -> State:
    _, end = exact.rk4(x, v, dt, accel)
    return x + end * dt, end


def three_eighths(x: float, v: float, dt: float, accel: Accel) -> State:
    v1, a1 = v, accel(x)
    v2, a2 = v + dt * a1 / 3, accel(x + dt * v1 / 3)
    v3, a3 = v + dt * (a2 - a1 / 3), accel(x + dt * (v2 - v1 / 3))
    v4, a4 = v + dt * (a1 - a2 + a3), accel(x + dt * (v1 - v2 + v3))
    return x + dt / 8 * (v1 + 3 * v2 + 3 * v3 + v4), v + dt / 8 * (a1 + 3 * a2 + 3 * a3 + a4)


def led_by_acceleration(x: float, v: float, dt: float, accel: Accel) -> tuple[float, ...]:
    """Return the positions of samples that move by the acceleration."""
    places = [x]
    for share in (0.5, 0.5, 1.0):
        places.append(x + share * dt * accel(places[-1]))
    return tuple(dict.fromkeys(places))


def each_from_the_last(x: float, v: float, dt: float, accel: Accel) -> tuple[float, ...]:
    """Return the positions of samples that each start from the sample before."""
    places, slope = [x], v
    for share in (0.5, 0.5, 1.0):
        slope, place = v + share * dt * accel(places[-1]), places[-1] + share * dt * slope
        places.append(place)
    return tuple(dict.fromkeys(places))


OTHER_SAMPLES: dict[str, tuple[Source, ...]] = {
    "second-sample-at-full-step": ((0, 1.0), (1, 0.5), (2, 1.0)),
    "third-sample-at-full-step": ((0, 0.5), (1, 1.0), (2, 1.0)),
    "last-sample-at-half-step": ((0, 0.5), (1, 0.5), (2, 0.5)),
    "middle-samples-at-full-step": WHOLE_STEPS,
    "third-sample-repeats-the-second": ((0, 0.5), (0, 0.5), (2, 1.0)),
    "last-sample-uses-the-second": ((0, 0.5), (1, 0.5), (1, 1.0)),
    "every-sample-from-the-first": ((0, 0.5), (0, 0.5), (0, 1.0)),
}
OTHER_WEIGHTS: dict[str, tuple[tuple[float, ...], ...]] = {
    "weights-are-swapped": ((2 / 6, 1 / 6, 1 / 6, 2 / 6),),
    "equal-weights": ((1 / 4,) * 4, (1 / 6,) * 4),
    "sum-is-not-divided": ((1.0, 2.0, 2.0, 1.0),),
    "third-sample-counts-once": ((1 / 6, 2 / 6, 1 / 6, 1 / 6), (1 / 5, 2 / 5, 1 / 5, 1 / 5)),
    "second-sample-counts-once": ((1 / 6, 1 / 6, 2 / 6, 1 / 6), (1 / 5, 1 / 5, 2 / 5, 1 / 5)),
    "divided-by-another-number": tuple((1 / n, 2 / n, 2 / n, 1 / n) for n in (2, 3, 4, 5, 8)),
    "one-middle-sample-stands-twice": ((1 / 6, 4 / 6, 0.0, 1 / 6), (1 / 6, 0.0, 4 / 6, 1 / 6)),
    "last-sample-is-missing": (
        (1 / 5, 2 / 5, 2 / 5, 0.0),
        (1 / 6, 2 / 6, 2 / 6, 0.0),
        (1 / 4, 2 / 4, 1 / 4, 0.0),
    ),
}
RK4: Models = (
    ("explicit-euler-again", explicit_euler),
    ("midpoint-method", midpoint),
    ("samples-lead-on", samples_lead_on),
    ("new-velocity-in-x", new_velocity_in_x),
    ("mean-of-both-ends", weigh_samples(WHOLE_STEPS, (1 / 2, 1 / 2, 0, 0))),
    (
        "velocity-is-not-sampled",
        weigh_samples(USUAL, RIGHT_WEIGHTS, [(before, 0.0) for before, _ in USUAL]),
    ),
    (
        "step-stays-halved",
        lambda x, v, dt, a: weigh_samples(WHOLE_STEPS, RIGHT_WEIGHTS)(x, v, dt / 2, a),
    ),
    ("three-eighths", three_eighths),
    *((name, weigh_samples(sources, RIGHT_WEIGHTS)) for name, sources in OTHER_SAMPLES.items()),
    ("pairs-are-joined", lambda x, v, dt, a: (x + dt / 6 * v, v + dt / 6 * a(x))),
)
SUMS: Models = (
    *(
        (name, weigh_samples(USUAL, weights))
        for name, some in OTHER_WEIGHTS.items()
        for weights in some
    ),
    (
        "sum-without-the-step",
        lambda x, v, dt, a: weigh_samples(USUAL, [w / dt for w in RIGHT_WEIGHTS])(x, v, dt, a),
    ),
)
PLACES_OF_SAMPLES: Models = (
    *((name, find_places(sources)) for name, sources in OTHER_SAMPLES.items()),
    ("acceleration-leads-to-the-places", led_by_acceleration),
    ("each-sample-from-the-last-place", each_from_the_last),
)
register("8c", "rk4", RK4, take_accel, apart=False)  # x and v share the samples
register("8c", "rk4", SUMS, take_accel)
register("8c", SAMPLES, PLACES_OF_SAMPLES, take_accel)

PLACES = ("first", "second", "third", "fourth")
REACHES = {0.0: "at the start", 0.5: "half-way", 1.0: "at the end of the step"}


def list_other_sources() -> Iterator[tuple[str, str, str, Sources, Sources]]:
    """Yield mistakes in one sample: its part, a name, the end of a sentence, and its sources.

    The sources are a list for the position and one for the velocity.
    """
    for number, (before, reach) in enumerate(USUAL, 1):
        for source, share in product(range(number), REACHES):
            if (source != before) == (share != reach):
                continue  # right, or two mistakes
            words = f"of the {PLACES[number]} sample, k{number + 1}, "
            if source == before:
                words += f"is that {REACHES[share]}; it belongs {REACHES[reach]}."
            else:
                words += f"starts from the {PLACES[source]}; it must use what the {PLACES[before]}"
                words += " one found."
            other = (*USUAL[: number - 1], (source, share), *USUAL[number:])
            name = f"of-k{number + 1}-from-k{source + 1}-at-{share:g}"
            yield "position", name, words, other, USUAL
            yield "velocity", name, words, USUAL, other


for part, name, words, sources, speeds in list_other_sources():
    name, words = f"{part}-{name}", f"The {part} {words}"
    ways, step = find_places(sources, speeds), weigh_samples(sources, RIGHT_WEIGHTS, speeds)
    mistake("8c", SAMPLES, name, words, from_force(ways))
    mistake("8c", "rk4", name, words, from_force(step), apart=False)
for number, (before, reach) in enumerate(USUAL, 1):
    other = (*USUAL[: number - 1], (number, reach), *USUAL[number:])
    step = weigh_samples(other, RIGHT_WEIGHTS, USUAL)
    words = (
        f"The position of the {PLACES[number]} sample, k{number + 1}, is moved by its own "
        f"velocity; it must be moved by that of the {PLACES[before]} one."
    )
    name = f"position-of-k{number + 1}-by-its-own-velocity"
    mistake("8c", "rk4", name, words, from_force(step), apart=False)

for todo, (about, right) in METHODS.items():
    for name, words, step in list_common(right):
        mistake(todo, about, name, words, from_force(step))
