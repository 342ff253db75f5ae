"""The ``repr`` of each public value is one line of at most 200 characters, however large it is."""

import dataclasses
import warnings
from fractions import Fraction

import numpy as np
import pytest
from folding import every
from public_calls import CALLS, LONG, REFUSED, World, long_world

import exactpt
from exactpt.brief import LONGEST, in_brief

pytestmark = pytest.mark.long

COMMON = (str, bytes, int, float, bool, type(None), Fraction, np.ndarray, np.generic, dict)
"""Types of Python and numpy, which have a ``repr`` of their own."""

DEPTH = 3


def values_in(value, depth=DEPTH):
    """Yield the values of exactpt in a result: itself, its items and its public attributes."""
    if isinstance(value, (list, tuple)) and type(value) in (list, tuple):
        for item in value[:3]:
            yield from values_in(item, depth)
        return
    if isinstance(value, COMMON) or not type(value).__module__.startswith("exactpt"):
        return
    yield value
    if depth == 0:
        return
    for name in dir(type(value)):
        # In compiled classes some private names have no value; properties are descriptors there.
        if not name.startswith(("_", "exact_")) and hasattr(getattr(type(value), name), "__set__"):
            yield from attributes(value, name, depth)
    names = getattr(value, "_fields", ())
    if dataclasses.is_dataclass(value):
        names = [field.name for field in dataclasses.fields(value)]
    for name in names:
        yield from attributes(value, name, depth)


def attributes(value, name, depth):
    """Yield the values in an attribute, if it has a value now."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of former names
            found = getattr(value, name)
    except exactpt.InputError:  # such as the tiling of a run that has ended
        return
    yield from values_in(found, depth - 1)


@every("name", CALLS)
def test_a_large_value_has_a_short_repr_in_one_line(name, tmp_path):
    for value in values_in(CALLS[name](long_world(tmp_path))):
        text = repr(value)
        assert len(text) <= LONGEST, (type(value), len(text), text[:300])
        assert text.isprintable(), (type(value), text)


@every("name", REFUSED)
def test_a_refusal_of_large_values_has_a_short_message(name, tmp_path):
    with pytest.raises(Exception) as refusal:  # noqa: PT011 - each kind
        REFUSED[name](long_world(tmp_path))

    message = str(refusal.value)
    assert len(message) <= 2 * LONGEST + 100, message[:500]
    assert message.isprintable()


def test_a_small_value_has_its_usual_repr(tmp_path):
    world = World(tmp_path)

    assert repr(exactpt.Polynomial([1, "1/2"])) == "Polynomial(['1', '1/2'])"
    assert repr(world.motion) == "Translation(x=Polynomial(['0', '1']), y=Polynomial([]))"
    assert repr(world.moving) == "<Body 'mover': polygon of 4 vertices>"
    assert repr(world.scene) == "<Scene: 2 bodies, 8 vertices, t in [0, 10]>"
    assert repr(world.simulation()) == "<Simulation of 2 bodies, tiling greedy, t = 1.0>"
    assert repr(exactpt.first_contact(world.scene).pairs[0]).startswith(
        "ContactPoint(kind='vertex-edge', body="
    )
    assert repr(exactpt.Simulation(world.scene).tiling) == (
        "<Snapshot of the tiling greedy at t = 0: 8 nodes, 2 faces>"
    )


def test_long_numbers_are_cut_where_python_writes_none():
    assert in_brief(10**9000 + 7, 40) == "1000000000000000000...00000007"
    assert in_brief(-(10**700), 30) == "-10000...00000000"
    assert len(in_brief([LONG] * 50)) <= LONGEST
    assert in_brief(b"x" * 10**6) == "<1000000 bytes>"
