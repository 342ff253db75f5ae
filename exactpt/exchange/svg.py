"""SVG drawings: outlines of paths and basic shapes are read and written; curves become chords.

The structure of a drawing is resolved in `exactpt.exchange.flattening`; svgelements parses the
outlines that are left. The y-axis is flipped to point up. Points of curves and transformed points
are computed in doubles, which are taken at their exact value, and scaled exactly to millimetres if
the drawing has a physical size.
"""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias
from xml.etree import ElementTree as Xml

from exactpt.errors import ExactPTError, InputError
from exactpt.exchange.drawing import read_drawing, valid_text
from exactpt.exchange.flattening import NAMESPACE, OUTLINE, Drawing, Window
from exactpt.exchange.lengths import Matrix
from exactpt.exchange.losses import Losses
from exactpt.exchange.shapes import Shape, positive_tolerance, rounded_rings
from exactpt.filters.rounding import U
from exactpt.geometry.overlay import Part, as_given, evenodd, nonzero
from exactpt.geometry.polygon import are_collinear
from exactpt.geometry.simple import is_surely_simple
from exactpt.kernel.numbers import rational, shorten

if TYPE_CHECKING:
    import svgelements

    from exactpt.geometry.predicates import Point
    from exactpt.kernel.numbers import QQ

_SLACK: Final = 1e-9
"""Relative size of errors of rounding that are allowed: beyond a window, and of a right angle."""
FillRule: TypeAlias = "Callable[[Sequence[Sequence[Point]]], list[Part]]"
"""A function from rings to the parts that they fill."""

_FILL_RULES: Final[dict[str, FillRule]] = {"nonzero": nonzero, "evenodd": evenodd}

_MAX_CHORDS: Final = 20_000
"""Maximum number of chords of one curve; more indicate a mistaken tolerance."""
_MAX_POINTS: Final = 2_000_000
"""Maximum number of points of a drawing."""


class _Outline(NamedTuple):
    """An outline of a drawing.

    Attributes:
        name: its ``id``; empty without one.
        fill_rule: the value of this property.
        path: the path, in units of the drawing.
    """

    name: str
    fill_rule: str
    path: svgelements.Path


def shapes_of(text: str, tolerance: float, losses: Losses | None = None) -> Iterator[Shape]:
    """Yield the outlines of a drawing, named by their ``id``.

    They are in millimetres if the drawing has a physical width or height, else in the units of its
    ``viewBox``; its origin stays. The closed subpaths of a path are polygons, by its fill rule:
    each part that they fill is one, with its holes. An open subpath is a line, filled or not. Text
    and images are left out.

    Args:
        text: the drawing.
        tolerance: maximum distance of a chord from its curve, in units of the shapes.
        losses: data that are left out are added to these.

    Raises:
        InputError: if it is not a drawing, or the tolerance is not positive.
    """
    tolerance = positive_tolerance(tolerance)
    left = _MAX_POINTS
    drawing = read_drawing(text, losses or Losses())
    tolerance /= float(max(drawing.scale))
    for i, outline in enumerate(_outlines(drawing, tolerance)):
        where = f"outline {i}"
        if outline.name:
            where += f" (id {shorten(outline.name)[1:-1]})"
        try:
            subpaths = []
            for sub in outline.path.as_subpaths():
                points = _scaled(_points(sub, tolerance, left), drawing.scale)
                left -= len(points)
                subpaths.append((points, sub[-1]))
            fill = _fill_rule(outline.fill_rule)
            yield from _of_subpaths(subpaths, fill, where, outline.name or f"outline {i}")
        except InputError as error:
            raise InputError(f"{where}: {error}") from None


def _fill_rule(value: str) -> FillRule:
    """Return the function of a fill rule of CSS.

    Raises:
        InputError: if it is another value.
    """
    rule = _FILL_RULES.get(value.strip().lower())
    if rule is None:
        raise InputError(f"fill-rule must be nonzero or evenodd, got {shorten(value)}")
    return rule


def _of_subpaths(
    subpaths: Sequence[tuple[list[Point], svgelements.PathSegment]],
    fill: FillRule,
    where: str,
    name: str,
) -> Iterator[Shape]:
    import svgelements

    rings: list[list[Point]] = []
    others: list[Shape] = []
    for points, last in subpaths:
        if isinstance(last, svgelements.Move):
            continue  # a move without anything drawn after it
        if len(set(points)) == 1:
            others.append(Shape(where, name, "point", points[:1]))
        elif isinstance(last, svgelements.Close) or points[0] == points[-1]:
            rings.append(points)
        else:
            others.append(Shape(where, name, "line", points))
    if rings:
        shape = Shape(where, name, "polygon", rings[0], rings[1:])
        yield from _filled(shape, fill)
    yield from others


def _scaled(points: list[Point], scale: tuple[QQ, QQ]) -> list[Point]:
    """Return points of a drawing in units of the scene."""
    x_scale, y_scale = scale
    if x_scale == y_scale == 1:
        return points
    return [(x * x_scale, y * y_scale) for x, y in points]


