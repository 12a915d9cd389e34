"""Keeps the inverse inertias of two bodies, and misses that they were changed."""

# TODO 2: add the spin terms
kept = effective_mass.__dict__.setdefault("kept", {})
ease_a, ease_b = kept.setdefault((a, b), (a.inv_inertia, b.inv_inertia))
total += cross(ra, axis) ** 2 * ease_a + cross(rb, axis) ** 2 * ease_b
# END TODO 2
