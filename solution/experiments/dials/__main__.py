"""Open the window with dials, with the compiled stable engine where there is one."""

from ..compiled import use_compiled
from .window import main

if __name__ == "__main__":
    print(use_compiled())
    main()
