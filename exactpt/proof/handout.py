"""Checkers as single files, which need nothing but Python, for those who are to be convinced.

In the package, both checkers import `exactpt.proof_scene`. A file that is handed out has the text
of that module where the import stands. No other word is changed.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from exactpt.errors import AuditError

_IMPORT: Final = re.compile(r"^from exactpt\.proof_scene import \([^)]*\)\n", re.MULTILINE)
_FIRST_LINES: Final = re.compile(r'\A"""(.*?)"""\n', re.DOTALL)
_PACKAGE: Final = Path(__file__).parents[1]


def checker_file(name: str) -> bytes:
    """Return the file of a checker that is handed out.

    >>> b"import exactpt" in checker_file("proof_check")
    False

    Args:
        name: the module, "proof_check" or "check_apart".

    Raises:
        AuditError: if the module does not import its reader exactly once.
    """
    checker = _text_of(name)
    reader, count = _FIRST_LINES.subn(_as_comment, _text_of("proof_scene"))
    joined, imports = _IMPORT.subn(lambda _: reader, checker)
    if count != 1 or imports != 1:
        raise AuditError(f"{name}: {imports} imports of its reader, which has {count} docstrings")
    return joined.encode()


def _text_of(module: str) -> str:
    return (_PACKAGE / f"{module}.py").read_text(encoding="utf-8")


def _as_comment(docstring: re.Match[str]) -> str:
    """Return a docstring as a comment: in the middle of a file it would be no docstring."""
    lines = docstring[1].rstrip().split("\n")
    return "".join(f"# {line}".rstrip() + "\n" for line in ("", *lines, ""))
