"""Half-way, whatever the share."""

# TODO B5: draw between steps
pos, angle = body.before
return (pos + body.pos) / 2, (angle + body.angle) / 2
# END TODO B5
