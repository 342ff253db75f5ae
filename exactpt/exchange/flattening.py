"""Drawings without structure: every outline that is shown, with its own values and transform.

Groups, copies by ``use``, symbols, nested drawings, ``switch`` and style sheets are resolved as in
SVG 2. Data that would change an outline and are not understood are refused by name; drawn content
other than outlines is counted in `Losses`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Final, NamedTuple
from xml.etree import ElementTree as Xml

from exactpt.errors import InputError
from exactpt.exchange.lengths import (
    MILLIMETRES,
    PIXEL,
    Alignment,
    Box,
    Length,
    Matrix,
    Rectangle,
    alignment_of,
    box_of,
    checked_path,
    checked_points,
    length_of,
    matrix_of,
    moved,
    pixels,
    rectangle_of,
)
from exactpt.exchange.losses import Losses
from exactpt.exchange.style import CHANGES, INHERITED, MARKERS, Declarations, StyleSheets
from exactpt.kernel.numbers import QQ, parse_rational, shorten

NAMESPACE: Final = "http://www.w3.org/2000/svg"
HREFS: Final = ("href", "{http://www.w3.org/1999/xlink}href")

OUTLINE: Final = "data-outline"
"""Attribute of a flat outline: its number."""

_GROUPS: Final = ("g", "a")
_UNSEEN: Final = {
    "clipPath", "color-profile", "cursor", "defs", "desc", "filter", "font", "font-face", "hatch",
    "linearGradient", "marker", "mask", "mesh", "meshgradient", "metadata", "missing-glyph",
    "mpath", "pattern", "radialGradient", "solidcolor", "style", "symbol", "title", "view",
}  # fmt: skip
"""Elements that are not drawn where they are."""
_ANIMATIONS: Final = ("animate", "animateColor", "animateMotion", "animateTransform", "set")
_PAINT: Final = (
    "color", "fill", "fill-opacity", "opacity", "stop-color", "stop-opacity", "stroke",
    "stroke-dashoffset", "stroke-opacity", "stroke-width",
)  # fmt: skip
"""Attributes that an animation may change: no outline moves."""

_LENGTHS: Final[dict[str, dict[str, str]]] = {
    "rect": {"x": "x", "y": "y", "width": "x", "height": "y", "rx": "x", "ry": "y"},
    "circle": {"cx": "x", "cy": "y", "r": "xy"},
    "ellipse": {"cx": "x", "cy": "y", "rx": "x", "ry": "y"},
    "line": {"x1": "x", "y1": "y", "x2": "x", "y2": "y"},
    "path": {},
    "polyline": {},
    "polygon": {},
}
"""For each basic shape its lengths, and the size of the viewport that is 100% of each."""
_SIZES: Final[dict[str, set[str]]] = {
    "rect": {"width", "height"},
    "circle": {"r"},
    "ellipse": {"rx", "ry"},
    "line": set(),
    "path": set(),
    "polyline": set(),
    "polygon": set(),
}
"""For each basic shape the lengths without which it is not drawn."""

_SMALLEST: Final = QQ(1, 10**100)
"""A unit of a drawing has more millimetres than these."""
_UNCHANGING: Final = {"auto", "none", "normal", "inherit", "initial", "unset"}
_FROM_PARENT: Final = ("inherit", "unset")
_IDENTITY: Final = Matrix()


class Window(NamedTuple):
    """A rectangle that cuts off everything outside of it.

    Attributes:
        name: the element that cuts, for messages.
        matrix: the map from the window, with the corner (0, 0), to the drawing.
        width: its width.
        height: its height.
    """

    name: str
    matrix: Matrix
    width: float
    height: float


@dataclass(frozen=True)
class Drawing:
    """A drawing without structure.

    Attributes:
        root: an ``svg`` with outlines alone, without transforms; each has a number.
        scale: units of the scene for each unit of the drawing, in x and in y.
        matrices: by the numbers of outlines, the maps from their coordinates to the drawing.
        windows: by the numbers of outlines, the windows that cut them.
    """

    root: Xml.Element
    scale: tuple[QQ, QQ]
    matrices: dict[str, Matrix]
    windows: dict[str, tuple[Window, ...]]


@dataclass(frozen=True)
class _Place:
    """Where an element is.

    Attributes:
        matrix: the map from its coordinates to the drawing.
        size: width and height of the viewport, None if they are unknown.
        inherited: values of properties that elements inherit.
        windows: the rectangles that cut it.
    """

    matrix: Matrix = _IDENTITY
    size: tuple[float | None, float | None] = (None, None)
    inherited: Declarations = field(default_factory=dict)
    windows: tuple[Window, ...] = ()

    def inside(self, matrix: Matrix) -> _Place:
        """Return the place of elements within a transform."""
        return replace(self, matrix=self.matrix.then(matrix))

    def whole(self, axis: str) -> float | None:
        """Return the length of 100%: the width, the height, or (for "xy") part of the diagonal."""
        width, height = self.size
        if axis == "xy":
            known = width is not None and height is not None
            return math.hypot(width or 0, height or 0) / math.sqrt(2) if known else None
        return width if axis == "x" else height


def tag_of(element: Xml.Element) -> str:
    """Return the tag of an element of SVG, also without a namespace; empty for others."""
    namespace, _, tag = element.tag.rpartition("}")
    return tag if namespace in ("", f"{{{NAMESPACE}") else ""


def link_of(element: Xml.Element) -> str | None:
    """Return the address that an element refers to."""
    return next((link for key in HREFS if (link := element.get(key)) is not None), None)


def named_elements(root: Xml.Element) -> dict[str, Xml.Element]:
    """Return the elements with an ``id``; of several with the same, the first."""
    found: dict[str, Xml.Element] = {}
    for element in root.iter():
        name = element.get("id")
        if name is not None:
            found.setdefault(name, element)
    return found


def flatten(root: Xml.Element, losses: Losses) -> Drawing:
    """Return a drawing without structure; copies by ``use`` must be bounded.

    Raises:
        InputError: if it has something that changes an outline, and is not understood.
    """
    return _Flattening(root, losses).drawing()


class _Flattening:
    """The outlines of a drawing, collected in its order."""

    def __init__(self, root: Xml.Element, losses: Losses) -> None:
        self._root, self._losses = root, losses
        self._named = named_elements(root)
        sheets = [element for element in root.iter() if tag_of(element) == "style"]
        self._styles = StyleSheets(sheets)
        self._flat = Xml.Element(f"{{{NAMESPACE}}}svg")
        self._matrices: dict[str, Matrix] = {}
        self._windows: dict[str, tuple[Window, ...]] = {}

    def drawing(self) -> Drawing:
        """Return the drawing."""
        where = _where(self._root)
        for element in self._root.iter():
            if tag_of(element) in _ANIMATIONS and link_of(element) is not None:
                _check_animation(element, tag_of(element))
        values = self._styles.values_of(self._root, "svg")
        values.pop("overflow", None)  # outlines beyond the page count too
        box = box_of(self._root.get("viewBox"), where)
        page = _page(values, box, self._root.get("preserveAspectRatio"), where)
        place = self._styled(values, _Place(size=page.size), where)
        if place is not None:
            self._add_children(self._root, place)
        return Drawing(self._flat, page.scale, self._matrices, self._windows)

    def _add_children(self, element: Xml.Element, place: _Place) -> None:
        for child in element:
            self._add(child, place)

    def _add(self, element: Xml.Element, place: _Place, using: Xml.Element | None = None) -> None:
        """Add the outlines of an element, used by a ``use`` or where it is."""
        tag = tag_of(element)
        is_unseen = tag in _UNSEEN and not (using is not None and tag == "symbol")
        if not tag or is_unseen or element.get("requiredExtensions", "").strip():
            return
        where = _where(element)
        if element.get("systemLanguage") is not None:
            raise InputError(f"{where}: systemLanguage is not supported: remove it")
        if tag in _ANIMATIONS:
            _check_animation(element, tag)
            return
        values = self._styles.values_of(element, tag)
        inside = self._styled(values, place, where)
        if inside is None:
            return
        if tag in _GROUPS:
            self._add_children(element, inside)
        elif tag == "switch":
            self._add_first(element, inside)
        elif tag == "use":
            self._add_copy(element, values, inside, where)
        elif tag in ("svg", "symbol"):
            self._add_nested(element, values, inside, where, using)
        elif tag in _LENGTHS:
            for child in element:
                if tag_of(child) in _ANIMATIONS:
                    _check_animation(child, tag_of(child))
            self._add_outline(element, tag, values, inside)
        else:
            self._losses.count(tag, "element")

    def _styled(self, values: Declarations, place: _Place, where: str) -> _Place | None:
        """Return the place in an element; None if it is not displayed."""
        for key, value in values.items():
            if "var(" in value:
                raise InputError(f"{where}: {key}: {shorten(value)} is not supported")
        if values.get("display", "").lower() == "none":
            return None
        for key in sorted(CHANGES.intersection(values)):
            if values[key].lower() not in _UNCHANGING:
                raise InputError(f"{where}: {key}: {shorten(values[key])} is not supported")
        if values.get("vector-effect", "none").lower() not in ("non-scaling-stroke", *_UNCHANGING):
            raise InputError(f"{where}: vector-effect: {values['vector-effect']} is not supported")
        if values.get("filter", "none").lower() not in _UNCHANGING:
            self._losses.count("filter", "element")
        matrix = matrix_of(values.get("transform", "none"), where)
        _check_origin(values, matrix, where)
        own = {key: values[key] for key in INHERITED if key in values}
        own = {key: value for key, value in own.items() if value.lower() not in _FROM_PARENT}
        inherited = {
            key: value
            for key, value in (place.inherited | own).items()
            if value.lower() != "initial"
        }
        inside = replace(place.inside(matrix), inherited=inherited)
        return self._cut(values, inside, where)

    def _cut(self, values: Declarations, place: _Place, where: str) -> _Place:
        """Return the place with the window of a clip path that is a rectangle."""
        if values.get("mask", "none").lower() not in _UNCHANGING:
            raise InputError(
                f"{where}: mask: {shorten(values['mask'])} is not supported: remove it"
            )
        clip = values.get("clip-path", "none")
        if clip.lower() in _UNCHANGING:
            return place
        window = self._window(clip, place, where)
        if window is None:
            raise InputError(
                f"{where}: clip-path: only one rectangle is supported: {shorten(clip)}"
            )
        return replace(place, windows=(*place.windows, window))

    def _window(self, clip: str, place: _Place, where: str) -> Window | None:
        """Return the window of a clip path; None if it is anything else."""
        name = clip.removeprefix("url(").removesuffix(")").strip(" \"'").removeprefix("#")
        path = self._named.get(name)
        if path is None or tag_of(path) != "clipPath" or not clip.startswith("url("):
            return None
        children = [child for child in path if tag_of(child) not in ("", "title", "desc")]
        is_plain = path.get("clipPathUnits", "userSpaceOnUse") == "userSpaceOnUse"
        if not is_plain or len(children) != 1 or tag_of(children[0]) not in ("rect", "path"):
            return None
        (child,) = children
        values = [self._styles.values_of(element, tag_of(element)) for element in (path, child)]
        others = ("clip-path", "mask", "display", "visibility", "rx", "ry", "transform-origin")
        if any(key in found for found in values for key in (*others, *CHANGES)):
            return None
        at = f"{where}: clip-path"
        matrix = place.matrix
        for found in values:
            matrix = matrix.then(matrix_of(found.get("transform", "none"), at))
        if tag_of(child) == "path":
            rectangle = rectangle_of(checked_path(_path_data(values[1].get("d", "none")), at))
            if rectangle is None:
                return None
        else:
            rectangle = Rectangle(
                pixels(values[1].get("x", "0"), place.whole("x"), f"{at}: x"),
                pixels(values[1].get("y", "0"), place.whole("y"), f"{at}: y"),
                pixels(values[1].get("width", "0"), place.whole("x"), f"{at}: width"),
                pixels(values[1].get("height", "0"), place.whole("y"), f"{at}: height"),
            )
        corner = moved(rectangle.x, rectangle.y)
        name = f"clip-path of {where}"
        return Window(name, matrix.then(corner), rectangle.width, rectangle.height)

    def _add_first(self, element: Xml.Element, place: _Place) -> None:
        """Add the first child of a ``switch`` that needs no extension."""
        for child in element:
            drawn = tag_of(child) and tag_of(child) not in _UNSEEN
            if drawn and child.get("requiredExtensions") is None:
                self._add(child, place)
                return

    def _add_copy(
        self, element: Xml.Element, values: Declarations, place: _Place, where: str
    ) -> None:
        link = link_of(element) or ""
        used = self._named.get(link[1:]) if link.startswith("#") else None
        if used is None:
            raise InputError(f"{where}: this file has no element {shorten(link)}")
        x, y = (
            pixels(values.get(key, "0"), place.whole(key), f"{where}: {key}") for key in ("x", "y")
        )
        self._add(used, place.inside(moved(x, y)), using=element)

    def _add_nested(
        self,
        element: Xml.Element,
        values: Declarations,
        place: _Place,
        where: str,
        using: Xml.Element | None,
    ) -> None:
        """Add a drawing in the drawing, or a symbol, which is one at each of its copies."""
        if using is not None:
            outer = self._styles.values_of(using, "use")
            values = values | {key: outer[key] for key in ("width", "height") if key in outer}
        lengths = {"x": "0", "y": "0", "width": "100%", "height": "100%"}
        axes = {"x": "x", "y": "y", "width": "x", "height": "y"}
        for key in lengths:
            if values.get(key, "auto").lower() != "auto":
                lengths[key] = values[key]
        box = box_of(element.get("viewBox"), where)
        overflow = values.get("overflow", "hidden").lower()
        fills = any(
            lengths[key].strip().endswith("%") and place.whole(axes[key]) is None
            for key in ("width", "height")
        )
        if fills and box is None:  # all of a page without a size, which cuts nothing
            x, y = (pixels(lengths[key], place.whole(key), f"{where}: {key}") for key in ("x", "y"))
            self._add_children(element, place.inside(moved(x, y)))
            return
        x, y, width, height = (
            pixels(lengths[key], place.whole(axes[key]), f"{where}: {key}") for key in lengths
        )
        if width <= 0 or height <= 0:
            return
        inside = place.inside(moved(x, y))
        if overflow not in ("visible", "auto"):
            window = Window(where, inside.matrix, width, height)
            inside = replace(inside, windows=(*inside.windows, window))
        alignment = alignment_of(element.get("preserveAspectRatio"), where)
        size: tuple[float | None, float | None] = (width, height)
        if box is not None:
            inside = inside.inside(_fitted(box, width, height, alignment))
            size = box.size
        self._add_children(element, replace(inside, size=size))

    def _add_outline(
        self, element: Xml.Element, tag: str, values: Declarations, place: _Place
    ) -> None:
        where = _where(element)
        if place.inherited.get("visibility", "visible").lower() in ("hidden", "collapse"):
            return
        given = {**element.attrib, **values}
        lengths = _lengths_of(tag, given, place, where)
        if not all(lengths[key] > 0 for key in _SIZES[tag]):
            return
        own = {key: repr(value) for key, value in lengths.items()}
        if tag == "path":
            data = _path_data(given.get("d", "none"))
            if not data.strip():
                return
            own["d"] = checked_path(data, where)
        elif not _LENGTHS[tag]:
            own["points"] = checked_points(given.get("points", ""), where)
        self._count_paint(place.inherited)
        rule = place.inherited.get("fill-rule", "nonzero").lower()
        number = str(len(self._flat))
        own |= {"fill-rule": rule, OUTLINE: number}
        if element.get("id") is not None:
            own["id"] = element.get("id", "")
        self._matrices[number] = place.matrix
        self._windows[number] = place.windows
        Xml.SubElement(self._flat, f"{{{NAMESPACE}}}{tag}", own)

    def _count_paint(self, values: Declarations) -> None:
        """Count strokes and markers of an outline."""
        if "stroke-width" in values and values.get("stroke", "none").lower() != "none":
            self._losses.count("stroke-width", "outline")
        for key in MARKERS:
            if values.get(key, "none").lower() not in _UNCHANGING:
                self._losses.count(key, "outline")


def _where(element: Xml.Element) -> str:
    tag = tag_of(element)
    name = element.get("id")
    return f"{tag} {shorten(name)}" if name else tag


def _lengths_of(tag: str, given: Declarations, place: _Place, where: str) -> dict[str, float]:
    """Return the lengths of a basic shape, in pixels.

    A radius that is not given is the other radius of an ellipse; other lengths are 0.

    Raises:
        InputError: if a size is negative.
    """
    lengths = {
        key: pixels(given[key], place.whole(axis), f"{where}: {key}")
        for key, axis in _LENGTHS[tag].items()
        if given.get(key, "auto").strip().lower() != "auto"
    }
    if tag in ("rect", "ellipse"):
        for key, other in (("rx", "ry"), ("ry", "rx")):
            lengths.setdefault(key, lengths.get(other, 0.0))
    for key in _LENGTHS[tag]:
        lengths.setdefault(key, 0.0)
    for key in _SIZES[tag] | ({"rx", "ry"} & lengths.keys()):
        if lengths[key] < 0:
            raise InputError(f"{where}: {key}: it is negative: {lengths[key]!r}")
    return lengths


def _path_data(data: str) -> str:
    """Return path data, of an attribute or of a style sheet."""
    text = data.strip()
    if text.startswith("path(") and text.endswith(")"):
        return text.removeprefix("path(").removesuffix(")").strip().strip("\"'")
    return "" if text == "none" else data


def _check_animation(element: Xml.Element, tag: str) -> None:
    """Refuse an animation that moves an outline."""
    name = element.get("attributeName", "")
    if tag in ("animateMotion", "animateTransform") or name not in _PAINT:
        what = f"{tag} of {shorten(name)}" if name else tag
        raise InputError(f"{what}: a drawing that moves is not supported: remove it")


def _check_origin(values: Declarations, matrix: Matrix, where: str) -> None:
    """Refuse an origin of a transform other than (0, 0)."""
    if matrix == _IDENTITY:
        return
    for key in ("transform-origin", "transform-box"):
        value = values.get(key, "initial").lower()
        is_zero = key == "transform-origin" and set(value.split()) <= {"0", "0px"}
        if value not in ("initial", "unset", "view-box") and not is_zero:
            raise InputError(f"{where}: {key}: {shorten(value)} is not supported")


def _fitted(box: Box, width: float, height: float, alignment: Alignment) -> Matrix:
    """Return the map from a viewBox to its viewport."""
    scale = [width / box.size[0], height / box.size[1]]
    if alignment.x is not None:
        scale = [(max if alignment.slice else min)(scale)] * 2
    free = width - scale[0] * box.size[0], height - scale[1] * box.size[1]
    x = free[0] * (alignment.x or 0) - scale[0] * float(box.x)
    y = free[1] * (alignment.y or 0) - scale[1] * float(box.y)
    return Matrix(a=scale[0], d=scale[1], e=x, f=y)


class _Page(NamedTuple):
    """The page of a drawing.

    Attributes:
        scale: units of the scene for each unit of the drawing, in x and in y.
        size: width and height of the viewport, None if they are unknown.
    """

    scale: tuple[QQ, QQ]
    size: tuple[float | None, float | None]


def _page(values: Declarations, box: Box | None, aspect: str | None, where: str) -> _Page:
    """Return the page of a drawing.

    If a side has a physical unit, the scale is in millimetres; else a unit of the drawing is one.
    The origin stays where the drawing has it, so the alignment of its box does not matter.
    """
    given: dict[str, Length] = {}
    for key in ("width", "height"):
        text = values.get(key, "auto")
        if text.strip().lower() in ("", "auto"):
            continue
        length = length_of(text, f"{where}: {key}")
        if length.unit != "%":
            given[key] = length
            if length.millimetres <= 0:
                raise InputError(f"{where}: {key}: it has no size: {shorten(text)}")
    alignment = alignment_of(aspect, where)
    is_physical = any(length.unit in MILLIMETRES for length in given.values())
    if box is None:
        sides = {key: float(length.millimetres / PIXEL) for key, length in given.items()}
        one = PIXEL if is_physical else QQ(1)
        return _Page((one, one), (sides.get("width"), sides.get("height")))
    if not is_physical:
        return _Page((QQ(1), QQ(1)), box.size)
    found = {
        key: given[key].millimetres / parse_rational(side)
        for key, side in (("width", box.width), ("height", box.height))
        if key in given
    }
    if not all(_SMALLEST < ratio < 1 / _SMALLEST for ratio in found.values()):
        raise InputError(f"{where}: width, height: no size for a viewBox {' '.join(box)}")
    if alignment.x is None and len(found) == 2:
        return _Page((found["width"], found["height"]), box.size)
    one = (max if alignment.slice else min)(found.values())
    return _Page((one, one), box.size)
