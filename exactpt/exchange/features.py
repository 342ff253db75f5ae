"""Contacts and intervals as GeoJSON features: with a point, and with one of the bodies."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from exactpt.errors import InputError
from exactpt.exchange.geojson import geometry_of
from exactpt.exchange.instants import to_datetime
from exactpt.exchange.shapes import shape_at
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import shorten
from exactpt.motion.shape import listed
from exactpt.pair.contact import Contact
from exactpt.scene.scene import Scene
from exactpt.search.clearance import CloseInterval
from exactpt.search.intervals import ContactInterval


def to_features(
    scene: Scene,
    answers: Iterable[ContactInterval | CloseInterval | Contact],
    *,
    geometry: Literal["a", "b"] = "a",
    dates: bool = False,
) -> dict[str, object]:
    """Return a GeoJSON feature collection of contacts and intervals.

    ``json.dump`` writes it; ``geopandas.GeoDataFrame.from_features(collection)`` is its table.

    An interval becomes a feature with the properties a, b, start and end, and the geometry of one
    of the bodies at the start. A contact becomes a feature for each of its pairs, with the
    properties a, b, time and kind, and the point; an overlap at the start has no geometry. The
    properties of a body follow as "a_..." and "b_...". Numbers are the nearest doubles.

    Args:
        scene: the scene of the contacts and intervals.
        answers: intervals of contact, or of a distance (`Clearance.below`), and contacts.
        geometry: the body whose geometry an interval gets.
        dates: whether times are seconds since 1970-01-01T00:00:00Z, and become texts of dates,
            rounded to microseconds. A scene with an epoch of its own is refused.

    Raises:
        InputError: if a value is neither, or the scene has no such body or date.
    """
    if geometry not in ("a", "b"):
        raise InputError(f"geometry: either a or b: {shorten(geometry)}")
    if dates and scene.epoch is not None:
        raise InputError(
            "dates: times are taken as seconds since 1970-01-01T00:00:00Z, but time 0 of this "
            f"scene is {shorten(scene.epoch)}; leave dates= out"
        )
    features: list[dict[str, object]] = []

    def written(time: AlgebraicNumber) -> object:
        return to_datetime(time).isoformat().replace("+00:00", "Z") if dates else float(time)

    def add(a: str, b: str, shown: object, more: dict[str, object]) -> None:
        properties = {"a": a, "b": b, **more}
        for side, name in (("a", a), ("b", b)):
            own = scene.body(name).properties
            properties |= {f"{side}_{key}": value for key, value in own.items()}
        features.append({"type": "Feature", "properties": properties, "geometry": shown})

    for answer in listed("answers", answers):
        if isinstance(answer, (ContactInterval, CloseInterval)):
            shape = shape_at(scene.body(answer.a if geometry == "a" else answer.b), answer.start)
            times = {"start": written(answer.start), "end": written(answer.end)}
            add(answer.a, answer.b, geometry_of(shape), times)
        elif isinstance(answer, Contact):
            about = {"time": written(answer.time), "kind": answer.kind}
            for pair in answer.pairs:
                point = {"type": "Point", "coordinates": list(pair.point)}
                add(pair.body, pair.other, point, about)
            if not answer.pairs:
                for names in answer.initial_pairs:
                    add(*names, None, about)
        else:
            raise InputError(f"neither an interval nor a contact: {shorten(answer)}")
    return {"type": "FeatureCollection", "features": features}
