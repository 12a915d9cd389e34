"""Never finds a contact."""

# TODO 1: find the contact of a circle and a box
return None
# END TODO 1
