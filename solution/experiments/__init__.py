"""Experiments with the lesson's engine, the stable one, pymunk, and others that are installed.

Programs, each started with python -m experiments.NAME:
    dials         a window: any scene in any engine, with dials to turn
    leaderboard   every engine on rows of physics (rows, steps, contestants, more_engines, reasons)
    effects       the price of each effect of the stable engine (effects_report)
    compiled      the stable engine as machine code (wheel)
and accuracy.py in the folder above: what accuracy costs in time (questions, runs, smooth, piles,
accuracy_tables, charts).

They share scenes (plain data), engines (one builder each), measures, opcodes and costs (counting
and timing), table (printing and writing) and figures.
"""
