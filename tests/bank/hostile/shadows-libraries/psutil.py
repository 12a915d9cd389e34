"""In the place of psutil, wherever this folder comes first."""

import os

print("this is not psutil")
os._exit(0)
