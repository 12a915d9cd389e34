"""A price list as a page, and as a part of other pages: of a class, and of one student."""

from functools import cache
from pathlib import Path

from markupsafe import Markup

from grader.player.page import as_data, environment, filled, one_line
from grader.prices import chart
from grader.prices.listing import PriceList
from grader.report.files import write_whole

TEMPLATES = Path(__file__).with_name("templates")


def write_prices(prices: PriceList, title: str, path: Path, own: str = "") -> None:
    """Write the page of a class, or of one engine."""
    script = "" if own else js()
    page = filled(
        TEMPLATES / "prices.html",
        css(),
        *([script] if script else []),
        title=title,
        section=section(prices, own),
        script=Markup(script),
        clean=one_line,
    )
    write_whole(page.encode("utf-8"), path)


def section(prices: PriceList, own: str = "") -> Markup:
    """The curves of all, or of `own` and those to compare with.

    The page around them needs `css`, and where it shows all of them, `js`.
    """
    drawn = chart.charts(prices, own)
    template = environment(TEMPLATES).get_template("section.html")
    return Markup(
        template.render(
            list=prices,
            own=own,
            charts=drawn,
            data=as_data([[*map(said, [*each.lines, *each.edge])] for each in drawn]),
            width=chart.WIDTH,
            height=chart.HEIGHT,
            left=chart.LEFT,
            right=chart.RIGHT,
            top=chart.TOP,
            bottom=chart.BOTTOM,
            edge=chart.EDGE,
            opcodes=chart.in_opcodes,
            px=chart.in_px,
            clean=one_line,
        )
    )


def said(line: chart.Line) -> dict[str, object]:
    """What the script tells of one engine, in words that are text as all others are."""
    return {
        "name": one_line(line.name),
        "places": line.places,
        "words": [*map(one_line, line.words)],
    }


@cache
def css() -> str:
    return (TEMPLATES / "prices.css").read_text(encoding="utf-8")


@cache
def js() -> str:
    return (TEMPLATES / "prices.js").read_text(encoding="utf-8")
