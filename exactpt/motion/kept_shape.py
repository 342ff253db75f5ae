"""The test that a body keeps its shape.

At each time it is the image of one shape by a bijection of the plane that keeps lines straight.
"""

from __future__ import annotations

from itertools import pairwise

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, show
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Rigid, SimpleMotion, Translation
from exactpt.motion.outline import pieces_of
from exactpt.motion.shape import are_constant


def loss_of_shape(body: Body, start: QQ, end: QQ) -> str | None:
    """Return why a body may not keep its shape in a closed time span, in words; None if it does.

    It does if its vertices are constant in the rest frame, and its motion is a translation, a
    rotation, or affine with a matrix that is regular at all times of the span, or consists of
    pieces of these. Each of them is a bijection of the plane at each time, and takes segments to
    segments. So edges meet at one time if and only if they meet at all times.

    >>> from exactpt import Polynomial
    >>> shrinking = Affine([[Polynomial([2, -1]), 0], [0, 1]])
    >>> body = Body("b", [(0, 0), (1, 0), (0, 1)], shrinking)
    >>> loss_of_shape(body, QQ(0), QQ(1)), loss_of_shape(body, QQ(0), QQ(3))
    (None, 'its affine motion collapses at t = 2')

    Args:
        body: the body.
        start: the start of the span.
        end: the end of the span.
    """
    if not body.vertices or not are_constant(body.vertices):
        return "its vertices move by polynomials of their own"
    pieces = pieces_of(body.motion)
    ends = [start, *(end if until is None else until for _, until in pieces)]
    for (motion, _), (since, until) in zip(pieces, pairwise(ends), strict=True):
        first, last = max(since, start), min(until, end)
        loss = _loss_of_motion(motion, first, last) if first < last else None
        if loss is not None:
            return loss
    return None


def _loss_of_motion(motion: SimpleMotion, start: QQ, end: QQ) -> str | None:
    """Return why a motion may not be a bijection at all times of a span, in words."""
    if isinstance(motion, (Translation, Rigid)):
        return None
    if not isinstance(motion, Affine):
        return (
            f"exactpt does not know whether its motion, of class {type(motion).__name__}, "
            "keeps its shape"
        )
    time = _first_collapse(motion, start, end)
    if time is None:
        return None
    number = time.simplified()
    when = show(number.exact_low) if number.is_rational else f"about {float(number)!r}"
    return f"its affine motion collapses at t = {when}"


def _first_collapse(motion: Affine, start: QQ, end: QQ) -> AlgebraicNumber | None:
    """Return the first time of a closed span at which the matrix is singular."""
    (a, b), (c, d) = motion.matrix
    determinant = a * d - b * c
    begin = AlgebraicNumber(start)
    if determinant.exact_at(start) == 0:
        return begin
    roots = roots_after(determinant.exact_integers(), begin, end)
    return next((root.time for root in roots), None)
