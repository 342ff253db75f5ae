"""Numbers: what is read exactly, what is refused, and how doubles enclose rationals."""

import math
import re
import time
from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction

import gmpy2
import numpy as np
import pytest
import sympy
from folding import every
from hypothesis import example, given
from hypothesis import strategies as st
from strategies import as_rational, doubles, fractions, wide_fractions

from exactpt import AlgebraicNumber, InputError
from exactpt.kernel.approximation import decimal_quotient
from exactpt.kernel.numbers import (
    QQ,
    ZZ,
    as_doubles,
    ceil,
    enclosing_floats,
    floor,
    nearest_float,
    parse_rational,
    power_of_two,
    rational,
    rationals,
    shorten,
    sign,
)
from fuzz.references.real_roots import exact, is_nearest_double

LARGEST = Fraction(math.nextafter(math.inf, 0.0))
SMALLEST = Fraction(5e-324)
TIE_WITH_INFINITY = Fraction(2) ** 1024 - Fraction(2) ** 970

digits = st.text("0123456789", min_size=1, max_size=40)
signs = st.sampled_from(["", "-", "+"])
decimals = st.builds(
    "".join,
    st.tuples(
        signs,
        st.one_of(
            digits,
            st.builds("{}.{}".format, digits, digits),
            st.builds(".{}".format, digits),
            st.builds("{}.".format, digits),
        ),
        st.one_of(
            st.just(""), st.builds("{}{}".format, st.sampled_from("eE"), st.integers(-400, 400))
        ),
    ),
)
quotients = st.builds("{}{}/{}".format, signs, digits, digits.filter(lambda d: int(d) > 0))


@given(text=st.one_of(decimals, quotients))
def test_a_written_number_is_read_as_fraction_reads_it(text):
    assert exact(parse_rational(text)) == Fraction(text)


@every(
    "text, value",
    [
        ("0", 0),
        ("-0", 0),
        ("+7", 7),
        ("007", 7),
        ("-6/4", Fraction(-3, 2)),
        ("0/5", 0),
        ("1.25", Fraction(5, 4)),
        ("-3e-2", Fraction(-3, 100)),
        ("0.1", Fraction(1, 10)),
        ("1E+3", 1000),
        ("-.5", Fraction(-1, 2)),
        ("2.", 2),
    ],
)
def test_written_forms_of_the_contract(text, value):
    assert parse_rational(text) == as_rational(Fraction(value))


def test_integers_of_more_digits_than_python_converts_are_read():
    assert parse_rational("7" * 20_000) == (gmpy2.mpz(10) ** 20_000 - 1) // 9 * 7


def test_the_largest_exponents_are_read():
    assert parse_rational("1e100000") == gmpy2.mpz(10) ** 100_000
    assert parse_rational("1e-100000") == gmpy2.mpq(1, gmpy2.mpz(10) ** 100_000)


@every(
    "text",
    [
        "", " ", "+", "-", ".", "e5", "1e", "1e+", "--1", "+-1", "1 2", " 1", "1 ", "1\n", "\n1",
        "1/", "/2", "1/0", "0/0", "-1/00", "1/-2", "1/+2", "1/2/3", "1.5/2", "1/2.5", "1/2e3",
        "1_000", "1,5", "0x10", "\u0661", "\uff11", "\u00bd", "1e5.0", "1e1_0", "nan", "NaN", "inf",
        "-inf", "Infinity", "1e100001", "1e-100001", "1e999999999999", "1j", "1+1", "true", "\x00",
    ],
)  # fmt: skip
def test_what_is_no_number_is_refused_in_one_line(text):
    with pytest.raises(InputError) as refusal:
        parse_rational(text)

    assert "\n" not in str(refusal.value)
    assert shorten(text) in str(refusal.value)


@given(text=st.text(st.sampled_from("0123456789+-./eE _x"), max_size=8))
def test_any_text_is_a_number_or_refused(text):
    try:
        value = parse_rational(text)
    except InputError:
        return

    power = re.search("[eE](.*)", text)
    if not power or abs(int(power[1])) < 4000:  # what `Fraction` reads without protest
        assert exact(value) == Fraction(text)


def test_bug_a_long_refused_text_takes_quadratic_time():
    """The regular expression tries every split into units and decimals: 10,000 digits take 2 s."""
    start = time.process_time()

    with pytest.raises(InputError):
        parse_rational("1" * 5_000 + "x")

    assert time.process_time() - start < 0.1


@given(q=wide_fractions)
def test_rational_keeps_a_fraction_an_int_and_its_own_type(q):
    exact = as_rational(q)

    assert rational(q) == exact
    assert rational(exact) is exact
    assert rational(q.numerator) == q.numerator
    assert rational(gmpy2.mpz(q.numerator)) == q.numerator
    assert type(rational(q)) is type(rational(q.numerator)) is type(QQ())


