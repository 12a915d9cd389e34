"""Start the window, for python -m mini_engine."""

from mini_engine.game_loop import main

main()
