"""Every number that tunes the engine, with its unit. Nothing to do here.

Lengths are in px, times in s, angles in rad. y grows down, as on the screen.
"""

WIDTH, HEIGHT = 900, 600  # px
STEP = 1 / 120  # s, one physics step
MAX_STEPS = 8  # most steps in one frame
ITERATIONS = 8  # solver passes in one step
BETA = 0.2  # share of an error put right in one step
SLOP = 0.5  # px of overlap left alone, so that resting bodies stay in contact
RESTING_SPEED = 30  # px/s, a slower impact does not bounce
MAX_BALLS = 40  # most moving bodies in the window
