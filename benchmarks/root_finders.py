"""Programs that find the first root of an integer polynomial in (0, END]."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, final

from exactpt.certificates import first_root as filters
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after

__all__ = ["END", "EXACT", "FILTER", "FINDERS", "Finder", "exact_first"]

END: Final = 2

NEARLY_REAL: Final = 2.0**-30
"""Maximum imaginary part of a real root of mpmath, which rounds both parts."""


@final
@dataclass(frozen=True, slots=True)
class Finder:
    """A program that finds roots.

    Attributes:
        name: its name in tables.
        convert: converts an integer polynomial to its own type; not timed.
        first: the first root, in its own type; None if that is undecided.
        value: that root as a double, not timed; None for intervals of arbitrary width.
        numbers: converts the first root for comparison by `before`; not timed.
        before: whether one root is less than another.
        package: the package that must be installed; None if none.
    """

    name: str
    convert: Callable[[IntPoly], Any]
    first: Callable[[Any], Any]
    value: Callable[[Any], float] | None = float
    numbers: Callable[[Any], Any] | None = None
    before: Callable[[Any, Any], bool] | None = None
    package: str | None = None


def exact_first(f: IntPoly) -> AlgebraicNumber:
    """The first root by exact arithmetic, without the filter."""
    return next(roots_after(f, AlgebraicNumber(0), QQ(END))).time


def _made_anew(f: IntPoly) -> tuple[IntPoly, QQ, QQ]:
    """The polynomial and interval of a root, so that no refinement is shared between runs."""
    root = exact_first(f)
    return root.exact_polynomial, root.exact_low, root.exact_high


def _exact_before(p: tuple[IntPoly, QQ, QQ], q: tuple[IntPoly, QQ, QQ]) -> bool:
    return AlgebraicNumber.root(*p).compare(AlgebraicNumber.root(*q)) < 0


def _filter_image(f: IntPoly) -> tuple[list[float], list[float]]:
    """The polynomial divided by a power of two, in doubles, with error bounds of one ulp."""
    shift = max(c.bit_length() for c in f)
    c = [float(QQ(x, ZZ(1) << shift)) for x in f]
    return c, [abs(x) * 2.0**-53 for x in c]


def _filter_first(image: tuple[list[float], list[float]]) -> float | None:
    c, e = image
    now, end = 0.0, float(END)
    if len(c) == 2:
        s, low, high = filters.linear(c[0], c[1], e[0], e[1], now, now, end, at_root=False)
    elif len(c) == 3:
        s, low, high = filters.quadratic(
            c[0], c[1], c[2], e[0], e[1], e[2], now, now, end, at_root=False
        )
    else:
        s, low, high = filters.polynomial(c, e, now, now, end, at_root=False)
    return 0.5 * (low + high) if s else None


def _to_sympy(f: IntPoly) -> Any:  # noqa: ANN401 - SymPy is optional
    import sympy

    return sympy.Poly([int(c) for c in reversed(f)], sympy.Symbol("t"))


def _sympy_first(poly: Any) -> Any:  # noqa: ANN401
    """The isolating intervals in [0, END], the first of which counts."""
    return poly.intervals(inf=0, sup=END)[0]


def _sympy_number(poly: Any) -> Any:  # noqa: ANN401
    return next(r for r in poly.real_roots() if 0 < r <= END)


def _to_flint(f: IntPoly) -> Any:  # noqa: ANN401
    import flint

    return flint.fmpz_poly([int(c) for c in f])


def _flint_first(poly: Any) -> Any:  # noqa: ANN401
    """FLINT encloses all complex roots; the least real one in (0, END] counts."""
    reals = (r.real for r, _ in poly.complex_roots() if r.imag == 0)
    return min((r for r in reals if r > 0 and r <= END), key=float)


def _mpmath_first(coefficients: list[int]) -> float | None:
    """All complex roots in double precision; the least that is nearly real counts."""
    import mpmath

    with mpmath.workprec(max(64, 2 * len(coefficients))):
        roots = mpmath.polyroots(coefficients, maxsteps=200, extraprec=200, error=False)
    reals = (float(r.real) for r in roots if abs(r.imag) <= NEARLY_REAL * abs(r))
    return min((r for r in reals if 0 < r <= END), default=None)


EXACT: Final = Finder(
    "exactpt, exact", lambda f: f, exact_first, numbers=_made_anew, before=_exact_before
)
FILTER: Final = Finder("exactpt, filter", _filter_image, _filter_first)
FINDERS: Final = (
    EXACT,
    FILTER,
    Finder(
        "SymPy",
        _to_sympy,
        _sympy_first,
        None,
        _sympy_number,
        lambda p, q: bool(p < q),
        "sympy",
    ),
    Finder(
        "FLINT",
        _to_flint,
        _flint_first,
        float,
        _flint_first,
        lambda p, q: bool(p < q),
        "python-flint",
    ),
    Finder(
        "mpmath",
        lambda f: [int(c) for c in reversed(f)],
        _mpmath_first,
        package="mpmath",
    ),
)
"""All programs, those of exactpt first."""
