"""Every question put to every setting, with what each answer cost and which dials help."""

import math

from .costs import opcodes_per_second, repeated_times, shares
from .dials import LESSON, QUESTIONS, dials

EXACT = 1e-9  # errors below this need no dial
FRAMES = 60  # per second
HELPS = 0.05  # a dial whose whole range changes the error by a smaller share cannot help


class Effort:
    """How much work a study may do."""

    def __init__(self, quick=False, scale=1.0):
        self.quick, self.scale = quick, scale
        self.repeats = 3 if quick else 5  # of each time
        self.rounds = 1 if quick else 4  # in a repeat

    def seconds(self, question):
        return self.scale * question.seconds


def study(name, effort, tick=lambda setting: None):
    """The answers to one question: its runs, and what each dial does to each error."""
    question, rows = QUESTIONS[name], dials(effort.quick)
    settings = list(dict.fromkeys(setting for _, _, row in rows for _, setting in row))
    runs = []
    for setting in settings:
        tick(setting)
        runs.append(answer(question, setting, effort))
    price(runs, settings, effort)
    for run in runs:
        del run["in motion"]
    return {
        "title": question.title,
        "seconds": effort.seconds(question),
        "units": question.units,
        "runs": runs,
        "dials": [
            dial_row(engine, dial, row, runs, settings, question.units, question.chance or HELPS)
            for engine, dial, row in rows
        ],
    }


def answer(question, setting, effort):
    """One run: its setting, its errors by name, and the engine in motion."""
    engine = setting.build(question.scene())
    try:
        errors = question.ask(engine, effort.seconds(question), setting.dt)
    except ValueError:  # the engines refuse to go on with NaN
        errors = dict.fromkeys(question.units, "NaN")
    except Exception as problem:  # a student's code
        errors = dict.fromkeys(question.units, type(problem).__name__)
    known = {name: error if usable(error) else "NaN" for name, error in errors.items()}
    return {
        "engine": setting.engine,
        "rate": setting.rate,
        "passes": None if setting.engine == "stable" else setting.passes,
        "substeps": setting.substeps,
        "edits": list(setting.edits),
        "default": setting == LESSON,
        "errors": known,
        "in motion": engine,
    }


def usable(error):
    return isinstance(error, str) or math.isfinite(error)


def price(runs, settings, effort):
    """Add to each run what it costs from its last state on: ms of each frame in every repeat.

    Opcodes are counted first: the clock runs the engines on, and by how much is its own affair.
    """
    for run, setting in zip(runs, settings, strict=True):
        engine = run["in motion"]
        run["solves"] = setting.solves(engine)
        python = setting.engine in ("lesson", "stable")
        run["opcodes"] = opcodes_per_second(engine, setting.dt) if python else None
    going = [(run["in motion"], s.dt) for run, s in zip(runs, settings, strict=True)]
    taken = repeated_times(going, effort.repeats, effort.rounds)
    unit = taken[settings.index(LESSON)]
    for run, times in zip(runs, taken, strict=True):
        run["ms"] = milliseconds(times)
        run["ratio"] = shares(times, unit)


def milliseconds(times):
    """Times in s as ms of each frame, or None."""
    return None if times is None else [1000 * seconds / FRAMES for seconds in times]


# ---------------------------------------------------------------- what a dial does


def dial_row(engine, dial, row, runs, settings, units, helps=HELPS):
    """The runs of one dial, by their place, and its verdict for each error."""
    places = [settings.index(setting) for _, setting in row]
    return {
        "engine": engine,
        "dial": dial,
        "values": [str(value) for value, _ in row],
        "runs": places,
        "verdicts": {name: verdict(name, [runs[i] for i in places], helps) for name in units},
    }


def work(run):
    """The least and the most that a run costs, to compare within one engine.

    In opcodes, which repeat, or else in time.
    """
    if run["opcodes"]:
        return [run["opcodes"], run["opcodes"]]
    return run["ratio"] and [run["ratio"][0], run["ratio"][-1]]


def verdict(name, runs, helps=HELPS):
    """What the dial does to that error, and what one more digit costs: factors of work, or None.

    They are the least and the most that may lie between the first and the last value of the dial,
    carried on (or back) to an error ten times smaller. helps is the share of an error below which
    a change says nothing.
    """
    known = [(run["errors"][name], work(run)) for run in runs]
    known = [pair for pair in known if not isinstance(pair[0], str) and pair[1]]
    if len(known) < 2:
        return {"says": "gives up", "digit": None}
    (first, (least, most)), *_, (last, (cheapest, dearest)) = known
    first, last = max(first, 1e-16), max(last, 1e-16)
    if max(first, last) < EXACT:
        return {"says": "exact already", "digit": None}
    if abs(first - last) / max(first, last) < helps:
        return {"says": "cannot help", "digit": None}
    if last > first:
        return {"says": "no steady gain", "digit": None}
    digits = math.log10(first / last)
    dearer = [cheapest / most, dearest / least]
    return {"says": "helps", "digit": [max(one, 1.0) ** (1 / digits) for one in dearer]}


def best_dial(found, name, engine="lesson"):
    """The dial of an engine with the cheapest digit for that error, and those that cannot help."""
    rows = [row for row in found["dials"] if row["engine"] == engine]
    helping = [row for row in rows if row["verdicts"][name]["says"] == "helps"]
    best = min(helping, key=lambda row: row["verdicts"][name]["digit"], default=None)
    useless = [row["dial"] for row in rows if row["verdicts"][name]["says"] == "cannot help"]
    return best, useless
