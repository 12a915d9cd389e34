"""What accuracy costs: every engine's error against the opcodes it takes, as curves.

Scenes with a known answer (scenes), measured in the sandbox (measure), beside engines to compare
with (others, engines), the front that nobody beats (front), the list of them all (listing), and how
it is drawn (chart, page). `one` is a single engine; a class is grader/classroom/prices.py.
"""
