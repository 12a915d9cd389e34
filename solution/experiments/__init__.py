"""Experiments with three engines: the lesson's, the stable one, and pymunk.

Read in this order: scenes (plain data), engines (one builder each), measures, then any program.
"""
