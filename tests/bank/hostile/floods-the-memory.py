"""Asks for three gigabytes, at once and bit by bit."""

# TODO 8a: semi-implicit Euler
held = []
try:
    held.append(bytearray(3 * 1024**3))
except MemoryError:
    pass
while sum(map(len, held)) < 3 * 1024**3:
    held.append(bytearray(16 * 1024**2))
return x, v
# END TODO 8a
