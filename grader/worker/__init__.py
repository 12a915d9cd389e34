"""Run a submission. This package imports only `protocol` from the rest of the grader.

A child goes through these steps:

1. Start. warm.py loads Python, pygame and pymunk once and forks a child per check, in milliseconds.
   Where there is no fork, spawned.py starts each child as a new process. Without processes, tab.py
   keeps the child in the judge's process, only for the user's own work.
2. Confine (confinement.py, root.py, filter.py): the child gives up its rights before it sees a line
   of the submission.
3. Copy (copies.py): it gets its own copy of the submission.
4. Prepare (session.py): it replaces the clock, the output and the import rule.
5. Answer (child.py): it imports the submission and answers requests until the judge hangs up.
   subject.py holds its objects, values.py reads them as numbers, play.py runs whole programs,
   recorder.py records states for replays.
6. End: the starter of step 1 kills the child with all that it started, and returns its exit status.

The submission can change all of Python in its child, so it may invent every byte that the child
sends. Nothing here decides a mark: the judge checks types and values.
"""
