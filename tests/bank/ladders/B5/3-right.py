"""Right."""

# TODO B5: draw between steps
pos, angle = body.before
return pos + (body.pos - pos) * share, angle + (body.angle - angle) * share
# END TODO B5
