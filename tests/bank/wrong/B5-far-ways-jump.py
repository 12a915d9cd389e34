"""A way of more than 10 px in the step counts as a jump: drawn where it is now."""

# TODO B5: draw between steps
pos, angle = body.before
if (body.pos - pos).length() > 10:
    return body.pos, body.angle
return pos + (body.pos - pos) * share, angle + (body.angle - angle) * share
# END TODO B5
