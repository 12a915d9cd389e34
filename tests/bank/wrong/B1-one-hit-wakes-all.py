"""One sleeper that is disturbed wakes all of the world."""

# TODO B1: let bodies sleep, and wake them
for body in world.bodies:
    near = touching.get(body, [])
    if body.asleep:
        hit = any(speed(other, fall) > WAKING for other in near)
        if hit or any(has_left(other, near, present) for other in body.support):
            for sleeper in world.bodies:
                if sleeper.asleep:
                    wake(sleeper)
    elif not body.is_static:
        at_rest = near and speed(body, fall) < SLOW and body not in held
        body.still_for = body.still_for + dt if at_rest else 0.0
        if body.still_for > SLEEP_AFTER:
            fall_asleep(body, near)
# END TODO B1
