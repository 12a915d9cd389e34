"""In the place of pytest, wherever this folder comes first."""

import os

print("this is not pytest")
os._exit(0)
