"""Grade one submission: run the checks, weigh the answers, word the result.

A grade goes through these steps:

1. Take in (submission.py): make a read-only copy, and find the TODOs in it. A TODO with the stub of
   the starter is not started.
2. Run (loop.py, running.py): run each check of the rubric in a child (wall/), with the reference's
   functions in place of the other TODOs (reference.py). The check asks by its `Lab` (lab.py).
3. Judge (failures.py, verdict.py): a check that returns has passed. One that raises `NotYet`, as
   `Lab.want` does, is "not yet": *Expected* and *Got* are its words. `Broke` is an error.
4. Decide the points (grade.py): give back what changed given code alone has cost, and count a guard
   only beside another check that passed.
5. Explain (explain/): find what a failure means and where to look. No points depend on it.
"""
