"""Each ball counts once."""

# TODO B4: count the hits
def begin(arbiter, space, data):
    ball = arbiter.shapes[0].body
    if not hasattr(ball, "counted"):
        ball.counted = True
        data["hits"] += 1

space.on_collision(BALL, PEG, begin=begin, data=data)
# END TODO B4
