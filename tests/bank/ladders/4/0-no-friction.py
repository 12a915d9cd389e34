"""Leaves before anything rubs."""

# TODO 4: clamp the friction total
return
# END TODO 4
