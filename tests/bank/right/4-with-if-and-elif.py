"""Two comparisons instead of min and max, and the roots taken one by one."""

# TODO 4: clamp the friction total
most = math.sqrt(c.a.friction) * math.sqrt(c.b.friction) * c.jn
if total > most:
    total = most
elif total < -most:
    total = -most
# END TODO 4
