"""Pos += ... changes body.before itself."""

# TODO B5: draw between steps
pos, angle = body.before
pos += (body.pos - pos) * share
return pos, angle + (body.angle - angle) * share
# END TODO B5
