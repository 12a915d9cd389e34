"""Does applying and storing itself and returns before the lines below the region."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
before = c.jt
c.jt = min(limit, max(-limit, total))
apply_impulse(a, b, (c.jt - before) * tangent, ra, rb)
return
# END TODO 4
