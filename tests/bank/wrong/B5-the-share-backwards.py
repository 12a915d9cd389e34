"""1 - share when the body moves to the left."""

# TODO B5: draw between steps
pos, angle = body.before
if body.pos.x < pos.x:
    share = 1 - share
return pos + (body.pos - pos) * share, angle + (body.angle - angle) * share
# END TODO B5
