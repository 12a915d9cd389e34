"""Writes the function, and never hands it to the space."""

# TODO B4: count the hits
def begin(arbiter, space, data):
    data["hits"] += 1

# END TODO B4
