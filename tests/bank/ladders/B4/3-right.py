"""Right."""

# TODO B4: count the hits
def begin(arbiter, space, data):
    data["hits"] += 1

space.on_collision(BALL, PEG, begin=begin, data=data)
# END TODO B4
