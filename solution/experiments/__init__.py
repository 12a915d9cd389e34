"""Experiments with the lesson's engine, the stable one, pymunk, and others that are installed.

Programs, each started with python -m experiments.NAME:
    dials         a window: any scene in any engine, with dials to turn
    leaderboard   every engine on rows of physics (rows/)
    effects       the price of each effect of the stable engine (effects_report)
    compiled      the stable engine as machine code (wheel/)
and accuracy.py in the folder above: the cost of accuracy in time (accuracy/).

They share scenes (plain data), engines/ (a builder for each engine), steps (of varying length),
measures, opcodes (counting), table (printing and writing) and figures.
"""
