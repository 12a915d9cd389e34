"""Reasons for the rows that the stable engine loses, by how their titles begin."""

REASONS = {
    "fast balls: 20 thrown at 20": "Without Bounce, balls do not meet on their way.",
}


def find_reason(title):
    """Return the reason for a row, or nothing."""
    return next((why for start, why in REASONS.items() if title.startswith(start)), "")
