"""The list of sources that `make compiled` compiled: an edited one is not hidden.

setup.py writes the list when it compiles a checkout; a wheel has none. ``import exactpt`` compares
it with the sources, if it is there.
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
LIST = Path(__file__).with_name("compiled.txt")


def write(sources: list[str]) -> None:
    """Write digest, size in bytes and time of change in ns of each source, a path from the root."""
    lines = []
    for source in sources:
        status = (ROOT / source).stat()
        lines.append(f"{_digest(ROOT / source)} {status.st_size} {status.st_mtime_ns} {source}\n")
    LIST.write_text("".join(lines), encoding="utf-8")


def compare() -> None:
    """Compare the sources with the list; only those of another size or time are read.

    Raises:
        ImportError: if a source has another content, or is missing. The command line ends with
            the message and exit code 2 instead.
    """
    for line in LIST.read_text(encoding="utf-8").splitlines():
        digest, size, changed, source = line.split(" ", 3)
        try:
            status = (ROOT / source).stat()
            if (status.st_size, status.st_mtime_ns) == (int(size), int(changed)):
                continue
            if _digest(ROOT / source) == digest:
                continue
            what = "edited"
        except FileNotFoundError:
            what = "removed"
        message = f"{source} was {what} after `make compiled`: run make compiled or make plain"
        if Path(sys.argv[0]).stem == "exactpt" or sys.orig_argv[1:3] == ["-m", "exactpt"]:
            sys.stderr.write(f"exactpt: {message}\n")
            sys.exit(2)
        raise ImportError(message)


def _digest(source: Path) -> str:
    from hashlib import sha256

    return sha256(source.read_bytes()).hexdigest()
