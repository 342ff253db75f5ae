"""The XML of a drawing, read within bounds of depth and of copies.

What parses a drawing afterwards recurses into groups, and follows every ``use`` of an element,
also of one that contains it. So both are bounded here, before anything is copied.
"""

from __future__ import annotations

import re
from typing import Final
from xml.etree import ElementTree as Xml

from exactpt.errors import InputError
from exactpt.exchange.shapes import DEEPEST
from exactpt.kernel.numbers import shorten

NAMESPACE: Final = "http://www.w3.org/2000/svg"

_MAX_COPIES: Final = 100_000
"""Maximum number of elements that copies by ``use`` add to a drawing."""

_HREFS: Final = ("href", "{http://www.w3.org/1999/xlink}href")

_NO_TEXT: Final = re.compile("[^\\t\\n\\r\\x20-\\ud7ff\\ue000-\\ufffd\\U00010000-\\U0010ffff]")
"""The characters that XML cannot hold, not even escaped."""

_NUMBER: Final = re.compile(r"[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?")


def valid_text(text: str) -> str:
    """Return the text with the replacement character in place of those that XML cannot hold."""
    return _NO_TEXT.sub("\ufffd", text)


def read_drawing(text: str) -> Xml.Element:
    """Return the root element of a drawing.

    Raises:
        InputError: if the text is not a drawing, is nested too deeply, an element uses itself, or
            there are too many copies.
    """
    try:
        root = Xml.fromstring(text, Xml.XMLParser(target=_Shallow()))
    except Xml.ParseError as error:
        raise InputError(f"not XML: {error}") from None
    if root.tag not in ("svg", f"{{{NAMESPACE}}}svg"):
        raise InputError(f"not a drawing: its first element is {shorten(root.tag)[1:-1]}")
    _check_copies(root)
    _make_linear(root)
    return root


def _make_linear(root: Xml.Element) -> None:
    """Rewrite texts on which regular expressions of svgelements take quadratic or cubic time.

    They backtrack over long digits of ``points``, over a parenthesis, brace or comment that is not
    closed, and over spaces before an empty rule. The values are the same: doubles of numbers,
    closed transforms, rules that have a selector and a body.
    """
    for element in root.iter():
        for key, value in element.items():
            if key == "points":
                element.set(key, _NUMBER.sub(_double, value))
            elif key == "style" or key.lower().endswith("transform"):
                element.set(key, _closed(value))
        if element.tag in ("style", f"{{{NAMESPACE}}}style"):
            element.text = _plain_rules(element.text or "")


def _double(number: re.Match[str]) -> str:
    """Return a number in 24 characters or fewer, of the same double; infinity as 1e999."""
    return number[0] if len(number[0]) < 25 else repr(float(number[0])).replace("inf", "1e999")


def _closed(declarations: str) -> str:
    """Cut each declaration before a parenthesis that is not closed."""
    parts = declarations.split(";")
    cut = (p[: p.rfind(")") + 1] if p.rfind("(") > p.rfind(")") else p for p in parts)
    return ";".join(cut)


def _plain_rules(css: str) -> str:
    """Return the rules of a style sheet without comments, each as selector { declarations }."""
    first, *others = css.split("/*")
    text = first + "".join(other.partition("*/")[2] for other in others)
    rules = (rule.partition("{") for rule in text.split("}")[:-1])
    return "\n".join(
        f"{' '.join(selector.split())} {{{_closed(body.strip())}}}"
        for selector, _, body in rules
        if selector.strip() and body.strip()
    )


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


def _check_copies(root: Xml.Element) -> None:
    """Check depth and number of the elements of a drawing in which each ``use`` is a copy.

    An element that uses itself is infinitely deep, and is refused at the allowed depth.
    """
    named = {name: element for element in root.iter() if (name := element.get("id")) is not None}
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
    if element.tag.rpartition("}")[2] == "use":
        links = [element.get(key) for key in _HREFS]
        parts += [named[link[1:]] for link in links if link is not None and link[1:] in named]
    return parts
