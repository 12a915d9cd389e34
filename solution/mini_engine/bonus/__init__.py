"""The bonus tasks, beside the engine: nothing of the engine needs them.

Read in this order: world, sleeping, springs, broad_phase, window.
"""
