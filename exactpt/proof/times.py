"""Names of times: a function that vanishes at it, and a coarse isolating interval."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from exactpt.kernel.descartes import single_roots
from exactpt.kernel.integer_polynomial import IntPoly, sign_at, square_free
from exactpt.kernel.numbers import QQ, floor, power_of_two

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.proof.nodes import Nodes


def time_text(time: AlgebraicNumber, names: Iterable[tuple[int, ...]], nodes: Nodes) -> str:
    """Return a time in the notation of docs/proofs.md.

    Args:
        time: within the time span.
        names: triples or pairs of vertices whose orientation or difference of abscissas may
            vanish at it, each written with its least vertex first; if none does, the coefficients
            of a polynomial are written.
        nodes: the vertices of the scene.
    """
    time.simplified()
    if time.is_rational:
        return f"{time.exact_low} {time.exact_low}"
    for given in names:
        if len(given) not in (2, 3) or len(set(given)) < len(given):
            continue
        least = given.index(min(given))
        name = given[least:] + given[:least]
        piece = max(nodes.last_break(nodes.body_of[v], time) for v in name)
        f = nodes.vanishing(name, piece)
        if f and time.sign_of(f) == 0:
            low, high = _interval(time, square_free(f), nodes.breaks(name), nodes.scene.exact_end)
            return f"{low} {high} @ {' '.join(map(str, name))}"
    low, high = _interval(time, time.exact_polynomial, [], nodes.scene.exact_end)
    return f"{low} {high} {' '.join(map(str, time.exact_polynomial))}"


def _interval(time: AlgebraicNumber, f: IntPoly, breaks: list[QQ], end: QQ) -> tuple[QQ, QQ]:
    """Return the interval [m / 2^k, (m + 1) / 2^k] that isolates this root, for the least k.

    The interval contains no other root and no breakpoint in its interior; k begins where 2^-k
    has the size of the time.
    """
    size = max(abs(time.exact_low), abs(end))
    k = size.denominator.bit_length() - size.numerator.bit_length()
    while True:
        unit = power_of_two(-k)
        low = floor(time.exact_low / unit) * unit
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
