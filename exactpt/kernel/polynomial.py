"""Polynomials over the rationals: the coordinates of motions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from math import lcm
from typing import TYPE_CHECKING, ClassVar, Final, final, overload

from exactpt.brief import call_in_brief
from exactpt.errors import InputError
from exactpt.kernel.budget import LONG, check_budget
from exactpt.kernel.numbers import (
    QQ,
    ZZ,
    Rational,
    as_doubles,
    fraction,
    fractions,
    rational,
    shorten,
)

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.kernel.integer_polynomial import IntPoly
    from exactpt.kernel.sympy_adapter import Expression, Variable


@final
class Polynomial:
    """A polynomial in t over the rationals: dense, immutable, hashable.

    Sums, differences, products and powers are polynomials, and so are quotients by numbers; a
    number stands for the constant polynomial. Coefficients given as doubles are kept, and become
    rationals on first access.

    >>> t = Polynomial([0, 1])
    >>> f = t / 2 - t**2
    >>> f, f(3), f(t + 1)
    (Polynomial(['0', '1/2', '-1']), Fraction(-15, 2), Polynomial(['-1/2', '-3/2', '-1']))
    >>> f.derivative()
    Polynomial(['1/2', '-2'])
    >>> (t**2 - 2).roots(after=0)
    [<1.4142135623730951... (root of a polynomial of degree 2)>]
    """

    __slots__ = ("_exact", "exact_doubles")
    exact_doubles: tuple[float, ...] | None
    _exact: tuple[QQ, ...] | None
    __match_args__: ClassVar = ("coefficients",)

    def __init__(self, coefficients: Iterable[Rational] = ()) -> None:
        # `exact_doubles` are the coefficients if all were given as doubles; `_exact` are rational.
        if isinstance(coefficients, str):
            raise InputError(f"a polynomial has a list of coefficients: {shorten(coefficients)}")
        try:
            given = list(coefficients)
        except TypeError:  # also an array without dimension
            what = f"a polynomial has a list of coefficients: {shorten(coefficients)}"
            raise InputError(what) from None
        near = as_doubles(given)
        if near is None:
            self._keep([rational(c) for c in given])
            return
        while near and near[-1] == 0.0:
            near.pop()
        object.__setattr__(self, "exact_doubles", tuple(near))
        object.__setattr__(self, "_exact", None)

    def _keep(self, values: list[QQ]) -> None:
        while values and values[-1] == 0:
            values.pop()
        object.__setattr__(self, "exact_doubles", None)
        object.__setattr__(self, "_exact", tuple(values))

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Polynomial cannot be changed: {name}")

    @classmethod
    def exact_from(cls, values: list[QQ]) -> Polynomial:
        """Return the polynomial with these coefficients, constant first, which are not checked."""
        self = cls.__new__(cls)
        self._keep(values)
        return self

    @property
    def exact_coefficients(self) -> tuple[QQ, ...]:
        """The coefficients; the last is not 0."""
        values = self._exact
        if values is None:
            values = tuple([QQ(*c.as_integer_ratio()) for c in self.exact_doubles or ()])
            object.__setattr__(self, "_exact", values)
        return values

    @classmethod
    def from_sympy(cls, expression: Expression, variable: Variable) -> Polynomial:
        """Return a SymPy expression as a polynomial in ``variable``.

        Raises:
            InputError: if it is not a polynomial with rational coefficients.
        """
        from exactpt.kernel.sympy_adapter import coefficients_from_sympy

        return cls(coefficients_from_sympy(expression, variable))

    def to_sympy(self, variable: Variable) -> Expression:
        """Return the polynomial as a SymPy expression in ``variable``."""
        from exactpt.kernel.sympy_adapter import polynomial_to_sympy

        return polynomial_to_sympy(self, variable)

    @property
    def coefficients(self) -> tuple[Fraction, ...]:
        """``coefficients[i]`` is that of t**i; the last is not 0, and ``()`` is zero."""
        return fractions(self.exact_coefficients)

    @property
    def degree(self) -> int:
        """The degree; -1 for the zero polynomial."""
        coefficients = self.exact_coefficients if self.exact_doubles is None else self.exact_doubles
        return len(coefficients) - 1

    def __getitem__(self, i: int) -> Fraction:
        """Return the coefficient of t**i: 0 beyond the degree.

        Raises:
            IndexError: if i is negative.
        """
        if i < 0:
            raise IndexError(f"expected an exponent of at least 0, got {i}")
        values = self.exact_coefficients
        return fraction(values[i] if i < len(values) else QQ(0))

    @overload
    def __call__(self, t: Rational) -> Fraction: ...
    @overload
    def __call__(self, t: Polynomial) -> Polynomial: ...
    def __call__(self, t: Rational | Polynomial) -> Fraction | Polynomial:
        """Return the value at a rational number, or the composition with a polynomial."""
        if not isinstance(t, Polynomial):
            return fraction(self.exact_at(rational(t)))
        if t.degree <= 1:
            origin, step, *_ = *t.exact_coefficients, QQ(0), QQ(0)
            return Polynomial.exact_from(substituted(self.exact_coefficients, origin, step))
        result = ZERO
        for c in reversed(self.exact_coefficients):
            result = result * t + c
        return result

    def exact_at(self, t: QQ) -> QQ:
        """Return the value at a time as a rational of GMP."""
        value = QQ(0)
        for c in reversed(self.exact_coefficients):
            value = value * t + c
        return value

    def sign(self, t: AlgebraicNumber | Rational) -> int:
        """Return the sign at a time, -1, 0 or 1, exactly."""
        return _number(t).sign_of(self.exact_integers())

    def sign_after(self, t: AlgebraicNumber | Rational) -> int:
        """Return the sign just after a time, exactly: 0 for the zero polynomial alone."""
        return _number(t).sign_after(self.exact_integers())

    def roots(
        self,
        after: AlgebraicNumber | Rational | None = None,
        until: Rational | None = None,
    ) -> list[AlgebraicNumber]:
        """Return the distinct real roots t with after < t <= until, in increasing order.

        Args:
            after: a lower bound; None for none.
            until: an upper bound; None for none.

        Raises:
            InputError: if the polynomial is zero.
        """
        from exactpt.kernel.roots import roots_after

        if self.degree < 0:
            raise InputError("every number is a root of the zero polynomial")
        # Cauchy's bound: every root is smaller in absolute value.
        bound = 1 + max(abs(c / self.exact_coefficients[-1]) for c in self.exact_coefficients)
        start = _number(-bound if after is None else after)
        end = bound if until is None else rational(until)
        return [root.time for root in roots_after(self.exact_integers(), start, end)]

    def exact_integers(self) -> IntPoly:
        """Return a positive multiple with integer coefficients."""
        common = ZZ(lcm(*(int(c.denominator) for c in self.exact_coefficients)))
        return tuple(ZZ(c * common) for c in self.exact_coefficients)

    def __add__(self, other: Polynomial | Rational) -> Polynomial:
        f = self.exact_coefficients
        g = other.exact_coefficients if isinstance(other, Polynomial) else (rational(other),)
        if len(f) < len(g):
            f, g = g, f
        return Polynomial.exact_from([*(a + b for a, b in zip(f, g, strict=False)), *f[len(g) :]])

    def __radd__(self, other: Rational) -> Polynomial:
        return self + other

    def __neg__(self) -> Polynomial:
        return Polynomial.exact_from([-c for c in self.exact_coefficients])

    def __sub__(self, other: Polynomial | Rational) -> Polynomial:
        return self + (-other if isinstance(other, Polynomial) else -rational(other))

    def __rsub__(self, other: Rational) -> Polynomial:
        return -self + other

    def __mul__(self, other: Polynomial | Rational) -> Polynomial:
        f = self.exact_coefficients
        if not isinstance(other, Polynomial):
            factor = rational(other)
            return Polynomial.exact_from([c * factor for c in f])
        g = other.exact_coefficients
        if not f or not g:
            return ZERO
        product = [QQ(0)] * (len(f) + len(g) - 1)
        for i, a in enumerate(f):
            if len(g) > LONG:
                check_budget()
            for j, b in enumerate(g):
                product[i + j] += a * b
        return Polynomial.exact_from(product)

    def __rmul__(self, other: Rational) -> Polynomial:
        return self * other

    def __truediv__(self, other: Rational) -> Polynomial:
        divisor = rational(other)
        if divisor == 0:
            raise ZeroDivisionError("a polynomial divided by zero")
        return Polynomial.exact_from([c / divisor for c in self.exact_coefficients])

    def __pow__(self, exponent: int) -> Polynomial:
        if exponent < 0:
            raise InputError(f"an exponent is an integer >= 0: {exponent}")
        power, square = ONE, self
        while exponent:
            if exponent & 1:
                power = power * square
            exponent >>= 1
            if exponent:
                square = square * square
        return power

    def derivative(self) -> Polynomial:
        """Return the derivative."""
        return Polynomial.exact_from([i * c for i, c in enumerate(self.exact_coefficients) if i])

    def __iter__(self) -> Iterator[Fraction]:
        return iter(self.coefficients)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Polynomial):
            return NotImplemented
        if self.exact_doubles is not None and other.exact_doubles is not None:
            return self.exact_doubles == other.exact_doubles
        return self.exact_coefficients == other.exact_coefficients

    def __hash__(self) -> int:
        return hash(self.exact_coefficients)

    def __reduce__(self) -> tuple[object, ...]:
        return Polynomial, (tuple(map(str, self.exact_coefficients)),)

    def __repr__(self) -> str:
        return call_in_brief("Polynomial", [str(c) for c in self.exact_coefficients])


ZERO: Final = Polynomial()
ONE: Final = Polynomial([1])


def polynomial(value: Polynomial | Rational | Iterable[Rational]) -> Polynomial:
    """Return a polynomial from itself, from one number (a constant), or from coefficients.

    Raises:
        InputError: if ``value`` is none of these.
    """
    if isinstance(value, Polynomial):
        return value
    if isinstance(value, str):
        return Polynomial.exact_from([rational(value)])
    if type(value) is list or isinstance(value, Iterable):
        return Polynomial(value)
    if hasattr(value, "as_integer_ratio") or hasattr(value, "numerator"):
        return Polynomial([value])
    raise InputError(f"not a polynomial: {shorten(value)}")


def substituted(f: Sequence[QQ], origin: QQ, step: QQ) -> list[QQ]:
    """Return the coefficients of f(origin + step * t)."""
    moved = list(f)
    n = len(moved)
    if origin:
        for i in range(n - 1):
            if n > LONG:
                check_budget()
            for j in range(n - 2, i - 1, -1):
                moved[j] += origin * moved[j + 1]
    factor = QQ(1)
    for i in range(n):
        moved[i] *= factor
        factor *= step
    return moved


def _number(t: AlgebraicNumber | Rational) -> AlgebraicNumber:
    from exactpt.kernel.algebraic import AlgebraicNumber

    return t if isinstance(t, AlgebraicNumber) else AlgebraicNumber(t)
