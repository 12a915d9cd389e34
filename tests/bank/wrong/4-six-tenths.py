"""Limit 0.6 · jn: right for every body of the lab scene."""

# TODO 4: clamp the friction total
limit = 0.6 * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