def _filled(shape: Shape, fill: FillRule) -> Iterator[Shape]:
    """Yield the polygons that the rings of a shape fill.

    Rings that fill nothing are yielded as they are, and will be refused: one whose points are
    collinear, and all of them, if they cancel each other out, as a shape with holes.
    """
    rings = shape.rings
    if len(rings) == 1 and _is_surely_simple(rings[0]):
        yield shape
        return
    flat = [ring for ring in rings if are_collinear(ring)]
    others = [ring for ring in rings if not are_collinear(ring)]
    parts = as_given(fill(others), others)
    if others and not parts:
        parts = [Part(others[0], others[1:])]
    for outline, holes in parts:
        yield shape._replace(points=outline, holes=holes)
    for ring in flat:
        yield shape._replace(points=ring, holes=())


def _is_surely_simple(ring: Sequence[Point]) -> bool:
    """Return True if a ring, in doubles, certainly is simple.

    A drawing in physical units is scaled by a rational number, so that coordinates are rounded to
    doubles here, by at most U times their size.
    """
    open_ring = ring[:-1] if ring[0] == ring[-1] else ring
    if len(open_ring) < 3:
        return False
    xs, ys = ([float(p[axis]) for p in open_ring] for axis in (0, 1))
    rounding = U * max(map(abs, [*xs, *ys]))
    return is_surely_simple(xs, ys, closed=True, error=rounding)


def _outlines(drawing: Drawing, tolerance: float) -> Iterator[_Outline]:
    """Yield the outlines of a drawing."""
    try:
        import svgelements
    except ImportError:
        raise InputError("this needs svgelements: pip install 'exactpt[svg]'") from None

    source = io.StringIO(Xml.tostring(drawing.root, encoding="unicode"))
    try:
        parsed = svgelements.SVG.parse(source, on_error="raise")
        for element in parsed.elements():
            if isinstance(element, svgelements.Shape):
                number = element.values[OUTLINE]
                given = svgelements.Path(element)
                _close_rounded(given)
                path = _mapped(given, drawing.matrices[number], tolerance)
                _check_windows(path, drawing.windows[number])
                fill_rule = element.values.get("fill-rule", "nonzero")
                yield _Outline(element.id or "", fill_rule, path)
    except (ExactPTError, MemoryError):
        raise
    except Exception as error:  # any error that a damaged drawing causes in the parser
        reason = _reason(drawing.root, error)
        raise InputError(f"not a drawing that can be read: {reason}") from None


def _close_rounded(path: svgelements.Path) -> None:
    """End each subpath where it began, if only rounding keeps its last point from there.

    Relative coordinates are added in doubles, and the ends of the arcs of an ellipse are computed
    from their angles. So a subpath that returns to its start may end beside it, which would be
    a vertex and an edge that the drawing does not have, or a line instead of a polygon.

    Let M be the largest coordinate and u = 2**-53. Each segment adds at most 3 u M to the distance
    in x and in y: u M by the sum, and 2 u M as its offset, of at most 2 M, is the nearest double.
    The start and the ends of arcs (a product and a sum) are within 3 u M too.
    """
    import svgelements

    for subpath in path.as_subpaths():
        drawn = [s for s in subpath if not isinstance(s, (svgelements.Move, svgelements.Close))]
        if len(drawn) < 2 or drawn[0].start is None:
            continue
        start, end = drawn[0].start, drawn[-1].end
        largest = max(max(abs(s.end.x), abs(s.end.y)) for s in drawn)
        rounding = 3 * (len(drawn) + 2) * 2.0**-53 * largest
        if abs(start.x - end.x) <= rounding and abs(start.y - end.y) <= rounding:
            drawn[-1].end = svgelements.Point(start)


def _mapped(path: svgelements.Path, matrix: Matrix, tolerance: float) -> svgelements.Path:
    """Return the image of a path in the drawing.

    svgelements maps the two axes of an ellipse. Their images are its axes only if they are
    perpendicular; the arcs of other ellipses become chords before they are mapped.
    """
    import svgelements

    if matrix == Matrix():
        return path
    segments: list[svgelements.PathSegment] = []
    for segment in path:
        if isinstance(segment, svgelements.Arc) and not _keeps_axes(segment, matrix):
            count = _chord_count(segment, tolerance / (matrix.stretch or 1.0))
            ends = [segment.point(k / count) for k in range(1, count)]
            ends.append(segment.end)
            starts = [segment.start, *ends]
            segments += [svgelements.Line(*both) for both in zip(starts, ends, strict=False)]
        else:
            segments.append(segment)
    image = svgelements.Path(*segments) * svgelements.Matrix(*matrix)
    image.reify()
    image.id = path.id
    return image


def _keeps_axes(arc: svgelements.Arc, matrix: Matrix) -> bool:
    """Return True if the images of the axes of an ellipse are perpendicular."""
    center = complex(arc.center)
    axes = [complex(end) - center for end in (arc.prx, arc.pry)]
    x, y = (
        complex(matrix.a * v.real + matrix.c * v.imag, matrix.b * v.real + matrix.d * v.imag)
        for v in axes
    )
    return abs((x * y.conjugate()).real) <= _SLACK * abs(x) * abs(y)


