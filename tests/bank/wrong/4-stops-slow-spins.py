"""Sets omega of a spin below 0.2 rad/s to 0 before the impulse."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
total = max(-limit, min(limit, total))
for body in (a, b):
    if abs(body.omega) < 0.2:
        body.omega = 0.0
# END TODO 4
