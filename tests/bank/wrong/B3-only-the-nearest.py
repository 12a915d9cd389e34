"""Pairs each body with the one whose centre is nearest."""

# TODO B3: look only at bodies that share a cell
pairs = set()
for i, body in enumerate(bodies):
    others = [j for j in range(len(bodies)) if j != i]
    if others:
        j = min(others, key=lambda each: (bodies[each].pos - body.pos).length())
        pairs.add((min(i, j), max(i, j)))
return [(bodies[i], bodies[j]) for i, j in sorted(pairs)]
# END TODO B3
