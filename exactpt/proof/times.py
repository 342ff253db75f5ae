"""Names of times: what vanishes then, and the coarsest interval in which nothing else does."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from exactpt.kernel.descartes import single_roots
from exactpt.kernel.integer_polynomial import IntPoly, sign_at, square_free
from exactpt.kernel.numbers import QQ, floor, power_of_two

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.proof.nodes import Nodes

__all__ = ["time_in_words"]


def time_in_words(time: AlgebraicNumber, names: Iterable[tuple[int, ...]], nodes: Nodes) -> str:
    """A time as in docs/proofs.md.

    Args:
        time: within the time span.
        names: vertices, three or two, of which the orientation or the difference of
            abscissas may vanish then; if none does, coefficients are written.
        nodes: the vertices.
    """
    time.simplified()
    if time.is_rational:
        return f"{time._low} {time._low}"
    for name in names:
        if len(name) not in (2, 3) or len(set(name)) < len(name):
            continue
        piece = max(nodes.last_break(nodes.body_of[v], time) for v in name)
        f = nodes.vanishing(name, piece)
        if f and time.sign_of(f) == 0:
            low, high = _interval(time, square_free(f), nodes.breaks(name), nodes.scene._end)
            return f"{low} {high} @ {' '.join(map(str, name))}"
    low, high = _interval(time, time._polynomial, [], nodes.scene._end)
    return f"{low} {high} {' '.join(map(str, time._polynomial))}"


def _interval(time: AlgebraicNumber, f: IntPoly, breaks: list[QQ], end: QQ) -> tuple[QQ, QQ]:
    """Neighbours m / 2^k and (m + 1) / 2^k with this root of f between them, and no other.

    The first of them, from those of the size of the time on; no breakpoint is inside.
    """
    size = max(abs(time._low), abs(end))
    k = size.denominator.bit_length() - size.numerator.bit_length()
    while True:
        unit = power_of_two(-k)
        low = floor(time._low / unit) * unit
        while time.compare_rational(low + unit) > 0:
            low += unit
        high = low + unit
        if (
            time.compare_rational(low) > 0
            and not any(low < b < high for b in breaks)
            and sign_at(f, low) * sign_at(f, high) < 0
            and [alone for *_, alone in single_roots(f, low, high)] == [True]
        ):
            return low, high
        k += 1
