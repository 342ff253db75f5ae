"""Queries against brute force over all edges, on generic and degenerate scenes."""

from collections import Counter
from itertools import pairwise
from random import Random

import pytest

from exactpt import Body, FreeSpace, InputError, Scene, Simulation, Translation
from exactpt.geometry.predicates import orient2d
from exactpt.kernel.numbers import QQ
from exactpt.motion.course import Piece
from exactpt.pairs.start import initial_touches
from exactpt.testing.reference import homotopy
from exactpt.testing.reference import space as definition
from exactpt.testing.reference.shapes import is_on_segment
from exactpt.testing.scenes import FAMILIES, RINGS, generate
from exactpt.tiling.events import ContactFound
from exactpt.tiling.start import start_tiling


def spaces(family, seeds, tiling="auto"):
    """Of each scene the space at the start, at rational event times, and in between."""
    for seed in seeds:
        scene, rng = generate(family, seed), Random(f"{family}:{seed}")
        if initial_touches(scene)[1]:
            continue
        kinetic = start_tiling(scene, tiling, scene.start)
        yield scene, FreeSpace(kinetic, scene.start), rng
        try:
            for _ in range(rng.randint(1, 30)):
                if kinetic.advance(scene.end) is None:
                    break
                now = kinetic.now.simplified()
                if now.is_rational and rng.random() < 0.3:
                    yield scene, FreeSpace(kinetic, now.low), rng
            t = scene.start + (scene.end - scene.start) * QQ(rng.randint(1, 15), 16)
            if kinetic.now.compare_rational(t) <= 0:
                while kinetic.advance(t) is not None:
                    pass
                yield scene, FreeSpace(kinetic, t), rng
        except ContactFound:
            continue


def some_point(rng, bodies):
    """On a vertex, on a line through two, level with two, on the lattice, or anywhere."""
    points = [p for ps in bodies.values() for p in ps]
    a, b = rng.choice(points), rng.choice(points)
    kind = rng.randrange(6)
    if kind == 0:
        return a
    if kind == 1:
        t = QQ(rng.randint(-2, 6), 4)
        return (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]))
    if kind == 2:
        return (a[0], b[1])
    if kind == 3:
        return (QQ(round(a[0])) + rng.randint(-3, 3), QQ(round(a[1])) + rng.randint(-3, 3))
    low = [min(p[k] for p in points) for k in (0, 1)]
    high = [max(p[k] for p in points) for k in (0, 1)]
    return tuple(
        lo + (hi - lo + 1) * QQ(rng.randint(-10, 110), 100)
        for lo, hi in zip(low, high, strict=True)
    )


def check_places_and_rays(space, bodies, rng, count):
    for _ in range(count):
        p, q = some_point(rng, bodies), some_point(rng, bodies)
        place = space.locate(p)
        found = definition.owner(p, bodies)
        assert (place.body, place.vertex, place.edge) == (found or (None, None, None))
        assert place.is_free == (found is None)
        if p == q:
            continue
        direction = (q[0] - p[0], q[1] - p[1])
        hit, expected = space.ray_cast(p, direction), definition.first_hit(p, direction, bodies)
        assert (hit and (hit.at, hit.body, hit.vertex, hit.edge)) == expected
        if hit is not None:
            assert hit.point == tuple(p[k] + hit.at * direction[k] for k in (0, 1))
        assert space.is_free(p, q) == (expected is None or expected[0] > 1)


def check_hull(space, bodies):
    hull = [bodies[b][v] for b, v in space.hull()]
    corners = definition.convex_hull([p for ps in bodies.values() for p in ps])
    assert set(corners) <= set(hull)
    for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
        assert all(orient2d(a, b, p) >= 0 for p in hull)
    assert all(
        any(is_on_segment(p, a, b) for a, b in zip(corners, corners[-1:] + corners, strict=False))
        for p in hull
    )


def check_taut(path, bodies):
    """No body in the way, and one at every bend: so the path is the shortest of its class."""
    points = path.points
    assert not any(definition.crosses(p, q, bodies) for p, q in pairwise(points))
    for i, (name, vertex) in enumerate(path.bends):
        assert bodies[name][vertex] == points[i + 1]
        assert definition.bends_around(*points[i : i + 3], bodies[name], vertex)


