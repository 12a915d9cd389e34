"""What the layers around a submission hold back, told by their names."""

from typing import Literal

Isolation = Literal["auto", "strict", "none"]

# What is confined, and the layers of which one is enough.
LAYERS = {
    "files": {"own-root", "landlock-files"},
    "network": {"system-calls", "network-namespace", "landlock-tcp"},
    "other processes": {"system-calls", "pid-namespace", "landlock-scope", "own-user"},
}
STRICT = ("files", "network")  # what --isolation=strict insists on


def unconfined(layers: list[str]) -> list[str]:
    """What a submission can still reach."""
    return [what for what, any_of in LAYERS.items() if not any_of & set(layers)]
