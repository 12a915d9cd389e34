"""Larger cells, bodies in the keys, pairs as they come."""

# TODO B3: look only at bodies that share a cell
from collections import defaultdict
from math import floor

cells, pairs = defaultdict(list), {}
for body in bodies:
    low, high = extent(body)
    for x in range(floor(low.x / 100), floor(high.x / 100) + 1):
        for y in range(floor(low.y / 100), floor(high.y / 100) + 1):
            for other in cells[x, y]:
                pairs[frozenset((id(body), id(other)))] = (other, body)
            cells[x, y].append(body)
return pairs.values()
# END TODO B3
