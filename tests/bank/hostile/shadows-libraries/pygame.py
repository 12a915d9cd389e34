"""In the place of pygame, wherever this folder comes first."""

import os

print("this is not pygame")
os._exit(0)
