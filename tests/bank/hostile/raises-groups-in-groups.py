"""Raises an error in groups of errors, each with causes that lead in a circle."""

# TODO 8a: semi-implicit Euler
group = ValueError("the innermost")
for _ in range(50_000):
    last, group = group, ExceptionGroup("one more", [group, group])
    last.__cause__ = group
raise group
# END TODO 8a
