"""Known mistakes in TODO 8a to 8c, as models of what one step then returns."""

import math
from collections.abc import Callable, Sequence
from itertools import product

from grader.checks import exact
from grader.checks.exact import Accel, State, polynomial
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import right_models, truth

SEMI_IMPLICIT, VERLET, RK4 = "semi_implicit_euler", "velocity_verlet", "rk4"
SAMPLES = "samples of accel"
Force = Sequence[float]
Step = Callable[[float, float, float, Force], State]

known_8a = known_in("8a", SEMI_IMPLICIT)
known_8b = known_in("8b", VERLET)
known_8c = known_in("8c", RK4, apart=False)  # x and v share the samples
known_samples = known_in("8c", SAMPLES)
KNOWN = {SEMI_IMPLICIT: known_8a, VERLET: known_8b, RK4: known_in("8c", RK4)}


def right_semi_implicit(x: float, v: float, dt: float, force: Force) -> State:
    return exact.semi_implicit_euler(x, v, dt, polynomial(force))


XV = {"x": [0], "v": [1]}


def describe_step(x: float, v: float, dt: float, force: Force) -> dict[str, str]:
    """Describe the start of a step."""
    return {
        "_speed": f"v is {'0' if not v else 'not 0'} at the start",
        "_force": f"{'no' if not polynomial(force)(x) else 'a'} force acts at the start",
        "_case": f"a step of {dt:g} s from x = {x:g}, v = {v:g} with accel(x) = {formula(force)}",
    }


def formula(force: Force) -> str:
    powers = zip(force, ("", "·x", "·x²", "·x³"), strict=False)
    return " ".join(f"{c:+g}{power}" for c, power in powers if c) or "0"


truth(SEMI_IMPLICIT, right_semi_implicit, describe_step, XV, apart=True)
truth(
    VERLET,
    lambda x, v, dt, force: exact.velocity_verlet(x, v, dt, polynomial(force)),
    describe_step,
    XV,
    apart=True,
)
truth(
    RK4,
    lambda x, v, dt, force: exact.rk4(x, v, dt, polynomial(force)),
    describe_step,
    XV,
    apart=True,
)


SPRING = (0.0, -((2 * math.pi) ** 2))  # the lesson's
for about, known in KNOWN.items():
    known(
        "the-spring-itself",
        lambda x, v, dt, force, about=about: right_models[about](x, v, dt, SPRING),
        meaning="The acceleration of the lesson's spring is used for every force: call accel(x).",
    )


# ---------------------------------------------------------------- how steps are put together


def semi_implicit_with(
    kick: Callable[[float, float], float], drift: Callable[[float, float], float]
) -> Step:
    """Return the step in which v changes by kick(a, dt), then x by drift(v, dt)."""

    def model(x: float, v: float, dt: float, force: Force) -> State:
        v += kick(polynomial(force)(x), dt)
        return x + drift(v, dt), v

    return model


def verlet_with(
    bend: Callable[[float, float], float], kick: Callable[[float, float, float], float]
) -> Step:
    """Return the step in which x bends by bend(a, dt); v changes by kick(a, a at the end, dt)."""

    def model(x: float, v: float, dt: float, force: Force) -> State:
        accel = polynomial(force)
        end = x + v * dt + bend(accel(x), dt)
        return end, v + kick(accel(x), accel(end), dt)

    return model


def drift_by(factor: float) -> Callable[[float, float], float]:
    return lambda v, dt: factor * v * dt


def bend_by(factor: float) -> Callable[[float, float], float]:
    return lambda a, dt: factor * a * dt**2 / 2


def kick_by(factor: float) -> Callable[[float, float, float], float]:
    return lambda old, new, dt: factor * (old + new) / 2 * dt


Source = tuple[int, float]  # the sample that another starts from, and the share of the step
USUAL: tuple[Source, ...] = ((0, 0.5), (1, 0.5), (2, 1.0))
RIGHT_WEIGHTS = (1 / 6, 2 / 6, 2 / 6, 1 / 6)
WHOLE_STEPS: tuple[Source, ...] = ((0, 1.0), (1, 1.0), (2, 1.0))


