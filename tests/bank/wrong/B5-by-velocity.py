"""Pos - vel·STEP·(1 - share) instead of body.before: wrong for another step or a body that was moved by hand."""

# TODO B5: draw between steps
pos, angle = body.before
return body.pos - body.vel * (STEP * (1 - share)), angle + (body.angle - angle) * share
# END TODO B5
