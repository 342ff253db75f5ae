"""The test that a body keeps its shape.

At each time it is the image of one shape by a bijection of the plane that keeps lines straight.
"""

from __future__ import annotations

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, show
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Rigid, SimpleMotion, Translation, formulas_of
from exactpt.motion.outline import pieces_during
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
    if all(isinstance(formula, (Translation, Rigid)) for formula in formulas_of(body.motion)):
        return None
    since = start
    for motion, ends in pieces_during(body.motion, start, end):
        until = end if ends is None else min(ends, end)
        loss = _loss_of_motion(motion, since, until)
        if loss is not None:
            return loss
        since = until
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
