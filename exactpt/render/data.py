"""JSON data of an animation: exact trajectories, exact times, and the lifetimes of edges and tiles.

Times and coordinates are fixed-point integers (`exactpt.render.fixed`): times in units of
2**(timeUnit - 192), coordinates in units of 2**(lengthUnit - 192). Trajectories are the
polynomials of the engine, with all coefficients.
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Final

from exactpt.kernel.numbers import QQ, nearest_float, power_of_two
from exactpt.render.fixed import BITS, exponent_above, fixed
from exactpt.render.palette import body_colour
from exactpt.render.window import widened
from exactpt.render.words import contact_in_words, pair_in_words, short

if TYPE_CHECKING:
    from collections.abc import Iterator

    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.pair.contact import Contact
    from exactpt.render.film import Film, Step
    from exactpt.scene.scene import Scene

_SAFE: Final = 2**53
_LONGEST: Final = 1200
"""Maximum number of digits of the polynomial of a time; longer polynomials are left out."""


def data_of(film: Film, *, at: AlgebraicNumber | QQ | None = None) -> dict[str, object]:
    """Return the JSON data that the page needs; ``at`` is the time shown first."""
    scene = film.scene
    time_unit = exponent_above(scene.exact_end - scene.exact_start)
    time_bits = BITS - time_unit
    length_unit, origin = _extent(film)
    end = film.end
    return {
        "tiling": film.tiling,
        "timeUnit": time_unit,
        "lengthUnit": length_unit,
        "start": _integer(fixed(scene.exact_start, time_bits)),
        "end": _integer(fixed(end, time_bits)),
        "at": None if at is None else _integer(fixed(at, time_bits)),
        "startText": str(scene.exact_start),
        "endText": str(scene.exact_end),
        "origin": [_integer(fixed(c, BITS - length_unit)) for c in origin],
        "bodies": [_body(i, film, time_bits, length_unit) for i in range(len(scene.bodies))],
        "steps": [_step(step, time_bits) for step in film.steps],
        "edges": [list(edge) for edge in sorted(film.edges, key=lambda e: (e.first, e.u, e.v))],
        "tiles": [
            [list(t.nodes), list(t.corners), t.tint, t.inside, *t.place, t.first, t.last]
            for t in sorted(film.tiles, key=lambda t: (t.first, t.nodes))
        ],
        "contact": None if film.contact is None else _contact(film.contact, scene, length_unit),
    }


def _integer(value: int) -> int | str:
    """Return a JSON number if a double holds the value, else a string of its digits."""
    return int(value) if -_SAFE < value < _SAFE else str(value)


def _extent(film: Film) -> tuple[int, tuple[QQ, QQ]]:
    """Return the exponent of a power of two >= the scene's size, and a point in the scene."""
    scene = film.scene
    last = film.end.simplified().exact_canonical_interval()[0]
    times = (scene.exact_start, (scene.exact_start + last) / 2, last)
    boxes = [
        (min(values), max(values))
        for t in times
        for values in zip(
            *(
                point
                for i, body in enumerate(scene.bodies)
                if film.is_there(i, t)
                for point in widened(body.exact_at(t), body.exact_radius)
            ),
            strict=True,
        )
    ]
    if not boxes:
        return 0, (QQ(0), QQ(0))
    extent = max(high - low for low, high in boxes)
    (left, right), (bottom, top) = boxes[:2]
    return exponent_above(extent), ((left + right) / 2, (bottom + top) / 2)


def _body(index: int, film: Film, time_bits: int, length_unit: int) -> list[object]:
    scene, end = film.scene, film.end
    body = scene.bodies[index]
    pieces: list[object] = []
    time: QQ | None = scene.exact_start
    while time is not None and end.compare_rational(time) >= 0:
        piece = body.exact_piece_after(time)
        tracks = [[[_integer(c) for c in f] for f in (t.x, t.y, t.w)] for t in piece.tracks]
        time = piece.until
        pieces.append([None if time is None else _integer(fixed(time, time_bits)), tracks])
    more: list[object] = []
    if body.exact_radius or body.has_rings or film.spans:
        more.append(_in_units(body.exact_radius, length_unit))
    if body.has_rings or film.spans:
        more.append([ring.start for ring in body.rings])
    if film.spans:
        since, until = (_integer(fixed(t, time_bits)) for t in film.spans[index])
        more += [since, None if film.spans[index][1] == scene.exact_end else until]
    return [body.name, body_colour(index), body.closed, pieces, *more]


def _in_units(length: QQ, unit: int) -> float:
    return nearest_float(length * power_of_two(-unit))


def _step(step: Step, time_bits: int) -> dict[str, object]:
    number = step.time.simplified()
    data: dict[str, object] = {
        "time": _integer(fixed(number, time_bits)),
        "changes": [
            [
                c.kind,
                [list(e) for e in c.removed],
                [list(e) for e in c.added],
                *([c.words] if c.words else []),
            ]
            for c in step.changes
        ],
        "certificate": list(step.certificate),
    }
    if number.is_rational:
        data["exact"] = str(number.exact_low)
        return data
    digits = [str(c) for c in number.exact_polynomial]
    data["degree"] = len(digits) - 1
    data["exact"] = digits if sum(map(len, digits)) <= _LONGEST else None
    return data


def touched_edges(contact: Contact, scene: Scene) -> Iterator[tuple[int, int] | None]:
    """Yield for each incidence the edge that is touched, as two vertices of its other body.

    Two edges in one place have two pairs of vertices that coincide: for both pairs, that edge.
    None if a vertex alone is touched.
    """
    places = {(p.body, p.vertex, p.other, p.other_vertex) for p in contact.pairs}
    for pair in contact.pairs:
        other = scene.body(pair.other)
        if pair.edge is not None:
            yield pair.edge, other.end_of_edge(pair.edge)
            continue
        sides, its = (
            [u + v - at for u, v in body.edges if at in (u, v)]
            for body, at in ((scene.body(pair.body), pair.vertex), (other, pair.other_vertex or 0))
        )
        both = product(sides, its)
        found = (w for v, w in both if (pair.body, v, pair.other, w) in places)
        end = next(found, None)
        yield None if end is None else (pair.other_vertex or 0, end)


def _contact(contact: Contact, scene: Scene, length_unit: int) -> dict[str, object]:
    first: dict[str, int] = {}
    count = 0
    for body in scene.bodies:
        first[body.name] = count
        count += body.size
    pairs = []
    for pair, touched in zip(contact.pairs, touched_edges(contact, scene), strict=True):
        start = first[pair.other]
        edge = None if touched is None else [start + vertex for vertex in touched]
        other = None if pair.other_vertex is None else start + pair.other_vertex
        radius = scene.body(pair.body).exact_radius
        shift = None
        if pair.normal is not None and (radius or scene.body(pair.other).exact_radius):
            # From the vertex of the core to the common point.
            shift = [-_in_units(radius, length_unit) * c for c in pair.normal]
        pairs.append(
            {
                "node": first[pair.body] + pair.vertex,
                "edge": edge,
                "other": other,
                "normal": None if pair.normal in (None, (0.0, 0.0)) else list(pair.normal or ()),
                "words": pair_in_words(pair),
                **({} if shift is None else {"shift": shift}),
            }
        )
    return {
        "kind": contact.kind,
        "words": contact_in_words(contact),
        "pairs": pairs,
        "overlaps": [f"{short(a)} and {short(b)} share a point" for a, b in contact.initial_pairs],
    }
