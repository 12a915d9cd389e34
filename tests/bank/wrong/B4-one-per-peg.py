"""Each peg counts once."""

# TODO B4: count the hits
seen = set()

def begin(arbiter, space, data):
    seen.add(arbiter.shapes[1])
    data["hits"] = len(seen)

space.on_collision(BALL, PEG, begin=begin, data=data)
# END TODO B4
