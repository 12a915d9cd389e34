"""Draws a body where it was before the step, whatever the share."""

# TODO B5: draw between steps
return body.before
# END TODO B5
