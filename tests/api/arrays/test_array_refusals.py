"""Bad arrays are refused by one line that says which value."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from folding import every

from exactpt import InputError, Scene
from exactpt.arrays import first_contacts, point_segment_contacts

CORNERS = [(0, 0), (2, 0), (0, 2), (5, 1)]


def pairs_of(vertices=CORNERS, offsets=(0, 3, 4), pairs=((0, 1),), **options):
    return first_contacts(vertices, offsets, pairs, **options)


@every(
    "given, line",
    [
        ({"vertices": [(0, 0), (1, np.nan)]}, "vertices[1, 1]: not a finite number: nan"),
        ({"vertices": [0, 1]}, "vertices: shape (N, 2) is needed, not (2,)"),
        ({"vertices": "ab"}, "vertices: not an array of numbers: 'ab'"),
        ({"vertices": [(0, 0), (1,)]}, "vertices: not an array: [(0, 0), (1,)]"),
        ({"vertices": [(0, 2**60 + 1)]}, "vertices[0, 1]: not a double: 1152921504606846977"),
        ({"offsets": [1, 4]}, "offsets: they go from 0 to 4, the number of vertices, not from 1"),
        ({"offsets": [0, 3, 3, 4]}, "offsets: body 1: at least one vertex is needed"),
        ({"offsets": [0.0, 4.0]}, "offsets: not an array of integers: [0.0, 4.0]"),
        ({"offsets": []}, "offsets: shape (n + 1,) is needed, not (0,)"),
        ({"pairs": [(0, 2)]}, "pairs[0, 1]: there is no body 2 among 2"),
        ({"pairs": [(1, 1)]}, "pairs[0]: expected two different bodies, got 1 twice"),
        ({"pairs": [0, 1]}, "pairs: shape (m, 2) is needed, not (2,)"),
        ({"velocities": [(0, 1)]}, "velocities: 2 are needed, one for each body, not 1"),
        ({"velocities": [(0, 1), (0, -np.inf)]}, "velocities[1, 1]: not a finite number: -inf"),
        ({"coefficients": np.zeros((2, 3))}, "coefficients: shape (2, 2, d + 1) is needed"),
        ({"velocities": 0, "coefficients": 0}, "give either velocities or coefficients"),
        ({"closed": [1, 0]}, "closed: a boolean or 2 of them are needed: [1, 0]"),
        ({"time": (1, 1)}, "time: the span from 1.0 to 1.0 is empty"),
        ({"time": [(2, 1)]}, "time[0]: the span from 2.0 to 1.0 is empty"),
        ({"time": (0, 1, 2)}, "time: shape (2,) or (1, 2) is needed, not (3,)"),
        ({"vertices": [(0, 0), (1, 1), (2, 2), (5, 1)]}, "body '0': not a simple polygon"),
        ({"vertices": [(0, 0), (0, 0), (2, 2), (5, 1)]}, "body '0': not valid at the start"),
    ],
)
def test_pairs(given, line):
    with pytest.raises(InputError) as refused:
        pairs_of(**given)

    assert str(refused.value).startswith(line)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "given, line",
    [
        ({"lasts": [(1, 1)]}, "lasts: shape (2, 2) is needed, not (1, 2)"),
        ({"points": 3.0}, "points: shape (0, 2) is needed, not ()"),
        ({"firsts": None}, "firsts: shape (2, 2) is needed, not None"),
        ({"velocities": (None, None)}, "velocities: three arrays are needed, not 2"),
        ({"velocities": (None, [(1, 0)], None)}, "velocities[1]: shape (2, 2) is needed, not (1,"),
        ({"lasts": [(1, 1), (0, 1e400)]}, "lasts[1, 1]: not a finite number: inf"),
        ({"lasts": [(1, 1), (0, 5)]}, "query 1: the segment is a point at the start, t = 0"),
    ],
)
def test_queries(given, line):
    asked = {"points": [(0, 0), (1, 2)], "firsts": [(3, 3), (0, 5)], "lasts": [(4, 4), (4, 5)]}
    with pytest.raises(InputError) as refused:
        point_segment_contacts(**(asked | given))

    assert str(refused.value).startswith(line)


@pytest.mark.parametrize(
    "given, line",
    [
        ({"names": ["a"]}, "names: 2 are needed, one for each body: ['a']"),
        ({"names": ["a", "a"]}, "body 'a': the name is taken by another body"),
        ({"names": ["a", ""]}, "a body's name is a text that is not empty: ''"),
        ({"time": (3, 3)}, "time: the span from 3 to 3 is empty"),
        ({"closed": [True]}, "closed: a boolean or 2 of them are needed: [True]"),
    ],
)
def test_scenes(given, line):
    with pytest.raises(InputError) as refused:
        Scene.from_arrays(CORNERS, [0, 3, 4], **given)

    assert str(refused.value) == line


def test_integers_and_single_precision_are_taken_exactly():
    single = np.array(CORNERS, dtype=np.float32)
    unsigned = np.array(CORNERS, dtype=np.uint64)

    assert pairs_of(vertices=single).scene(0) == pairs_of(vertices=unsigned).scene(0)
    assert pairs_of(vertices=[*CORNERS[:3], (2**60, 1)]).scene(0).bodies[1].at(0) == [(2**60, 1)]


BOW = [(0, 0), (2, 2), (2, 0), (0, 2)]


@pytest.mark.parametrize("radii", [0.0, 0.25])
def test_pairs_with_bodies_that_are_not_simple_are_masked(radii):
    vertices = np.array([(0, 0), (1, 0), (0, 1), *BOW, (4, 0), (5, 0), (5, 1)], dtype=float)
    options = {"velocities": [(1, 0), (0, 0), (0, 0)], "radii": radii, "time": (0, 10)}
    pairs = [(0, 1), (0, 2), (2, 1), (2, 0)]

    masked = pairs_of(vertices, (0, 3, 7, 10), pairs, errors="mask", **options)
    good = pairs_of(vertices, (0, 3, 7, 10), [(0, 2), (2, 0)], **options)

    assert masked.refused.tolist() == [True, False, True, False]
    assert [i for i, _ in masked.reasons()] == [0, 2]
    assert all(line.startswith("body '1': not a simple polygon") for _, line in masked.reasons())
    assert np.isnan(masked.low[[0, 2]]).all()
    assert np.isnan(masked.high[[0, 2]]).all()
    assert masked.found.tolist() == [False, True, False, True]
    for name in ("body", "vertex", "edge", "other_vertex"):
        assert getattr(masked, name)[[0, 2]].tolist() == [-1, -1]
    for name in ("low", "high", "kind", "body", "vertex", "edge", "other_vertex", "exact"):
        assert getattr(masked, name)[[1, 3]].tolist() == getattr(good, name).tolist()
    assert not good.refused.any()
    assert good.reasons() == []
    with pytest.raises(InputError, match="body '1': not a simple polygon"):
        masked.contact(0)


def test_queries_with_a_segment_that_is_a_point_are_masked():
    masked = point_segment_contacts(
        [(0, 1), (0, 1), (0, 1)], [(2, 0), (2, 0), (3, 0)], [(2, 0), (2, 4), (3, 0)],
        velocities=([(1, 0)] * 3, None, [(0, 0), (0, 0), (0, 1)]), time=(0, 10), errors="mask",
    )  # fmt: skip

    assert masked.refused.tolist() == [True, False, True]
    assert masked.found.tolist() == [False, True, False]
    assert np.isnan(masked.low[[0, 2]]).all()
    assert masked.low[1] <= 2.0 <= masked.high[1]
    assert masked.reasons() == [
        (i, f"query {i}: the segment is a point at the start, t = 0") for i in (0, 2)
    ]


def test_errors_are_raised_or_masked():
    line = 'errors: "raise" or "mask" is needed, not '
    with pytest.raises(InputError, match=line):
        pairs_of(errors="ignore")
    with pytest.raises(InputError, match=line):
        point_segment_contacts([(0, 0)], [(1, 1)], [(2, 2)], errors="ignore")


TRIANGLES = [(0, 0), (2, 0), (0, 2), (5, 1), (7, 0), (7, 3), (9, 0), (11, 0), (9, 2)]
OUTLINES = (0, 3, 6, 9)


@every(
    "name, at, why",
    [
        ("vertices", (4, 1), "vertices[4, 1]: not a finite number: nan"),
        ("velocities", (1, 0), "velocities[1, 0]: not a finite number: nan"),
        ("radii", (1,), "radii[1]: not a finite number: nan"),
    ],
)
def test_pairs_with_numbers_that_are_not_finite_are_masked(name, at, why):
    """Bug: one NaN refused all pairs."""
    given = {
        "vertices": np.array(TRIANGLES, float),
        "velocities": np.array([(1.0, 0), (-2, 0), (-1, 0)]),
        "radii": np.zeros(3),
    }
    whole = first_contacts(offsets=OUTLINES, pairs=[(0, 1), (0, 2)], time=(0, 9), **given)
    given[name][at] = np.nan

    with pytest.raises(InputError, match=re.escape(why)):
        first_contacts(offsets=OUTLINES, pairs=[(0, 1)], **given)
    masked = first_contacts(
        offsets=OUTLINES, pairs=[(0, 1), (0, 2)], time=(0, 9), errors="mask", **given
    )

    assert masked.reasons() == [(0, why)]
    assert masked.refused.tolist() == [True, False]
    assert masked.found.tolist() == [False, True]
    assert masked.low[1] == whole.low[1]


def test_queries_with_numbers_that_are_not_finite_are_masked():
    points, firsts, lasts = np.array([(0.0, 1)] * 3), np.array([(2.0, 0)] * 3), [(2.0, 4)] * 3
    velocities = np.array([(1.0, 0)] * 3), None, None
    firsts[1, 1], velocities[0][2, 0] = np.inf, np.nan

    masked = point_segment_contacts(
        points, firsts, lasts, velocities=velocities, time=(0, 9), errors="mask"
    )

    assert masked.reasons() == [
        (1, "firsts[1, 1]: not a finite number: inf"),
        (2, "velocities[0][2, 0]: not a finite number: nan"),
    ]
    assert masked.found.tolist() == [True, False, False]
    assert masked.low[0] <= 2.0 <= masked.high[0]
    assert np.isnan(masked.low[1:]).all()


MEMORY = """
import numpy as np
from exactpt.arrays import first_contacts
n = {count}
rng = np.random.default_rng(1)
angles = np.sort(rng.uniform(0, 2 * np.pi, (2 * n, 3)), axis=1)
shapes = np.stack([np.cos(angles), np.sin(angles)], axis=-1) + rng.uniform(-5, 5, (2 * n, 1, 2))
shapes, offsets = shapes.reshape(-1, 2), np.arange(0, 6 * n + 1, 3)
pairs, velocities = np.arange(2 * n).reshape(-1, 2), rng.uniform(-2, 2, (2 * n, 2))
first_contacts(shapes[:6], offsets[:3], pairs[:1], velocities=velocities[:2])
def status(key):
    lines = open("/proc/self/status").read().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(key)) // 1024
before = status("VmRSS")
open("/proc/self/clear_refs", "w").write("5")
first_contacts(shapes, offsets, pairs, velocities=velocities, time=(0.0, 4.0))
print(status("VmHWM") - before)
"""


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="needs Linux")
def test_a_million_pairs_of_triangles_need_less_than_500_megabytes():
    code = MEMORY.format(count=1_000_000)
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert int(run.stdout) < 500
