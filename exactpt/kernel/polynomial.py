"""Polynomials over the rationals: the coordinates of motions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from numbers import Real
from typing import TYPE_CHECKING, ClassVar, Final, final

from exactpt.errors import InputError
from exactpt.kernel.budget import LONG, ask
from exactpt.kernel.numbers import QQ, Rational, as_doubles, fraction, fractions, rational, shorten

if TYPE_CHECKING:
    from exactpt.kernel.sympy_door import Expression, Variable

__all__ = ["ONE", "ZERO", "Polynomial", "polynomial"]


@final
class Polynomial:
    """A polynomial in t over the rationals: dense, immutable, hashable.

    Coefficients given as doubles are kept, and become rationals when these are asked for.

    >>> f = Polynomial([0, "1/2", -1])
    >>> f(3)
    Fraction(-15, 2)
    >>> f.derivative()
    Polynomial(['1/2', '-2'])
    """

    __slots__ = ("_doubles", "_exact")
    _doubles: tuple[float, ...] | None
    _exact: tuple[QQ, ...] | None
    __match_args__: ClassVar = ("coefficients",)

    def __init__(self, coefficients: Iterable[Rational] = ()) -> None:
        # `_doubles` are the coefficients if all were given as doubles; `_exact` are rational.
        if isinstance(coefficients, str) or not isinstance(coefficients, Iterable):
            raise InputError(f"a polynomial has a list of coefficients: {shorten(coefficients)}")
        given = list(coefficients)
        near = as_doubles(given)
        if near is None:
            self._keep([rational(c) for c in given])
            return
        while near and near[-1] == 0.0:
            near.pop()
        object.__setattr__(self, "_doubles", tuple(near))
        object.__setattr__(self, "_exact", None)

    def _keep(self, values: list[QQ]) -> None:
        while values and values[-1] == 0:
            values.pop()
        object.__setattr__(self, "_doubles", None)
        object.__setattr__(self, "_exact", tuple(values))

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Polynomial cannot be changed: {name}")

    @classmethod
    def _of(cls, values: list[QQ]) -> Polynomial:
        self = cls.__new__(cls)
        self._keep(values)
        return self

    @property
    def _coefficients(self) -> tuple[QQ, ...]:
        """The coefficients; the last is not 0."""
        values = self._exact
        if values is None:
            values = tuple([rational(c) for c in self._doubles or ()])
            object.__setattr__(self, "_exact", values)
        return values

    @classmethod
    def from_sympy(cls, expression: Expression, variable: Variable) -> Polynomial:
        """A SymPy expression as a polynomial in ``variable``.

        Raises:
            InputError: if it is not a polynomial with rational coefficients.
        """
        from exactpt.kernel.sympy_door import coefficients_from_sympy

        return cls(coefficients_from_sympy(expression, variable))

    def to_sympy(self, variable: Variable) -> Expression:
        """The polynomial as a SymPy expression in ``variable``."""
        from exactpt.kernel.sympy_door import polynomial_to_sympy

        return polynomial_to_sympy(self, variable)

    @property
    def coefficients(self) -> tuple[Fraction, ...]:
        """``coefficients[i]`` is that of t**i; the last is not 0, and ``()`` is zero."""
        return fractions(self._coefficients)

    @property
    def degree(self) -> int:
        """The degree; -1 for the zero polynomial."""
        return len(self._coefficients if self._doubles is None else self._doubles) - 1

    def __call__(self, t: Rational) -> Fraction:
        """The value at a rational t."""
        return fraction(self._at(rational(t)))

    def _at(self, t: QQ) -> QQ:
        value = QQ(0)
        for c in reversed(self._coefficients):
            value = value * t + c
        return value

    def __add__(self, other: Polynomial) -> Polynomial:
        f, g = self._coefficients, other._coefficients
        if len(f) < len(g):
            f, g = g, f
        return Polynomial._of([*(a + b for a, b in zip(f, g, strict=False)), *f[len(g) :]])

    def __neg__(self) -> Polynomial:
        return Polynomial._of([-c for c in self._coefficients])

    def __sub__(self, other: Polynomial) -> Polynomial:
        return self + -other

    def __mul__(self, other: Polynomial) -> Polynomial:
        f, g = self._coefficients, other._coefficients
        if not f or not g:
            return ZERO
        product = [QQ(0)] * (len(f) + len(g) - 1)
        for i, a in enumerate(f):
            if len(g) > LONG:
                ask()
            for j, b in enumerate(g):
                product[i + j] += a * b
        return Polynomial._of(product)

    def derivative(self) -> Polynomial:
        """The derivative."""
        return Polynomial._of([i * c for i, c in enumerate(self._coefficients) if i])

    def __iter__(self) -> Iterator[Fraction]:
        return iter(self.coefficients)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Polynomial):
            return NotImplemented
        if self._doubles is not None and other._doubles is not None:
            return self._doubles == other._doubles
        return self._coefficients == other._coefficients

    def __hash__(self) -> int:
        return hash(self._coefficients)

    def __reduce__(self) -> tuple[object, ...]:
        return Polynomial, (tuple(map(str, self._coefficients)),)

    def __repr__(self) -> str:
        return f"Polynomial({[str(c) for c in self._coefficients]})"


ZERO: Final = Polynomial()
ONE: Final = Polynomial([1])


def polynomial(value: Polynomial | Rational | Iterable[Rational]) -> Polynomial:
    """A polynomial from itself, from one number (a constant), or from coefficients.

    Raises:
        InputError: if ``value`` is none of these.
    """
    if isinstance(value, Polynomial):
        return value
    if isinstance(value, Iterable) and not isinstance(value, str):
        return Polynomial(value)
    if isinstance(value, (str, Real)) or hasattr(value, "numerator"):
        return Polynomial([value])
    raise InputError(f"not a polynomial: {value!r}")
