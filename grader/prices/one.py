"""The prices of one engine: measured, as a table, and as files."""

from pathlib import Path

from rich.console import Console
from rich.table import Table

from grader.judge.children import start_worker
from grader.judge.grade import Options
from grader.prices.chart import in_opcodes, in_px
from grader.prices.listing import Asked, PriceList, as_json, price_list
from grader.prices.measure import Curve, Prices, measure
from grader.prices.others import IN_C, LESSON, STABLE, lesson_in, others
from grader.prices.page import write_prices
from grader.prices.scenes import scenes
from grader.report.files import write_whole
from grader.text import clean

SHORT = {LESSON: "lesson", STABLE: "stable"}  # for the columns of a terminal


def price_one(path: Path, options: Options) -> tuple[PriceList, Prices]:
    """Measure the engine at `path`, and those to compare with; raises CannotGrade."""
    asked = scenes(options.seed)
    worker = start_worker()
    try:
        own = measure(path, asked, options, worker)
        beside = others(asked, options, worker, path)
    finally:
        worker.close()
    prices = own.checked(lesson_in(beside))
    return price_list(asked, [each.prices for each in beside], [prices]), prices


def write_one(prices: PriceList, own: Prices, folder: Path) -> list[Path]:
    """The curves as a page, and as JSON."""
    page, data = (folder / f"{own.name}.prices.{suffix}" for suffix in ("html", "json"))
    write_prices(prices, own.name, page, own.name)
    write_whole(as_json(prices), data)
    return [page, data]


# ---------------------------------------------------------------- for people


def show(prices: PriceList, own: Prices, console: Console) -> None:
    """A table for each scene, and what the lesson's opcodes buy."""
    console.print(f"Opcodes of {prices.python} per simulated second, and the error.")
    for scene in prices.scenes:
        console.print()
        console.print(f"{scene.title}: {scene.error}")
        curve = own.curve(scene.id)
        if curve.points:
            console.print(table_of(prices, scene, curve))
        if curve.gave_up:
            console.print(f"gave up: {clean(curve.gave_up)}", soft_wrap=True)
        if curve.points and (found := prices.same_price(own, scene)):
            theirs, mine, opcodes = found
            words = "nothing so cheap" if mine is None else in_px(mine)
            told = f"For the lesson's {in_opcodes(opcodes)} opcodes: lesson {in_px(theirs)}"
            console.print(f"{told}, this engine {words}.")


def table_of(prices: PriceList, scene: Asked, own: Curve) -> Table:
    """A row for each setting: this engine, then the others; of those in C the error alone."""
    table = Table("setting", "opcodes", "error", box=None, padding=(0, 2, 0, 0))
    rows = [[each.setting, in_opcodes(each.opcodes), in_px(each.error)] for each in own.points]
    for other in prices.others:
        points = {each.setting: each for each in other.curve(scene.id).points}
        counted = other.name not in IN_C
        if counted:
            table.add_column(SHORT.get(other.name, other.name))
        table.add_column("error" if counted else other.name)
        for row in rows:
            point = points.get(row[0])
            row += [in_opcodes(point.opcodes) if point else "-"] * counted
            row.append(in_px(point.error) if point else "-")
    for row in rows:
        table.add_row(*row)
    return table
