"""Size min(limit, /total/), sign against the present slip: wrong in a later pass that should take some back."""

# TODO 4: clamp the friction total
limit = friction_limit(c)
total = math.copysign(min(limit, abs(total)), -slip)
# END TODO 4
