"""Keeps the inverse inertia of the first call on the body."""

# TODO 2: add the spin terms
for body, arm in ((a, ra), (b, rb)):
    if not hasattr(body, 'ease'):
        body.ease = body.inv_inertia
    total += cross(arm, axis) ** 2 * body.ease
# END TODO 2
