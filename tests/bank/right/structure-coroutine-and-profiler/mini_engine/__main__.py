"""Start the window, for python -m mini_engine."""

import asyncio

from mini_engine import main

asyncio.run(main())
