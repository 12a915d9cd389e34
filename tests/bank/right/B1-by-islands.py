"""Puts whole heaps to sleep at once, and wakes them at once."""

# TODO B1: let bodies sleep, and wake them
for body in world.bodies:
    if body.is_static:
        continue
    at_rest = touching.get(body) and speed(body, fall) < SLOW and body not in held
    body.still_for = body.still_for + dt if at_rest else 0.0


def heap_of(first, others):
    """All that can move and hang together with first."""
    heap, ahead = [], [first]
    while ahead:
        body = ahead.pop()
        if body not in heap and (body.asleep or not body.is_static):
            heap.append(body)
            ahead.extend(others(body))
    return heap


def disturbed(body):
    near = touching.get(body, [])
    if any(speed(other, fall) > WAKING for other in near):
        return True
    return any(has_left(other, near, present) for other in body.support)


for body in world.bodies:
    if body.asleep and disturbed(body):
        for each in heap_of(body, lambda each: each.support):
            if each.asleep:
                wake(each)
for body in world.bodies:
    if not body.is_static and body.still_for > SLEEP_AFTER:
        heap = heap_of(body, lambda each: touching.get(each, []))
        if all(each.asleep or each.still_for > SLEEP_AFTER for each in heap):
            for each in heap:
                if not each.asleep:
                    fall_asleep(each, touching[each])
# END TODO B1
