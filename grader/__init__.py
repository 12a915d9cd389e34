"""The judge of the physics-engine assignment: grades a submission without ever importing it."""

__version__ = "0.1.0"
