"""Counts in post_solve, which pymunk calls in every step of a touch: only the first one counts."""

# TODO B4: count the hits
def touching(arbiter, space, data):
    if arbiter.is_first_contact:
        data["hits"] = data["hits"] + 1

space.on_collision(collision_type_a=PEG, collision_type_b=BALL, post_solve=touching, data=data)
# END TODO B4
