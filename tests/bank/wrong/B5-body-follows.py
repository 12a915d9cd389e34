"""Angle brought into 0..2π on the body itself."""

# TODO B5: draw between steps
body.angle %= 6.283185307179586
pos, angle = body.before
return pos + (body.pos - pos) * share, angle + (body.angle - angle) * share
# END TODO B5
