"""The bonus tasks, beside the engine: nothing of the engine needs them.

Read in this order: world, sleeping (TODO B1), springs (B2), broad_phase (B3), window (B5, B6).
"""
