"""Returns the pair the wrong way round."""

# TODO 8a: semi-implicit Euler
v = v + accel(x) * dt
x = x + v * dt
return v, x
# END TODO 8a
