"""Counts each step of a touch."""

# TODO B4: count the hits
def touching(arbiter, space, data):
    data["hits"] += 1

space.on_collision(BALL, PEG, pre_solve=touching, data=data)
# END TODO B4
