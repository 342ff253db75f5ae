"""Arrays of rounded bodies: each answer is that of `first_contact`."""

import numpy as np
import pytest
from array_help import agrees

from exactpt import InputError, arrays, first_contact
from exactpt.arrays import radii as of_radii
from exactpt.arrays.contacts import KINDS

RNG = np.random.default_rng(4)


@pytest.mark.long
def test_answers_are_those_of_first_contact():
    n = 60
    corners = RNG.integers(-6, 7, (2 * n, 2)).astype(float)
    offsets = np.arange(0, 2 * n + 1, 2)
    speeds = RNG.integers(-2, 3, (n, 2)).astype(float)
    radii = RNG.choice([0.0, 0.5, 1.0], n)
    corners[1::2] += (corners[::2] == corners[1::2]).all(axis=1)[:, None]
    pairs = RNG.integers(0, n, (80, 2))
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]

    found = arrays.first_contacts(
        corners, offsets, pairs, velocities=speeds, radii=radii, time=(0, 4)
    )

    seen = set()
    for k in range(len(pairs)):
        contact = first_contact(found.scene(k))
        assert found.scene(k).bodies[0].radius == radii[pairs[k, 0]]
        kind = "none" if contact is None else contact.kind
        seen.add(kind)
        assert KINDS[found.kind[k]] == kind
        if contact is not None:
            assert found.low[k] <= contact.time <= found.high[k]
            assert found.contact(k).to_json() == contact.to_json()
    assert {"none", "initial", "vertex-edge", "vertex-vertex"} <= seen


def test_a_negative_radius():
    with pytest.raises(InputError, match=r"radii\[1\]: it is negative"):
        arrays.first_contacts([(0, 0), (5, 0)], [0, 1, 2], [(0, 1)], radii=[1.0, -1.0])
    with pytest.raises(InputError, match=r"^radii: it is negative: -1.0$"):
        arrays.first_contacts([(0, 0), (5, 0)], [0, 1, 2], [(0, 1)], radii=-1)


SHAPES = [
    [(0, 0)], [(0, 0), (2, 1)], [(0, 0), (2, 0), (0, 2)], [(0, 0), (2, 0), (2, 2), (0, 2)],
    [(0, 0), (1, 0), (1, 3)],
]  # fmt: skip


def table(seed, degree, count, *, is_grid, at=0.0, scale=1.0):
    """Pairs of small bodies near each other, generic or on an integer grid with many ties."""
    rng = np.random.default_rng(seed)
    shapes = [np.array(SHAPES[k], float) for k in rng.integers(0, len(SHAPES), 2 * count)]
    if is_grid:
        shapes = [s + rng.integers(-5, 6, 2) for s in shapes]
        motions = rng.integers(-2, 3, (2 * count, 2, degree + 1)) / 2.0
        radii = rng.choice([0.0, 0.5, 1.0, 1.5], 2 * count)
    else:
        shapes = [s + rng.uniform(-0.2, 0.2, s.shape) + rng.uniform(-5, 5, 2) for s in shapes]
        motions = rng.uniform(-1, 1, (2 * count, 2, degree + 1))
        radii = rng.uniform(0, 1, 2 * count) * (rng.random(2 * count) < 0.8)
    return arrays.first_contacts(
        (np.concatenate(shapes) + at) * scale,
        np.cumsum([0, *map(len, shapes)]),
        np.arange(2 * count).reshape(-1, 2),
        coefficients=motions * scale,
        radii=radii * scale,
        closed=rng.random(2 * count) < 0.7,
        time=(-1.5, 4.5),
    )


def faults(found):
    return [k for k in range(len(found)) if not agrees(found, k, first_contact(found.scene(k)))]


@pytest.mark.parametrize("is_grid", [False, True])
@pytest.mark.parametrize("degree", [1, 2])
def test_filters_and_exact_decisions(degree, is_grid):
    found = table(degree, degree, 30, is_grid=is_grid)

    assert faults(found) == []
    assert set(found.kind.tolist()) == {0, 1, 3, 4}
    assert found.exact.mean() < (0.4 if is_grid else 0.05)


