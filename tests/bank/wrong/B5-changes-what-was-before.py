"""Adds to the place before in place: asked twice, it answers twice."""

# TODO B5: draw between steps
pos, angle = body.before
pos += (body.pos - pos) * share
return pos, angle + (body.angle - angle) * share
# END TODO B5
