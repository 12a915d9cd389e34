from .engine import *
from .window import main
