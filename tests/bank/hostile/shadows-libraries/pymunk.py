"""In the place of pymunk, wherever this folder comes first."""

import os

print("this is not pymunk")
os._exit(0)
