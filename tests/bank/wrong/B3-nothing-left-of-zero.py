"""Cells begin at 0: what lies left of it or above is in none."""

# TODO B3: look only at bodies that share a cell
cells = {}
for number, body in enumerate(bodies):
    low, high = extent(body)
    for x in range(max(0, int(low.x // CELL)), int(high.x // CELL) + 1):
        for y in range(max(0, int(low.y // CELL)), int(high.y // CELL) + 1):
            cells.setdefault((x, y), []).append(number)

pairs = {pair for numbers in cells.values() for pair in combinations(numbers, 2)}
return [(bodies[i], bodies[j]) for i, j in sorted(pairs)]
# END TODO B3
