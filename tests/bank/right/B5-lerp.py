"""Another way: lerp."""

# TODO B5: draw between steps
place, angle = body.before
return place.lerp(body.pos, min(1.0, max(0.0, share))), (1 - share) * angle + share * body.angle
# END TODO B5
