"""Signs just after an event, by filters and exactly: they agree, and filters decide."""

from itertools import permutations
from random import Random

import numpy as np
import pytest

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.one_sided import OneSided
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.vertices import Vertices


def collinear(seed):
    """Four triangles of random doubles, and vertices of them that become collinear."""
    rng = Random(seed)
    while True:
        bodies = []
        for i in range(4):
            x, y = 6 * (i % 2) + rng.uniform(-1, 1), 6 * (i // 2) + rng.uniform(-1, 1)
            motion = Translation([0, rng.uniform(-1, 1)], [0, rng.uniform(-1, 1)])
            bodies.append(Body(f"b{i}", [(x, y), (x + 1, y), (x, y + 1)], motion))
        certifier = certifier_of(bodies, exact_only=False)
        for triple in permutations(range(0, 12, 3), 3):
            if certifier.orientation(*triple)[1] is not None:
                return bodies, triple


def certifier_of(bodies, *, exact_only):
    return Certifier(Vertices.of(bodies, QQ(0), QQ(50)), QQ(0), QQ(50), exact_only=exact_only)


def turns(bodies, triple, *, exact_only, before):
    """The turns of all pairs of segments that share an end, and what was decided exactly."""
    certifier = certifier_of(bodies, exact_only=exact_only)
    time = certifier.orientation(*triple)[1]
    certifier.move_to(time, [time])
    signs = OneSided(certifier, before=before)
    ends = [
        segments
        for p, q, r in permutations(triple)
        for segments in [(p, q, p, r), (p, q, r, q), (p, q, r, p), (p, q, q, r)]
    ]
    asked = certifier.counters.exact
    return [signs.cross_sign(*four) for four in ends], certifier.counters.exact - asked


@pytest.mark.parametrize("before", [False, True])
@pytest.mark.parametrize("seed", range(12))
def test_segments_that_share_an_end_and_become_parallel(seed, before, request):
    found = collinear(seed)
    expected, _ = turns(*found, exact_only=True, before=before)
    signs, exact = turns(*found, exact_only=False, before=before)

    assert signs == expected
    assert set(signs) == {1, -1}
    if not before and not request.config.getoption("--exact-only"):
        assert exact == 0


@pytest.mark.parametrize("seed", range(6))
def test_rotated_triples_have_one_enclosure(seed, request):
    if request.config.getoption("--exact-only"):
        pytest.skip("is about enclosures of the filter")
    bodies, (a, b, c) = collinear(seed)
    certifier = certifier_of(bodies, exact_only=False)
    triples = [(a, b, c), (b, c, a), (c, a, b)]
    answers = [certifier.orientation(*t) for t in triples]
    ((s, t), *_) = answers
    signs, lows, highs = certifier.orientations(np.array([(t.a, t.b, t.c)]))

    assert len({(s, t.low, t.high, t.a, t.b, t.c) for s, t in answers}) == 1
    assert [*signs, *lows, *highs] == [s, t.low, t.high]
