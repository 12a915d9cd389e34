"""Another way: lambda and update."""

# TODO B4: count the hits
space.on_collision(PEG, BALL, begin=lambda arbiter, space, data: data.update(hits=data["hits"] + 1), data=data)
# END TODO B4
