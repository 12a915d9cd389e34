"""Read submissions and class lists as people and learning systems make them.

A learning system is one `Lms` of `lms.py`, in a file of its own in `learning_systems/`.
"""
