"""Answers of the wrong type, size or value wherever an answer is due."""

# TODO 1: find the contact of a circle and a box
endless = []
endless.append(endless)
return endless
# END TODO 1

# TODO 2: add the spin terms
total = 10**10000
# END TODO 2

# TODO 3: hold the rod's length
self.a.vel = self.b.vel = Vector2(float("nan"), float("inf"))
self.bias = self.k = None
# END TODO 3

# TODO 4: clamp the friction total
total = float("nan")
# END TODO 4

# TODO 5: damp by a rate per second
keep_vel = keep_omega = float("inf")
# END TODO 5

# TODO 6: run whole steps from the accumulator
steps = True
accumulator = "full"
# END TODO 6

# TODO 7a: gravity
space.gravity = (float("nan"), float("inf"))
space.damping = float("nan")
# END TODO 7a

# TODO 7b: the ball's moment of inertia
moment = 1e308
# END TODO 7b

# TODO 7c: a pin joint for the rod
bob.position = (float("inf"), float("nan"))
# END TODO 7c

# TODO 7d: run whole steps from the accumulator
steps = -1
accumulator = None
# END TODO 7d

# TODO 8a: semi-implicit Euler
return [[0.0] * 1000] * 1000
# END TODO 8a

# TODO 8b: velocity Verlet
return True, False
# END TODO 8b

# TODO 8c: RK4
return 10**400, float("-inf")
# END TODO 8c
