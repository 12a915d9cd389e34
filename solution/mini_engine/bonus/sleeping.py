"""Bodies at rest sleep, and cost next to nothing.

A sleeper keeps its mass. While body.asleep is true, BonusWorld lets no force and no contact move
it, and looks for no contact between sleepers.
"""

from pygame import Vector2

SLOW = 12.0  # px/s, slower bodies may fall asleep
SLEEP_AFTER = 0.5  # s at rest
WAKING = 30.0  # px/s, a touch by a faster body wakes


def speed(body, fall):
    """Return the speed of the centre or the rim (px/s), the greater one; 0 for what cannot move.

    fall is the velocity (px/s) that gravity has just added in this step. It does not count.
    """
    if body.is_static or body.asleep:
        return 0.0
    return max((body.vel - fall).length(), abs(body.omega) * body.shape.radius)


def neighbours(world):
    """For each body that touches others in this step, the list of those."""
    found = {}
    for contact in world.contacts:
        found.setdefault(contact.a, []).append(contact.b)
        found.setdefault(contact.b, []).append(contact.a)
    return found


def fall_asleep(body, support):
    """Put a body to rest. support: the bodies it touches, whose leaving wakes it."""
    body.vel, body.omega = Vector2(0, 0), 0.0
    body.asleep, body.support = True, support


def wake(body):
    """Let a sleeper move again."""
    body.asleep, body.support = False, []
    body.still_for = 0.0


def update_sleep(world, dt):
    """Send bodies at rest to sleep and wake those that are disturbed. Whether any of that happened.

    Called when the contacts of a step of dt seconds have been found. body.still_for counts the
    seconds for which a body has touched another one and been slower than SLOW; else it is 0. When
    it passes SLEEP_AFTER the body falls asleep. Those in held, on rods and springs, never do.
    A sleeper wakes when it is touched by a body faster than WAKING, or when one of its support is
    in the world no more, or awake and touches it no more.
    """
    touching, present = neighbours(world), set(world.bodies)
    held = {end for joint in world.joints + world.springs for end in (joint.a, joint.b)}
    fall = world.gravity * dt
    before = [body.asleep for body in world.bodies]
    # TODO B1: let bodies sleep, and wake them
    for body in world.bodies:
        near = touching.get(body, [])
        if body.asleep:
            hit = any(speed(other, fall) > WAKING for other in near)
            if hit or any(has_left(other, near, present) for other in body.support):
                wake(body)
        elif not body.is_static:
            at_rest = near and speed(body, fall) < SLOW and body not in held
            body.still_for = body.still_for + dt if at_rest else 0.0
            if body.still_for > SLEEP_AFTER:
                fall_asleep(body, near)
    # END TODO B1
    return before != [body.asleep for body in world.bodies]


def has_left(body, near, present):
    """Return whether a sleeper's support is gone: out of the world, or awake and not near."""
    still = body.is_static or body.asleep
    return body not in present or not (still or body in near)
