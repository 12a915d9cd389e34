"""In the place of math, wherever this folder comes first."""

import os

print("this is not math")
os._exit(0)
