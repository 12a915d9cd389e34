"""Names and comments in other alphabets: Ελληνικά, кириллица, 日本語, עברית, 🎱."""

# TODO 1: find the contact of a circle and a box
# Ближайшая точка прямоугольника
ρ = a.shape.radius
Δ = a.pos - b.pos
h = b.shape.half
内側 = abs(Δ.x) <= h.x and abs(Δ.y) <= h.y
nächste = Vector2(max(-h.x, min(Δ.x, h.x)), max(-h.y, min(Δ.y, h.y)))
if not 内側:
    δ = nächste - Δ
    if δ.length() >= ρ:
        return None
    return Contact(a, b, δ / δ.length(), ρ - δ.length(), b.pos + nächste)
# 最も近い面から出る 🎱
ἄκρα = [
    (h.x - Δ.x, Vector2(1, 0)),
    (h.x + Δ.x, Vector2(-1, 0)),
    (h.y - Δ.y, Vector2(0, 1)),
    (h.y + Δ.y, Vector2(0, -1)),
]
κενό, έξοδος = min(ἄκρα, key=lambda άκρο: άκρο[0])
return Contact(a, b, -έξοδος, ρ + κενό, a.pos + έξοδος * κενό)
# END TODO 1

# TODO 4: clamp the friction total
µ = math.sqrt(c.a.friction * c.b.friction)  # коэффициент трения
total = max(-µ * c.jn, min(µ * c.jn, total))
# END TODO 4

# TODO 8a: semi-implicit Euler
ω = v + accel(x) * dt  # מהירות
ξ = x + ω * dt
return ξ, ω
# END TODO 8a
