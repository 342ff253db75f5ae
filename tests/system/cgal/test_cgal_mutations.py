"""CGAL on tilings: damaged ones, those of points, and those of bodies with holes and parts."""

import random
from collections import Counter
from fractions import Fraction

import pytest
from cgal_damage import KINDS
from cgal_tilings import as_tile, random_map, random_tiling

from exactpt import Simulation
from exactpt.cgal import BodyShape, CgalCheck
from exactpt.check import check_scene
from exactpt.pair.start import initial_touches
from exactpt.simulation.tile import tile_at
from exactpt.testing.scenes import POINTS, RINGS, generate
from exactpt.tiling.start import TILINGS

pytestmark = pytest.mark.cgal

MUTANTS = 60


@pytest.fixture(scope="module")
def tiles():
    """Tiles of all sizes, from one body to a dozen; half of them on the grid itself."""
    rng = random.Random(5)
    result = []
    for i in range(MUTANTS):
        columns, rows = [(1, 1), (2, 1), (3, 1), (2, 2), (3, 2), (4, 2), (3, 3), (4, 3)][i % 8]
        deletions = 1.0 if i < MUTANTS // 2 else rng.random()
        tiling = random_tiling(rng, columns, rows, deletions=deletions)
        result.append(as_tile(rng, tiling, random_map(rng) if i % 2 else None))
    return result


@pytest.fixture(scope="module")
def table():
    rows = []
    yield rows
    print(f"\n{'damage':40} {'mutants':>8} {'rejected':>9}  most frequent reason")  # noqa: T201
    for name, mutants, rejected, reason in rows:
        print(f"{name:40} {mutants:8} {rejected:9}  {reason}")  # noqa: T201


def family(reason):
    """A reason without its indices."""
    words = ["#" if any(c.isdigit() for c in word) else word for word in reason.split()]
    return " ".join(words)[:60]


@pytest.mark.parametrize("deep", [False, True])
def test_undamaged_tiles_are_accepted(witness, tiles, table, deep):
    verdicts = list(witness.check_tilings(tiles, deep=deep))

    rejected = [v.reason for v in verdicts if not v.ok]
    name = "none, asked of both witnesses" if deep else "none"
    table.append((name, len(tiles), len(rejected), ""))
    assert rejected == []


EXTREMES = {
    "scaled by 2^500": (2**500, 0),
    "scaled by 2^-500": (Fraction(1, 2**500), 0),
    "below the smallest double": (Fraction(1, 2**1200), 0),
    "beyond the largest double": (3**1000, -(7**600)),
    "shifted by 2^60": (1, 2**60),
    "scaled by 2^-500, shifted by 2^500": (Fraction(1, 2**500), 2**500),
    "rationals of 9,000 bits": (Fraction(3**3000, 5**2000), Fraction(1, 7**1700)),
}


@pytest.mark.parametrize("name", EXTREMES)
def test_extreme_coordinates(witness, name):
    """The same verdicts wherever and however large: undamaged, and with an edge too many."""
    rng = random.Random(8)
    factor, shift = EXTREMES[name]
    tilings = [random_tiling(rng, 3, 2) for _ in range(5)]
    tiles = [
        as_tile(rng, tiling, lambda p: (factor * p[0] + shift, factor * p[1] - shift))
        for tiling in tilings
    ]
    crossing = [KINDS["edge added"](rng, *pair) for pair in tiles]
    moved = [KINDS["vertex moved 1e-40 beyond an edge"](rng, *pair) for pair in tiles]

    assert [v.reason for v in witness.check_tilings(tiles, deep=True) if not v.ok] == []
    damaged = list(witness.check_tilings([*crossing, *filter(None, moved)], deep=True))
    assert [v.reason for v in damaged if v.ok or "no objection" in v.reason] == []


def test_tiles_are_degenerate_and_of_every_sort(tiles):
    """The generator gives what the damages need: see how much of each."""
    faces = [f for tile, _ in tiles for f in tile["faces"]]
    shapes = [s for _, shapes in tiles for s in shapes]

    assert sum(len(f["vertices"]) > 3 for f in faces) > 100
    assert {(s.closed, min(s.size, 4)) for s in shapes} >= {
        (True, 1),
        (True, 2),
        (True, 3),
        (True, 4),
        (False, 3),
        (False, 4),
    }
    assert {s.clockwise for s in shapes} == {True, False, None}


@pytest.mark.parametrize("kind", KINDS)
def test_damaged_tiles_are_rejected(witness, tiles, table, kind):
    """By both witnesses, where the damage does not show before there are coordinates."""
    rng = random.Random(kind)
    mutants = []
    while len(mutants) < MUTANTS:
        damaged = KINDS[kind](rng, *rng.choice(tiles))
        if damaged is not None:
            mutants.append(damaged)

    plain = list(witness.check_tilings(mutants))
    deep = list(witness.check_tilings(mutants, deep=True))

    reasons = Counter(family(v.reason) for v in plain if not v.ok)
    table.append((kind, len(mutants), sum(reasons.values()), reasons.most_common(1)[0][0]))
    accepted = [mutant for mutant, v in zip(mutants, plain, strict=True) if v.ok]
    assert accepted == []
    assert [v.reason for v in deep if v.ok or "no objection" in v.reason] == []


# CGAL on the incremental pseudo-triangulation and the fan triangulation of moving points


@pytest.mark.parametrize("family", sorted(POINTS))
def test_cgal_agrees_all_along(family):
    """Every tiling between two events, and every event time."""
    tilings = 0
    for seed in range(12):
        report = check_scene(generate(family, seed), tiling="incremental")
        assert report.ok, report.lines()
        tilings += report.tilings
    assert tilings > 24


@pytest.mark.parametrize("family", sorted(POINTS))
def test_fan_triangulation(witness, family):
    """At the end of the run, and built there: equal, and triangles all."""
    for seed in range(12):
        scene = generate(family, seed)
        simulation = Simulation(scene, tiling="incremental")
        if initial_touches(scene)[1] or simulation.run_to_contact() is not None:
            continue
        tile = simulation.snapshot().to_json()
        assert tile == tile_at(scene, scene.end, tiling="incremental").to_json()
        verdict = witness.check_triangulation(tile, BodyShape.of_scene(scene))
        assert verdict.ok, verdict.reason


# CGAL on tilings of bodies with holes and parts


@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", sorted(RINGS))
def test_runs_are_verified(family, tiling):
    """Proof, tilings, event times, and the search over pairs."""
    tilings = 0
    for seed in range(4):
        report = check_scene(generate(family, seed), tiling=tiling)
        assert report.ok, (seed, report.lines())
        tilings += report.tilings
    assert tilings > 4


@pytest.mark.parametrize("family", sorted(RINGS))
def test_both_witnesses_agree(family):
    with CgalCheck() as witness:
        for seed in range(6):
            scene = generate(family, seed)
            if initial_touches(scene)[1]:
                continue
            tile = Simulation(scene).tiling.to_json()
            shapes = BodyShape.of_scene(scene)
            verdict = witness.check_tiling(tile, shapes, deep=True)
            assert verdict.ok, (seed, verdict.reason)
            assert verdict.stats["polygons"] == sum(
                len(body.parts) for body in scene.bodies if body.has_interior
            )
            swapped = [  # the outline of each part for the last of its holes
                shape._replace(parts=[part[::-1] for part in shape.parts]) for shape in shapes
            ]
            if any(shape.parts for shape in swapped):
                reported = witness.check_tiling(tile, swapped).reason
                assert "is clockwise" in reported or "is not one region" in reported
