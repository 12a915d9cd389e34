"""Does nothing."""

# TODO 3: hold the rod's length
return
# END TODO 3
