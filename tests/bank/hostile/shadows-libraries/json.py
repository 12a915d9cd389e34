"""In the place of json, wherever this folder comes first."""

import os

print("this is not json")
os._exit(0)
