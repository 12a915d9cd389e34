"""Another way: sweeps and prunes."""

# TODO B3: look only at bodies that share a cell
boxes = sorted((extent(body)[0].x, extent(body)[1].x, i) for i, body in enumerate(bodies))
active, pairs = [], []
for low, high, i in boxes:
    active = [(h, j) for h, j in active if h >= low]
    li, hi = extent(bodies[i])
    for _, j in active:
        lj, hj = extent(bodies[j])
        if li.y <= hj.y and lj.y <= hi.y:
            pairs.append((min(i, j), max(i, j)))
    active.append((high, i))
return [(bodies[i], bodies[j]) for i, j in sorted(pairs)]
# END TODO B3
