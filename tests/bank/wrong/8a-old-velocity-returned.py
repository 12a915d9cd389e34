"""Moves with the new velocity but hands back the old one."""

# TODO 8a: semi-implicit Euler
return x + (v + accel(x) * dt) * dt, v
# END TODO 8a
