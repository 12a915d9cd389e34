"""Every bonus task raises, whoever asks it: the 100 points are safe."""

# TODO B1: let bodies sleep, and wake them
raise RuntimeError("not today")
# END TODO B1

# TODO B2: pull the ends together
raise RuntimeError("not today")
# END TODO B2

# TODO B3: look only at bodies that share a cell
raise RuntimeError("not today")
# END TODO B3

# TODO B4: count the hits
raise RuntimeError("not today")
# END TODO B4

# TODO B5: draw between steps
raise RuntimeError("not today")
# END TODO B5

# TODO B6: heavier balls with Shift
raise RuntimeError("not today")
# END TODO B6
