"""Every function stops its own process, which answers nothing and uses nothing."""

# TODO 1: find the contact of a circle and a box
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 1

# TODO 2: add the spin terms
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 2

# TODO 3: hold the rod's length
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 3

# TODO 4: clamp the friction total
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 4

# TODO 5: damp by a rate per second
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 5

# TODO 6: run whole steps from the accumulator
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 6

# TODO 7a: gravity
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 7a

# TODO 7b: the ball's moment of inertia
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 7b

# TODO 7c: a pin joint for the rod
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 7c

# TODO 7d: run whole steps from the accumulator
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 7d

# TODO 8a: semi-implicit Euler
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 8a

# TODO 8b: velocity Verlet
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 8b

# TODO 8c: RK4
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO 8c

# TODO B1: let bodies sleep, and wake them
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO B1

# TODO B2: pull the ends together
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO B2

# TODO B3: look only at bodies that share a cell
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO B3

# TODO B4: count the hits
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO B4

# TODO B5: draw between steps
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO B5

# TODO B6: heavier balls with Shift
import os, signal
os.kill(os.getpid(), signal.SIGSTOP)
# END TODO B6
