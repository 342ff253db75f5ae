"""Style sheets of drawings: the properties of an element that change its outlines.

Simple selectors are understood: a type, ``*``, classes, an id, and several of these together. A
rule with another selector or a condition is refused if it would change an outline, and ignored if
it is about paint.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import Final, NamedTuple, TypeAlias, final
from xml.etree import ElementTree as Xml

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten

Declarations: TypeAlias = dict[str, str]

PLACES: Final = {"x", "y", "width", "height", "cx", "cy", "r", "rx", "ry", "d", "transform"}
"""Properties of the standard that place an outline."""
CHANGES: Final = {
    "animation", "animation-name", "clip", "motion-path", "offset", "offset-path", "rotate",
    "scale", "translate", "zoom",
}  # fmt: skip
"""Properties of style sheets that change an outline, or move it, and are not understood."""
MARKERS: Final = ("marker", "marker-start", "marker-mid", "marker-end")
PAINTED: Final = ("stroke", "stroke-width", *MARKERS)
"""Properties that draw beside an outline; elements in a group inherit them."""
INHERITED: Final = ("fill-rule", "visibility", *PAINTED)
_SHAPING: Final = {
    "clip-path", "display", "fill-rule", "mask", "overflow", "transform-box", "transform-origin",
    "vector-effect", "visibility", *PLACES, *CHANGES,
}  # fmt: skip
"""Properties that decide which outlines there are."""
_KNOWN: Final = {"filter", *_SHAPING, *PAINTED}
_OF_STYLE_SHEETS: Final = CHANGES - {"clip"}
"""Properties that have no attribute of that meaning."""

_SIMPLE: Final = re.compile(r"(?P<type>\*|[A-Za-z][\w-]*)?(?P<others>(?:[.#][A-Za-z_][\w-]*)*)")
_PART: Final = re.compile(r"[.#][\w-]+")
_HARMLESS: Final = ("@charset", "@font-face", "@keyframes", "@namespace", "@-webkit-keyframes")
"""Rules without a selector that place nothing: an animation is refused where it is named."""


class _Rule(NamedTuple):
    """A rule with a simple selector.

    Attributes:
        rank: number of ids, of classes, and of types; then its place in the drawing.
        type: the type of element; empty for any.
        ids: the ids that an element must have.
        classes: the classes that it must have.
        declarations: the values of properties.
    """

    rank: tuple[int, int, int, int]
    type: str
    ids: frozenset[str]
    classes: frozenset[str]
    declarations: Declarations


@final
class StyleSheets:
    """The rules of a drawing.

    >>> sheet = Xml.fromstring("<style>.cut {display: none} path {display: inline}</style>")
    >>> sheets = StyleSheets([sheet])
    >>> sheets.values_of(Xml.Element("path", {"class": "cut", "transform": "scale(2)"}), "path")
    {'transform': 'scale(2)', 'display': 'none'}

    Raises:
        InputError: if a rule would change an outline, and is not understood.
    """

    def __init__(self, sheets: list[Xml.Element]) -> None:
        self._count = 0
        self._rules: dict[str, list[_Rule]] = defaultdict(list)
        """By an id or a class that an element must have ("#a", ".a"), else by its type or ""."""
        for sheet in sheets:
            if sheet.get("type", "text/css").strip().lower() != "text/css":
                continue
            text = "".join(sheet.itertext())
            if sheet.get("media", "all").strip().lower() not in ("", "all", "screen"):
                _check_unread(_without_comments(text), "media")
                continue
            self._read(_without_comments(text))

    def _read(self, text: str) -> None:
        for selectors, body in _blocks(text):
            if selectors.startswith("@"):
                _check_at_rule(selectors, body)
                continue
            declarations = declared(body)
            for selector in selectors.split(","):
                self._add(selector.strip(), declarations)

    def _add(self, selector: str, declarations: Declarations) -> None:
        match = _SIMPLE.fullmatch(selector)
        if match is None or not selector:
            _refuse_shaping(declarations, f"the selector {shorten(selector)}")
            return
        parts = _PART.findall(match["others"])
        ids = frozenset(part[1:] for part in parts if part[0] == "#")
        classes = frozenset(part[1:] for part in parts if part[0] == ".")
        kind = match["type"] or "*"
        kind = "" if kind == "*" else kind
        self._count += 1
        rank = len(ids), len(classes), int(bool(kind)), self._count
        key = parts[0] if parts else kind
        self._rules[key].append(_Rule(rank, kind, ids, classes, declarations))

    def values_of(self, element: Xml.Element, tag: str) -> Declarations:
        """Return the values of the properties of an element that are known here.

        Attributes come first, then rules by rank, then its ``style``; important ones last.
        """
        found = {k: v for k, v in element.items() if k in _KNOWN and k not in _OF_STYLE_SHEETS}
        keys = {"", tag, f"#{element.get('id')}", *(f".{c}" for c in _classes(element))}
        near = [rule for key in keys for rule in self._rules.get(key, ())]
        rules = sorted(rule for rule in near if _applies(rule, element, tag))
        given = [*(rule.declarations for rule in rules), declared(element.get("style", ""))]
        important: Declarations = {}
        for declarations in given:
            for key, value in declarations.items():
                plain, mark, _ = value.partition("!")
                (important if mark else found)[key] = plain.strip()
        return found | important


def _applies(rule: _Rule, element: Xml.Element, tag: str) -> bool:
    if rule.type and rule.type != tag:
        return False
    if rule.ids and rule.ids != {element.get("id")}:
        return False
    return rule.classes <= _classes(element)


def _classes(element: Xml.Element) -> set[str]:
    return set(element.get("class", "").split())


def _without_comments(text: str) -> str:
    first, *others = text.split("/*")
    return " ".join([first, *(other.partition("*/")[2] for other in others)])


def declared(text: str) -> Declarations:
    """Return the declarations of a text that are known here, as ``{property: value}``."""
    found: Declarations = {}
    for declaration in _without_comments(text).split(";"):
        key, _, value = declaration.partition(":")
        if key.strip().lower() in _KNOWN and value.strip():
            found[key.strip().lower()] = value.strip()
    return found


def _blocks(text: str) -> Iterator[tuple[str, str]]:
    """Yield the selectors and the content of each block, and at-rules that have none."""
    depth = start = 0
    selectors = ""
    for mark in re.finditer("[{};]", text):
        if mark[0] == "{":
            if not depth:
                selectors = text[start : mark.start()].strip()
                start = mark.end()
            depth += 1
        elif mark[0] == "}" and depth:
            depth -= 1
            if not depth:
                yield selectors, text[start : mark.start()]
                start = mark.end()
        elif not depth:
            statement = text[start : mark.start()].strip()
            if statement.startswith("@"):
                yield statement, ""
            start = mark.end()
    if depth:  # a block that is not closed ends with the sheet
        yield selectors, text[start:]


def _check_at_rule(name: str, body: str) -> None:
    """Refuse an at-rule that may change an outline."""
    if name.lower().startswith("@import"):
        raise InputError("style: @import: style sheets of other files are not read; copy it in")
    if not name.lower().startswith(_HARMLESS):
        _check_unread(body, name)


def _check_unread(body: str, name: str) -> None:
    for _, inner in _blocks(body):
        _refuse_shaping(declared(inner.replace("{", ";").replace("}", ";")), shorten(name))


def _refuse_shaping(declarations: Mapping[str, str], where: str) -> None:
    shaping = sorted(
        key
        for key in _SHAPING.intersection(declarations)
        if (key, declarations[key]) != ("vector-effect", "non-scaling-stroke")  # paint
    )
    if shaping:
        raise InputError(
            f"style: {where} with {shorten(shaping[0])} is not supported: give the elements "
            "this property themselves"
        )