@given(x=doubles)
@example(x=5e-324)
@example(x=-0.0)
@example(x=1.7976931348623157e308)
def test_rational_of_a_float_is_its_exact_value(x):
    assert exact(rational(x)) == Fraction(x)
    assert rational(np.float64(x)) == rational(x)


@every("kind", [np.int8, np.int16, np.int32, np.int64, np.uint8, np.uint16, np.uint32, np.uint64])
def test_rational_takes_every_numpy_integer(kind):
    for value in (np.iinfo(kind).min, 0, 1, np.iinfo(kind).max):
        exact = rational(kind(value))

        assert exact == int(value)
        assert type(exact) is type(QQ())


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64, np.longdouble])
def test_rational_takes_every_numpy_float(kind):
    """Only float64 is a Python float; others were refused."""
    value = kind(1) / kind(3)

    exact = rational(value)

    assert exact == QQ(*map(int, value.as_integer_ratio()))
    assert type(exact) is type(QQ())
    for bad in (kind("nan"), kind("inf")):
        with pytest.raises(InputError, match="not a finite number"):
            rational(bad)


def test_rational_takes_sympy_rationals():
    assert rational(sympy.Rational(-2, 3)) == QQ(-2, 3)
    assert rational(sympy.Integer(5)) == 5


@given(value=st.decimals(allow_nan=False, allow_infinity=False))
def test_a_decimal_is_its_exact_value(value):
    assert exact(rational(value)) == Fraction(value)


@given(q=wide_fractions)
def test_an_algebraic_number_that_is_rational_is_a_number(q):
    number = AlgebraicNumber(q)

    assert exact(rational(number)) == q
    assert number.as_integer_ratio() == q.as_integer_ratio()


def test_a_rational_root_of_an_irrational_looking_polynomial_is_a_number():
    assert rational(AlgebraicNumber.root([-8, 0, 0, 27], 0, 1)) == QQ(2, 3)


def test_an_irrational_number_is_refused_with_what_to_do():
    with pytest.raises(InputError, match=r"irrational.*\.low, \.high or float\(\)"):
        rational(AlgebraicNumber.root([-2, 0, 1], 1, 2))


@pytest.mark.parametrize(
    "value",
    [
        True,
        False,
        np.True_,
        pytest.param(type("bool", (), {"__index__": lambda _: 1})(), id="numpy's before 2.3"),
        math.nan,
        math.inf,
        -math.inf,
        np.float64("nan"),
        np.float64("-inf"),
        gmpy2.mpfr(1),
        gmpy2.mpfr("nan"),
        gmpy2.mpc(1),
        1j,
        None,
        b"1",
        [1],
        (1, 2),
        {},
        pytest.param(object(), id="object"),
        sympy.pi,
        pytest.param(sympy.nan, id="sympy.nan"),
        sympy.oo,
        Decimal("nan"),
        Decimal("-inf"),
        Decimal("1e100001"),
        AlgebraicNumber.root([-2, 0, 1], 1, 2),
        "one",
    ],
    ids=repr,
)
def test_rational_refuses_what_is_not_an_exact_number(value):
    with pytest.raises(InputError) as refusal:
        rational(value)

    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("value", [np.array([1, 2]), np.array([0.5]), np.zeros((2, 2)), int])
def test_bug_rational_of_an_array_is_a_type_error(value):
    """Arrays have ``__index__`` and classes ``numerator``; to use them raises TypeError."""
    with pytest.raises(InputError):
        rational(value)


@given(q=wide_fractions)
@example(q=LARGEST)
@example(q=-LARGEST)
@example(q=TIE_WITH_INFINITY)
@example(q=TIE_WITH_INFINITY - Fraction(1, 3))
@example(q=-TIE_WITH_INFINITY)
@example(q=Fraction(10) ** 400)
@example(q=SMALLEST / 2)
@example(q=SMALLEST / 2 + Fraction(1, 10**400))
@example(q=-SMALLEST * 3 / 2)
@example(q=Fraction(2) ** -1022 - SMALLEST / 2)
@example(q=1 + Fraction(1, 2**53))
@example(q=1 + Fraction(3, 2**53))
@example(q=1 + Fraction(1, 2**53) + Fraction(1, 2**2000))
@example(q=Fraction(-1, 10**400))
def test_nearest_float_is_the_nearest_double(q):
    assert is_nearest_double(nearest_float(as_rational(q)), q)


@given(q=wide_fractions)
@example(q=LARGEST)
@example(q=LARGEST + 1)
@example(q=-LARGEST - 1)
@example(q=TIE_WITH_INFINITY)
@example(q=Fraction(10) ** 400)
@example(q=-(Fraction(10) ** 400))
@example(q=SMALLEST / 2)
@example(q=-SMALLEST / 3)
@example(q=SMALLEST)
@example(q=Fraction(1, 3))
def test_enclosing_floats_are_neighbours_around_the_number(q):
    lo, hi = enclosing_floats(as_rational(q))

    assert math.isinf(lo) or Fraction(lo) <= q
    assert math.isinf(hi) or q <= Fraction(hi)
    if lo == hi:
        assert Fraction(lo) == q
    else:
        assert hi == math.nextafter(lo, math.inf)
        assert Fraction(lo if math.isfinite(lo) else hi) != q


