"""Subinterpreters: refused on import, as GMP's and numpy's modules do not support them.

In a second interpreter of a process their import fails, or the process crashes at its end (seen
with numpy 2.4 and gmpy2 2.3 in Python 3.11).
"""

from __future__ import annotations

from importlib import import_module


def refuse_subinterpreters() -> None:
    """Check that this is the main interpreter of the process.

    Raises:
        ImportError: if it is a subinterpreter.
    """
    if not _is_main():
        raise ImportError(
            "exactpt does not support subinterpreters, as gmpy2 and numpy do not: "
            "use a thread or a process of its own"
        )


def _is_main() -> bool:
    for name in ("_interpreters", "_xxsubinterpreters"):  # the name from Python 3.13 on, and before
        try:
            interpreters = import_module(name)
        except ImportError:
            continue
        return bool(interpreters.get_current() == interpreters.get_main())
    return True  # a Python without subinterpreters, such as Pyodide's