def take_samples(
    x: float,
    v: float,
    dt: float,
    force: Force,
    sources: Sequence[Source] = USUAL,
    speeds: Sequence[Source] | None = None,
) -> tuple[list[State], list[float]]:
    """Return the four samples, and the positions at which accel is called.

    `speeds` replace the sources of their velocities.
    """
    accel = polynomial(force)
    samples, places = [(v, accel(x))], [x]
    for (source, share), (other, reach) in zip(sources, speeds or sources, strict=True):
        speed = v + reach * dt * samples[other][1]
        dx = [*(each[0] for each in samples), speed][source]
        places.append(x + share * dt * dx)
        samples.append((speed, accel(places[-1])))
    return samples, places


def find_places(
    sources: Sequence[Source], speeds: Sequence[Source] | None = None
) -> Callable[..., tuple[float, ...]]:
    return lambda x, v, dt, force: tuple(
        dict.fromkeys(take_samples(x, v, dt, force, sources, speeds)[1])
    )


def weigh_samples(
    sources: Sequence[Source], weights: Sequence[float], speeds: Sequence[Source] | None = None
) -> Step:
    """Return the step that adds up such samples with such weights."""

    def model(x: float, v: float, dt: float, force: Force) -> State:
        samples = take_samples(x, v, dt, force, sources, speeds)[0]
        for weight, (dx, dv) in zip(weights, samples, strict=True):
            x, v = x + dt * weight * dx, v + dt * weight * dv
        return x, v

    return model


# ---------------------------------------------------------------- 8a


@known_8a("explicit-euler-again")
def explicit_euler(x: float, v: float, dt: float, force: Force) -> State:
    return x + v * dt, v + polynomial(force)(x) * dt


known_8b("explicit-euler-again", explicit_euler)
known_8c("explicit-euler-again", explicit_euler)


@known_8a("position-first")
def position_first(x: float, v: float, dt: float, force: Force) -> State:
    x += v * dt
    return x, v + polynomial(force)(x) * dt


known_8b("position-first", position_first)
known_8a("velocity-without-the-step", semi_implicit_with(lambda a, dt: a, drift_by(1.0)))
known_8a(
    "old-velocity-returned", lambda x, v, dt, force: (right_semi_implicit(x, v, dt, force)[0], v)
)


@known_8a("velocity-is-replaced")
def velocity_is_replaced(x: float, v: float, dt: float, force: Force) -> State:
    v = polynomial(force)(x) * dt
    return x + v * dt, v


known_8a("pair-swapped-and-both-old", lambda x, v, dt, force: explicit_euler(x, v, dt, force)[::-1])


@known_8a("mean-of-both-velocities")
def mean_of_both_velocities(x: float, v: float, dt: float, force: Force) -> State:
    new_v = v + polynomial(force)(x) * dt
    return x + (v + new_v) / 2 * dt, new_v


@known_8a("acceleration-of-the-velocity")
def acceleration_of_the_velocity(x: float, v: float, dt: float, force: Force) -> State:
    v += polynomial(force)(v) * dt
    return x + v * dt, v


@known_8a("position-is-replaced")
def position_is_replaced(x: float, v: float, dt: float, force: Force) -> State:
    _, v = right_semi_implicit(x, v, dt, force)
    return v * dt, v


known_8a(
    "changes-alone-are-returned",
    lambda x, v, dt, force: ((v + polynomial(force)(x) * dt) * dt, polynomial(force)(x) * dt),
)


@known_8a("parabola-with-the-new-velocity")
def parabola_with_the_new_velocity(x: float, v: float, dt: float, force: Force) -> State:
    end, new_v = right_semi_implicit(x, v, dt, force)
    return end + polynomial(force)(x) * dt**2 / 2, new_v


known_8a(
    "velocity-by-the-square-of-the-step", semi_implicit_with(lambda a, dt: a * dt**2, drift_by(1.0))
)


# ---------------------------------------------------------------- 8b


def parabola(x: float, v: float, dt: float, accel: Accel) -> float:
    return x + v * dt + accel(x) * dt**2 / 2


