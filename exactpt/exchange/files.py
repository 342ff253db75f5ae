"""Files of shapes; the suffix determines the format, for ``.json`` the content."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal, TypeAlias

from exactpt.errors import InputError
from exactpt.exchange import geojson, mfjson, svg, wkt
from exactpt.exchange.bodies import Holes, Parts, scene_of
from exactpt.exchange.drawing import valid_text
from exactpt.exchange.instants import from_datetime
from exactpt.exchange.losses import Losses, check_strict
from exactpt.exchange.shapes import Shape, shapes_at
from exactpt.files import read_text, write_atomically
from exactpt.kernel.numbers import shorten
from exactpt.motion.displacement import has_assumed_error
from exactpt.motion.motions import REST
from exactpt.motion.shape import are_constant, listed
from exactpt.scene.format import loads
from exactpt.scene.json_values import parse_json
from exactpt.scene.written import save

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.kernel.numbers import Rational
    from exactpt.motion.body import Body
    from exactpt.scene.scene import Scene

Format: TypeAlias = Literal["scene", "geojson", "mfjson", "wkt", "svg"]

ENDINGS: Final[dict[str, Format]] = {
    ".geojson": "geojson",
    ".mfjson": "mfjson",
    ".wkt": "wkt",
    ".svg": "svg",
    ".json": "scene",
}
"""Format by suffix; a ``.json`` file that is read may be GeoJSON, and both may be MF-JSON."""


def read_shapes(
    path: str | Path,
    *,
    time: Sequence[Rational | datetime] | None = None,
    tolerance: float = 0.1,
    holes: Holes = "keep",
    parts: Parts = "keep",
    repair: bool = False,
    repaired: Callable[[str], None] | None = None,
    skip_invalid: bool = False,
    skipped: Callable[[str], None] | None = None,
    strict: bool = False,
    max_bytes: int | None = None,
) -> Scene:
    """Return the scene at rest of a GeoJSON, WKT or SVG file.

    A MultiPolygon is one body; of other shapes, and in SVG, each part is.

    Of an MF-JSON file, the scene of its moving features; times are seconds since
    1970-01-01T00:00:00Z.

    Decimals in GeoJSON, MF-JSON and WKT are read exactly. In SVG, curves become chords, the y-axis
    is flipped to point up, and coordinates are the exact values of doubles, in millimetres if the
    drawing has a physical size, else in its own units.

    A part of the file that would change a shape or a motion and is not understood is an error.
    Other data that a scene has no place for are left out and named in `Scene.lost`; docs/format.md
    lists them.

    >>> from pathlib import Path
    >>> from tempfile import mkdtemp
    >>> pole = Path(mkdtemp()) / "pole.geojson"
    >>> _ = pole.write_text('{"type": "Point", "coordinates": [1, 0.1, 7.5]}')
    >>> shapes = read_shapes(pole)
    >>> shapes.bodies[0].at(0), shapes.lost
    ([(Fraction(1, 1), Fraction(1, 10))], ('z of 1 point',))

    Args:
        path: a file with a suffix in `ENDINGS`. A scene file is loaded unchanged.
        time: the start and the end of the time span; by default that of moving features, or from
            0 to 1. They may be datetimes (`from_datetime`).
        tolerance: maximum distance of a chord from its curve in an SVG, in units of the scene.
        holes: "keep" the holes of polygons, "refuse" such polygons, or "fill" the holes.
        parts: "keep" the parts of a MultiPolygon together as one body, or "split" them.
        repair: whether a polygon that is not valid is replaced by the polygons that its rings fill:
            by the even-odd rule, and exactly. The result is a body, with parts where it needs them.
        repaired: called with a message for each repair; it implies ``repair``.
        skip_invalid: whether a shape that cannot be a body is left out; else it is an error.
        skipped: called with a message for each shape that is left out; it implies
            ``skip_invalid``.
        strict: whether data that would be left out are an error.
        max_bytes: maximum size of the file, which is refused otherwise; by default 10^8.

    Raises:
        InputError: one line that names the file, the shape and its fault.
    """
    if holes not in ("keep", "refuse", "fill"):
        raise InputError(f"holes: either keep, refuse or fill: {shorten(holes)}")
    if parts not in ("keep", "split"):
        raise InputError(f"parts: either keep or split: {shorten(parts)}")
    span = None if time is None else [_seconds(t) for t in listed("time", time)]
    file = Path(path)
    kind, text = _format(file), read_text(file, max_bytes)

    def reporter(
        report: Callable[[str], None] | None, *, is_wanted: bool
    ) -> Callable[[str], None] | None:
        if report is not None:
            return lambda line: report(f"{file}: {line}")
        return (lambda _: None) if is_wanted else None

    to_repaired = reporter(repaired, is_wanted=repair)
    to_skipped = reporter(skipped, is_wanted=skip_invalid)

    losses = Losses()
    try:
        kind = _detected_format(kind, text)
        if kind == "scene":
            return loads(text)
        if kind == "mfjson":
            scene = mfjson.scene_of_features(
                text, losses, time=span, holes=holes, skipped=to_skipped
            )
        else:
            scene = scene_of(
                _shapes_of(kind, text, tolerance, losses),
                time=span or (0, 1),
                holes=holes,
                parts=parts,
                repaired=to_repaired,
                skipped=to_skipped,
            )
        if strict:
            check_strict(losses.texts())
    except InputError as error:
        raise InputError(f"{file}: {error}") from None
    except RecursionError:
        raise InputError(f"{file}: nested too deeply") from None
    scene.lost = losses.texts()
    return scene


def _seconds(at: Rational | datetime) -> Rational:
    return from_datetime(at) if isinstance(at, datetime) else at


def holds_scene(path: Path, max_bytes: int | None = None) -> bool:
    """Return True if a file is a scene file.

    Raises:
        InputError: if it cannot be read.
    """
    try:
        kind = _format(path)
        return kind == "scene" and _detected_format(kind, read_text(path, max_bytes)) == "scene"
    except InputError as error:
        message = str(error)
        if not message.startswith(str(path)):
            message = f"{path}: {message}"
        raise InputError(message) from None


def _format(path: Path) -> Format:
    kind = ENDINGS.get(path.suffix.lower())
    if kind is None:
        raise InputError(f"{path}: a file of shapes ends in one of {', '.join(ENDINGS)}")
    return kind


def _detected_format(kind: Format, text: str) -> Format:
    """Return the format of a file, by its suffix or, of JSON, by its content."""
    if kind not in ("scene", "geojson"):
        return kind
    data = parse_json(text)
    if not isinstance(data, dict) or (kind == "scene" and "exactpt" in data):
        return kind
    if mfjson.is_moving(data):
        return "mfjson"
    is_other = geojson.is_type(data.get("type")) or data.get("type") == "Topology"
    return "geojson" if is_other else kind


def _shapes_of(kind: Format, text: str, tolerance: float, losses: Losses) -> Iterator[Shape]:
    if kind == "svg":
        return svg.shapes_of(text, tolerance, losses)
    return wkt.shapes_of(text, losses) if kind == "wkt" else geojson.shapes_of(text, losses)


def write_shapes(
    scene: Scene,
    path: str | Path,
    at: Rational | AlgebraicNumber | None = None,
    *,
    tolerance: float | None = None,
    strict: bool = False,
) -> None:
    """Write the bodies at a time, as points, lines and polygons; or the scene with its motions.

    The latter as a scene file, or as MF-JSON if all vertices move straight, piece by piece. Exact
    positions are rounded to the nearest doubles. Shapes are written wherever their
    motions put them, even if they touch or overlap at that time. Of rounded bodies, outlines of
    chords are written, by shapely's buffer (see `Scene.to_shapely`); a scene file has the radii.

    Rings keep the order and the orientation of their vertices. An SVG is in millimetres. Data
    that a format has no place for are left out: names and properties in WKT, properties in SVG.

    >>> from pathlib import Path
    >>> from tempfile import mkdtemp
    >>> from exactpt import Body, Scene
    >>> file = Path(mkdtemp()) / "pole.wkt"
    >>> pole = Scene([Body("pole", [(1, "1/3")])])
    >>> write_shapes(pole, file)
    >>> file.read_text().strip()
    'POINT (1.0 0.3333333333333333)'
    >>> write_shapes(pole, file, strict=True)
    Traceback (most recent call last):
        ...
    exactpt.errors.InputError: ...pole.wkt: lost: name of 1 body; leave out --strict ...

    Args:
        scene: the bodies.
        path: a file with a suffix in `ENDINGS`; it is complete or not there.
        at: the time, which may be irrational; by default the start.
        tolerance: maximum distance of a chord from its arc; by default a hundredth of the radius.
        strict: whether data that would be left out are an error; so are radii, motions if no time
            is given, errors that are stated of motions and of bodies, units and the epoch.

    Raises:
        InputError: if the time is outside the time span, or the file cannot be written.
    """
    file = Path(path)
    kind = _format(file)
    try:
        if strict:
            check_strict(lost_by_writing(scene, file, at))
        if at is not None and kind in ("scene", "mfjson"):
            what = "a scene has" if kind == "scene" else "moving features have"
            raise InputError(f"{what} all times: leave the time away")
        text = None if kind == "scene" else _text_of(scene, kind, at, tolerance)
    except InputError as error:
        raise InputError(f"{file}: {error}") from None
    if text is None:
        save(scene, file)
    else:
        write_atomically(file, text)


def _text_of(
    scene: Scene, kind: Format, at: Rational | AlgebraicNumber | None, tolerance: float | None
) -> str:
    """Return the text of a file of shapes, or of moving features, see `write_shapes`."""
    if kind == "mfjson":
        return mfjson.mfjson_of(scene)
    shapes = shapes_at(scene, scene.exact_start if at is None else at)
    if scene.has_radius:
        from exactpt.exchange.shapely_adapter import outlined

        shapes = [outlined(shape, tolerance) for shape in shapes]
    writers = {"geojson": geojson.geojson_of, "wkt": wkt.wkt_of, "svg": svg.svg_of}
    return writers[kind](shapes)


def lost_by_writing(
    scene: Scene, path: Path, at: Rational | AlgebraicNumber | None
) -> tuple[str, ...]:
    """Return the data that `write_shapes` leaves out, see `Losses.texts`.

    Raises:
        InputError: if the suffix is unknown.
    """
    kind = _format(path)
    losses = Losses()
    if kind == "scene":
        return ()
    if scene.ignoring:
        losses.count("ignoring", "group", len(scene.ignoring))
    for i, body in enumerate(scene.bodies):
        if kind != "mfjson" and at is None and _moves(body):
            losses.count("motion", "body")
        elif has_assumed_error(body.motion):
            losses.count("error of the motion", "body")
        for error in _stated_errors(body):
            losses.count(error, "body")
        if kind != "mfjson" and body.exact_radius:
            losses.count("radius", "body")
        if not _keeps_name(body.name, i, kind):
            losses.count("name", "body")
        if kind in ("wkt", "svg") and body.properties:
            losses.count("properties", "body")
        elif str(body.properties.get("name", body.name)) != body.name:
            losses.count("property name", "body")
        if kind == "svg" and len(body.parts) > 1:
            losses.count("unity of the parts", "body")
    if scene.units is not None:
        losses.add("units")
    if scene.epoch is not None:
        losses.add("epoch")
    return losses.texts()


def _stated_errors(body: Body) -> list[str]:
    """Return what errors are stated of a body."""
    stated = body.exact_errors
    sizes = {
        "place error": stated.place,
        "angle error": stated.angle,
        "shape error": max(stated.shape),
    }
    return [error for error, size in sizes.items() if size]


def _keeps_name(name: str, number: int, kind: Format) -> bool:
    """Return True if a format gives the name of a body back, by its number in the file."""
    if kind == "wkt":
        return name == f"body {number}"
    if kind == "svg":
        return valid_text(name) == name
    return geojson.name_of({"properties": {"name": name}}) == name


def _moves(body: Body) -> bool:
    """Return True if a body has a motion, or changes its shape."""
    deforms = bool(body.keyframes) or not are_constant(body.vertices)
    return body.motion != REST or deforms
