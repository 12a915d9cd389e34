"""Counts what bounces, and nothing that comes to lie."""

# TODO B4: count the hits
def hit(arbiter, space, data):
    if arbiter.is_first_contact and arbiter.total_impulse.length > 50:
        data["hits"] += 1

space.on_collision(BALL, PEG, post_solve=hit, data=data)
# END TODO B4
