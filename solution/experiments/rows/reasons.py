"""Why the stable engine loses the rows that it loses, by how their titles begin."""

SOFT = "Contacts are soft: they sink by a little that grows with the weight."
REASONS = {
    "strike: the end of a rod at": "An impact does not see the rod behind a ball.",
    "bounce: rough, 900 px/s": "Friction takes more than μ times the impulse of the impact.",
    "dome: rolls": "In a substep a ball moves straight on, off the round surface: it hops.",
    "double pendulum: 1:100, energy": "The light ball turns further than a substep can follow.",
    "chain: 40 links let go level, energy": "The tip of a whip turns further than a substep can "
    "follow.",
    "dumbbell: 10000 px/s": "The rod turns by 0.8 radians in a substep.",
    "spring: 5 Hz, path": "Each of 50 swings is a little too quick, and that adds up.",
    "tower: 20 equal balls, top": SOFT,
    "tower: 40 equal balls, top": SOFT,
    "tower: 6 balls of 1 kg and 100 kg": SOFT,
    "tower: 12 balls of 1 kg and 100 kg": SOFT,
    "heavy on light: 1:1000": SOFT,
    "heavy on light: 1, 10": SOFT,
    "bad start: 10 balls with the same centre, speed": "Pairs part as fast as they are pushed, "
    "each in a direction of its own.",
    "gas: 20 balls of 1:100": "Impacts slower than 30 px/s do not bounce.",
}


def find_reason(title):
    """Return the reason for a row, or nothing."""
    return next((why for start, why in REASONS.items() if title.startswith(start)), "")
