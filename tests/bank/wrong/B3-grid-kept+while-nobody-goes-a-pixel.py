"""Keeps the pairs until somebody has gone a pixel: finds none that has formed on a shorter way."""

# TODO B3: look only at bodies that share a cell
kept = getattr(near_pairs, 'kept', ([], [], []))
places = [Vector2(body.pos) for body in bodies]
if kept[0] == bodies and all((a - b).length() < 1 for a, b in zip(kept[1], places)):
    return kept[2]
cells = {}
for number, body in enumerate(bodies):
    low, high = extent(body)
    for x in range(int(low.x // CELL), int(high.x // CELL) + 1):
        for y in range(int(low.y // CELL), int(high.y // CELL) + 1):
            cells.setdefault((x, y), []).append(number)
pairs = {pair for numbers in cells.values() for pair in combinations(numbers, 2)}
near_pairs.kept = list(bodies), places, [(bodies[i], bodies[j]) for i, j in sorted(pairs)]
return near_pairs.kept[2]
# END TODO B3
