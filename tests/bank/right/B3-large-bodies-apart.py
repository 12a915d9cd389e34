"""Another way: large bodies apart."""

# TODO B3: look only at bodies that share a cell
import math
from collections import defaultdict
from itertools import product

grid = defaultdict(set)
large = []
pairs = set()
for i, body in enumerate(bodies):
    low, high = extent(body)
    columns = range(math.floor(low.x / CELL), math.floor(high.x / CELL) + 1)
    rows = range(math.floor(low.y / CELL), math.floor(high.y / CELL) + 1)
    if len(columns) * len(rows) > 9:
        large.append(i)
        continue
    for cell in product(columns, rows):
        for j in grid[cell]:
            pairs.add((j, i))
        grid[cell].add(i)
def overlap(i, j):
    (al, ah), (bl, bh) = extent(bodies[i]), extent(bodies[j])
    return al.x <= bh.x and bl.x <= ah.x and al.y <= bh.y and bl.y <= ah.y

for i in large:
    for j in range(len(bodies)):
        if i != j and overlap(i, j):
            pairs.add((min(i, j), max(i, j)))
return [(bodies[i], bodies[j]) for i, j in sorted(pairs)]
# END TODO B3
