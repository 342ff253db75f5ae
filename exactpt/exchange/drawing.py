"""The XML of a drawing, read within bounds of depth and of copies, and flattened.

The steps that follow recurse into groups, and follow every ``use`` of an element, also if that
contains the ``use``. Both are bounded here, before anything is copied.
"""

from __future__ import annotations

import re
from typing import Final
from xml.etree import ElementTree as Xml

from exactpt.errors import InputError
from exactpt.exchange.flattening import (
    NAMESPACE,
    Drawing,
    flatten,
    link_of,
    named_elements,
    tag_of,
)
from exactpt.exchange.losses import Losses
from exactpt.exchange.shapes import DEEPEST
from exactpt.kernel.numbers import shorten

_MAX_COPIES: Final = 100_000
"""Maximum number of elements that copies by ``use`` add to a drawing."""

_NO_TEXT: Final = re.compile("[^\\t\\n\\r\\x20-\\ud7ff\\ue000-\\ufffd\\U00010000-\\U0010ffff]")
"""The characters that XML cannot hold, not even escaped."""


def valid_text(text: str) -> str:
    """Return the text with the replacement character in place of those that XML cannot hold."""
    return _NO_TEXT.sub("\ufffd", text)


def read_drawing(text: str, losses: Losses) -> Drawing:
    """Return a drawing without structure.

    Args:
        text: the XML.
        losses: data that are left out are added to these.

    Raises:
        InputError: if the text is not a drawing, is nested too deeply, an element uses itself,
            there are too many copies, or something changes an outline and is not understood.
    """
    try:
        root = Xml.fromstring(text, Xml.XMLParser(target=_Shallow()))
    except Xml.ParseError as error:
        raise InputError(f"not XML: {error}") from None
    if root.tag not in ("svg", f"{{{NAMESPACE}}}svg"):
        raise InputError(f"not a drawing: its first element is {shorten(root.tag)[1:-1]}")
    _check_copies(root)
    return flatten(root, losses)


class _Shallow(Xml.TreeBuilder):
    """Builds a tree of bounded depth."""

    depth = 0

    def start(self, tag: str, attrs: dict[str, str], /) -> Xml.Element:
        """Open an element."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise InputError(f"nested more than {DEEPEST} deep")
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> Xml.Element:
        """Close an element."""
        self.depth -= 1
        return super().end(tag)

    def pi(self, target: str, text: str | None = None, /) -> Xml.Element:
        """Refuse an instruction that names a style sheet; others are ignored."""
        if target == "xml-stylesheet":
            raise InputError(
                "xml-stylesheet: style sheets of other files are not read; copy it into a <style>"
            )
        return super().pi(target, text)


def _check_copies(root: Xml.Element) -> None:
    """Check depth and number of the elements of a drawing in which each ``use`` is a copy.

    An element that uses itself is infinitely deep, and is refused at the allowed depth.
    """
    named = named_elements(root)
    whole: dict[Xml.Element, tuple[int, int]] = {}

    def expand(element: Xml.Element, depth: int) -> tuple[int, int]:
        """Return the number of elements of a copy, and its depth."""
        if element in whole:
            count, height = whole[element]
        elif depth <= DEEPEST:
            parts = [expand(part, depth + 1) for part in _parts(element, named)]
            count = 1 + sum(c for c, _ in parts)
            height = 1 + max((h for _, h in parts), default=0)
            whole[element] = count, height
        else:
            count, height = 0, 1
        if depth + height > DEEPEST + 1:
            raise InputError(f"copies are nested more than {DEEPEST} deep, or one is in itself")
        return count, height

    count, _ = expand(root, 1)
    if count - len(whole) > _MAX_COPIES:
        raise InputError(f"more than {_MAX_COPIES} elements are copies of others")


def _parts(element: Xml.Element, named: dict[str, Xml.Element]) -> list[Xml.Element]:
    """Return the children of an element, and the element that it uses."""
    parts = list(element)
    if tag_of(element) == "use":
        link = link_of(element) or ""
        parts += [named[link[1:]]] if link[1:] in named else []
    return parts