def check_paths(space, bodies, rng, count):
    """Paths are taut, and a shortened walk can be deformed into the walk."""
    found = 0
    obstacles = homotopy.split_into_parts(bodies)
    inner = {name: homotopy.inner_point(points, rng) for name, points in obstacles.items()}
    for _ in range(count):
        walk = [some_point(rng, bodies)]
        for _ in range(rng.randint(1, 12)):
            p = some_point(rng, bodies)
            if len(walk) == 1 and not space.locate(walk[0]).is_free:
                walk = [p]
            elif space.is_free(walk[-1], p):
                walk.append(p)
        try:
            path = space.shorten(walk)
            direct = space.path(walk[0], walk[-1])
        except InputError:
            continue
        found += 1
        check_taut(path, bodies)
        assert (path.points[0], path.points[-1]) == (walk[0], walk[-1])
        check_taut(direct, bodies)
        anchors = homotopy.anchors_beside(path.points, obstacles, inner)
        assert homotopy.crossing_word(walk, anchors) == homotopy.crossing_word(path.points, anchors)
    return found


def check_relative_hulls(space, bodies, rng):
    """Around one body and no other, nothing in the way, and taut: so it is the shortest."""
    anchors = {name: homotopy.inner_point(points, rng) for name, points in bodies.items()}
    for body, own in bodies.items():
        if len(getattr(own, "parts", ())) > 1:
            with pytest.raises(InputError, match="has several parts: no loop"):
                space.relative_hull(body)
            continue
        hull = space.relative_hull(body)
        points = [bodies[b][v] for b, v in hull]
        if len(own) < 3:
            assert set(hull) == {(body, v) for v in range(len(own))}
            continue
        for i, (name, vertex) in enumerate(hull):
            before, here, after = points[i - 1], points[i], points[(i + 1) % len(points)]
            assert not definition.crosses(here, after, bodies)
            turn = orient2d(before, here, after)
            if turn:
                assert turn < 0 or name == body
                assert definition.bends_around(before, here, after, bodies[name], vertex)
        for name, p in anchors.items():
            if any(is_on_segment(p, points[i - 1], points[i]) for i in range(len(points))):
                assert len(bodies[name]) < 3 or isinstance(bodies[name], definition.OpenChain)
            else:
                is_around = name == body or definition.is_in_hole(p, own)
                assert definition.winding(p, points) == is_around


def check_neighbours(space, bodies):
    """The bridge graph is that of the diagonals, and connected."""
    joined = {name: set() for name in bodies}
    nodes = space.snapshot.nodes
    for edge in space.snapshot.diagonals:
        a, b = nodes[edge.u].body, nodes[edge.v].body
        if a != b:
            joined[a].add(b)
            joined[b].add(a)
    names = list(bodies)
    for name in names:
        assert space.neighbours(name) == sorted(joined[name], key=names.index)
    seen, todo = set(), names[:1]
    while todo:
        name = todo.pop()
        if name not in seen:
            seen.add(name)
            todo += joined[name]
    assert len(seen) == len(names)


def test_bug_a_path_along_a_chain_is_told_by_what_it_does_not_touch():
    """The crossing word said that it had left the class of the walk (chains:0, chains:1)."""
    chain = [(0, 0), (4, 0), (4, -3)]
    scene = Scene([Body("chain", chain, closed=False), Body("point", [(9, 1)])])
    space = FreeSpace(start_tiling(scene, "auto", scene.start), scene.start)
    bodies = definition.points_of(scene, 0)
    inner = {name: homotopy.inner_point(points, None) for name, points in bodies.items()}
    walk = [(-1, -2), (-1, 1), (5, 1), (5, -2)]

    over, under = space.shorten(walk), space.shorten([walk[0], (-1, -4), (5, -4), walk[-1]])

    assert over.points == (walk[0], (0, 0), (4, 0), walk[-1])
    anchors = homotopy.anchors_beside(over.points, bodies, inner)
    assert anchors == {"chain": (4, -3), "point": (9, 1)}
    word = homotopy.crossing_word(walk, anchors)
    assert word == homotopy.crossing_word(over.points, anchors) == [("chain", 1)]
    assert homotopy.crossing_word(under.points, anchors) == []


def test_bug_the_way_back_over_two_anchors_in_one_column_undoes_the_way_there():
    """It was in the same order as the way there (chains_on_grid:1)."""
    anchors = {"a": (1, 4), "b": (1, 2), "c": (1, 9)}

    assert homotopy.crossing_word([(0, 5), (2, 6)], anchors) == [("a", 1), ("b", 1)]
    assert homotopy.crossing_word([(0, 5), (2, 6), (2, 5), (0, 6)], anchors) == []
    assert homotopy.crossing_word([(0, 5), (1, 6), (0, 7)], anchors) == []
    assert homotopy.crossing_word([(0, 5), (2, 6), (1, 3), (0, 3)], anchors) == [("a", 1)]


