"""What is asked of the student: one file of checks per TODO, points in rubric.toml.

A check is a function whose docstring is the title a student reads; it takes a `Lab`.
"""
