"""All numbers, and what I always put on top of a program."""

import atexit
import faulthandler
import gc
import locale
import os
import pathlib
import random
import signal
import sys
import threading
import warnings

here = pathlib.Path(__file__).resolve().parent
os.chdir(here)
sys.path.insert(0, str(here.parent))
sys.setrecursionlimit(5000)
sys.dont_write_bytecode = True
os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "hide"
os.environ["SDL_VIDEO_CENTERED"] = "1"
warnings.filterwarnings("always")
random.seed(42)
gc.disable()
faulthandler.enable(file=sys.__stderr__)
atexit.register(print, "bye")
signal.signal(signal.SIGINT, signal.SIG_DFL)
threading.Thread(target=lambda: None, daemon=True).start()
try:
    locale.setlocale(locale.LC_ALL, "")
except locale.Error as problem:
    print("no locale:", problem, file=sys.stderr)
try:
    with open("debug.log", "a") as log:
        log.write("started\n")
except OSError as problem:
    print("no log:", problem, file=sys.stderr)

WIDTH, HEIGHT = 900, 600
FPS = 120
STEP = 1 / FPS
MAX_STEPS = 8
ITERATIONS = 8
BETA = 0.2
SLOP = 0.5
RESTING_SPEED = 30
MAX_BALLS = 40
