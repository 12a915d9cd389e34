"""The plane as complex numbers."""

# TODO 1: find the contact of a circle and a box
z = complex(a.pos.x, a.pos.y) - complex(b.pos.x, b.pos.y)  # the centre, seen from the box
h = complex(b.shape.half.x, b.shape.half.y)
c = complex(min(max(z.real, -h.real), h.real), min(max(z.imag, -h.imag), h.imag))
if c != z:
    gap = abs(c - z)
    if gap >= a.shape.radius:
        return None
    n, depth = (c - z) / gap, a.shape.radius - gap
else:
    exits = [(h.real - z.real, 1 + 0j), (h.real + z.real, -1 + 0j), (h.imag - z.imag, 1j), (h.imag + z.imag, -1j)]
    gap, way = min(exits, key=lambda e: e[0])
    n, depth, c = -way, a.shape.radius + gap, z + way * gap
return Contact(a, b, Vector2(n.real, n.imag), depth, b.pos + Vector2(c.real, c.imag))
# END TODO 1
