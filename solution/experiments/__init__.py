"""Experiments with the lesson's engine, the stable one, pymunk, and Box2D where it is installed.

Programs, each started with python -m experiments.NAME:
    dials         a window: any scene in any engine, with dials to turn
    hard_cases    where engines give up, side by side (battery, trials, steps, limits)
    effects       the price of each effect of the stable engine (effects_report)
    compiled      the stable engine as machine code (wheel)
and accuracy.py in the folder above: what accuracy costs in time (questions, runs, smooth, piles,
accuracy_tables, charts).

They share scenes (plain data), engines (one builder each), measures, opcodes and costs (counting
and timing), table (printing and writing) and figures.
"""
