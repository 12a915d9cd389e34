"""Stand in for the joints of pymunk."""

from . import Constraint as Constraint

for each in ("DampedSpring", "PinJoint", "PivotJoint", "SlideJoint"):
    globals()[each] = type(each, (Constraint,), {})
