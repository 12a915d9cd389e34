"""Keeps the pairs in a set, and so in the order of their hashes."""

# TODO B3: look only at bodies that share a cell
grid, seen = {}, set()
for body in bodies:
    low, high = extent(body)
    for x in range(int(low.x // CELL), int(high.x // CELL) + 1):
        for y in range(int(low.y // CELL), int(high.y // CELL) + 1):
            cell = grid.setdefault((x, y), [])
            seen.update(frozenset((body, other)) for other in cell)
            cell.append(body)
return map(tuple, seen)
# END TODO B3
