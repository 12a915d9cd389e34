"""All settings."""

from typing import Final

WIDTH: Final = 900
HEIGHT: Final = 600
STEP: Final = 1 / 120
MAX_STEPS: Final = 8
ITERATIONS: Final = 8
BETA: Final = 0.2
SLOP: Final = 0.5
RESTING_SPEED: Final = 30
MAX_BALLS: Final = 40
