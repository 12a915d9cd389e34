"""Puts the body itself where it is to be drawn: it goes slower and slower."""

# TODO B5: draw between steps
pos, angle = body.before
body.pos = pos + (body.pos - pos) * share
body.angle = angle + (body.angle - angle) * share
return body.pos, body.angle
# END TODO B5
