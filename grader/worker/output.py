"""What a submission prints: kept up to a bound, the rest counted and let go."""

import io
import sys

KEEP = 64 * 1024  # bytes between two answers


class Output(io.RawIOBase):
    """Takes the place of standard output and standard error alike."""

    def __init__(self) -> None:
        self.kept = bytearray()
        self.dropped = 0

    def install(self) -> None:
        self.text = io.TextIOWrapper(
            self,  # type: ignore[type-var]
            encoding="utf-8",
            errors="replace",
            newline="",
            write_through=True,
        )
        sys.stdout = sys.stderr = self.text

    def writable(self) -> bool:
        return True

    def write(self, data: bytes) -> int:  # type: ignore[override]
        room = max(0, KEEP - len(self.kept))
        self.kept += bytes(data[:room])
        self.dropped += max(0, len(data) - room)
        return len(data)

    def so_far(self) -> str:
        return self.kept.decode("utf-8", "replace")

    def take(self) -> str:
        text = self.so_far()
        if self.dropped:
            text += f"\n… and {self.dropped} bytes more"
        self.kept.clear()
        self.dropped = 0
        return text