@pytest.mark.slow
@pytest.mark.parametrize("is_grid", [False, True])
@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize(("at", "scale"), [(0.0, 1.0), (2.0**40, 1.0), (0.0, 2.0**-60)])
def test_thousands_of_pairs(degree, is_grid, at, scale):
    for seed in range(4 if degree < 3 else 1):
        assert faults(table(seed, degree, 300, is_grid=is_grid, at=at, scale=scale)) == []


def test_bounds_of_a_filter_hold_out_of_the_range_of_doubles():
    for scale in (2.0**-500, 2.0**480):
        assert faults(table(7, 2, 4, is_grid=True, scale=scale)) == []


def test_bodies_that_just_touch_at_the_start_or_pass_in_contact():
    discs = [(0, 0), (3, 4), (0, 0), (3.0000000000000004, 4), (0, 0), (-9, 5), (0, 0), (-9, 5)]
    found = arrays.first_contacts(
        discs, np.arange(9), np.arange(8).reshape(-1, 2), time=(0, 20),
        velocities=[(0, 0), (1, 0), (0, 0), (1, 0), (0, 0), (1, 0), (0, 0), (1, 2.0**-60)],
        radii=[2, 3, 2, 3, 2, 3, 2, 3],
    )  # fmt: skip

    assert [KINDS[k] for k in found.kind] == ["initial", "none", "vertex-vertex", "none"]
    assert faults(found) == []
    assert found.exact.tolist()[2:] == [True, True]


def test_discs_on_parabolas_come_close_twice():
    """At (t - 2)^2 - 2^-k above a disc: the first approach is the first of two zeros, or none."""
    heights = [2.0, 2.0**-10, 0.0, -(2.0**-10), -1.0]
    points = [p for h in heights for p in ((0, 0), (0, 4 + 2 + h))]
    motions = np.zeros((10, 2, 3))
    motions[1::2, 1] = [0, -4, 1]

    found = arrays.first_contacts(
        points, np.arange(11), np.arange(10).reshape(-1, 2), coefficients=motions, radii=1.0,
        time=(0, 5),
    )  # fmt: skip

    assert found.found.tolist() == [False, False, True, True, True]
    assert faults(found) == []
    assert found.exact.tolist() == [False, False, True, False, False]


def test_intervals_are_halved_while_needed_alone(monkeypatch):
    """Of zeros that are well apart, no interval is as short as the last that is possible."""
    monkeypatch.setattr(of_radii, "DEPTH", 6)
    found = table(3, 2, 200, is_grid=False)
    assert found.exact.mean() < 0.05


def test_a_segment_whose_squared_length_overflows():
    """A long capsule: the foot of a near point is inside its core, where doubles see the end."""
    found = arrays.first_contacts(
        [(-8e153, 0), (1.2e154, 0), (0, 1e140), (0, 2e140)], [0, 2, 4], [(0, 1)], radii=[1e150, 0]
    )
    assert faults(found) == []


def test_a_span_that_is_longer_than_the_largest_double():
    motions = np.zeros((2, 2, 3))
    motions[0, 0], motions[1, 1] = [0, 1e-9, 0], [0, 0, 1e-300]
    found = arrays.first_contacts(
        [(0, 0), (5, 0)], [0, 1, 2], [(0, 1)], coefficients=motions, radii=1.0,
        time=(-1.7e308, 1.7e308),
    )  # fmt: skip
    assert found.found.tolist() == [True]
    assert faults(found) == []


@pytest.mark.parametrize(("at", "end"), [(4.0, 1e70), (2.0, 1.0)])
def test_intervals_without_a_decision_are_not_halved(monkeypatch, at, end):
    """Those in which errors are all, and those after a contact at the start."""
    lengths, tile = [], np.tile
    monkeypatch.setattr(np, "tile", lambda a, n: lengths.append(n * len(a)) or tile(a, n))
    motions = np.zeros((2, 2, 3))
    motions[1, 0] = [0, -1, 0.25 / end]
    found = arrays.first_contacts(
        [(0, 0), (at, 0)], [0, 1, 2], [(0, 1)], coefficients=motions, radii=1.0, time=(0, end)
    )
    assert faults(found) == []
    assert max(lengths, default=0) <= 2
