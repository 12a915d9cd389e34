"""Every stub with its words changed and nothing done."""

# TODO 1: find the contact of a circle and a box
pass
return None
# END TODO 1

# TODO 2: add the spin terms
total += 0.0
# END TODO 2

# TODO 3: hold the rod's length
pass
# END TODO 3

# TODO 4: clamp the friction total
total = total * 1.0
# END TODO 4

# TODO 5: damp by a rate per second
keep_vel = 1 - 0.01
keep_omega = 1 - 0.01
# END TODO 5

# TODO 6: run whole steps from the accumulator
steps = 1
world.step(STEP)
# END TODO 6

# TODO 7a: gravity
space.gravity = 0, 0
# END TODO 7a

# TODO 7b: the ball's moment of inertia
moment = float("Infinity")
# END TODO 7b

# TODO 7c: a pin joint for the rod
bob.angle = 0
# END TODO 7c

# TODO 7d: run whole steps from the accumulator
steps = 1
space.step(STEP)
# END TODO 7d

# TODO 8a: semi-implicit Euler
return x + v * dt, v + accel(x) * dt
# END TODO 8a

# TODO 8b: velocity Verlet
return x + v * dt, v + accel(x) * dt
# END TODO 8b

# TODO 8c: RK4
return x + v * dt, v + accel(x) * dt
# END TODO 8c
