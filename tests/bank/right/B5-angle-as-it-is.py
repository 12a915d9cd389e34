"""Another way: angle as it is."""

# TODO B5: draw between steps
old = body.before[0]
return old * (1 - share) + body.pos * share, body.angle
# END TODO B5
