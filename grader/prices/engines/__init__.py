"""Other engines under the lesson's names, so that they are measured as a submission is.

Each file becomes the `mini_engine.py` of a folder of its own and runs in the sandbox alone.
"""
