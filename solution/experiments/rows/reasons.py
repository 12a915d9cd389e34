"""Why the stable engine loses the rows that it loses, by how their titles begin."""

SOFT = "Contacts are soft: they sink by a little that grows with the weight."
REASONS = {
    "dome: rolls": "In a substep a ball moves straight on, off the round surface: it hops.",
    "spring: 5 Hz, path": "Each of 50 swings is a little too quick, and that adds up.",
    "tower: 20 equal balls, top": SOFT,
    "tower: 40 equal balls, top": SOFT,
    "tower: 6 balls of 1 kg and 100 kg": SOFT,
    "tower: 12 balls of 1 kg and 100 kg": SOFT,
    "heavy on light: 1:1000": SOFT,
    "heavy on light: 1, 10": SOFT,
    "bad start: 10 balls with the same centre, speed": "Pairs part as fast as they are pushed, "
    "each in a direction of its own.",
}


def find_reason(title):
    """Return the reason for a row, or nothing."""
    return next((why for start, why in REASONS.items() if title.startswith(start)), "")
