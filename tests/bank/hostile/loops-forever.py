"""A loop that never ends."""

# TODO 8a: semi-implicit Euler
while True:
    pass
# END TODO 8a
