"""Every function runs in circles: a check that is cut is followed by the next."""

# TODO 1: find the contact of a circle and a box
while True:
    pass
# END TODO 1

# TODO 2: add the spin terms
while True:
    pass
# END TODO 2

# TODO 3: hold the rod's length
while True:
    pass
# END TODO 3

# TODO 4: clamp the friction total
while True:
    pass
# END TODO 4

# TODO 5: damp by a rate per second
while True:
    pass
# END TODO 5

# TODO 6: run whole steps from the accumulator
while True:
    pass
# END TODO 6

# TODO 7a: gravity
while True:
    pass
# END TODO 7a

# TODO 7b: the ball's moment of inertia
while True:
    pass
# END TODO 7b

# TODO 7c: a pin joint for the rod
while True:
    pass
# END TODO 7c

# TODO 7d: run whole steps from the accumulator
while True:
    pass
# END TODO 7d

# TODO 8a: semi-implicit Euler
while True:
    pass
# END TODO 8a

# TODO 8b: velocity Verlet
while True:
    pass
# END TODO 8b

# TODO 8c: RK4
while True:
    pass
# END TODO 8c

# TODO B1: let bodies sleep, and wake them
while True:
    pass
# END TODO B1

# TODO B2: pull the ends together
while True:
    pass
# END TODO B2

# TODO B3: look only at bodies that share a cell
while True:
    pass
# END TODO B3

# TODO B4: count the hits
while True:
    pass
# END TODO B4

# TODO B5: draw between steps
while True:
    pass
# END TODO B5

# TODO B6: heavier balls with Shift
while True:
    pass
# END TODO B6
