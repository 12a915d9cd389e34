"""Ten thousand files and a hundred megabytes, in pieces that no limit on one file notices."""

# TODO 8a: semi-implicit Euler
for number in range(10_000):
    with open(f"piece-{number}", "wb") as file:
        file.write(bytes(10_000))
return x + v * dt, v + accel(x) * dt
# END TODO 8a
