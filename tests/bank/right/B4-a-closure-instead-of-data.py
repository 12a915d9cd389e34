"""Counts in a function that keeps the dictionary by itself."""

# TODO B4: count the hits
data = {"hits": 0}
space.on_collision(BALL, PEG, lambda *_: data.update(hits=data["hits"] + 1))
# END TODO B4
