"""Values that were read: each has its type and its range, or its place is named."""

import math

import pytest

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ
from exactpt.kernel.stored import Stored


def refusal(call):
    with pytest.raises(InputError) as error:
        call()
    return str(error.value)


def test_place_names_keys_and_positions():
    data = Stored({"a": [{"b\n": 1}, {"c": [0, 5]}]}, "run.json: line 3")

    assert refusal(lambda: data["a"].entries()[1]["c"].integers(0, 4)) == (
        'run.json: line 3: "a"[1]: "c"[1]: expected an integer from 0 to 4, got 5'
    )
    assert refusal(data["a"].entries()[0]["b\n"].text) == (
        'run.json: line 3: "a"[0]: "b\\n": expected a text, got 1'
    )


@pytest.mark.parametrize("value", [True, 1.0, "1", None, [1], -1, 8, 10**400])
def test_value_that_is_no_integer_in_range_is_refused(value):
    assert "expected an integer from 0 to 7" in refusal(lambda: Stored(value, "x").integer(0, 7))
    assert "expected an integer" in refusal(lambda: Stored([3, value], "x").integers(0, 7))


@pytest.mark.parametrize("value", [math.nan, math.inf, -0.5, "1", True, 10**400, 2**53 + 1])
def test_value_that_is_no_double_in_range_is_refused(value):
    stored = Stored(value, "x")
    assert "expected a double from 0.0 to 9e+99" in refusal(
        lambda: stored.double(least=0.0, most=9e99)
    )


@pytest.mark.parametrize("text", ["1e5", "1.5", "1/0", "1/-2", "", "0x1", "\uff11", " 1", "1_0", 1])
def test_text_that_is_no_rational_is_refused(text):
    """A decimal exponent too: of 7 characters, 1e99999 has 332,000 bits."""
    assert 'expected a rational as text, "p" or "p/q"' in refusal(Stored(text, "x").rational)


def test_right_values_are_returned():
    assert Stored("-12/8", "x").rational() == QQ(-3, 2)
    assert Stored("-7", "x").big_integer() == -7
    assert Stored([0, 7], "x").integers(0, 7, length=2) == [0, 7]
    assert Stored(3, "x").double() == 3.0
    assert Stored(-math.inf, "x").double() == -math.inf
    assert Stored("b", "x").text(["a", "b"]) == "b"
    assert Stored(data=False, within="x").flag() is False
    assert {key: v.integer(0) for key, v in Stored({"n": 2}, "x").members()} == {"n": 2}


@pytest.mark.parametrize(
    "data, message",
    [
        ([], "x: expected an object, got []"),
        ({"a": 1}, 'x: the key "b" is missing'),
        ({"a": 1, "b": 2, "d": 3}, "x: unknown key 'd'"),
    ],
)
def test_object_with_other_keys_is_refused(data, message):
    assert refusal(lambda: Stored(data, "x").with_keys("a", "b", optional=("c",))) == message
