"""``python -m exactpt``, and the command ``exactpt``: the command line."""

from __future__ import annotations

import sys


def main() -> None:
    """Run the command line; Ctrl-C while its modules are imported ends it in one line."""
    try:
        from exactpt.cli import main as run

        run()
    except KeyboardInterrupt:
        sys.stderr.write("exactpt: interrupted\n")
        sys.exit(130)


if __name__ == "__main__":
    main()
