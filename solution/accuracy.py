"""What accuracy costs in time: your engine and integrators, the stable engine, pymunk, Box2D.

Every scene has an exact answer. The program turns each dial of each engine, and tells how far the
answer is off and what the run costs. It prints tables and writes them with figures into a folder:

    python accuracy.py            takes some minutes
    python accuracy.py --quick    takes half a minute: the same runs, with fewer values of each dial
    python accuracy.py --again    writes tables and figures of the last run anew

Figures need matplotlib; everything else works without it.
"""

import argparse
import json
import platform
import re
import shutil
import sys
from pathlib import Path

from experiments import accuracy_tables, budgets, figures, race, smooth, statements
from experiments.answers import Effort, study
from experiments.charts import all_charts, rounded
from experiments.compiled import time_compiled
from experiments.dials import QUESTIONS, dials, questions
from experiments.table import Progress, write_markdown

BALLS, QUICK_BALLS = (8, 40, 200, 1000), (8,)  # in piles
WEIGHTS = {"lesson": 1.0, "stable": 0.4, "pymunk": 0.03, "box2d": 0.03}  # of a solve, roughly
CHAIN_WEIGHT = 3e5  # of one engine
SMOOTH_WEIGHT = 4e5  # of one system of the integrators
FIGURES = "To draw the figures, install matplotlib: python -m pip install matplotlib"


# ---------------------------------------------------------------- measuring


def measure(effort, balls, progress):
    """All results, as plain lists and dictionaries."""
    return {
        "about": about(effort),
        "budgets": {name: measure_budgets(name, effort, progress) for name in budgets.SCENES},
        "chain": measure_chain(effort, progress),
        "smooth": measure_smooth(effort, progress),
        "dials": {name: measure_dials(name, effort, progress) for name in questions(effort.quick)},
        "piles": [measure_pile(count, effort, progress) for count in balls],
        "same step": [measure_same_step(n, effort, progress) for n in same_step_balls(balls)],
    }


def measure_budgets(name, effort, progress):
    def tick(engine):
        progress.step(budget_weight(effort), f"{budgets.SCENES[name].title}, {engine} in a frame")

    return budgets.study(name, effort, tick)


def measure_chain(effort, progress):
    def tick(engine):
        progress.step(CHAIN_WEIGHT, f"the energy of a chain, {engine}")

    return budgets.chain_energy(effort, tick)


def measure_smooth(effort, progress):
    most = effort.scale * 1e6  # steps
    systems = []
    for make in smooth.SYSTEMS:
        system = make()
        progress.step(SMOOTH_WEIGHT, f"integrators, {system.title}")
        systems.append(smooth.study(system, most=most))
    return {"systems": systems, "energy": smooth.energy_study(), "fall": smooth.fall_study()}


def measure_dials(name, effort, progress):
    question = QUESTIONS[name]

    def tick(setting):
        progress.step(weight(question, setting, effort), f"{question.title}, {setting.engine}")

    return study(name, effort, tick)


def measure_pile(count, effort, progress):
    def tick(who):
        progress.step(pile_weight(count), f"pile of {count} balls, {who}")

    return race.pile_row(count, effort, tick)


def measure_same_step(count, effort, progress):
    def tick(who):
        progress.step(pile_weight(count), f"pile of {count} balls, the same step, {who}")

    return race.same_step(count, effort, tick)


def same_step_balls(balls):
    """The piles that are also run step for step beside pymunk: all but the smallest."""
    return balls[1:] or balls


def about(effort):
    """What was run, so that two results can be told apart."""
    return {
        "python": platform.python_version(),
        "machine": platform.machine(),
        "quick": effort.quick,
        "scale": effort.scale,
    }


# ---------------------------------------------------------------- how long it takes


def weight(question, setting, effort):
    """Roughly how much work a run is, in passes over one ball."""
    moving = len(question.scene().moving())
    steps = effort.seconds(question) * setting.rate * setting.substeps
    return steps * (moving + 1) * (setting.passes + 10) * WEIGHTS[setting.engine]


