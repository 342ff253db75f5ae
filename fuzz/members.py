"""Members of files: each is read, kept, named as lost, or refused; never passed over in silence.

A case is a valid document of a format with random small vertices, into which one member of its
standard is put, or an unknown one. The effect that the member may have is stated beside it, from
the standard; the places of the bodies are computed here, in rationals, without code of
`exactpt.exchange`. Each scene is also written and read again: vertices keep their numbers.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any, Final, Literal, NamedTuple, TypeAlias

import click

from exactpt import InputError, Scene, read_shapes, write_shapes
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.options import HELP, Options, conduct, options

__all__ = ["FORMATS", "Case", "Members", "case", "fault", "members"]

Effect: TypeAlias = Literal["read", "kept", "lost", "refused", "kept or lost"]
"""The effect that a member may have: only its meaning, a property, a loss by name, a refusal."""
Json: TypeAlias = Any
Place: TypeAlias = tuple[Fraction, Fraction]
Ring: TypeAlias = list[Place]

FORMATS: Final = ("geojson", "mfjson", "wkt", "svg")
PATIENCE: Final = 10.0
"""Seconds in which a document is read."""
_FAR: Final = 1000
"""Distance of the bodies of a document, which do not touch."""


class Case(NamedTuple):
    """A document with one member.

    Attributes:
        suffix: the suffix of its file.
        text: the document.
        member: the word that names the member in messages and properties.
        effect: what it may do.
        time: a time of the scene; None for its start.
        bodies: at that time, the vertices of each body in the order of the document.
    """

    suffix: str
    text: str
    member: str
    effect: Effect
    time: Fraction | None
    bodies: list[Ring]


class _Member(NamedTuple):
    name: str
    value: Json
    effect: Effect


def case(kind: str, rng: Random) -> Case:
    """A random document of a format."""
    return _MAKERS[kind](rng)


def fault(given: Case, folder: Path) -> str:
    """Return the fault in the reading of a document; empty if there is none."""
    path = folder / f"document.{given.suffix}"
    path.write_text(given.text, encoding="utf-8")
    try:
        scene = read_shapes(path)
    except InputError as error:
        if given.effect != "refused":
            return f"refused: {error}"
        return "" if given.member.lower() in str(error).lower() else f"not named: {error}"
    if given.effect == "refused":
        return f"{given.member} is read in silence"
    return _misread(given, scene) or _unlike(given, scene, folder)


def _misread(given: Case, scene: Scene) -> str:
    """Return the fault of a scene."""
    at = scene.start if given.time is None else given.time
    found = [body.at(at) for body in scene.bodies]
    if found != given.bodies:
        return f"other vertices: {found} for {given.bodies}"
    is_kept = any(given.member in json.dumps(body.properties) for body in scene.bodies)
    is_lost = any(given.member in text for text in scene.lost)
    allowed = {
        "read": not is_lost,
        "kept": is_kept and not is_lost,
        "lost": is_lost,
        "kept or lost": is_kept or is_lost,
    }
    return "" if allowed[given.effect] else f"kept: {is_kept}, lost: {', '.join(scene.lost)}"


def _unlike(given: Case, scene: Scene, folder: Path) -> str:
    """Return the change by writing and reading the scene."""
    suffix = "mfjson" if given.time is not None else given.suffix
    again = folder / f"again.{suffix}"
    write_shapes(scene, again)
    back = read_shapes(again)
    at = back.start if given.time is None else given.time
    rounded = [[(Fraction(float(x)), Fraction(float(y))) for x, y in ring] for ring in given.bodies]
    if [body.at(at) for body in back.bodies] != rounded:
        return f"other vertices once written: {[body.at(at) for body in back.bodies]}"
    if suffix in ("geojson", "mfjson"):
        for old, new in zip(scene.bodies, back.bodies, strict=True):
            found = new.properties
            if any(found.get(key) != value for key, value in old.properties.items()):
                return f"other properties once written: {found} for {old.properties}"
    return ""


# Outlines


def _ring(rng: Random, x: int) -> Ring:
    """A polygon whose corners are on a circle, in either orientation, from any corner on."""
    corners = [(3, 4), (-3, 4), (-5, 0), (-4, -3), (0, -5), (4, -3), (5, 0)]
    chosen = sorted(rng.sample(range(len(corners)), rng.randint(3, len(corners))))
    first = rng.randrange(len(chosen))
    turned = [corners[i] for i in chosen[first:] + chosen[:first]]
    places = turned[:: rng.choice([1, -1])]
    return [(Fraction(x + a), Fraction(b)) for a, b in places]


def _chain(rng: Random, x: int) -> Ring:
    return [(Fraction(x + 2 * i), Fraction(rng.randint(-9, 9))) for i in range(rng.randint(2, 5))]


def _point(rng: Random, x: int) -> Ring:
    return [(Fraction(x), Fraction(rng.randint(-9, 9), 4))]


def _numbers(ring: Ring, *, closed: bool = False) -> list[list[float]]:
    places = [[float(x), float(y)] for x, y in ring]
    return [*places, places[0]] if closed else places


def _word(rng: Random) -> str:
    """A name that no standard has."""
    return "q" + "".join(rng.choices("bcdfghjklmnpqrstvwxz", k=6))


# GeoJSON

_CRS: Final = {"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}
_COLLECTION: Final = [
    _Member("crs", _CRS, "lost"), _Member("bbox", [0, 0, 9, 9], "lost"),
    _Member("name", "layer", "lost"), _Member("geometry", None, "refused"),
    _Member("properties", {}, "refused"), _Member("coordinates", [1, 2], "refused"),
    _Member("crs", None, "read"),
]  # fmt: skip
_FEATURE: Final = [
    _Member("id", 7, "kept"), _Member("id", "seven", "kept"), _Member("title", {"a": [1]}, "kept"),
    _Member("crs", _CRS, "lost"), _Member("bbox", [0, 0, 9, 9], "lost"),
    _Member("coordinates", [1, 2], "refused"), _Member("features", [], "refused"),
    _Member("geometries", [], "refused"), _Member("properties", [1], "refused"),
]  # fmt: skip
_GEOMETRY: Final = [
    _Member("crs", _CRS, "lost"), _Member("bbox", [0, 0, 9, 9], "lost"),
    _Member("radius", 3, "lost"), _Member("properties", {}, "refused"),
    _Member("features", [], "refused"), _Member("bbox", None, "read"),
]  # fmt: skip


def _geometry(rng: Random, x: int) -> tuple[dict[str, Json], Ring]:
    """A geometry and the vertices of its body."""
    kind = rng.choice(["Point", "LineString", "Polygon", "MultiPolygon", "GeometryCollection"])
    if kind == "Point":
        ring = _point(rng, x)
        return {"type": kind, "coordinates": _numbers(ring)[0]}, ring
    if kind == "LineString":
        ring = _chain(rng, x)
        return {"type": kind, "coordinates": _numbers(ring)}, ring
    if kind == "MultiPolygon":
        rings = [_ring(rng, x), _ring(rng, x + 50)]
        parts = [[_numbers(ring, closed=True)] for ring in rings]
        return {"type": kind, "coordinates": parts}, rings[0] + rings[1]
    ring = _ring(rng, x)
    inside = [(2 * p + q + r) / 4 for p, q, r in zip(*ring[:3], strict=True)]
    hole = [(inside[0] + (a - inside[0]) / 4, inside[1] + (b - inside[1]) / 4) for a, b in ring]
    polygon = {
        "type": "Polygon",
        "coordinates": [_numbers(ring, closed=True), _numbers(hole, closed=True)],
    }
    if kind == "Polygon":
        return polygon, ring + hole
    return {"type": kind, "geometries": [polygon]}, ring + hole


def _geojson(rng: Random) -> Case:
    geometries = [_geometry(rng, _FAR * i) for i in range(rng.randint(1, 3))]
    features: list[dict[str, Json]] = [
        {"type": "Feature", "properties": {"name": f"b{i}"}, "geometry": geometry}
        for i, (geometry, _) in enumerate(geometries)
    ]
    bodies = [ring for _, ring in geometries]
    document: dict[str, Json] = {"type": "FeatureCollection", "features": features}
    places: list[tuple[dict[str, Json], list[_Member]]] = [
        (document, [*_COLLECTION, _Member(_word(rng), 1, "lost")]),
        (features[0], [*_FEATURE, _Member(_word(rng), [1, "a"], "kept")]),
        (features[0]["geometry"], [*_GEOMETRY, _Member(_word(rng), 1, "lost")]),
    ]
    match rng.randrange(6):
        case 0:
            point = {"type": "Point", "coordinates": [5000, 1.5, 9]}
            features.append({"type": "Feature", "properties": None, "geometry": point})
            bodies.append([(Fraction(5000), Fraction(3, 2))])
            member = _Member("z of 1 point", None, "lost")
        case 1:
            features.append({"type": "Feature", "properties": {}, "geometry": None})
            member = _Member("no geometry", None, "lost")
        case 2:
            features.append({"type": "Feature", "properties": {}, "geometri": None})
            member = _Member("geometri", None, "refused")
        case _:
            target, members = rng.choice(places)
            member = rng.choice(members)
            target[member.name] = member.value
    suffix = rng.choice(["geojson", "json"]) if member.effect == "refused" else "geojson"
    return Case(suffix, json.dumps(document), member.name, member.effect, None, bodies)


# Moving features

_DATES: Final = [f"1970-01-01T00:00:{second:02}Z" for second in (0, 4, 8)]
_TIME: Final = Fraction(3)
_ISO: Final = {"type": "Name", "properties": {"name": "urn:ogc:data:time:iso8601"}}
_WEEKS: Final = {"type": "Name", "properties": {"name": "urn:weeks"}}
_UPRIGHT: Final = {"scales": [1, 1, 1], "angles": [0, 0, 0]}
_YES: Final = True
_NO: Final = False
_MOVING: Final = [
    *(_Member("interpolation", word, "refused")
      for word in ("Discrete", "Step", "Stepwise", "Quadratic", "Cubic", "http://a.b/c")),
    _Member("interpolations", ["Step"], "refused"), _Member("interpolation", "Linear", "read"),
    _Member("base", {"type": "glTF", "href": "a.gltf"}, "refused"), _Member("base", None, "read"),
    _Member("orientations", [_UPRIGHT] * 3, "read"),
    _Member("orientations", [_UPRIGHT, {"scales": [1, 1, 1], "angles": [0, 0, 5]}], "refused"),
    _Member("orientations", [{"scales": [2, 1, 1], "angles": [0, 0, 0]}], "refused"),
    _Member("crs", _CRS, "lost"), _Member("trs", _ISO, "read"), _Member("trs", _WEEKS, "refused"),
    _Member("bbox", [0, 0, 9, 9], "lost"), _Member("upper_inc", _NO, "lost"),
    _Member("lower_inc", _YES, "read"), _Member("sequences", [], "refused"),
]  # fmt: skip
_MOVING_FEATURE: Final = [
    _Member("temporalProperties", [{"datetimes": _DATES, "speed": {"values": [1, 2, 3]}}], "kept"),
    _Member("id", 7, "kept"), _Member("crs", _CRS, "lost"), _Member("trs", _WEEKS, "refused"),
    _Member("bbox", [0, 0, 9, 9], "lost"), _Member("time", [_DATES[0], _DATES[2]], "read"),
    _Member("time", [_DATES[0], "1970-01-02T00:00:00Z"], "lost"),
    _Member("time", ["1971-01-01T00:00:00Z", "1972-01-01T00:00:00Z"], "refused"),
    _Member("coordinates", [1, 2], "refused"),
]  # fmt: skip
_STILL: Final = _Member("geometry", {"type": "Point", "coordinates": [1, 2]}, "lost")


def _mfjson(rng: Random) -> Case:
    places = [(Fraction(rng.randint(-9, 9)), Fraction(rng.randint(-9, 9))) for _ in _DATES]
    shift = tuple((a + 3 * b) / 4 for a, b in zip(places[0], places[1], strict=True))
    is_trajectory = rng.random() < 0.4
    feature: dict[str, Json] = {"type": "Feature", "properties": {"name": "a"}}
    if is_trajectory:
        rest: Ring = [(Fraction(0), Fraction(0))]
        feature["geometry"] = {"type": "LineString", "coordinates": _numbers(places)}
        feature["properties"]["datetimes"] = _DATES
        members = [*_MOVING_FEATURE, _Member(_word(rng), 1, "kept")]
        target = feature
    else:
        kind, rest = rng.choice(
            [("Point", _point(rng, 0)), ("LineString", _chain(rng, 0)), ("Polygon", _ring(rng, 0))]
        )
        geometry: dict[str, Json] = {"type": f"Moving{kind}", "datetimes": _DATES}
        geometry["coordinates"] = [_coordinates(kind, rest, by) for by in places]
        feature["temporalGeometry"] = geometry
        target, members = rng.choice(
            [
                (geometry, [*_MOVING, _Member(_word(rng), 1, "lost")]),
                (feature, [*_MOVING_FEATURE, _STILL, _Member(_word(rng), 1, "kept")]),
            ]
        )
    member = rng.choice(members)
    target[member.name] = member.value
    document = rng.choice([feature, {"type": "FeatureCollection", "features": [feature]}])
    suffix = rng.choice(["mfjson", "json", "geojson"])
    bodies = [[(x + shift[0], y + shift[1]) for x, y in rest]]
    return Case(suffix, json.dumps(document), member.name, member.effect, _TIME, bodies)


def _coordinates(kind: str, rest: Ring, by: Place) -> Json:
    ring = [(x + by[0], y + by[1]) for x, y in rest]
    if kind == "Point":
        return _numbers(ring)[0]
    return _numbers(ring) if kind == "LineString" else [_numbers(ring, closed=True)]


# Well-known text


def _wkt(rng: Random) -> Case:
    further, member = rng.choice(
        [("", "SRID"), ("", "CIRCLE"), ("Z", "z of"), ("M", "m of"), ("ZM", "z of"), ("ZM", "m of")]
    )
    kind, ring = rng.choice(
        [("POINT", _point(rng, 0)), ("LINESTRING", _chain(rng, 0)), ("POLYGON", _ring(rng, 0))]
    )
    more = "".join(f" {rng.randint(1, 9)}" for _ in further)
    places = [f"{float(x)!r} {float(y)!r}{more}" for x, y in ring]
    inner = ", ".join([*places, places[0]] if kind == "POLYGON" else places)
    inner = f"({inner})" if kind == "POLYGON" else inner
    text = f"{kind} {further} ({inner})"
    if member == "SRID":
        return Case("wkt", f"SRID={rng.randint(1, 9999)};{text}", member, "kept", None, [ring])
    if member == "CIRCLE":
        return Case("wkt", f"{text}\nCIRCLE (1 2 3)", member, "refused", None, [ring])
    return Case("wkt", text, member, "lost", None, [ring])


# Drawings


@dataclass
class _View:
    """The map from coordinates of an element to those of the scene, without a turn."""

    scale: Place = (Fraction(1), Fraction(1))
    move: Place = (Fraction(0), Fraction(0))

    def inside(self, scale: Place, move: Place) -> _View:
        (a, b), (e, f) = self.scale, self.move
        return _View((a * scale[0], b * scale[1]), (e + a * move[0], f + b * move[1]))

    def of(self, place: Place) -> Place:
        x, y = (m + s * p for s, m, p in zip(self.scale, self.move, place, strict=True))
        return x, -y


_ONE: Final = (Fraction(1), Fraction(1))
_ORIGIN: Final = (Fraction(0), Fraction(0))
_MILLIMETRES: Final = {
    "mm": Fraction(1), "cm": Fraction(10), "in": Fraction("25.4"), "pt": Fraction("25.4") / 72,
    "pc": Fraction("25.4") / 6, "px": Fraction("25.4") / 96,
}  # fmt: skip
_BOX: Final = 256
"""Width and height of a viewBox: a power of two, so that doubles are exact."""

_ATTRIBUTES: Final = [
    _Member("clip-path", "url(#round)", "refused"), _Member("mask", "url(#round)", "refused"),
    _Member("transform", "translate(1 2) blur(3)", "refused"), _Member("clip-path", "none", "read"),
    _Member("transform", "scale(", "refused"), _Member("transform", "none", "read"),
    _Member("style", "rotate: 3deg", "refused"), _Member("style", "mask: url(#round)", "refused"),
    _Member("style", "fill: red; display: inline", "read"), _Member("class", "seen", "read"),
    _Member("vector-effect", "non-scaling-stroke", "read"), _Member("filter", "url(#f)", "lost"),
    _Member("vector-effect", "fixed-position", "refused"),
]  # fmt: skip
_ELEMENTS: Final = [
    _Member("text", "<text>a</text>", "lost"), _Member("image", '<image href="a.png"/>', "lost"),
    _Member("foreignObject", "<foreignObject/>", "lost"), _Member("blob", "<blob/>", "lost"),
    _Member("title", "<title>a</title><desc>b</desc>", "read"),
    _Member("rect", '<rect height="4"/><circle/><ellipse ry="0"/>', "read"),
    _Member("defs", '<defs><rect width="9" height="9"/></defs>', "read"),
    _Member("symbol", '<symbol><rect width="9" height="9"/></symbol>', "read"),
    _Member("marker", '<marker id="m"><rect width="9" height="9"/></marker>', "read"),
    _Member("pattern", '<pattern id="p"><rect width="9" height="9"/></pattern>', "read"),
    _Member("display", '<g display="none"><rect width="9" height="9"/></g>', "read"),
    _Member("visibility", '<g visibility="hidden"><rect width="9" height="9"/></g>', "read"),
    _Member("switch", '<switch><g requiredExtensions="a"><path d="M0 0h9"/></g></switch>', "read"),
    _Member("style", "<style>.hidden {display: none}</style>"
            '<rect class="hidden" width="9" height="9"/>', "read"),
    _Member("g > rect", "<style>g &gt; rect {display: none}</style>", "refused"),
    _Member("@import", "<style>@import url(a.css);</style>", "refused"),
    _Member("use", '<use href="#nowhere"/>', "refused"),
    _Member("animateTransform", '<animateTransform type="rotate" to="9"/>', "refused"),
    _Member("points", '<polygon points="0,0 1,1 2"/>', "refused"),
    _Member("path data", '<path d="M0 0h1v1z?"/>', "refused"),
    _Member("em", '<rect width="1em" height="1"/>', "refused"),
]  # fmt: skip


def _svg(rng: Random) -> Case:
    head, view = _page(rng)
    ring = [(x + 60, y + 60) for x, y in _ring(rng, 0)]
    outline, given = _outline(rng, ring)
    text, inner = outline, _View()
    for _ in range(rng.randint(0, 3)):
        text, inner = _wrapped(rng, text, inner)
    member = rng.choice([*_ATTRIBUTES, *_ELEMENTS])
    if member in _ELEMENTS:
        text = "".join(rng.choice([(text, member.value), (member.value, text)]))
    else:
        text = f'<g {member.name}="{member.value}">{text}</g>'
    whole = view.inside(inner.scale, inner.move)
    name = member.name if member.name != "style" else str(member.value).partition(":")[0]
    ids = '<defs><clipPath id="round"><circle r="1"/></clipPath></defs>'
    document = f'<svg xmlns="http://www.w3.org/2000/svg" {head}>{ids}{text}</svg>'
    return Case("svg", document, name, member.effect, None, [[whole.of(p) for p in given]])


def _page(rng: Random) -> tuple[str, _View]:
    """The size of a drawing, and its scale."""
    if rng.random() < 0.3:
        return f'width="999" height="9" viewBox="5 7 {_BOX} {_BOX}"', _View()
    unit = rng.choice(list(_MILLIMETRES))
    sides = rng.randint(1, 40), rng.randint(1, 40)
    aspect = rng.choice(["", "none", "xMidYMid meet", "xMinYMax slice"])
    scale = [_MILLIMETRES[unit] * side / _BOX for side in sides]
    if aspect != "none":
        scale = [(max if "slice" in aspect else min)(scale)] * 2
    size = f'width="{sides[0]}{unit}" height="{sides[1]}{unit}"'
    ratio = f'preserveAspectRatio="{aspect}"' if aspect else ""
    return f'{size} viewBox="-3 2 {_BOX} {_BOX}" {ratio}', _View((scale[0], scale[1]))


def _outline(rng: Random, ring: Ring) -> tuple[str, Ring]:
    """An outline in one of the ways to draw it, and its vertices."""
    pairs = [f"{float(x)!r},{float(y)!r}" for x, y in ring]
    match rng.randrange(3):
        case 0:
            return f'<polygon points="{" ".join(pairs)}"/>', ring
        case 1:
            return f'<path d="M{" L".join(pairs)}Z"/>', ring
        case _:
            x, y = ring[0]
            text = f'<rect x="{float(x)!r}" y="{float(y)!r}" width="64" height="8"/>'
            return text, [(x, y), (x + 64, y), (x + 64, y + 8), (x, y + 8)]


def _wrapped(rng: Random, text: str, view: _View) -> tuple[str, _View]:
    """A drawing in another element, and the map of both."""
    x, y = rng.randint(-9, 9), rng.randint(-9, 9)
    by = Fraction(x), Fraction(y)
    two = Fraction(2), Fraction(2)
    match rng.randrange(5):
        case 0:
            return f'<g transform="translate({x} {y})">{text}</g>', _View(_ONE, by).inside(
                view.scale, view.move
            )
        case 1:
            return f'<g style="transform: scale(2)">{text}</g>', _View(two).inside(
                view.scale, view.move
            )
        case 2:
            size = 'width="512" height="512" viewBox="0 0 256 256"'
            nested = f'<svg x="{x}" y="{y}" overflow="visible" {size}>{text}</svg>'
            return nested, _View(two, by).inside(view.scale, view.move)
        case 3:
            name = f"s{rng.randrange(10**9)}"
            box = 'viewBox="1 2 256 256" overflow="visible"'
            symbol = f'<symbol id="{name}" {box}>{text}</symbol>'
            use = f'<use href="#{name}" x="{x}" y="{y}" width="256" height="256"/>'
            return symbol + use, _View(_ONE, (by[0] - 1, by[1] - 2)).inside(view.scale, view.move)
        case _:
            return f'<svg x="{x}" y="{y}" overflow="visible">{text}</svg>', _View(_ONE, by).inside(
                view.scale, view.move
            )


_MAKERS: Final[dict[str, Callable[[Random], Case]]] = {
    "geojson": _geojson,
    "mfjson": _mfjson,
    "wkt": _wkt,
    "svg": _svg,
}


@dataclass(frozen=True)
class Members(Check):
    """The check of members.

    Attributes:
        formats: the formats, taken in turn.
        seed: seed of all documents.
        keep: folder for documents with a fault.
    """

    formats: Sequence[str]
    seed: int
    keep: Path
    name = "members"

    @property
    def about(self) -> object:
        """The formats and the seed."""
        return [list(self.formats), self.seed]

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:  # noqa: ARG002 - it is short
        """Have a document read."""
        number = item.numbers.start
        kind = self.formats[number % len(self.formats)]
        given = case(kind, Random(f"members {kind} {self.seed} {number}"))
        path = self.keep / f"{kind}-{self.seed}-{number}.{given.suffix}"
        finding = Finding(kind, "hangs", str(path), {path: given.text.encode()})
        tell(Step(PATIENCE, finding))
        with TemporaryDirectory() as folder:
            wrong = fault(given, Path(folder))
        counts = Counts({(kind, "documents"): 1, (kind, given.effect): 1})
        if not wrong:
            return Result(counts)
        why = f"{path}: {given.member}: {wrong[:400]}"
        return Result(counts, [finding._replace(signature="FAULT", why=why)])

    def table(self, counts: Counts) -> list[str]:
        """One line for each format: documents, and of how many each effect is expected."""
        head = ("format", "documents", "read", "kept", "lost", "refused")
        rows = ([kind, *(counts[kind, word] for word in head[1:])] for kind in self.formats)
        return [
            f"{row[0]:10}" + "".join(f"{cell:>10}" for cell in row[1:]) for row in (head, *rows)
        ]


@click.command("members", context_settings=HELP)
@click.option("--format", "formats", multiple=True, type=click.Choice(FORMATS))
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("members-found"),
    show_default=True,
    help="Folder for documents with a fault.",
)
@options(2_000)
def members(chosen: Options, formats: tuple[str, ...], keep: Path) -> None:
    """Have documents read into which members of their standards are put, and others."""
    conduct(Members(formats or FORMATS, chosen.seed, keep), chosen, again=f"--seed {chosen.seed}")
