"""Leaves out cells with 40 bodies and more."""

# TODO B3: look only at bodies that share a cell
cells = {}
for number, body in enumerate(bodies):
    low, high = extent(body)
    for x in range(int(low.x // CELL), int(high.x // CELL) + 1):
        for y in range(int(low.y // CELL), int(high.y // CELL) + 1):
            cells.setdefault((x, y), []).append(number)
few = [numbers for numbers in cells.values() if len(numbers) < 40]
pairs = {pair for numbers in few for pair in combinations(numbers, 2)}
return [(bodies[i], bodies[j]) for i, j in sorted(pairs)]
# END TODO B3
