"""What the tests draw from, degenerate first: small integers, planted roots, ties."""

from __future__ import annotations

from fractions import Fraction
from math import lcm

import flint
from hypothesis import strategies as st

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import primitive, trimmed
from exactpt.kernel.numbers import QQ, ZZ
from fuzz.references.real_roots import RealRoot, real_roots, separate

__all__ = [
    "algebraics",
    "as_int_poly",
    "as_primitive",
    "as_rational",
    "body_data",
    "doubles",
    "factors",
    "fractions",
    "int_polys",
    "planted_polys",
    "raw_polys",
    "scene_data",
    "small",
    "times",
    "trim",
    "wide_fractions",
    "written",
]


def as_rational(q):
    """The kernel's rational for a `Fraction`."""
    return QQ(ZZ(q.numerator), ZZ(q.denominator))


def as_int_poly(coefficients):
    """The kernel's integer polynomial for a list of integers."""
    return tuple(ZZ(int(c)) for c in coefficients)


def as_primitive(coefficients):
    """The kernel's primitive positive multiple of a polynomial over the rationals."""
    denominator = ZZ(lcm(*(int(c.denominator) for c in coefficients)))
    return primitive(trimmed(ZZ(c * denominator) for c in coefficients))


# Numbers

small = st.integers(-4, 4)
fractions = st.builds(Fraction, small, st.integers(1, 4))
wide_fractions = st.one_of(
    fractions,
    st.builds(Fraction, st.integers(-(10**30), 10**30), st.integers(1, 10**30)),
    st.builds(
        lambda m, e, d: m * Fraction(2) ** e + Fraction(d, 2**1200),
        st.integers(-(2**54), 2**54),
        st.integers(-1140, 1030),
        st.integers(-1, 1),
    ),
)
doubles = st.floats(allow_nan=False, allow_infinity=False)


# Polynomials, constant term first, as tuples of `int`

_FACTORS = [
    (-2, 0, 1),
    (-3, 0, 1),
    (-1, 0, 2),
    (-1, 1, 1),
    (1, 0, 1),
    (1, 1, 1),
    (-2, 0, 0, 1),
    (1, -3, 0, 1),
    (-1, 0, -1, 0, 1),
    (-(2**41), 2**40 + 1, 2**40),
    (-2 * 2**80 - 1, 0, 2**80),
]


def trim(coefficients):
    """Without leading zeros."""
    f = [int(c) for c in coefficients]
    while f and f[-1] == 0:
        f.pop()
    return tuple(f)


def times(*factors):
    """The product of integer polynomials."""
    result = flint.fmpz_poly([1])
    for f in factors:
        result *= flint.fmpz_poly([int(c) for c in f])
    return tuple(int(c) for c in result.coeffs())


def raw_polys(max_size=7):
    """Small coefficients, many of them zero; the zero polynomial too."""
    return st.lists(small, max_size=max_size).map(trim)


linear_factors = st.builds(lambda q: (-q.numerator, q.denominator), fractions)
close_factors = st.builds(
    lambda q, d: (-q.numerator * 2**90 - d, q.denominator * 2**90), fractions, st.integers(-2, 2)
)
factors = st.one_of(linear_factors, close_factors, st.sampled_from(_FACTORS))


@st.composite
def planted_polys(draw, max_factors=3, max_power=3):
    """A product of powers of factors that come from few, times a constant of either sign."""
    chosen = draw(st.lists(factors, min_size=1, max_size=max_factors))
    powers = [f for f in chosen for _ in range(draw(st.integers(1, max_power)))]
    return times((draw(st.sampled_from([1, -1, 2, -6])),), *powers)


int_polys = st.one_of(raw_polys(), planted_polys(), st.builds(times, raw_polys(4), raw_polys(4)))
"""Any; the zero polynomial too."""


@st.composite
def algebraics(draw):
    """A pair: an `AlgebraicNumber` of the kernel, and the `RealRoot` that it is.

    The polynomial is a square-free product of few, so that equal numbers come with
    different polynomials; the interval is as wide as it may be or already narrow, its
    low end another root or not, its high end the number itself or not.
    """
    if draw(st.integers(0, 5)) == 0:
        q = draw(fractions)
        (root,) = real_roots((-q.numerator, q.denominator))
        return AlgebraicNumber(as_rational(q)), root
    chosen = draw(st.lists(factors, min_size=1, max_size=3, unique=True))
    f = _square_free(times(*chosen))
    roots = real_roots(f)
    if not roots:
        f, roots = (-2, 0, 1), real_roots((-2, 0, 1))
    i = draw(st.integers(0, len(roots) - 1))
    if draw(st.booleans()):
        f = tuple(-c for c in f)
    low, high = draw(_interval(roots, i))
    number = AlgebraicNumber.root(as_int_poly(f), as_rational(low), as_rational(high))
    for _ in range(draw(st.integers(0, 3))):
        number.refine()
    return number, real_roots(f)[i]


