"""The degrees of coordinates, of which the checkers of proofs take those up to a bound."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Final

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten
from exactpt.motion.motions import Affine, Rigid, Translation, formulas_of

if TYPE_CHECKING:
    from exactpt.motion.body import Body
    from exactpt.motion.motions import SimpleMotion

MOST: Final = 64
"""The highest degree of a coordinate in a proof (docs/scene-grammar.md, What has no proof)."""


def refuse_degrees(bodies: Iterable[Body]) -> None:
    """Refuse bodies whose proofs no checker would read.

    Raises:
        InputError: if a coordinate of one of them has a degree above `MOST`.
    """
    for body in bodies:
        of_shape = _degree_of_shape(body)
        degree = max(_degree(of_shape, one) for one in formulas_of(body.motion))
        if degree > MOST:
            raise InputError(
                f"body {shorten(body.name)} has coordinates of degree {degree}: proofs are checked "
                f"up to degree {MOST} (leave out the proof)"
            )


def _degree_of_shape(body: Body) -> int:
    """Return the highest degree of a coordinate before the motion."""
    shape = body.exact_shape
    if shape.keyframes:
        return 1
    if shape.near is not None:
        return 0
    return max(0, *(f.degree for position in shape.positions for f in position))


def _degree(of_shape: int, motion: SimpleMotion) -> int:
    """Return the degree of the coordinates after the motion, as docs/scene-grammar.md counts."""
    if isinstance(motion, Rigid):
        highest = max(of_shape, motion.x.degree, motion.y.degree)
        return highest + 2 * max(0, motion.half_turn.degree)
    if isinstance(motion, Affine):
        of_matrix = max(0, *(f.degree for row in motion.matrix for f in row))
        return max(of_shape + of_matrix, motion.x.degree, motion.y.degree)
    if isinstance(motion, Translation):
        return max(of_shape, motion.x.degree, motion.y.degree)
    return of_shape
