"""Runs of questions in many settings: what error each has, what it costs, and what follows."""

import math
from dataclasses import asdict, dataclass, replace
from itertools import count

from .costs import opcodes_per_second, repeated_times, shares, spread, time_slice
from .measures import finite
from .questions import DIALS, LADDERS, LESSON, dials, families

EXACT = 1e-9  # errors below this are all the same
HELPS = 0.05  # a dial that changes the error by a smaller share cannot help
FRAMES = 60  # per second
BUDGETS, QUICK_BUDGETS = (1.0, 4.0, 16.0), (1.0,)  # ms of each frame
TOO_SLOW = 1.3  # a setting that exceeds the largest budget by this factor is not run


@dataclass
class Effort:
    """The greatest amount of work in a study."""

    quick: bool = False
    scale: float = 1.0  # share of the simulated time

    @property
    def repeats(self):
        """Return the number of repeats of each time."""
        return 3 if self.quick else 5

    @property
    def rounds(self):
        """Return the number of slices of time in a repeat."""
        return 1 if self.quick else 4

    @property
    def budgets(self):
        return QUICK_BUDGETS if self.quick else BUDGETS


def run_setting(question, setting, effort):
    """Run a question once. Return its error, and the engine in motion for the clock."""
    engine = setting.build(question.scene())
    try:
        error = question.ask(engine, effort.scale * question.seconds, setting.dt)
        if is_number(error) and not (math.isfinite(error) and finite(engine)):
            error = "NaN"
    except ValueError:  # the engines refuse to go on with NaN
        error = "NaN"
    except Exception as problem:  # a student's code
        error = type(problem).__name__
    return {**asdict(setting), "error": error, "in motion": engine}


def add_costs(runs, effort, count_opcodes=False):
    """Add to each run what it costs from its last state on: ms of a frame in every repeat.

    Opcodes are counted first, as the clock moves the engines on.
    """
    going = [(run.pop("in motion"), 1 / run["rate"]) for run in runs]
    if count_opcodes:
        for run, (engine, dt) in zip(runs, going, strict=True):
            in_python = run["engine"] in ("lesson", "stable")
            run["opcodes"] = opcodes_per_second(engine, dt) if in_python else None
    for run, times in zip(runs, repeated_times(going, effort.repeats, effort.rounds), strict=True):
        run["ms"] = as_milliseconds(times)


def as_milliseconds(times):
    """Convert times in s per second to ms per frame. None stays None."""
    return None if times is None else [1000 * seconds / FRAMES for seconds in times]


def is_number(value):
    return not isinstance(value, str)


def study_dials(name, effort, tick=lambda engine: None):
    """Ask one question of every value of every dial."""
    question, rows = DIALS[name], dials(effort.quick)
    settings = list(dict.fromkeys(setting for *_, row in rows for setting in row.values()))
    runs = []
    for setting in settings:
        tick(setting.engine)
        runs.append(run_setting(question, setting, effort))
    add_costs(runs, effort, count_opcodes=True)
    default = runs[settings.index(LESSON)]
    for run in runs:
        run["ratio"] = shares(run["ms"], default["ms"])
    found = []
    for engine, dial, row in rows:
        places = [settings.index(setting) for setting in row.values()]
        verdict = judge([runs[i] for i in places])
        found.append({"engine": engine, "dial": dial, "runs": places, "verdict": verdict})
        found[-1]["values"] = [str(value) for value in row]
    return {**describe(question, effort), "runs": runs, "dials": found, "default": default}


def describe(question, effort):
    about = {"title": question.title, "error": question.error, "unit": question.unit}
    return about | {"seconds": effort.scale * question.seconds}


def judge(runs):
    """Say what a dial does to the error, and what one more digit costs: factors of work, or None.

    They are the least and the most that may lie between the first and the last value of the dial,
    carried on (or back) to an error ten times smaller.
    """
    known = [(run["error"], get_work(run)) for run in runs]
    known = [pair for pair in known if is_number(pair[0]) and pair[1]]
    if len(known) < 2:
        return {"says": "gives up", "digit": None}
    (first, (least, most)), *_, (last, (cheapest, dearest)) = known
    first, last = max(first, 1e-16), max(last, 1e-16)
    if max(first, last) < EXACT:
        return {"says": "exact already", "digit": None}
    if abs(first - last) / max(first, last) < HELPS:
        return {"says": "cannot help", "digit": None}
    if last > first:
        return {"says": "no steady gain", "digit": None}
    factors = [cheapest / most, dearest / least]
    digits = math.log10(first / last)
    return {"says": "helps", "digit": [max(factor, 1.0) ** (1 / digits) for factor in factors]}


def get_work(run):
    """Return the least and the most that a run costs: in opcodes, or else in time."""
    if run["opcodes"]:
        return [run["opcodes"], run["opcodes"]]
    return run["ratio"] and [run["ratio"][0], run["ratio"][-1]]


def study_budgets(name, effort, tick=lambda engine: None):
    """Ask one question of every engine at ever more substeps, as long as a frame has time."""
    question = LADDERS[name]
    runs = []
    for engine, settings in families().items():
        tick(engine)
        for setting in settings:
            runs += climb(question, setting, effort)
    add_costs(runs, effort)
    within = {
        engine: [find_least(runs, engine, ms) | {"budget": ms} for ms in effort.budgets]
        for engine in families()
    }
    return {**describe(question, effort), "runs": runs, "within": within}


def climb(question, setting, effort):
    """Run a setting with 1, 2, 4 ... substeps, up to the first that takes far too long."""
    runs = []
    for doublings in count():
        higher = replace(setting, substeps=2**doublings)
        trial = higher.build(question.scene())
        taken = [time_slice(trial, higher.dt) for _ in range(3)]
        gave_up = None in taken
        if not gave_up and 1000 * min(taken) / FRAMES > TOO_SLOW * effort.budgets[-1]:
            return runs
        runs.append(run_setting(question, higher, effort))
        if gave_up:
            return runs


def find_least(runs, engine, budget):
    """Return the smallest error of an engine in so many ms a frame, and its range over repeats."""
    ours = [run for run in runs if run["engine"] == engine]
    fast, middle, slow = (least_within(ours, budget, which) for which in range(3))
    return {"error": middle, "range": [fast, slow]}


def least_within(runs, budget, which):
    """Return the smallest error of the runs that fit, or a word: how they gave up, or too slow.

    which is that of the three times that spread gives of a run.
    """
    fitting = [run["error"] for run in runs if run["ms"] and spread(run["ms"])[which] <= budget]
    return min(filter(is_number, fitting), default=(fitting or ["too slow"])[-1])
