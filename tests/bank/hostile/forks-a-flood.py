"""Twenty processes that end by themselves after ten seconds."""

# TODO 8a: semi-implicit Euler
import os
import select

for _ in range(20):
    if os.fork() == 0:
        select.select([], [], [], 10)  # s
        os._exit(0)
return x, v
# END TODO 8a
