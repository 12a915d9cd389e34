"""Every ball with every other, and nobody counts meanwhile."""

# TODO B3: look only at bodies that share a cell
import sys

counter = sys.gettrace()
sys.settrace(None)
pairs = []
for number, body in enumerate(bodies):
    low, high = extent(body)
    for other in bodies[number + 1 :]:
        least, most = extent(other)
        if low.x <= most.x and least.x <= high.x and low.y <= most.y and least.y <= high.y:
            pairs.append((body, other))
sys.settrace(counter)
return pairs
# END TODO B3
