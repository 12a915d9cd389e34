"""Counts the end of a touch."""

# TODO B4: count the hits
def parted(arbiter, space, data):
    data["hits"] += 1

space.on_collision(BALL, PEG, separate=parted, data=data)
# END TODO B4
