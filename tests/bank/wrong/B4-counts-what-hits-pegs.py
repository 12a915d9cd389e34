"""Names the peg only: what hits it may be anything."""

# TODO B4: count the hits
def begin(arbiter, space, data):
    data["hits"] += 1

space.on_collision(PEG, begin=begin, data=data)
# END TODO B4
