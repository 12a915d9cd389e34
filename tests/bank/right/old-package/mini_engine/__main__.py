"""Start the window, for python -m mini_engine."""

from .game_loop import main

main()
