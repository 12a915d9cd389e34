"""Sleeps in time and never wakes."""

# TODO B1: let bodies sleep, and wake them
for body in world.bodies:
    if body.is_static:
        continue
    at_rest = touching.get(body) and speed(body, fall) < SLOW and body not in held
    body.still_for = body.still_for + dt if at_rest else 0.0
    if body.still_for > SLEEP_AFTER:
        body.vel, body.omega = Vector2(0, 0), 0.0
        body.asleep = True
# END TODO B1
