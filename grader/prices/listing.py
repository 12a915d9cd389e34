"""A price list: engines, those to compare with, and what was asked; kept as JSON."""

import platform
from collections.abc import Sequence
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.prices.front import error_for
from grader.prices.measure import Prices
from grader.prices.others import LESSON
from grader.prices.scenes import PASSES, RATE, Scene, Setting
from grader.report.files import write_whole

OPEN_TASK = "tower"  # the scene of the open task
LESS = 0.9  # of the lesson's error, at most: what the open task asks for


class Asked(Struct, frozen=True):
    """A scene, as a page tells of it."""

    id: str
    title: str
    error: str
    usual: str  # the setting that the lesson has


class PriceList(Struct, frozen=True):
    """What was measured, and by which Python: opcodes of another one are others."""

    python: str
    scenes: list[Asked]
    others: list[Prices]
    engines: list[Prices]

    def of(self, name: str) -> Prices | None:
        return next((each for each in self.engines if each.name == name), None)

    @property
    def lesson(self) -> Prices | None:
        return next((each for each in self.others if each.name == LESSON), None)

    def same_price(self, own: Prices, scene: Asked) -> tuple[float, float | None, int] | None:
        """The lesson's error and this engine's for as many opcodes, and how many they are."""
        points = self.lesson.curve(scene.id).points if self.lesson else []
        usual = next((each for each in points if each.setting == scene.usual), None)
        if usual is None:
            return None
        return usual.error, error_for(own.curve(scene.id), usual.opcodes), usual.opcodes

    def sinks_less(self, own: Prices) -> bool:
        """Whether this engine has done the open task."""
        for scene in self.scenes:
            if scene.id == OPEN_TASK and (found := self.same_price(own, scene)):
                theirs, mine, _ = found
                return mine is not None and mine <= LESS * theirs
        return False


def price_list(
    scenes: Sequence[Scene], others: Sequence[Prices], engines: Sequence[Prices]
) -> PriceList:
    """All of it, in an order that hangs on nothing but names."""
    return PriceList(
        python_name(),
        [Asked(each.id, each.title, each.error, usual_of(each).words) for each in scenes],
        list(others),
        sorted(engines, key=lambda each: each.name),
    )


def usual_of(scene: Scene) -> Setting:
    """The setting in which the lesson's engine comes."""
    return next(each for each in scene.settings if (each.rate, each.passes) == (RATE, PASSES))


def python_name() -> str:
    """The Python that counted, as far as its opcodes hang on it."""
    version = ".".join(platform.python_version_tuple()[:2])
    return f"{platform.python_implementation()} {version}"


# ---------------------------------------------------------------- as a file


def place_of(results: Path) -> Path:
    """Where the list of a class is, beside its folder of results."""
    results = results.resolve()
    return results.with_name(f"{results.name}.prices.json")


def write_list(prices: PriceList, results: Path) -> None:
    write_whole(as_json(prices), place_of(results))


def as_json(prices: PriceList) -> bytes:
    """Indented for people; the same bytes for the same engines, whoever measures."""
    return msgspec.json.format(msgspec.json.encode(prices)) + b"\n"


def read_list(results: Path) -> PriceList | None:
    """The list that was made last; None where nobody has measured."""
    try:
        return msgspec.json.decode(place_of(results).read_bytes(), type=PriceList)
    except (OSError, msgspec.MsgspecError):
        return None