BENDS: dict[str, Callable[[float, float], float]] = {
    "half-is-missing-in-x": lambda a, dt: a * dt**2,
    "straight-line-in-x": lambda a, dt: 0.0,
    "square-is-missing-in-x": lambda a, dt: a * dt / 2,
}
KICKS: dict[str, Callable[[float, float, float], float]] = {
    "sum-instead-of-mean": lambda begin, end, dt: (begin + end) * dt,
    "old-acceleration-twice": lambda begin, end, dt: begin * dt,
    "new-acceleration-only": lambda begin, end, dt: end * dt,
    "step-is-missing-in-v": lambda begin, end, dt: (begin + end) / 2,
}


def known_bend(name: str) -> None:
    known_8b(name, verlet_with(BENDS[name], kick_by(1.0)))


def known_kick(name: str) -> None:
    known_8b(name, verlet_with(bend_by(1.0), KICKS[name]))


known_kick("old-acceleration-twice")
known_kick("new-acceleration-only")
known_kick("sum-instead-of-mean")
known_bend("half-is-missing-in-x")
known_bend("straight-line-in-x")
known_8b(
    "semi-implicit-euler-again",
    lambda x, v, dt, force: exact.semi_implicit_euler(x, v, dt, polynomial(force)),
)


def acceleration_at_the_mean_place(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    end = parabola(x, v, dt, accel)
    return end, v + accel((x + end) / 2) * dt


@known_8b("end-on-a-straight-line")
def end_on_a_straight_line(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    return parabola(x, v, dt, accel), v + (accel(x) + accel(x + v * dt)) / 2 * dt


known_8b("force-at-the-mean-place", acceleration_at_the_mean_place)


midpoint = weigh_samples(USUAL, (0, 1, 0, 0))


known_8b("midpoint-method", midpoint)
known_8c("midpoint-method", midpoint)
known_8b("old-half-alone", verlet_with(bend_by(1.0), lambda old, new, dt: old * dt / 2))
known_8b("new-half-alone", verlet_with(bend_by(1.0), lambda old, new, dt: new * dt / 2))
known_8b(
    "mean-without-brackets",
    verlet_with(bend_by(1.0), lambda old, new, dt: old + new / 2 * dt),
    verlet_with(bend_by(1.0), lambda old, new, dt: (old + new / 2) * dt),
    verlet_with(bend_by(1.0), lambda old, new, dt: old + new * dt / 2),
    verlet_with(bend_by(1.0), lambda old, new, dt: old / 2 + new * dt),
    verlet_with(bend_by(1.0), lambda old, new, dt: old / 2 + new * dt / 2),
    verlet_with(bend_by(1.0), lambda old, new, dt: (old / 2 + new) * dt),
)
known_8b(
    "mean-by-the-square-of-the-step",
    verlet_with(bend_by(1.0), lambda old, new, dt: (old + new) / 2 * dt**2),
)


@known_8b("acceleration-for-velocity")
def acceleration_for_velocity(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    end = parabola(x, v, dt, accel)
    return end, accel(end)


@known_8b("acceleration-of-the-velocity")
def old_acceleration_of_v(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    end = x + v * dt + accel(v) * dt**2 / 2
    return end, v + (accel(v) + accel(end)) / 2 * dt


# ---------------------------------------------------------------- 8c


@known_8c("samples-lead-on")
def samples_lead_on(x: float, v: float, dt: float, force: Force) -> State:
    accel, place, speed = polynomial(force), x, v
    for share, weight in ((0.5, 1), (0.5, 2), (1.0, 2), (0.0, 1)):
        dx, dv = speed, accel(place)
        x, v = x + dt / 6 * weight * dx, v + dt / 6 * weight * dv
        place, speed = place + share * dt * dx, speed + share * dt * dv
    return x, v


@known_8c("new-velocity-in-x")
def new_velocity_in_x(x: float, v: float, dt: float, force: Force) -> State:
    _, end = right_models[RK4](x, v, dt, force)
    return x + end * dt, end


known_8c("weights-are-swapped", weigh_samples(USUAL, (2 / 6, 1 / 6, 1 / 6, 2 / 6)), apart=True)
known_8c("mean-of-both-ends", weigh_samples(WHOLE_STEPS, (1 / 2, 1 / 2, 0, 0)))
known_8c(
    "velocity-is-not-sampled",
    weigh_samples(USUAL, RIGHT_WEIGHTS, tuple((before, 0.0) for before, _ in USUAL)),
)
known_8c(
    "step-stays-halved",
    lambda x, v, dt, force: weigh_samples(WHOLE_STEPS, RIGHT_WEIGHTS)(x, v, dt / 2, force),
)


@known_8c("three-eighths")
def three_eighths(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    v1, a1 = v, accel(x)
    v2, a2 = v + dt * a1 / 3, accel(x + dt * v1 / 3)
    v3, a3 = v + dt * (a2 - a1 / 3), accel(x + dt * (v2 - v1 / 3))
    v4, a4 = v + dt * (a1 - a2 + a3), accel(x + dt * (v1 - v2 + v3))
    return x + dt / 8 * (v1 + 3 * v2 + 3 * v3 + v4), v + dt / 8 * (a1 + 3 * a2 + 3 * a3 + a4)


# ---------------------------------------------------------------- a part left out, or typed in


TYPED = {"1/60": 1 / 60, "1/30": 1 / 30, "1/120": 1 / 120, "1/40": 1 / 40}
for about, known in KNOWN.items():
    for words, seconds in TYPED.items():
        known(
            f"step-of-{words.replace('/', '-')}",
            lambda x, v, dt, force, about=about, seconds=seconds: right_models[about](
                x, v, seconds, force
            ),
            meaning=f"Every step is taken to last {words} s; it lasts dt.",
        )
    known(
        "velocity-returned-first",
        lambda x, v, dt, force, about=about: right_models[about](x, v, dt, force)[::-1],
        meaning="The pair is the wrong way round: return x first, then v.",
    )
    known(
        "x-is-not-moved",
        lambda x, v, dt, force, about=about: (x, right_models[about](x, v, dt, force)[1]),
        meaning="x is returned unchanged: it must move.",
    )
    known(
        "v-is-not-changed",
        lambda x, v, dt, force, about=about: (right_models[about](x, v, dt, force)[0], v),
        meaning="v is returned unchanged: the acceleration must change it.",
    )


known_8a("moves-a-whole-second", semi_implicit_with(lambda a, dt: a * dt, lambda v, dt: v))
known_8a(
    "acceleration-has-the-wrong-sign",
    semi_implicit_with(lambda a, dt: -a * dt, lambda v, dt: v * dt),
)
known_8a("velocity-is-not-used", semi_implicit_with(lambda a, dt: 0.0, lambda v, dt: v * dt))
known_bend("square-is-missing-in-x")
known_kick("step-is-missing-in-v")
for (bend_name, bend), (kick_name, kick) in product(BENDS.items(), KICKS.items()):
    known_8b(f"{bend_name}+{kick_name}", verlet_with(bend, kick))


@known_8b("velocity-changes-twice")
def velocity_changes_twice(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    begin = accel(x)
    v += begin * dt
    x += v * dt + begin * dt**2 / 2
    return x, v + (begin + accel(x)) / 2 * dt


@known_8b("speed-is-missing-in-x")
def speed_is_missing_in_x(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    end = x + accel(x) * dt**2 / 2
    return end, v + (accel(x) + accel(end)) / 2 * dt


@known_8b(
    "acceleration-of-the-velocity",
    meaning="The second acceleration is that at v; accel is asked about the new x.",
)
def second_at_v(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    return parabola(x, v, dt, accel), v + (accel(x) + accel(v)) / 2 * dt


# ---------------------------------------------------------------- 8c: other samples, other weights

truth(
    SAMPLES,
    find_places(USUAL),
    describe_step,
    {f"the position of k{n + 1}": [n] for n in range(4)},
)
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
for sample_name, sources in OTHER_SAMPLES.items():
    known_samples(sample_name, find_places(sources))
    known_8c(sample_name, weigh_samples(sources, RIGHT_WEIGHTS))
for weight_name, many in OTHER_WEIGHTS.items():
    known_8c(weight_name, *(weigh_samples(USUAL, weights) for weights in many), apart=True)


PLACES = ("first", "second", "third", "fourth")
REACHES = {0.0: "at the start", 0.5: "half-way", 1.0: "at the end of the step"}
for number, (before, reach) in enumerate(USUAL, 1):
    for source, share in product(range(number), REACHES):
        if (source != before) == (share != reach):
            continue  # right, or two mistakes
        told = (
            f"of the {PLACES[number]} sample, k{number + 1}, is that {REACHES[share]}; it belongs "
            f"{REACHES[reach]}."
            if source == before
            else f"of the {PLACES[number]} sample, k{number + 1}, starts from the "
            f"{PLACES[source]}; it must use what the {PLACES[before]} one found."
        )
        other = (*USUAL[: number - 1], (source, share), *USUAL[number:])
        name = f"k{number + 1}-from-k{source + 1}-at-{share:g}"
        for part, places, speeds in (("position", other, USUAL), ("velocity", USUAL, other)):
            words = f"The {part} {told}"
            known_samples(f"{part}-of-{name}", find_places(places, speeds), meaning=words)
            known_8c(
                f"{part}-of-{name}", weigh_samples(places, RIGHT_WEIGHTS, speeds), meaning=words
            )


for number, (before, reach) in enumerate(USUAL, 1):
    other = (*USUAL[: number - 1], (number, reach), *USUAL[number:])
    known_8c(
        f"position-of-k{number + 1}-by-its-own-velocity",
        weigh_samples(other, RIGHT_WEIGHTS, USUAL),
        meaning=f"The position of the {PLACES[number]} sample, k{number + 1}, is moved by its own "
        f"velocity; it must be moved by that of the {PLACES[before]} one.",
    )


@known_8c("pairs-are-joined")
def pairs_are_joined(x: float, v: float, dt: float, force: Force) -> State:
    return x + dt / 6 * v, v + dt / 6 * polynomial(force)(x)


def led_by_acceleration(x: float, v: float, dt: float, force: Force) -> tuple[float, ...]:
    """Return the positions of samples that move by the acceleration."""
    accel, places = polynomial(force), [x]
    for share in (0.5, 0.5, 1.0):
        places.append(x + share * dt * accel(places[-1]))
    return tuple(dict.fromkeys(places))


def each_from_the_last(x: float, v: float, dt: float, force: Force) -> tuple[float, ...]:
    """Return the positions of samples that each start from the sample before."""
    accel, places, slope = polynomial(force), [x], v
    for share in (0.5, 0.5, 1.0):
        slope, place = v + share * dt * accel(places[-1]), places[-1] + share * dt * slope
        places.append(place)
    return tuple(dict.fromkeys(places))


known_samples("acceleration-leads-to-the-places", led_by_acceleration)
known_samples("each-sample-from-the-last-place", each_from_the_last)


# ---------------------------------------------------------------- a factor too much

FACTORS = (("half", "half of", 0.5), ("twice", "twice", 2.0), ("opposite", "the opposite of", -1.0))
for name, words, factor in FACTORS:
    known_8a(
        f"{name}-the-way",
        semi_implicit_with(drift_by(1.0), drift_by(factor)),
        meaning=f"x moves by {words} v * dt; it moves by v * dt, with the new v.",
    )
    if factor != 2.0:  # twice as much is half too little
        known_8b(
            f"{name}-the-bend",
            verlet_with(bend_by(factor), kick_by(1.0)),
            meaning=f"x bends by {words} a * dt² / 2; it bends by a * dt² / 2, with the old a.",
        )
        known_8b(
            f"{name}-the-mean",
            verlet_with(bend_by(1.0), kick_by(factor)),
            meaning=f"v changes by {words} the mean of both accelerations * dt; it is that mean "
            "* dt.",
        )


@known_8c("sum-without-the-step", apart=True)
def sum_without_the_step(x: float, v: float, dt: float, force: Force) -> State:
    samples = take_samples(x, v, dt, force, USUAL)[0]
    for weight, (dx, dv) in zip(RIGHT_WEIGHTS, samples, strict=True):
        x, v = x + weight * dx, v + weight * dv
    return x, v
