"""What a submission prints: the latest of it kept up to a bound, the rest counted and let go."""

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
        self.kept += bytes(data[-KEEP:])
        excess = max(0, len(self.kept) - KEEP)
        del self.kept[:excess]
        self.dropped += excess + max(0, len(data) - KEEP)
        return len(data)

    def so_far(self) -> str:
        return self.kept.decode("utf-8", "replace")

    def take(self) -> str:
        text = self.so_far()
        if self.dropped:
            text = f"{self.dropped} bytes and then …\n{text}"
        self.kept.clear()
        self.dropped = 0
        return text
