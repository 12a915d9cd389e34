"""Reasons for the rows that the stable engine loses, by how their titles begin."""

ROLLS = "A last ball still rolls: nothing brakes rolling, so chance decides when it stops."
REASONS = {
    "rained pile: 100 balls, late speed": ROLLS,
}


def find_reason(title):
    """Return the reason for a row, or nothing."""
    return next((why for start, why in REASONS.items() if title.startswith(start)), "")
