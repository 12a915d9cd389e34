"""No cells: sorts by the left ends, and yields what overlaps so far."""

# TODO B3: look only at bodies that share a cell
active = []
for body in sorted(bodies, key=lambda each: extent(each)[0].x):
    left = extent(body)[0].x
    active = [other for other in active if extent(other)[1].x >= left]
    for other in active:
        yield other, body
    active.append(body)
# END TODO B3
