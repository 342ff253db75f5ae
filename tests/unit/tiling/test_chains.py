"""Chains of the tiling of points that are searched, not walked along: counts of steps.

No public count has the steps along chains; that both kinds of chains are right is a law
(`tiling/static`, the source `many/arc_of_points`).
"""

import math

from exactpt import Body, Scene
from exactpt.certificates.certifier import Certifier
from exactpt.tiling.driver import Driver
from exactpt.tiling.events import Stats
from exactpt.tiling.incremental.incremental import IncrementalTiling
from exactpt.tiling.incremental.paths import SearchableTree
from exactpt.tiling.incremental.structure import UPPER
from exactpt.tiling.start import plan_tiling


def started(scene, chains):
    """The tiling at the start of a scene of points."""
    plan = plan_tiling(scene, "incremental", scene.start)
    certifier = Certifier(plan.vertices, scene.start, scene.end, exact_only=False)
    kinetic = IncrementalTiling(plan.entry, plan.vertices, certifier, Stats(), chains=chains)
    kinetic.begin(scene.start)
    return kinetic


def test_long_chains_are_searched():
    """Two points change places beside an arc: walked along it is n steps, searched log n."""
    n, swaps = 400, 100
    arc = [Body(f"a{y}", [(-y * y, 2 * y)]) for y in range(-n + 1, n, 2)]
    pair = [
        Body(name, keyframes=[(t, [(n * n + s * (-1) ** t, y)]) for t in range(swaps + 1)])
        for name, s, y in (("p", 1, 3 * n), ("q", -1, -3 * n))
    ]
    scene = Scene([*arc, *pair], (0, swaps))
    steps, ends = {}, set()
    for chains in ("linked", "searchable", "auto"):
        kinetic = started(scene, chains)
        Driver(scene, kinetic).run(scene.end)
        trees = kinetic.structure.trees
        ends.add(str([tree.parent for tree in trees]))
        assert kinetic.stats.events["x-order"] == swaps
        assert isinstance(trees[UPPER], SearchableTree) == (chains != "linked")
        steps[chains] = sum(tree.steps for tree in trees)
    assert len(ends) == 1
    assert steps["linked"] > n // 8 * swaps
    assert steps["searchable"] < n + 4 * math.log2(n) * swaps
    assert steps["searchable"] < steps["auto"] < steps["linked"]
