"""Mixes the two places the wrong way round: bodies jerk back and forth."""

# TODO B5: draw between steps
pos, angle = body.before
return body.pos + (pos - body.pos) * share, body.angle + (angle - body.angle) * share
# END TODO B5
