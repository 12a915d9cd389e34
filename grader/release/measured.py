"""Write the numbers of handouts/results.json that the figures of the measured pages show."""

import json
from collections.abc import Mapping
from typing import Any

BALLS = (10, 40, 200)
PIECES = (  # cost of all effects that may run at once, of a step
    "move only",
    "contacts",
    "friction",
    "bounce",
    "10 rods",
    "10 springs",
    "damping",
    "10 bullets, slow",
    "sleep, all awake",
)


def make_script(results: Mapping[str, Mapping[str, Any]]) -> str:
    data = {
        "prices": read_prices(results["effects.md"]),
        "charts": results["charts"],
    }
    return f'"use strict";\n\nconst measured = {json.dumps(data, indent=1)};\n'


def read_prices(lines: Mapping[str, float]) -> dict[str, dict[str, float]]:
    """Return the cost of each piece of a step in opcodes, by the number of balls in the pile."""
    return {
        str(balls): {piece: lines[f"{balls} balls, {piece}: price in opcodes"] for piece in PIECES}
        for balls in BALLS
    }
