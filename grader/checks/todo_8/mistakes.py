"""Known mistakes in TODO 8a to 8c, as models of what one step then returns."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import product

from grader.checks import exact
from grader.checks.exact import Accel, State, polynomial
from grader.judge.misconceptions import mistake, right_models, truth

SEMI_IMPLICIT, VERLET, RK4 = "semi_implicit_euler", "velocity_verlet", "rk4"
Force = Sequence[float]
Step = Callable[[float, float, float, Force], State]

known_8a = partial(mistake, "8a", SEMI_IMPLICIT)
known_8b = partial(mistake, "8b", VERLET)
known_8c = partial(mistake, "8c", RK4, apart=False)  # x and v share the samples


def right_semi_implicit(x: float, v: float, dt: float, force: Force) -> State:
    return exact.semi_implicit_euler(x, v, dt, polynomial(force))


XV = {"x": [0], "v": [1]}


def like(x: float, v: float, dt: float, force: Force) -> dict[str, str]:
    """Return where a step begins, in words."""
    return {
        "_speed": f"v is {'0' if not v else 'not 0'} at the start",
        "_force": f"{'no' if not polynomial(force)(x) else 'a'} force acts at the start",
        "_case": f"a step of {dt:g} s from x = {x:g}, v = {v:g} with accel(x) = {formula(force)}",
    }


def formula(force: Force) -> str:
    powers = zip(force, ("", "·x", "·x²", "·x³"), strict=False)
    return " ".join(f"{c:+g}{power}" for c, power in powers if c) or "0"


truth(SEMI_IMPLICIT, right_semi_implicit, like, XV, apart=True)
truth(
    VERLET,
    lambda x, v, dt, force: exact.velocity_verlet(x, v, dt, polynomial(force)),
    like,
    XV,
    apart=True,
)
truth(RK4, lambda x, v, dt, force: exact.rk4(x, v, dt, polynomial(force)), like, XV, apart=True)


SPRING = (0.0, -((2 * math.pi) ** 2))  # the lesson's
for todo, about in (("8a", SEMI_IMPLICIT), ("8b", VERLET), ("8c", RK4)):
    mistake(
        todo,
        about,
        "the-spring-itself",
        "The acceleration of the lesson's spring is used, whatever force is asked about: accel(x).",
        lambda x, v, dt, force, about=about: right_models[about](x, v, dt, SPRING),
    )


# ---------------------------------------------------------------- how steps are put together


def semi_implicit_with(
    kick: Callable[[float, float], float], drift: Callable[[float, float], float]
) -> Step:
    """v changes by kick(a, dt), then x by drift(v, dt)."""

    def model(x: float, v: float, dt: float, force: Force) -> State:
        v += kick(polynomial(force)(x), dt)
        return x + drift(v, dt), v

    return model


def verlet_with(
    bend: Callable[[float, float], float], kick: Callable[[float, float, float], float]
) -> Step:
    """x bends by bend(a, dt); v changes by kick(a at the start, a at the end, dt)."""

    def model(x: float, v: float, dt: float, force: Force) -> State:
        accel = polynomial(force)
        end = x + v * dt + bend(accel(x), dt)
        return end, v + kick(accel(x), accel(end), dt)

    return model


def times(factor: float) -> Callable[[float, float], float]:
    return lambda v, dt: factor * v * dt


def bent(factor: float) -> Callable[[float, float], float]:
    return lambda a, dt: factor * a * dt**2 / 2


def mean_times(factor: float) -> Callable[[float, float, float], float]:
    return lambda old, new, dt: factor * (old + new) / 2 * dt


Source = tuple[int, float]  # the sample that one starts from, and the share of the step
USUAL: tuple[Source, ...] = ((0, 0.5), (1, 0.5), (2, 1.0))
RIGHT_WEIGHTS = (1 / 6, 2 / 6, 2 / 6, 1 / 6)
WHOLE_STEPS: tuple[Source, ...] = ((0, 1.0), (1, 1.0), (2, 1.0))


def sampled(
    x: float,
    v: float,
    dt: float,
    force: Force,
    sources: Sequence[Source] = USUAL,
    speeds: Sequence[Source] | None = None,
) -> tuple[list[State], list[float]]:
    """Return the four samples, and the places where accel is asked.

    `speeds` are the sources of their velocities, where these are others.
    """
    accel = polynomial(force)
    samples, places = [(v, accel(x))], [x]
    for (source, share), (other, reach) in zip(sources, speeds or sources, strict=True):
        speed = v + reach * dt * samples[other][1]
        dx = [*(each[0] for each in samples), speed][source]
        places.append(x + share * dt * dx)
        samples.append((speed, accel(places[-1])))
    return samples, places


def places_of(
    sources: Sequence[Source], speeds: Sequence[Source] | None = None
) -> Callable[..., tuple[float, ...]]:
    return lambda x, v, dt, force: tuple(
        dict.fromkeys(sampled(x, v, dt, force, sources, speeds)[1])
    )


def weighed(
    sources: Sequence[Source], weights: Sequence[float], speeds: Sequence[Source] | None = None
) -> Step:
    """Return the step that adds up such samples with such weights."""

    def model(x: float, v: float, dt: float, force: Force) -> State:
        samples = sampled(x, v, dt, force, sources, speeds)[0]
        for weight, (dx, dv) in zip(weights, samples, strict=True):
            x, v = x + dt * weight * dx, v + dt * weight * dv
        return x, v

    return model


# ---------------------------------------------------------------- 8a


def explicit_euler(x: float, v: float, dt: float, force: Force) -> State:
    return x + v * dt, v + polynomial(force)(x) * dt


known_8a(
    "explicit-euler-again",
    "x moves with the old velocity; it must move with the velocity this step has just changed.",
    explicit_euler,
)
known_8b(
    "explicit-euler-again",
    "This is explicit Euler: x leaves out the acceleration, v the one at the end of the step.",
    explicit_euler,
)
known_8c(
    "explicit-euler-again",
    "This is explicit Euler: it takes one sample, at the start; RK4 takes four.",
    explicit_euler,
)


def position_first(x: float, v: float, dt: float, force: Force) -> State:
    x += v * dt
    return x, v + polynomial(force)(x) * dt


known_8a(
    "position-first",
    "x moves first and v follows; semi-implicit Euler changes v first, then x by the new v.",
    position_first,
)
known_8b(
    "position-first",
    "x moves without the acceleration, and v uses the acceleration at the end only.",
    position_first,
)


known_8a(
    "velocity-without-the-step",
    "The whole acceleration is added to v; a step of dt seconds adds accel(x) * dt.",
    semi_implicit_with(lambda a, dt: a, times(1.0)),
)
known_8a(
    "old-velocity-returned",
    "x moves with the new velocity, but the old one is returned.",
    lambda x, v, dt, force: (right_semi_implicit(x, v, dt, force)[0], v),
)


def velocity_replaced(x: float, v: float, dt: float, force: Force) -> State:
    v = polynomial(force)(x) * dt
    return x + v * dt, v


known_8a(
    "velocity-is-replaced",
    "The new v is the change alone: add accel(x) * dt to the v there was.",
    velocity_replaced,
)


known_8a(
    "pair-swapped-and-both-old",
    "The pair is the wrong way round, and x moves with the old velocity: change v first.",
    lambda x, v, dt, force: explicit_euler(x, v, dt, force)[::-1],
)


def mean_velocity(x: float, v: float, dt: float, force: Force) -> State:
    new_v = v + polynomial(force)(x) * dt
    return x + (v + new_v) / 2 * dt, new_v


known_8a(
    "mean-of-both-velocities",
    "x moves with the mean of the old and the new velocity; it must move with the new one alone.",
    mean_velocity,
)


def acceleration_of_v(x: float, v: float, dt: float, force: Force) -> State:
    v += polynomial(force)(v) * dt
    return x + v * dt, v


known_8a(
    "acceleration-of-the-velocity",
    "accel is asked about v; the acceleration depends on the position: accel(x).",
    acceleration_of_v,
)


def moved_alone(x: float, v: float, dt: float, force: Force) -> State:
    _, v = right_semi_implicit(x, v, dt, force)
    return v * dt, v


known_8a(
    "position-is-replaced",
    "The new x is the way alone: add v * dt to the x there was.",
    moved_alone,
)
known_8a(
    "changes-alone-are-returned",
    "What comes back are the changes alone: return x and v with their changes added.",
    lambda x, v, dt, force: ((v + polynomial(force)(x) * dt) * dt, polynomial(force)(x) * dt),
)


def bent_as_well(x: float, v: float, dt: float, force: Force) -> State:
    end, new_v = right_semi_implicit(x, v, dt, force)
    return end + polynomial(force)(x) * dt**2 / 2, new_v


known_8a(
    "parabola-with-the-new-velocity",
    "x gets the acceleration twice: by the new v and by the parabola's term. Leave out the term.",
    bent_as_well,
)


known_8a(
    "velocity-by-the-square-of-the-step",
    "v changes by accel(x) * dt²; it is accel(x) * dt, without the square.",
    semi_implicit_with(lambda a, dt: a * dt**2, times(1.0)),
)


# ---------------------------------------------------------------- 8b


def parabola(x: float, v: float, dt: float, accel: Accel) -> float:
    return x + v * dt + accel(x) * dt**2 / 2


BENDS: dict[str, tuple[str, Callable[[float, float], float]]] = {
    "half-is-missing-in-x": (
        "x gets a * dt² of the acceleration in all; on a parabola it is half of that.",
        lambda a, dt: a * dt**2,
    ),
    "straight-line-in-x": (
        "x moves along a straight line, x + v * dt; the acceleration bends the way.",
        lambda a, dt: 0.0,
    ),
    "square-is-missing-in-x": (
        "x gets half of a * dt; the square is missing: half of a * dt².",
        lambda a, dt: a * dt / 2,
    ),
}
KICKS: dict[str, tuple[str, Callable[[float, float, float], float]]] = {
    "sum-instead-of-mean": (
        "v gets the sum of both accelerations; it needs their mean, half of that.",
        lambda begin, end, dt: (begin + end) * dt,
    ),
    "old-acceleration-twice": (
        "Both accelerations are the one at the old x; the second belongs to the new x.",
        lambda begin, end, dt: begin * dt,
    ),
    "new-acceleration-only": (
        "v uses the acceleration at the new x only; it needs the mean of both ends.",
        lambda begin, end, dt: end * dt,
    ),
    "step-is-missing-in-v": (
        "v gets the mean acceleration itself; in a step of dt seconds it changes by mean * dt.",
        lambda begin, end, dt: (begin + end) / 2,
    ),
}


def known_bend(name: str) -> None:
    words, bend = BENDS[name]
    known_8b(name, words, verlet_with(bend, mean_times(1.0)))


def known_kick(name: str) -> None:
    words, kick = KICKS[name]
    known_8b(name, words, verlet_with(bent(1.0), kick))


known_kick("old-acceleration-twice")
known_kick("new-acceleration-only")
known_kick("sum-instead-of-mean")
known_bend("half-is-missing-in-x")
known_bend("straight-line-in-x")
known_8b(
    "semi-implicit-euler-again",
    "This is semi-implicit Euler: it never asks for the acceleration at the new x.",
    lambda x, v, dt, force: exact.semi_implicit_euler(x, v, dt, polynomial(force)),
)


def acceleration_at_the_mean_place(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    end = parabola(x, v, dt, accel)
    return end, v + accel((x + end) / 2) * dt


def end_on_a_straight_line(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    return parabola(x, v, dt, accel), v + (accel(x) + accel(x + v * dt)) / 2 * dt


known_8b(
    "end-on-a-straight-line",
    "The second acceleration is taken at x + v * dt; it belongs to where x ends, on the parabola.",
    end_on_a_straight_line,
)
known_8b(
    "force-at-the-mean-place",
    "v uses the acceleration at the mean place; it needs the mean of the accelerations at both "
    "ends. For a spring the two are the same.",
    acceleration_at_the_mean_place,
)


midpoint = weighed(USUAL, (0, 1, 0, 0))


known_8b(
    "midpoint-method",
    "This is the midpoint method: it samples half-way; Verlet uses both ends of the step.",
    midpoint,
)
known_8c(
    "midpoint-method",
    "This is the midpoint method: it stops after the second of the four samples.",
    midpoint,
)


known_8b(
    "old-half-alone",
    "v gets half of the old acceleration; the half of the one at the new x is missing.",
    verlet_with(bent(1.0), lambda old, new, dt: old * dt / 2),
)
known_8b(
    "new-half-alone",
    "v gets half of the acceleration at the new x; the half of the old one is missing.",
    verlet_with(bent(1.0), lambda old, new, dt: new * dt / 2),
)
known_8b(
    "mean-without-brackets",
    "Only one of the two accelerations is halved or multiplied by dt: put brackets around their "
    "sum, (old + new) / 2 * dt.",
    verlet_with(bent(1.0), lambda old, new, dt: old + new / 2 * dt),
    verlet_with(bent(1.0), lambda old, new, dt: (old + new / 2) * dt),
    verlet_with(bent(1.0), lambda old, new, dt: old + new * dt / 2),
    verlet_with(bent(1.0), lambda old, new, dt: old / 2 + new * dt),
    verlet_with(bent(1.0), lambda old, new, dt: old / 2 + new * dt / 2),
    verlet_with(bent(1.0), lambda old, new, dt: (old / 2 + new) * dt),
)
known_8b(
    "mean-by-the-square-of-the-step",
    "v changes by the mean * dt²; it is the mean * dt, without the square.",
    verlet_with(bent(1.0), lambda old, new, dt: (old + new) / 2 * dt**2),
)


def acceleration_returned(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    end = parabola(x, v, dt, accel)
    return end, accel(end)


known_8b(
    "acceleration-for-velocity",
    "The acceleration is returned in the place of v.",
    acceleration_returned,
)


def old_acceleration_of_v(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    end = x + v * dt + accel(v) * dt**2 / 2
    return end, v + (accel(v) + accel(end)) / 2 * dt


known_8b(
    "acceleration-of-the-velocity",
    "accel is asked about v; the acceleration depends on the position: accel(x).",
    old_acceleration_of_v,
)


# ---------------------------------------------------------------- 8c


def samples_that_lead_on(x: float, v: float, dt: float, force: Force) -> State:
    accel, place, speed = polynomial(force), x, v
    for share, weight in ((0.5, 1), (0.5, 2), (1.0, 2), (0.0, 1)):
        dx, dv = speed, accel(place)
        x, v = x + dt / 6 * weight * dx, v + dt / 6 * weight * dv
        place, speed = place + share * dt * dx, speed + share * dt * dv
    return x, v


known_8c(
    "samples-lead-on",
    "Each sample goes on from the place of the one before; all of them begin at x and v.",
    samples_that_lead_on,
)


def euler_in_x(x: float, v: float, dt: float, force: Force) -> State:
    _, end = right_models[RK4](x, v, dt, force)
    return x + end * dt, end


known_8c(
    "new-velocity-in-x",
    "x moves with the new velocity alone; it needs the four velocities, weighed as v is.",
    euler_in_x,
)
known_8c(
    "weights-are-swapped",
    "The first and the last sample count twice; it is the two in the middle that do: 1, 2, 2, 1.",
    weighed(USUAL, (2 / 6, 1 / 6, 1 / 6, 2 / 6)),
    apart=True,
)
known_8c(
    "mean-of-both-ends",
    "Only the start and the end are sampled; RK4 takes two samples in the middle as well.",
    weighed(WHOLE_STEPS, (1 / 2, 1 / 2, 0, 0)),
)
known_8c(
    "velocity-is-not-sampled",
    "Only the acceleration is sampled four times; each sample has a velocity of its own too.",
    weighed(USUAL, RIGHT_WEIGHTS, tuple((before, 0.0) for before, _ in USUAL)),
)
known_8c(
    "step-stays-halved",
    "dt is halved for the samples and stays so: the step covers only half of its time.",
    lambda x, v, dt, force: weighed(WHOLE_STEPS, RIGHT_WEIGHTS)(x, v, dt / 2, force),
)


def three_eighths(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    v1, a1 = v, accel(x)
    v2, a2 = v + dt * a1 / 3, accel(x + dt * v1 / 3)
    v3, a3 = v + dt * (a2 - a1 / 3), accel(x + dt * (v2 - v1 / 3))
    v4, a4 = v + dt * (a1 - a2 + a3), accel(x + dt * (v1 - v2 + v3))
    return x + dt / 8 * (v1 + 3 * v2 + 3 * v3 + v4), v + dt / 8 * (a1 + 3 * a2 + 3 * a3 + a4)


known_8c(
    "three-eighths",
    "This is the 3/8 rule, as good a method but another: RK4 samples the middle twice and weighs "
    "1, 2, 2, 1.",
    three_eighths,
)


# ---------------------------------------------------------------- a part left out, or typed in


TYPED = {"1/60": 1 / 60, "1/30": 1 / 30, "1/120": 1 / 120, "1/40": 1 / 40}
for todo, about in (("8a", SEMI_IMPLICIT), ("8b", VERLET), ("8c", RK4)):
    for words, seconds in TYPED.items():
        mistake(
            todo,
            about,
            f"step-of-{words.replace('/', '-')}",
            f"Every step is taken to last {words} s; it lasts dt.",
            lambda x, v, dt, force, about=about, seconds=seconds: right_models[about](
                x, v, seconds, force
            ),
        )
    mistake(
        todo,
        about,
        "velocity-returned-first",
        "The pair is the wrong way round: return x first, then v.",
        lambda x, v, dt, force, about=about: right_models[about](x, v, dt, force)[::-1],
    )
    mistake(
        todo,
        about,
        "x-is-not-moved",
        "x comes back as it was: it must move.",
        lambda x, v, dt, force, about=about: (x, right_models[about](x, v, dt, force)[1]),
    )
    mistake(
        todo,
        about,
        "v-is-not-changed",
        "v comes back as it was: the acceleration must change it.",
        lambda x, v, dt, force, about=about: (right_models[about](x, v, dt, force)[0], v),
    )


known_8a(
    "moves-a-whole-second",
    "x moves by v; in a step of dt seconds it moves by v * dt.",
    semi_implicit_with(lambda a, dt: a * dt, lambda v, dt: v),
)
known_8a(
    "acceleration-has-the-wrong-sign",
    "v changes the wrong way: add accel(x) * dt, whose sign says which way.",
    semi_implicit_with(lambda a, dt: -a * dt, lambda v, dt: v * dt),
)
known_8a(
    "velocity-is-not-used",
    "v does not change: add accel(x) * dt to it before x moves.",
    semi_implicit_with(lambda a, dt: 0.0, lambda v, dt: v * dt),
)


known_bend("square-is-missing-in-x")
known_kick("step-is-missing-in-v")
for bend_name, (bend_words, bend) in BENDS.items():
    for kick_name, (kick_words, kick) in KICKS.items():
        both = verlet_with(bend, kick)
        known_8b(f"{bend_name}+{kick_name}", f"{bend_words} Also: {kick_words}", both)


def changed_twice(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    begin = accel(x)
    v += begin * dt
    x += v * dt + begin * dt**2 / 2
    return x, v + (begin + accel(x)) / 2 * dt


known_8b(
    "velocity-changes-twice",
    "v changes twice: before x moves, and by the mean after it. Leave out the first.",
    changed_twice,
)


def speed_left_out(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    end = x + accel(x) * dt**2 / 2
    return end, v + (accel(x) + accel(end)) / 2 * dt


known_8b(
    "speed-is-missing-in-x",
    "x moves by the acceleration alone: v * dt is missing.",
    speed_left_out,
)


def second_at_v(x: float, v: float, dt: float, force: Force) -> State:
    accel = polynomial(force)
    return parabola(x, v, dt, accel), v + (accel(x) + accel(v)) / 2 * dt


known_8b(
    "acceleration-of-the-velocity",
    "The second acceleration is that at v; accel is asked about the new x.",
    second_at_v,
)


# ---------------------------------------------------------------- 8c: other samples, other weights

SAMPLES = "samples of accel"
truth(
    SAMPLES,
    places_of(USUAL),
    like,
    {f"the position of k{n + 1}": [n] for n in range(4)},
)
OTHER_SAMPLES: dict[str, tuple[str, tuple[Source, ...]]] = {
    "second-sample-at-full-step": (
        "The second sample, k2, is taken a whole step ahead; it belongs half-way.",
        ((0, 1.0), (1, 0.5), (2, 1.0)),
    ),
    "third-sample-at-full-step": (
        "The third sample, k3, is taken a whole step ahead; it belongs half-way.",
        ((0, 0.5), (1, 1.0), (2, 1.0)),
    ),
    "last-sample-at-half-step": (
        "The last sample is taken half-way; it belongs to the end of the step.",
        ((0, 0.5), (1, 0.5), (2, 0.5)),
    ),
    "middle-samples-at-full-step": (
        "All samples are taken a whole step ahead; the two in the middle belong half-way.",
        WHOLE_STEPS,
    ),
    "third-sample-repeats-the-second": (
        "The third sample starts from the first again; it must use what the second one found.",
        ((0, 0.5), (0, 0.5), (2, 1.0)),
    ),
    "last-sample-uses-the-second": (
        "The last sample, k4, goes on from the second; it must use what the third one found.",
        ((0, 0.5), (1, 0.5), (1, 1.0)),
    ),
    "every-sample-from-the-first": (
        "Every sample starts from the first one; each must use what the one before it found.",
        ((0, 0.5), (0, 0.5), (0, 1.0)),
    ),
}
OTHER_WEIGHTS: dict[str, tuple[str, tuple[tuple[float, ...], ...]]] = {
    "equal-weights": (
        "All four samples weigh the same; the two in the middle count twice: 1, 2, 2, 1.",
        ((1 / 4,) * 4, (1 / 6,) * 4),
    ),
    "sum-is-not-divided": (
        "The weighted sum is used as it is; the weights 1, 2, 2, 1 add up to 6, so divide by 6.",
        ((1.0, 2.0, 2.0, 1.0),),
    ),
    "third-sample-counts-once": (
        "The third sample, k3, counts once; it counts twice, like the second: 1, 2, 2, 1.",
        ((1 / 6, 2 / 6, 1 / 6, 1 / 6), (1 / 5, 2 / 5, 1 / 5, 1 / 5)),
    ),
    "second-sample-counts-once": (
        "The second sample, k2, counts once; it counts twice, like the third: 1, 2, 2, 1.",
        ((1 / 6, 1 / 6, 2 / 6, 1 / 6), (1 / 5, 1 / 5, 2 / 5, 1 / 5)),
    ),
    "divided-by-another-number": (
        "The weighted sum is divided by a number other than 6, which is what 1, 2, 2, 1 add up to.",
        tuple((1 / n, 2 / n, 2 / n, 1 / n) for n in (2, 3, 4, 5, 8)),
    ),
    "one-middle-sample-stands-twice": (
        "One of the two samples in the middle counts for both of them: k2 and k3 count 2 each.",
        ((1 / 6, 4 / 6, 0.0, 1 / 6), (1 / 6, 0.0, 4 / 6, 1 / 6)),
    ),
    "last-sample-is-missing": (
        "Only three samples count; the fourth, k4, at the end of the step, is missing.",
        ((1 / 5, 2 / 5, 2 / 5, 0.0), (1 / 6, 2 / 6, 2 / 6, 0.0), (1 / 4, 2 / 4, 1 / 4, 0.0)),
    ),
}
for sample_name, (sample_words, sources) in OTHER_SAMPLES.items():
    mistake("8c", SAMPLES, sample_name, sample_words, places_of(sources))
    known_8c(sample_name, sample_words, weighed(sources, RIGHT_WEIGHTS))
for weight_name, (weight_words, many) in OTHER_WEIGHTS.items():
    models = (weighed(USUAL, weights) for weights in many)
    known_8c(weight_name, weight_words, *models, apart=True)


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
            else f"of the {PLACES[number]} sample, k{number + 1}, goes on from the "
            f"{PLACES[source]}; it must use what the {PLACES[before]} one found."
        )
        other = (*USUAL[: number - 1], (source, share), *USUAL[number:])
        name = f"k{number + 1}-from-k{source + 1}-at-{share:g}"
        for part, places, speeds in (("position", other, USUAL), ("velocity", USUAL, other)):
            words = f"The {part} {told}"
            mistake("8c", SAMPLES, f"{part}-of-{name}", words, places_of(places, speeds))
            known_8c(f"{part}-of-{name}", words, weighed(places, RIGHT_WEIGHTS, speeds))


for number, (before, reach) in enumerate(USUAL, 1):
    other = (*USUAL[: number - 1], (number, reach), *USUAL[number:])
    known_8c(
        f"position-of-k{number + 1}-by-its-own-velocity",
        f"The position of the {PLACES[number]} sample, k{number + 1}, is moved by its own "
        f"velocity; it must be moved by that of the {PLACES[before]} one.",
        weighed(other, RIGHT_WEIGHTS, USUAL),
    )


def pairs_joined(x: float, v: float, dt: float, force: Force) -> State:
    return x + dt / 6 * v, v + dt / 6 * polynomial(force)(x)


known_8c(
    "pairs-are-joined",
    "Only the first sample counts, divided by 6. + joins two pairs to one of four numbers, and 2 * "
    "repeats a pair: add the velocities and the accelerations one by one.",
    pairs_joined,
)


def led_by_acceleration(x: float, v: float, dt: float, force: Force) -> tuple[float, ...]:
    """Return where the samples are taken when the acceleration leads there."""
    accel, places = polynomial(force), [x]
    for share in (0.5, 0.5, 1.0):
        places.append(x + share * dt * accel(places[-1]))
    return tuple(dict.fromkeys(places))


def each_from_the_last(x: float, v: float, dt: float, force: Force) -> tuple[float, ...]:
    """Return where the samples are taken when each goes on from the place of the one before."""
    accel, places, slope = polynomial(force), [x], v
    for share in (0.5, 0.5, 1.0):
        slope, place = v + share * dt * accel(places[-1]), places[-1] + share * dt * slope
        places.append(place)
    return tuple(dict.fromkeys(places))


mistake(
    "8c",
    SAMPLES,
    "acceleration-leads-to-the-places",
    "The place of a sample is moved by the acceleration of the one before; it is moved by its "
    "velocity.",
    led_by_acceleration,
)
mistake(
    "8c",
    SAMPLES,
    "each-sample-from-the-last-place",
    "Each sample goes on from the place of the one before; all of them start from x, where the "
    "step begins.",
    each_from_the_last,
)


# ---------------------------------------------------------------- a factor too much

FACTORS = (("half", "half of", 0.5), ("twice", "twice", 2.0), ("opposite", "the opposite of", -1.0))
for name, words, factor in FACTORS:
    known_8a(
        f"{name}-the-way",
        f"x moves by {words} v * dt; it moves by v * dt, with the new v.",
        semi_implicit_with(times(1.0), times(factor)),
    )
    if factor != 2.0:  # twice as much is half too little
        known_8b(
            f"{name}-the-bend",
            f"x bends by {words} a * dt² / 2; it bends by a * dt² / 2, with the old a.",
            verlet_with(bent(factor), mean_times(1.0)),
        )
        known_8b(
            f"{name}-the-mean",
            f"v changes by {words} the mean of both accelerations * dt; it is that mean * dt.",
            verlet_with(bent(1.0), mean_times(factor)),
        )


def sum_without_dt(x: float, v: float, dt: float, force: Force) -> State:
    samples = sampled(x, v, dt, force, USUAL)[0]
    for weight, (dx, dv) in zip(RIGHT_WEIGHTS, samples, strict=True):
        x, v = x + weight * dx, v + weight * dv
    return x, v


known_8c(
    "sum-without-the-step",
    "The mean of the samples is added as it is; a step of dt seconds adds it times dt.",
    sum_without_dt,
    apart=True,
)
