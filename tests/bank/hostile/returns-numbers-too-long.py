"""Returns whole numbers of a million digits, which Python refuses to print."""

# TODO 8a: semi-implicit Euler
return 1 << 4_000_000, -(1 << 4_000_000)
# END TODO 8a
