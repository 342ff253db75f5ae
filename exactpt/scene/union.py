"""The union of bodies that move alike, as one body."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from exactpt.errors import InputError
from exactpt.geometry import overlay
from exactpt.geometry.overlay import Part
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, rational, shorten
from exactpt.motion.body import Body
from exactpt.motion.displacement import displacement
from exactpt.motion.motions import REST, Motion, is_affine
from exactpt.motion.shape import are_constant, listed
from exactpt.motion.spin import Spin
from exactpt.motion.stated_errors import StatedErrors
from exactpt.motion.track import Track, difference
from exactpt.scene.scene import Scene


def union(bodies: Iterable[Body], *, name: str) -> Body:
    """Return the union of bodies that move alike, as one body.

    Bodies that overlap, or have edges in common, cannot be the parts of one body, and no tiling
    holds two bodies that touch. Their union has no such edges: its rings are the boundary of
    all of them together, exactly. Its vertices are vertices of the bodies and crossings of their
    edges. A vertex stays where its edges become straight. Parts that have only single points in
    common stay parts.

    >>> from exactpt import Translation
    >>> motion = Translation([0, 1])
    >>> first = Body("first", [(0, 0), (2, 0), (2, 2), (0, 2)], motion)
    >>> second = Body("second", [(1, 1), (3, 1), (3, 3), (1, 3)], motion)
    >>> both = union([first, second], name="both")
    >>> both
    <Body 'both': polygon of 8 vertices>
    >>> [(int(x), int(y)) for x, y in both.at(0)]
    [(0, 0), (2, 0), (2, 1), (3, 1), (3, 3), (1, 3), (1, 2), (0, 2)]

    Args:
        bodies: polygons without a radius that do not deform, with equal motions or all at rest.
            Motions may be written differently, such as by other pieces. One with an error (of a
            path, a spin or a spline) is equal only to the same one. Place and angle errors that are
            stated of them are equal, too: the result has these, and the largest shape errors.
            The parts of one body may overlap, too: each needs to be valid only by itself.
        name: the name of the result.

    Returns:
        A body with the motion of the first one, without properties. Vertices and edges are numbered
        anew: each outline is counter-clockwise, each hole clockwise, and begins with the vertex
        that comes first in the bodies.

    Raises:
        InputError: if a body is not such a polygon or not valid, if motions or stated errors
            differ, or if there is no body.
    """
    given = listed("bodies", bodies)
    if not given:
        raise InputError("union: at least one body is needed")
    for body in given:
        _check_polygon(body)
    first = given[0]
    other = next((body for body in given if not _have_equal_motions(first, body)), None)
    if other is None:
        motion, outlines = first.motion, [(body, _rest_points(body)) for body in given]
        errors = _common_errors(given, [body.exact_errors for body in given])
    elif all(map(_is_at_rest, given)):
        _check_error(given)
        motion, outlines = REST, [(body, body.exact_at(QQ(0))) for body in given]
        errors = _common_errors(given, list(map(_errors_at_rest, given)))
    else:
        raise InputError(
            f"union: bodies {shorten(first.name)} and {shorten(other.name)} move differently: only "
            "bodies with equal motions, or at rest, can be united"
        )
    parts = [part for body, points in outlines for part in _parts(body, points)]
    try:
        united = overlay.union(parts)
    except InputError as error:
        raise InputError(f"union: {error}") from None
    made = [{"vertices": part.outline, "holes": part.holes} for part in united]
    return Body(name, motion=motion, parts=made).exact_with_errors(errors)


def _errors_at_rest(body: Body) -> StatedErrors:
    """Return the errors of a body that never moves, with a reference point in the scene."""
    return body.exact_errors.halted(body.motion, body.exact_piece_after(QQ(0)).motion, QQ(0))


def _common_errors(bodies: Sequence[Body], errors: Sequence[StatedErrors]) -> StatedErrors:
    """Return the stated errors of a union of bodies that are known within the same errors.

    Bodies of one error of the place or the angle are taken to be out of place together: else their
    union would have no fixed shape. A point of the true union is in a true body, so at most the
    largest shape error from the modelled ones; likewise the other way round.
    """
    first = errors[0]
    for body, other in zip(bodies, errors, strict=True):
        if _of_pose(other, body.motion) != _of_pose(first, bodies[0].motion):
            raise InputError(
                f"union: bodies {shorten(bodies[0].name)} and {shorten(body.name)} have different "
                f"place or angle errors: give all the bodies the same ones, or none"
            )
    inner, outer = (max(of_shape) for of_shape in zip(*(e.shape for e in errors), strict=True))
    return first._replace(shape=(inner, outer))


def _of_pose(errors: StatedErrors, motion: Motion) -> tuple[object, ...]:
    return errors.place, errors.angle, errors.reference_point(motion)


def _check_polygon(body: object) -> None:
    if not isinstance(body, Body):
        raise InputError(f"union: not a body: {shorten(body)}")
    if body.exact_radius:
        raise InputError(
            f"union: body {shorten(body.name)} has a radius: only polygons without a radius can be "
            "united"
        )
    if not body.has_interior:
        raise InputError(
            f"union: body {shorten(body.name)} has no area: only polygons can be united"
        )


def _rest_points(body: Body) -> list[Point]:
    """Return the vertices of a body in its rest frame."""
    shapes = {frame.vertices for frame in body.keyframes}
    if len(shapes) == 1:
        return [(rational(x), rational(y)) for x, y in shapes.pop()]
    if shapes or not are_constant(body.vertices):
        raise InputError(
            f"union: body {shorten(body.name)} deforms: only bodies that keep their shape can be "
            "united"
        )
    return [(x.exact_at(QQ(0)), y.exact_at(QQ(0))) for x, y in body.vertices]


def _have_equal_motions(a: Body, b: Body) -> bool:
    """Return True if the motions of two bodies are equal, though perhaps written differently.

    At each time a motion is an affine map of the plane. The images of three points that are not
    on one line determine such a map. A motion with an error is equal only to the same one.
    """
    if a.motion == b.motion:
        return True
    if not (is_affine(a.motion) and is_affine(b.motion)) or _has_error(a) or _has_error(b):
        return False
    corners = [(0, 0), (1, 0), (0, 1)]
    first, second = (Body(body.name, corners, body.motion) for body in (a, b))
    breaks = sorted({*first.exact_breakpoints, *second.exact_breakpoints})
    before_all = breaks[0] - 1 if breaks else QQ(0)
    return all(
        _coincide(p, q)
        for t in (before_all, *breaks)
        for p, q in zip(
            first.exact_piece_after(t).tracks, second.exact_piece_after(t).tracks, strict=True
        )
    )


def _coincide(p: Track, q: Track) -> bool:
    """Return True if two trajectories are equal at all times: x / w and y / w are."""
    return not (difference(p.x, p.w, q.x, q.w) or difference(p.y, p.w, q.y, q.w))


def _has_error(body: Body) -> bool:
    """Return True if the motion of a body is known only within an error."""
    return displacement(body, QQ(0), QQ(0)) > 0


def _check_error(bodies: Sequence[Body]) -> None:
    """Refuse bodies at rest whose error the motion of the result, rest, would not have."""
    body = next(filter(_has_error, bodies), None)
    if body is not None:
        raise InputError(
            f"union: the motion of body {shorten(body.name)} has an error, which would be lost: "
            "give all the bodies this motion, or none"
        )


def _is_at_rest(body: Body) -> bool:
    """Return True if no vertex ever moves."""
    if isinstance(body.motion, Spin) and body.motion.exact_omega:
        return False
    pieces = [body.exact_piece_after(t) for t in (QQ(0), *body.exact_breakpoints)]
    coordinates = [f for piece in pieces for p in piece.tracks for f in (p.x, p.y, p.w)]
    return all(len(f) <= 1 for f in coordinates)


def _parts(body: Body, points: Sequence[Point]) -> list[Part]:
    """Return the parts of a body.

    Raises:
        InputError: if one of them is not valid.
    """
    parts: list[Part] = []
    for outline, *holes in body.parts:
        part = Part(
            points[outline.start : outline.stop],
            [points[hole.start : hole.stop] for hole in holes],
        )
        try:
            Scene([Body(body.name, part.outline, holes=part.holes)])
        except InputError as error:
            raise InputError(f"union: {error}") from None
        parts.append(part)
    return parts
