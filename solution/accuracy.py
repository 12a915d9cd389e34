"""Measure what accuracy costs: your engine and integrators, the stable engine, pymunk, Box2D.

Every scene has an exact answer. The program gives each engine more and more time, turns each dial
of yours, and measures how far the answer is off and what the run costs. It prints tables and writes
them with figures to a folder:

    python accuracy.py            takes some minutes
    python accuracy.py --quick    takes half a minute: the same runs, with fewer values of each dial

Figures need matplotlib; everything else works without it.
"""

import argparse
import json
import platform
import re
import shutil
import sys
from pathlib import Path

from experiments.accuracy.charts import make_charts, round_numbers
from experiments.accuracy.crowds import CROWDS, choose_settings, study_crowd
from experiments.accuracy.questions import QUESTIONS, dials, families
from experiments.accuracy.runs import Effort, study_budgets, study_dials
from experiments.accuracy.smooth import study_energy, study_spring
from experiments.accuracy.tables import make_lines, make_tables
from experiments.compiled import time_compiled
from experiments.figures import draw_figures
from experiments.table import Progress, write_markdown

STEPS = 1e6  # at most, of an integrator


def measure(effort, crowds, progress):
    """Return all results, as plain lists and dictionaries."""

    def tick(title):
        return lambda engine: progress.step(1, f"{title}, {engine}")

    tick("integrators")("spring")
    smooth = {"spring": study_spring(most=effort.scale * STEPS), "energy": study_energy()}
    return {
        "about": {"python": platform.python_version(), "machine": platform.machine()},
        "budgets": {name: study_budgets(name, effort, tick(name)) for name in QUESTIONS},
        "smooth": smooth,
        "dials": {name: study_dials(name, effort, tick(name)) for name in QUESTIONS},
        "crowds": [study_crowd(each, effort, tick(each.title)) for each in crowds],
    }


def count_runs(effort, crowds):
    """Return how often measuring ticks."""
    turned = len({setting for row in dials(effort.quick).values() for setting in row.values()})
    each = len(families()) + turned
    return 1 + len(QUESTIONS) * each + len(crowds) * len(choose_settings())


def main(arguments=None):
    options = read(arguments)
    effort = Effort(options.quick, options.scale)
    crowds = CROWDS[:1] if options.quick else CROWDS
    options.out.mkdir(parents=True, exist_ok=True)
    progress = Progress(count_runs(effort, crowds))
    results = measure(effort, crowds, progress)
    progress.end()
    results["lines"] = make_lines(results)
    text = json.dumps(results, indent=1, allow_nan=False)
    (options.out / "results.json").write_text(text, encoding="utf-8")
    tables = make_tables(results)
    for table in tables:
        print(table.text())
    print(f"Results are in {options.out}.")
    if not options.no_figures:
        print(draw_figures(make_charts(results), options.out))
    if options.markdown:
        charts = choose_charts(results, options.markdown)
        write_markdown(options.markdown, tables, results["lines"], charts=charts)
        copy_figures(options.out, options.markdown)


def choose_charts(results, handout):
    """Return the charts of the figures that a handout shows, by the names of the figures."""
    names, charts = find_figures(handout), make_charts(results)
    return {f"accuracy-{n}": round_numbers(chart) for n, chart in charts if f"{n}.svg" in names}


def copy_figures(folder, handout):
    """Copy the figures that a handout shows to its folder of figures."""
    for name in find_figures(handout):
        if (folder / name).exists():
            target = handout.parent / "figures" / f"accuracy-{name}"
            target.parent.mkdir(exist_ok=True)
            shutil.copyfile(folder / name, target)


def find_figures(handout):
    """Return the names of this program's SVG figures that a handout shows."""
    text = handout.read_text(encoding="utf-8") if handout.exists() else ""
    return re.findall(r"figures/accuracy-([\w-]+\.svg)", text)


def read(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer values per dial, one pile")
    parser.add_argument("--no-figures", action="store_true", help="tables and results only")
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
