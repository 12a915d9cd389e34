"""True and False, which pass for 1 and 0 where nobody looks at the type."""

# TODO 2: add the spin terms
total = True
# END TODO 2

# TODO 8a: semi-implicit Euler
return True, True
# END TODO 8a

# TODO 8b: velocity Verlet
return False, False
# END TODO 8b

# TODO 8c: RK4
return True
# END TODO 8c
