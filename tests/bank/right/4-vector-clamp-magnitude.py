"""A vector along the tangent with its length limited by hand, then back to a number."""

# TODO 4: clamp the friction total
friction = tangent * total
limit = friction_limit(c)
if friction.length() > limit:
    friction = friction.normalize() * limit
total = friction.dot(tangent)
# END TODO 4
