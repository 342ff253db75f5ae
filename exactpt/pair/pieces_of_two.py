"""The pieces of motion of two bodies, pair by pair."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, shorten
from exactpt.motion.body import Body
from exactpt.motion.track import Track
from exactpt.scene.groups import refuse_ignored_pair
from exactpt.scene.scene import Scene, a_scene


class PiecePair(NamedTuple):
    """One piece of motion of each of two bodies, during the interval that both last.

    Attributes:
        begin, end: the interval (begin, end].
        first, second: the trajectories of the vertices of each body.
    """

    begin: QQ
    end: QQ
    first: tuple[Track, ...]
    second: tuple[Track, ...]


def two_bodies(scene: Scene, a: str, b: str) -> tuple[Body, Body]:
    """Return two different bodies of a scene by their names, in the order of these.

    Raises:
        InputError: if the scene is not a `Scene`, a body does not exist, both are the same, or they
            ignore each other in the scene.
    """
    a_scene(scene)
    first, second = scene.body(a), scene.body(b)
    if first is second:
        raise InputError(f"expected two different bodies, got {shorten(a)} twice")
    refuse_ignored_pair(scene, a, b)
    return first, second


def piece_pairs(a: Body, b: Body, start: QQ, end: QQ) -> Iterator[PiecePair]:
    """Yield the pieces of two bodies, in the order of time: they cover the time span."""
    times = {t for body in (a, b) for t in body.exact_breakpoints_between(start, end)}
    begin = start
    for until in (*sorted(times), end):
        yield PiecePair(
            begin, until, a.exact_piece_after(begin).tracks, b.exact_piece_after(begin).tracks
        )
        begin = until


def segments_of(body: Body) -> list[tuple[int, int]]:
    """Return the edges of a body as pairs of vertices; a point is an edge from itself to itself."""
    return body.edges or [(0, 0)]
