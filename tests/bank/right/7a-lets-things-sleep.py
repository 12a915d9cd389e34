"""Also sets sleep_time_threshold, so resting bodies stop."""

# TODO 7a: gravity
space.gravity = (0, 980)
space.sleep_time_threshold = 0.5
# END TODO 7a