@given(x=doubles)
def test_a_double_is_enclosed_by_itself(x):
    assert enclosing_floats(rational(x)) == (x, x)


@given(q=wide_fractions)
def test_floor_ceil_and_sign(q):
    exact = as_rational(q)

    assert floor(exact) == math.floor(q)
    assert ceil(exact) == math.ceil(q)
    assert sign(exact) == (q > 0) - (q < 0)
    assert type(floor(exact)) is type(ceil(exact)) is type(ZZ())


@given(exponent=st.integers(-2000, 2000))
def test_power_of_two(exponent):
    assert exact(power_of_two(exponent)) == Fraction(2) ** exponent


@pytest.mark.long
@given(text=st.text(), limit=st.integers(25, 80))
def test_a_shortened_text_is_one_line_within_the_limit(text, limit):
    shown = shorten(text, limit)

    assert len(shown) <= limit
    assert len(shown.splitlines()) == 1


def test_bug_a_number_longer_than_python_writes_is_told_in_a_message():
    with pytest.raises(InputError, match=r"coordinates: 10{20,}\.\.\.0{8}$"):
        rationals(10**5000, 2, "a point has two coordinates")


def test_a_value_whose_repr_fails_is_shown_in_a_message():
    class Odd:
        def __repr__(self):
            raise RuntimeError

    assert shorten(Odd()).startswith(f"<{__name__}.test_a_value"[:40])
    with pytest.raises(InputError, match="not a number: <"):
        rational(Odd())


def poly(*coefficients):
    return tuple(map(ZZ, coefficients))


def nearest(value, digits):
    context = Context(digits, ROUND_HALF_EVEN)
    return context.divide(Decimal(value.numerator), Decimal(value.denominator))


ROOT_OF_TWO = AlgebraicNumber.root([-2, 0, 1], 1, 2)


@given(t=fractions, digits=st.integers(1, 50))
def test_at_a_rational_time_it_is_the_quotient_rounded(t, digits):
    found = decimal_quotient(poly(1, 3, 2), poly(2, 0, 1), AlgebraicNumber(t), digits)

    assert found == nearest((1 + 3 * t + 2 * t * t) / (2 + t * t), digits)


@given(digits=st.integers(1, 300))
def test_the_square_root_of_two(digits):
    expected = Context(digits, ROUND_HALF_EVEN).sqrt(Decimal(2))

    assert decimal_quotient(poly(0, 1), poly(1), ROOT_OF_TWO, digits) == expected


@pytest.mark.parametrize("halfway", [Fraction(5, 2), Fraction(7, 2), Fraction(-25, 2)])
def test_a_value_halfway_between_two_decimals_becomes_the_even_one(halfway):
    """The quotient (p + t^3 - 2 t) / q is p / q, though neither t nor its bounds are rational."""
    p, q = halfway.numerator, halfway.denominator
    digits = len(str(abs(p) // q))

    found = decimal_quotient(poly(p, -2, 0, 1), poly(q), ROOT_OF_TWO, digits)

    assert found == nearest(halfway, digits)
    assert found % 2 == 0


def test_zero_is_found():
    assert decimal_quotient(poly(-2, 0, 1), poly(3, 1), ROOT_OF_TWO, 20) == 0


@pytest.mark.parametrize("digits", [0, -1, pytest.param(10**10000, id="long"), 2.0, "3"])
def test_a_number_of_digits_that_no_decimal_has_is_refused(digits):
    with pytest.raises(InputError, match="digits: at least 1") as refused:
        decimal_quotient(poly(1), poly(1), ROOT_OF_TWO, digits)

    assert len(str(refused.value)) < 150


@every(
    "values",
    [
        [1.5, -0.0, 5e-324],
        [1.7e308, 1.7e308],  # their sum is infinite
        [1.7e308, -1.7e308, 1],
        [2**53, -(2**53), 0.5],
        [np.float64(0.1), 3],
        [],
    ],
)
def test_values_that_are_doubles(values):
    found = as_doubles(list(values))

    assert list(map(type, found)) == [float] * len(values)
    assert list(map(Fraction, found)) == list(map(Fraction, values))


@every(
    "other", [math.inf, math.nan, 2**53 + 1, 10**400, True, "1", np.float32(1), np.float64("inf")]
)
def test_values_that_are_no_doubles(other):
    assert all(as_doubles(values) is None for values in ([other], [0.5, other], [1, other, 0.5]))
    assert as_doubles([math.inf, -math.inf]) is None
