"""Times, features and names in words, for captions and labels."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import nearest_float, parse_rational, rational

if TYPE_CHECKING:
    from collections.abc import Sequence

    from exactpt.kernel.numbers import QQ
    from exactpt.pair.contact import Contact, ContactPoint


def clean(text: str) -> str:
    """Return the text with each character that XML does not allow replaced by U+FFFD."""
    return "".join(c if _is_xml(ord(c)) else "\ufffd" for c in text)


def _is_xml(c: int) -> bool:
    return 0x20 <= c < 0xD800 or 0xE000 <= c < 0xFFFE or c >= 0x10000 or c in (0x9, 0xA, 0xD)


def short(text: str, limit: int = 24) -> str:
    """Return the text, shortened in the middle to ``limit`` characters."""
    if len(text) <= limit:
        return text
    half = (limit - 1) // 2
    return f"{text[: limit - 1 - half]}…{text[len(text) - half :]}"


def time_in_words(time: AlgebraicNumber | QQ, digits: int = 12) -> str:
    """Return a time in decimals: ``t = 2.5``, or ``t ≈ 0.333333333333 (1/3)``.

    An exact fraction follows only if it is short, and no irrational number has one.
    """
    low = getattr(time, "low", time)
    near = float(time) if isinstance(time, AlgebraicNumber) else nearest_float(time)
    decimal = f"{near:.{digits}g}"
    if low != getattr(time, "high", time):
        return f"t ≈ {decimal}"
    exact = rational(low)
    if math.isfinite(near) and parse_rational(decimal) == exact:
        return f"t = {decimal}"
    fraction = str(exact)
    return f"t ≈ {decimal} ({fraction})" if len(fraction) <= 16 else f"t ≈ {decimal}"


def pair_in_words(pair: ContactPoint) -> str:
    """Return the two features of an incidence: ``vertex 2 of tip on edge 4 of box``."""
    mine = f"vertex {pair.vertex} of {short(pair.body)}"
    if pair.edge is None:
        return f"{mine} on vertex {pair.other_vertex} of {short(pair.other)}"
    return f"{mine} on edge {pair.edge} of {short(pair.other)}"


def polynomial_in_words(coefficients: Sequence[object]) -> str:
    """Return an integer polynomial in t, given with the constant term first: ``3 t^2 - t + 1``."""
    terms = []
    for power, coefficient in enumerate(map(str, coefficients)):
        size = coefficient.lstrip("-")
        t = "" if power == 0 else "t" if power == 1 else f"t^{power}"
        factor = "" if size == "1" and t else size
        if size != "0":
            terms.append(("-" if coefficient != size else "+", f"{factor} {t}".strip()))
    (sign, first), *rest = terms[::-1] or [("+", "0")]
    return f"{sign.strip('+')}{first}" + "".join(f" {sign} {term}" for sign, term in rest)


def incidences_in_words(contact: Contact) -> list[str]:
    """Return one line for every incidence, and for every two bodies that share a point."""
    return [pair_in_words(pair) for pair in contact.pairs] + [
        f"{short(a)} and {short(b)} share a point" for a, b in contact.initial_pairs
    ]


def contact_in_words(contact: Contact, *, limit: int = 1) -> str:
    """Return one line: the first ``limit`` incidences and the number of others."""
    found = incidences_in_words(contact)
    more = [f"{len(found) - limit} more"] if len(found) > limit else []
    return ", ".join(found[:limit] + more)
