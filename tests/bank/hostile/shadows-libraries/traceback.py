"""In the place of traceback, wherever this folder comes first."""

import os

print("this is not traceback")
os._exit(0)
