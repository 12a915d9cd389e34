"""Keep the end of what a submission prints, up to a bound; count and drop the rest.

An endless loop of print() must fill neither the memory nor the report.
"""

import io
import sys

from grader.protocol import MAX_OUTPUT


class Output(io.RawIOBase):
    """Replaces standard output and standard error; the real ones lead to /dev/null.

    The text is untrusted: the judge escapes it wherever it is shown.
    """

    def __init__(self) -> None:
        self.tail = bytearray()
        self.dropped = 0

    def install(self) -> None:
        """Replace sys.stdout and sys.stderr; an unknown letter becomes a question mark."""
        self.text = io.TextIOWrapper(
            self,  # type: ignore[type-var]
            encoding="utf-8",
            errors="replace",
            newline="",
            write_through=True,
        )
        sys.stdout = sys.stderr = self.text

    def writable(self) -> bool:
        """Return True, as io.TextIOWrapper demands."""
        return True

    def write(self, data: bytes) -> int:  # type: ignore[override]
        """Keep the last MAX_OUTPUT bytes since the last answer."""
        self.tail += bytes(data[-MAX_OUTPUT:])
        excess = max(0, len(self.tail) - MAX_OUTPUT)
        del self.tail[:excess]
        self.dropped += excess + max(0, len(data) - MAX_OUTPUT)
        return len(data)

    def peek(self) -> str:
        """Return the text without taking it."""
        return self.tail.decode("utf-8", "replace")

    def take(self) -> str:
        """Take the text for an answer, with a note on the dropped bytes."""
        text = self.peek()
        if self.dropped:
            text = f"{self.dropped} bytes and then …\n{text}"
        self.tail.clear()
        self.dropped = 0
        return text
