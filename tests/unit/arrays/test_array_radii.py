"""Arrays of rounded bodies: each answer is that of `first_contact`."""

import numpy as np
import pytest

from exactpt import InputError, arrays, first_contact
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