def test_points_that_a_path_covers_anchor_nothing():
    assert homotopy.anchors_beside([(0, 0), (4, 0)], {"p": [(1, 0)]}, {"p": (1, 0)}) == {}


@pytest.mark.long("chains", "flat", "grids_passing", "lakes", "mixed_shapes", "pieces")
@pytest.mark.parametrize("family", sorted({**FAMILIES, **RINGS}))
def test_queries_are_those_of_brute_force(family):
    """Places, rays, segments, paths, hulls: a few dozen in each family."""
    for scene, space, rng in spaces(family, range(2)):
        bodies = definition.points_of(scene, space.at)
        check_places_and_rays(space, bodies, rng, 20)
        check_hull(space, bodies)
        check_neighbours(space, bodies)
        check_paths(space, bodies, rng, 4)
        check_relative_hulls(space, bodies, rng)


@pytest.mark.slow
@pytest.mark.parametrize("tiling", ["auto", "lazy", "mixed"])
def test_queries_are_those_of_brute_force_ten_thousand_times(tiling):
    """10,000 places, rays and segments, and as many paths, without a difference."""
    done = Counter()
    seed = 0
    while min(done["rays"], done["paths"]) < 10_000:
        for family in (*FAMILIES, *RINGS):
            for scene, space, rng in spaces(family, (seed,), tiling):
                bodies = definition.points_of(scene, space.at)
                check_places_and_rays(space, bodies, rng, 60)
                check_hull(space, bodies)
                check_neighbours(space, bodies)
                check_relative_hulls(space, bodies, rng)
                done["rays"] += 60
                done["relative hulls"] += len(bodies)
                if done["paths"] < 10_000:
                    done["paths"] += check_paths(space, bodies, rng, 60)
        seed += 1
    print(tiling, dict(done))  # noqa: T201 - shown with -s


def bowl(m):
    """A bowl of 2m + 3 vertices: what is over it is a convex pocket. And a point far away."""
    outline = [(-m - 1, -1), (m + 1, -1), *((i, i * i) for i in range(m, -m - 1, -1))]
    return Scene([Body("bowl", outline), Body("far", [(0, 2 * m * m)])], (0, 1))


@pytest.mark.long
def test_few_edges_are_crossed_in_the_relative_hull():
    """Lemma 5.4: O(log n) edges on the way through F1, here two a level of the tree."""
    for m in (8, 64, 512):
        scene = bowl(m)
        space = FreeSpace(start_tiling(scene, "mixed", scene.start), QQ(0))
        rng = Random(m)
        most = 0
        for _ in range(100):
            x = QQ(rng.randint(-2 * m + 1, 2 * m - 1), 2)
            hit = space.ray_cast((x, x * x + 1), (rng.randint(-9, 9), rng.randint(-m, m) or 1))
            most = max(most, hit.crossed if hit else 0)

        assert 1 < most <= 2 * (2 * m + 3).bit_length()


def test_edges_crossed_are_of_the_order_of_bodies():
    """A greedy tiling of k convex bodies has 2k - 2 tiles: no line crosses more than O(k)."""
    for seed in range(4):
        scene = generate("convex", seed)
        space = FreeSpace(start_tiling(scene, "greedy", scene.start), scene.start)
        rng = Random(seed)
        bodies = definition.points_of(scene, space.at)
        for _ in range(50):
            p, q = some_point(rng, bodies), some_point(rng, bodies)
            crossed = [space.locate(p).crossed]
            hit = space.ray_cast(p, (q[0] - p[0], q[1] - p[1])) if p != q else None
            crossed.append(hit.crossed if hit else 0)
            assert max(crossed) <= 8 * len(bodies)


def test_scenes_of_few_points():
    """No body, one point, points on a line."""
    origin = (QQ(0), QQ(0))
    for count in range(4):
        scene = Scene([Body(f"p{i}", [(2 * i, i)]) for i in range(count)], (0, 1))
        space = FreeSpace(start_tiling(scene, "auto", scene.start), QQ(0))
        bodies = definition.points_of(scene, 0)
        assert len(set(space.hull())) == count
        if count:
            check_places_and_rays(space, bodies, Random(count), 200)
            check_neighbours(space, bodies)
            check_paths(space, bodies, Random(count), 50)
        else:
            assert space.locate(origin).kind == "outside"
            assert space.path(origin, (3, 4)).length == space.shorten([origin, (3, 4)]).length == 5
            assert space.ray_cast(origin, (1, 0)) is None


