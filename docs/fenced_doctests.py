"""An extension of Griffe for `make docs`: doctests in docstrings become blocks of code."""

from __future__ import annotations

import re
from typing import Final

import griffe

DOCTEST: Final = re.compile(r"(?:^>>> .*\n?(?:^(?!>>>).+\n?)*)+", re.MULTILINE)


class FencedDoctests(griffe.Extension):
    """Fences a doctest, up to the next blank line."""

    def on_object(self, *, obj: griffe.Object, **_: object) -> None:
        """Change the docstring of an object."""
        if obj.docstring is not None:
            text = obj.docstring.value
            obj.docstring.value = DOCTEST.sub(
                lambda found: f"```pycon\n{found[0].rstrip()}\n```\n", text
            )
