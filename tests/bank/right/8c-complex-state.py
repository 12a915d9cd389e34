"""Place and speed in one complex number."""

# TODO 8c: RK4
slope = lambda z: complex(z.imag, accel(z.real))
z = complex(x, v)
k1 = slope(z)
k2 = slope(z + dt / 2 * k1)
k3 = slope(z + dt / 2 * k2)
k4 = slope(z + dt * k3)
z += dt * (k1 + 2 * k2 + 2 * k3 + k4) / 6
return z.real, z.imag
# END TODO 8c
