"""Run a submission. Of the rest of the grader, this room imports `protocol` alone.

What happens, in this order:

1. warm (warm.py): a process loads Python, pygame and pymunk once, and waits for the judge.
2. fork (warm.py): each check gets a child of its own, in milliseconds, and no trace of another.
   Where there is no fork, spawned.py starts the child as a new process. Where there are no
   processes, tab.py keeps it in the judge's own, for one's own work alone.
3. confine (confinement.py): the child gives up its rights, before it sees a line of the submission.
4. serve (child.py): the child imports the submission and answers requests until the judge hangs up.
5. answer: subject.py calls functions and turns objects into plain numbers; play.py runs whole
   programs, on the clock of scripted.py; output.py keeps what is printed; recorder.py records
   states for replays.

Once a child runs the submission, every byte it sends may be made up, for the submission can change
all of Python around it. So nothing here decides a mark: the judge checks types and values.
"""
