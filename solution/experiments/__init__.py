"""Experiments with the lesson's engine, the stable one, pymunk, and Box2D where it is installed.

Programs, each started with python -m experiments.NAME:
    window        any scene in any engine, with dials
    hard_cases    where engines give up, side by side
    published     the tests of Boeing and Bräunl, side by side
    effects       what each effect of the stable engine costs
    compiled      the stable engine as machine code
and accuracy.py in the folder above: what accuracy costs in time.

What they share: scenes (plain data), engines (one builder each), edits (of the lesson's engine),
measures, opcodes (counting them), table (printing and writing).
What one alone uses: drawing for window; battery, trials, steps and limits for hard_cases and
published; effects_report for effects; smooth, dials, answers, costs, race, accuracy_tables and
figures for accuracy.py.
"""
