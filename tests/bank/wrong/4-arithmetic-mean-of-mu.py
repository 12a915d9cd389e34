"""Takes half the sum of the two coefficients: rubber on ice still grips."""

# TODO 4: clamp the friction total
limit = (c.a.friction + c.b.friction) / 2 * c.jn
total = max(-limit, min(limit, total))
# END TODO 4
