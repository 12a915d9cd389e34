"""Start the window, for python -m mini_engine."""

from mini_engine import main

main()
