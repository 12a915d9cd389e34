"""First wakes all that must wake, then looks who may sleep; waits a little longer."""

# TODO B1: let bodies sleep, and wake them
def wakes(body):
    near = touching.get(body, ())
    for other in body.support:
        if has_left(other, near, present):
            return True
    return max((speed(other, fall) for other in near), default=0) > WAKING


for body in filter(wakes, [each for each in world.bodies if each.asleep]):
    wake(body)
for body in world.moving_bodies():
    if speed(body, fall) >= SLOW / 2 or body in held or body not in touching:
        body.still_for = 0.0
        continue
    body.still_for += dt
    if body.still_for >= 1.1 * SLEEP_AFTER:
        fall_asleep(body, list(touching[body]))
# END TODO B1
