"""Names the ball only: what it hits may be anything."""

# TODO B4: count the hits
def begin(arbiter, space, data):
    data["hits"] += 1

space.on_collision(BALL, begin=begin, data=data)
# END TODO B4