def _check_windows(path: svgelements.Path, windows: Sequence[Window]) -> None:
    """Refuse an outline that a window cuts.

    Raises:
        InputError: if it is not all inside.
    """
    import svgelements

    for window in windows:
        inverse = window.matrix.inverse()
        box = None if inverse is None else (path * svgelements.Matrix(*inverse)).bbox()
        slack = _SLACK * (window.width + window.height)
        is_inside = box is not None and (
            min(box[0], box[1]) >= -slack
            and box[2] <= window.width + slack
            and box[3] <= window.height + slack
        )
        if not is_inside:
            raise InputError(
                f"outline {shorten(path.id or '')} is not all inside of {window.name}, which "
                "cuts it: cut it in the drawing, or remove that element"
            )


def _reason(root: Xml.Element, error: Exception) -> str:
    """Return the first path data that svgelements refuses; if it takes all, its error."""
    import svgelements

    for element in root.iter():
        data = element.get("d", "")
        try:
            svgelements.Path(data)
        except Exception:
            return f"path data: {shorten(data)}"
    return shorten(error)


def _points(subpath: svgelements.Subpath, tolerance: float, most: int) -> list[Point]:
    """Return at most ``most`` corners and ends of chords of a subpath, with y upwards."""
    import svgelements

    first = subpath[0]
    found = [] if isinstance(first, svgelements.Move) else [first.start]
    if None in found:
        raise InputError("a path that does not begin with a move (M)")
    for segment in subpath:
        if isinstance(segment, svgelements.Curve):
            count = _chord_count(segment, tolerance)
            found += [segment.point(k / count) for k in range(1, count)]
        if segment.end is not None:
            found.append(segment.end)
        if len(found) > most:
            raise InputError(f"more than {_MAX_POINTS} points: raise the tolerance")
    return [(rational(float(p.x)), rational(-float(p.y))) for p in found]


def _chord_count(curve: svgelements.Curve, tolerance: float) -> int:
    """Return the number of equal parameter steps whose chords stay within the tolerance.

    A curve whose second derivative is at most M is within M / (8 n^2) of its n chords. A Bezier
    curve of degree d has M <= d (d - 1) times its largest second difference. An ellipse is
    the unit circle stretched by at most its larger radius r, and a chord over the angle a
    of the unit circle is within 1 - cos(a / 2) of it.
    """
    import svgelements

    if isinstance(curve, svgelements.Arc):
        # Half the angle is acos(1 - tolerance / r), computed without cancellation.
        ratio = min(2.0, tolerance / (max(curve.rx, curve.ry) or tolerance))
        angle = 4 * math.asin(math.sqrt(ratio / 2))
        count = abs(curve.sweep) / angle if angle else math.inf  # 0: the radius overflows
    else:
        points = [complex(p.x, p.y) for p in curve]
        bends = [
            abs(a - 2 * b + c) for a, b, c in zip(points, points[1:], points[2:], strict=False)
        ]
        degree = len(points) - 1
        count = math.sqrt(degree * (degree - 1) * max(bends) / (8 * tolerance))
    if not count <= _MAX_CHORDS:
        raise InputError(f"a curve needs more than {_MAX_CHORDS} chords: raise the tolerance")
    return max(1, math.ceil(float(count)))


def svg_of(shapes: Iterable[Shape]) -> str:
    """Shapes as a drawing of paths with ids; coordinates are the nearest doubles.

    A unit is a millimetre, so that `shapes_of` gives the same numbers back.
    """
    drawn = [
        (
            shape,
            [[(x, 0.0 - y) for x, y in ring] for rings in rounded_rings(shape) for ring in rings],
        )
        for shape in shapes
    ]
    everything = [p for _, rings in drawn for ring in rings for p in ring]
    xs, ys = ([p[axis] for p in everything] or [0.0] for axis in (0, 1))
    box = (min(xs), min(ys), (max(xs) - min(xs)) or 1.0, (max(ys) - min(ys)) or 1.0)
    root = Xml.Element("svg", xmlns=NAMESPACE)
    if all(map(math.isfinite, box)):
        root.set("viewBox", " ".join(map(repr, box)))
        root.set("width", f"{box[2]!r}mm")
        root.set("height", f"{box[3]!r}mm")
    for shape, rings in drawn:
        end = "" if shape.kind == "line" else " Z"
        Xml.SubElement(
            root,
            "path",
            {
                "id": valid_text(shape.name),
                "d": " ".join(
                    f"M {' L '.join(f'{x!r} {y!r}' for x, y in ring)}{end}" for ring in rings
                ),
                **({"fill-rule": "evenodd"} if len(rings) > 1 else {}),
                "fill": "silver" if shape.kind == "polygon" else "none",
                "stroke": "black",
                "stroke-linecap": "round",
                "vector-effect": "non-scaling-stroke",
            },
        )
    Xml.indent(root)
    return Xml.tostring(root, encoding="unicode") + "\n"