def _square_free(f):
    p = flint.fmpz_poly(list(f))
    common = p.gcd(p.derivative())
    return tuple(int(c) for c in (p // common).coeffs())


@st.composite
def _interval(draw, roots: list[RealRoot], i):
    """(low, high] with the root i alone in it."""
    root = roots[i]
    width = draw(st.sampled_from([Fraction(4), Fraction(1, 3), Fraction(1, 2**40)]))
    if i > 0:
        separate(roots[i - 1], root)
    if i + 1 < len(roots):
        separate(root, roots[i + 1])
    low, high = root.low - width, root.high + width
    if i > 0:
        # Open at the low end: another root may lie there.
        end = roots[i - 1].high
        low = max(low, end if draw(st.booleans()) else (end + root.low) / 2)
    if i + 1 < len(roots):
        high = min(high, (root.high + roots[i + 1].low) / 2)
    if root.is_rational and draw(st.integers(0, 3)) == 0:
        high = root.low
    return low, high


# Bodies and scenes, as JSON data in the format of the contract

_BASES = [
    [(0, 0)],
    [(0, 0), (2, 1)],
    [(0, 0), (3, 0), (1, 2)],
    [(0, 0), (1, 2), (3, 0)],
    [(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)],
]

coefficients = st.lists(fractions, max_size=3)


def written(q):
    """One of the written forms of a rational: ``"p/q"``, ``"p"``, a JSON integer."""
    if q.denominator > 1:
        return st.just(str(q))
    return st.sampled_from([str(q), int(q)])


@st.composite
def _written_list(draw, numbers):
    return [draw(written(q)) for q in numbers]


def _at(f, t):
    return sum((c * t**i for i, c in enumerate(f)), Fraction(0))


@st.composite
def _shape(draw):
    """Keys of a body; simple at t = 0, whatever it does later."""
    base = [(Fraction(x), Fraction(y)) for x, y in draw(st.sampled_from(_BASES))]
    shift = draw(fractions), draw(fractions)
    base = [(x + shift[0], y + shift[1]) for x, y in base]
    kind = draw(st.sampled_from(["rest", "own", "keyframes"]))
    if kind == "rest":
        return {"vertices": [draw(_written_list(p)) for p in base]}
    if kind == "own":
        rows = []
        for x, y in base:
            row = {}
            for key, start in (("x", x), ("y", y)):
                own = [start, *draw(coefficients)]
                if any(own) or draw(st.booleans()):
                    row[key] = draw(_written_list(own))
            rows.append(row)
        return {"vertices": rows}
    times_ = sorted(draw(st.sets(fractions.map(abs), min_size=1, max_size=3)))
    frames = [{"t": draw(written(times_[0])), "vertices": [draw(_written_list(p)) for p in base]}]
    for t in times_[1:]:
        moved = [(x + draw(fractions), y + draw(fractions)) for x, y in base]
        frames.append({"t": draw(written(t)), "vertices": [draw(_written_list(p)) for p in moved]})
    return {"keyframes": frames}


@st.composite
def _one_motion(draw, x, y, ends):
    """A motion that is the translation by (x, y) at the times in ``ends``."""
    vanishing = [Fraction(draw(small))]
    for end in ends:
        vanishing = [
            (vanishing[i - 1] if i else 0) - end * (vanishing[i] if i < len(vanishing) else 0)
            for i in range(len(vanishing) + 1)
        ]
    shift = {"x": draw(_written_list(x)), "y": draw(_written_list(y))}
    kind = draw(st.sampled_from(["translation", "rigid", "affine"]))
    if kind == "rigid":
        turn = {"half_turn": draw(_written_list(vanishing)), **shift}
        if draw(st.booleans()):
            turn["pivot"] = draw(_written_list([draw(fractions), draw(fractions)]))
        return {"rigid": turn}
    if kind == "affine":
        rows = []
        for i in range(2):
            row = []
            for j in range(2):
                factor = draw(small)
                entry = [factor * c for c in vanishing]
                entry[0] += i == j
                row.append(draw(_written_list(entry)))
            rows.append(row)
        return {"affine": {"matrix": rows, **shift}}
    return shift


@st.composite
def _motion(draw):
    kind = draw(st.sampled_from(["rest", "one", "pieces"]))
    if kind == "rest":
        return {}
    x, y = draw(coefficients), draw(coefficients)
    if kind == "one":
        motion = draw(_one_motion(x, y, [Fraction(0)]))
        if "rigid" in motion and draw(st.booleans()):
            motion["rigid"]["orientation"] = draw(st.sampled_from([["3/5", "4/5"], ["0", "-1"]]))
        return {"motion": motion}
    breaks = sorted(draw(st.sets(fractions.map(abs), max_size=3)))
    pieces = []
    for i, end in enumerate([*breaks, None]):
        ends = {*([end] if end is not None else []), *([breaks[i - 1]] if i else [Fraction(0)])}
        if i == 0:
            ends.add(Fraction(0))
        piece = {"motion": draw(_one_motion(x, y, sorted(ends)))}
        if end is not None:
            piece["until"] = draw(written(end))
            # The next translation meets this one there.
            x, y = (_meeting(f, draw(coefficients), end) for f in (x, y))
        pieces.append(piece)
    return {"motion": {"pieces": pieces}}


def _meeting(before, tail, t):
    after = [Fraction(0), *tail]
    return [_at(before, t) - _at(after, t), *tail]


@st.composite
def body_data(draw, name="a"):
    """A body of the contract as JSON data: every shape, every motion, continuous."""
    body = {"name": name, **draw(_shape()), **draw(_motion())}
    if draw(st.integers(0, 4)) == 0:
        body["closed"] = False
    return body


@st.composite
def scene_data(draw):
    """A valid scene of the contract as JSON data; it starts at 0."""
    names = draw(st.lists(st.text(min_size=1, max_size=4), unique=True, max_size=3))
    bodies = [draw(body_data(name)) for name in names]
    return {"exactpt": 1, "time": ["0", draw(written(1 + abs(draw(fractions))))], "bodies": bodies}