def budget_weight(effort):
    return 3e5 if effort.quick else 4e6


def pile_weight(count):
    return 2e3 * count


def total_weight(effort, balls):
    """The whole program's work."""
    work = SMOOTH_WEIGHT * len(smooth.SYSTEMS)
    for question in [QUESTIONS[name] for name in questions(effort.quick)]:
        settings = {setting for _, _, row in dials(effort.quick) for _, setting in row}
        work += sum(weight(question, setting, effort) for setting in settings)
    work += len(budgets.SCENES) * len(budgets.families()) * budget_weight(effort) + 4 * CHAIN_WEIGHT
    same = (len(race.SAME_STEP) + 3) * sum(map(pile_weight, same_step_balls(balls)))
    return work + 5 * sum(map(pile_weight, balls)) + same


# ---------------------------------------------------------------- the program


def main(arguments=None):
    options = read(arguments)
    effort = Effort(options.quick, options.scale)
    balls = QUICK_BALLS if options.quick else BALLS
    balls = balls[:1] if options.scale < 1 else balls
    options.out.mkdir(parents=True, exist_ok=True)
    progress = Progress(total_weight(effort, balls))
    saved = options.out / "results.json"
    if options.again:
        results = json.loads(saved.read_text(encoding="utf-8"))
    else:
        results = measure(effort, balls, progress)
        progress.end()
    results["statements"] = statements.of_accuracy(results)
    saved.write_text(json.dumps(results, indent=1, allow_nan=False), encoding="utf-8")
    for table in accuracy_tables.all_tables(results):
        print(table.text())
    if options.no_figures:
        print(f"Results are in {options.out}.")
    else:
        draw(results, options.out, progress)
    if options.markdown:
        tables = accuracy_tables.short_tables(results)
        charts = charts_shown(results, options.markdown)
        write_markdown(options.markdown, tables, results["statements"], charts=charts)
        copy_figures(options.out, options.markdown)


def draw(results, folder, progress):
    """Draw the figures, or say what they need."""
    try:
        names = figures.draw_all(results, folder, lambda name: progress.step(0, f"drawing {name}"))
    except ImportError:
        print(f"Results are in {folder}. {FIGURES}")
        return
    progress.end()
    print(f"Results and {len(names)} figures are in {folder}.")


def copy_figures(folder, handout):
    """Bring the figures that a handout shows to where it shows them."""
    for name in figures_shown(handout):
        if (folder / name).exists():
            place = handout.parent / "figures" / f"accuracy-{name}"
            place.parent.mkdir(exist_ok=True)
            shutil.copyfile(folder / name, place)


def charts_shown(results, handout):
    """The charts behind the figures that a handout shows, by the names of the figures."""
    names = figures_shown(handout)
    return {
        f"accuracy-{name}": rounded(chart)
        for name, chart in all_charts(results)
        if f"{name}.svg" in names
    }


def figures_shown(handout):
    """The names of this program's SVG figures that a handout shows, as in the results' folder."""
    text = handout.read_text(encoding="utf-8") if handout.exists() else ""
    return re.findall(r"figures/accuracy-([\w-]+\.svg)", text)


def read(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer values per dial, no pile")
    parser.add_argument("--no-figures", action="store_true", help="tables and results only")
    parser.add_argument("--again", action="store_true", help="only write anew what DIR has")
    parser.add_argument("--out", type=Path, default=Path("build/accuracy"), metavar="DIR")
    parser.add_argument(
        "--markdown", type=Path, metavar="FILE", help="put tables between the markers of FILE"
    )
    parser.add_argument(
        "--scale", type=float, default=1.0, help="share of the simulated time to run, for a trial"
    )
    options = parser.parse_args(arguments)
    if not 0 < options.scale <= 1:
        parser.error(f"--scale is {options.scale}, but it must be above 0 and at most 1.")
    return options


if __name__ == "__main__":
    print(time_compiled())
    sys.exit(main())
