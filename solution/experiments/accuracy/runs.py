"""Run questions in many settings: measure the error and cost of each, and compare them."""

import math
from dataclasses import asdict, dataclass, replace

from ..measures import finite
from .costs import opcodes_per_second, repeated_times, spread, time_slice
from .questions import LESSON, QUESTIONS, dials, families

EXACT = 1e-9  # smaller errors count as equal
HELPS = 0.05  # a dial that changes the error by a smaller share cannot help
FRAMES = 60  # per second
BUDGETS, QUICK_BUDGETS = (1.0, 4.0, 16.0), (1.0,)  # ms of each frame
TOO_SLOW = 1.3  # a setting that exceeds the largest budget by this factor is not run
MOST_DOUBLINGS = 13  # of substeps, from one on


@dataclass
class Effort:
    """Limits on the work of a study."""

    quick: bool = False
    scale: float = 1.0  # share of the simulated time

    @property
    def budgets(self):
        return QUICK_BUDGETS if self.quick else BUDGETS


def run_setting(question, setting, effort):
    """Run a question once. Return its error, and the running engine to be timed."""
    engine = setting.build(question.scene())
    try:
        error = question.ask(engine, effort.scale * question.seconds, setting.dt)
        if is_number(error) and not (math.isfinite(error) and finite(engine)):
            error = "NaN"
    except ValueError:  # the engines refuse to go on with NaN
        error = "NaN"
    except Exception as problem:  # a student's code
        error = type(problem).__name__
    about = {"setting": str(setting), **asdict(setting)}
    return {**about, "error": error, "in motion": engine}


def add_times(runs, effort):
    """Add to each run its ms per frame in every repeat, timed from its last state on."""
    going = [(run.pop("in motion"), 1 / run["rate"]) for run in runs]
    repeats, rounds = (3, 1) if effort.quick else (5, 4)  # rounds: slices of time in a repeat
    for run, times in zip(runs, repeated_times(going, repeats, rounds), strict=True):
        run["ms"] = times and [1000 * seconds / FRAMES for seconds in times]


def is_number(value):
    return not isinstance(value, str)


def study_dials(name, effort, tick=lambda engine: None):
    """Ask one question of every value of every dial of the lesson's engine.

    Work is counted in opcodes, relative to the default dials.
    """
    question, rows, runs = QUESTIONS[name], dials(effort.quick), {}
    for setting in dict.fromkeys(setting for row in rows.values() for setting in row.values()):
        tick("dials")
        runs[setting] = run_setting(question, setting, effort)
        engine = runs[setting].pop("in motion")
        runs[setting]["opcodes"] = opcodes_per_second(engine, setting.dt)
    whole = runs[LESSON]["opcodes"]
    for run in runs.values():
        run["work"] = run["opcodes"] / whole if whole and run["opcodes"] else None
    found = []
    for dial, row in rows.items():
        tried = [{"value": str(value), **runs[setting]} for value, setting in row.items()]
        found.append({"dial": dial, "runs": tried, "verdict": judge(tried)})
    return {**describe(question, effort), "dials": found}


def describe(question, effort):
    about = {"title": question.title, "error": question.error, "unit": question.unit}
    return about | {"seconds": effort.scale * question.seconds}


def judge(runs):
    """Return the effect of a dial on the error, and the factor of work for a tenth of the error.

    The first and the last value of the dial decide. The factor is extrapolated to an error ten
    times smaller, and is None if the dial does not help.
    """
    known = [(run["error"], run["work"]) for run in runs]
    known = [pair for pair in known if is_number(pair[0]) and pair[1]]
    if len(known) < 2:
        return {"says": "gives up", "digit": None}
    (first, cheap), *_, (last, dear) = known
    first, last = max(first, 1e-16), max(last, 1e-16)
    if max(first, last) < EXACT:
        return {"says": "exact already", "digit": None}
    if abs(first - last) / max(first, last) < HELPS:
        return {"says": "cannot help", "digit": None}
    if last > first:
        return {"says": "no steady gain", "digit": None}
    return {"says": "helps", "digit": max(dear / cheap, 1.0) ** (1 / math.log10(first / last))}


def study_budgets(name, effort, tick=lambda engine: None):
    """Ask each engine one question with 1, 2, 4 ... substeps, while they fit into a frame."""
    question, runs = QUESTIONS[name], []
    for engine, settings in families().items():
        tick(engine)
        for setting in settings:
            runs += climb(question, setting, effort)
    add_times(runs, effort)
    within = {
        engine: [{"budget": ms, "picks": find_least(runs, engine, ms)} for ms in effort.budgets]
        for engine in families()
    }
    return {**describe(question, effort), "runs": runs, "within": within}


def climb(question, setting, effort):
    """Run a setting with 1, 2, 4 ... substeps, up to the first that takes far too long.

    A fall may take no longer with more.
    """
    runs = []
    for doublings in range(MOST_DOUBLINGS + 1):
        higher = replace(setting, substeps=2**doublings)
        trial = higher.build(question.scene())
        taken = [time_slice(trial, higher.dt) for _ in range(3)]
        gave_up = None in taken
        if not gave_up and 1000 * min(taken) / FRAMES > TOO_SLOW * effort.budgets[-1]:
            return runs
        runs.append(run_setting(question, higher, effort))
        if gave_up:
            return runs
    return runs


def find_least(runs, engine, budget):
    """Return an engine's least error in `budget` ms a frame, with its setting.

    There are three answers, by the times of the fastest, the middle and the slowest repeat.
    """
    ours = [run for run in runs if run["engine"] == engine]
    picked = [pick_within(ours, budget, which) for which in range(3)]
    return [{key: run.get(key) for key in ("setting", "error")} for run in picked]


def pick_within(runs, budget, which):
    """Return the run with the smallest error within `budget`.

    If none has a number, return the last that fits, or "too slow" as the error if none does.
    `which` is 0 for the fastest repeat, 1 for the middle, 2 for the slowest.
    """
    fitting = [run for run in runs if run["ms"] and spread(run["ms"])[which] <= budget]
    known = [run for run in fitting if is_number(run["error"])]
    fallback = (fitting or [{"error": "too slow"}])[-1]
    return min(known, key=lambda run: run["error"], default=fallback)