def test_a_mouth_pulled_shut():
    """The loop around a jaw with its prey passes a tooth twice, on either side (clamps:168)."""
    jaw = [(-20, -10), (100, -10), (80, 8), (60, 0), (40, 4), (20, 7), (0, 7), (-10, 10),
           (-3, 12), (25, 33), (45, 9), (60, 17), (79, 32), (100, 63), (-20, 63)]  # fmt: skip
    prey = [(21, 17), (21, 13), (22, 11), (27, 13), (24, 16)]
    scene = Scene([Body("jaw", jaw), Body("prey", prey)])
    for tiling in ("mixed", "lazy"):
        space = FreeSpace(start_tiling(scene, tiling, scene.start), QQ(0))
        assert space.relative_hull("jaw").count(("jaw", 10)) == 2
        check_relative_hulls(space, definition.points_of(scene, 0), Random(0))


def test_paths_lead_around_the_hull():
    """Two pockets of one body are joined outside alone; the winding of a walk is kept."""
    body = [(0, 0), (3, 4), (0, 8), (9, 8), (6, 4), (9, 0)]
    scene = Scene([Body("hourglass", body)])
    space = FreeSpace(start_tiling(scene, "auto", scene.start), QQ(0))
    left, right = (QQ(1), QQ(4)), (QQ(8), QQ(4))
    path = space.path(left, right)
    assert path.bends in (
        (("hourglass", 0), ("hourglass", 5)),
        (("hourglass", 2), ("hourglass", 3)),
    )
    over = space.shorten([left, (-9, 4), (-9, 99), (99, 99), (99, 4), right])
    assert over.bends == (("hourglass", 2), ("hourglass", 3))
    around = space.shorten([left, (-9, 4), (-9, 99), (99, 99), (99, -9), (-9, -9), (-9, 4), left])
    assert set(around.bends) == {("hourglass", v) for v in (0, 2, 3, 5)}
    assert space.path((-50, 4), (50, 4)).length < 102


def test_what_is_refused():
    """Directions of length zero, points that are none, paths through bodies."""
    scene = Scene([Body("a", [(0, 0), (4, 0), (0, 4)]), Body("b", [(9, 0), (12, 0), (9, 5)])])
    space = FreeSpace(start_tiling(scene, "auto", scene.start), QQ(0))
    with pytest.raises(InputError, match="direction"):
        space.ray_cast((0, 0), (0, 0))
    with pytest.raises(InputError, match="two coordinates"):
        space.locate((0, 0, 0))
    with pytest.raises(InputError, match="body 'a' has it"):
        space.path((1, 1), (6, 1))
    with pytest.raises(InputError, match="meets body 'b' at"):
        space.shorten([(6, 1), (8, 1), (14, 1)])
    with pytest.raises(InputError, match="no body 'c'"):
        space.neighbours("c")


def test_bug_the_relative_hull_of_a_point_is_the_point():
    """In the tiling of points, which has no copies of them, it was an internal error."""
    points = [Body(f"p{i}", [(i, i * i)], Translation([0, -i], [0, 2])) for i in range(6)]
    simulation = Simulation(Scene(points, (0, 3)))

    assert simulation.name == "incremental"
    assert [simulation.relative_hull(p.name) for p in points] == [[(p.name, 0)] for p in points]


@pytest.mark.parametrize("seed", [1, 5])
def test_positions_of_nodes_need_no_trajectories(seed, monkeypatch):
    made, track = [], Piece.track
    monkeypatch.setattr(Piece, "track", lambda piece, v: made.append(v) or track(piece, v))
    simulation = Simulation(generate("convex", seed))

    space = simulation.space()

    assert not made
    found = [((node.body, node.vertex), (node.x, node.y)) for node in space.snapshot.nodes]
    places = simulation.scene.at(space.at)
    assert found == [((b, i), place) for b in places for i, place in enumerate(places[b])]


@pytest.mark.parametrize("family", ["convex", "stars", "chains", "flat", "lakes", "frames"])
def test_links_of_the_subdivision_turn_counter_clockwise(family):
    """They come from the cycles around tiles and in bodies, not from directions."""
    scene = generate(family, 1)
    plane = FreeSpace(start_tiling(scene, "auto", scene.start), scene.start)._plane
    plane.map.audit()
    cycles = [plane.map.face(h) for face in plane.cycles.values() for h in face]
    assert sorted(h for cycle in cycles for h in cycle) == list(range(len(plane.face)))

    def angle(h):
        x, y = plane.direction(h)
        return y < 0 or (y == 0 and x < 0), y != 0, y and -x / y

    for h in plane.out:
        star = plane.map.star(h)
        least = star.index(min(star, key=angle))
        assert [*star[least:], *star[:least]] == sorted(star, key=angle)
