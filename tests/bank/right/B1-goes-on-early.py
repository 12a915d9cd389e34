"""Another way: goes on early."""

# TODO B1: let bodies sleep, and wake them
for body in world.bodies:
    others = touching.get(body, ())
    if body.asleep:
        disturbed = max((speed(o, fall) for o in others), default=0) > WAKING
        orphaned = any(has_left(o, others, present) for o in body.support)
        if disturbed or orphaned:
            wake(body)
        continue
    if body.is_static:
        continue
    if not others or body in held or speed(body, fall) >= SLOW:
        body.still_for = 0.0
        continue
    body.still_for += dt
    if body.still_for > SLEEP_AFTER:
        fall_asleep(body, list(others))
# END TODO B1
