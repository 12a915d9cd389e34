"""Reasons for the rows that the stable engine loses, by how their titles begin."""

SOFT = "Contacts are soft: they sink by a little that grows with the weight."
ROLLS = "A last ball still rolls: nothing brakes rolling, so chance decides when it stops."
REASONS = {
    "rained pile: 100 balls, late speed": ROLLS,
    "tower: 20 equal balls, top": SOFT,
    "tower: 40 equal balls, top": SOFT,
}


def find_reason(title):
    """Return the reason for a row, or nothing."""
    return next((why for start, why in REASONS.items() if title.startswith(start)), "")
