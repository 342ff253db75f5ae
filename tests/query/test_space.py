"""Queries against brute force over all edges, on generic and degenerate scenes."""

from random import Random

import brute
import pytest

from exactpt.collision.tilings import start_tiling
from exactpt.collision.initial import initial_touches
from exactpt.kernel.numbers import QQ
from exactpt.query.space import FreeSpace
from exactpt.scene.generate import FAMILIES, generate
from exactpt.tiling.events import ContactFound

def spaces(family, seeds, tilings=("auto", "lazy")):
    """Spaces at the start, at times in between and at event times, of a family's scenes."""
    for seed in seeds:
        scene = generate(family, seed)
        rng = Random(seed)
        if initial_touches(scene)[1]:
            continue
        for tiling in tilings:
            try:
                kinetic = start_tiling(scene, tiling, scene.start)
            except Exception as e:
                if "open chains" in str(e): continue
                raise
            yield scene, FreeSpace(kinetic, scene.start), rng
            try:
                for _ in range(rng.randint(1, 30)):
                    if kinetic.advance(scene.end) is None:
                        break
                    now = kinetic.now.simplified()
                    if now.is_rational and rng.random() < 0.5:
                        yield scene, FreeSpace(kinetic, now.low), rng
                t = scene.start + (scene.end - scene.start) * QQ(rng.randint(1, 15), 16)
                if kinetic.now.compare_rational(t) <= 0:
                    while kinetic.advance(t) is not None:
                        pass
                    yield scene, FreeSpace(kinetic, t), rng
            except ContactFound:
                continue

def interesting(rng, bodies):
    """A point: on a vertex, an edge, a line through two vertices, a lattice point, anywhere."""
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
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    w, h = max(xs) - min(xs) + 1, max(ys) - min(ys) + 1
    return (min(xs) + w * QQ(rng.randint(-10, 110), 100), min(ys) + h * QQ(rng.randint(-10, 110), 100))

def check(scene, space, rng, count):
    bodies = scene.at(space.at)
    for _ in range(count):
        p, q = interesting(rng, bodies), interesting(rng, bodies)
        place = space.locate(p)
        found = brute.owner(p, bodies)
        assert (place.body, place.vertex, place.edge) == (found or (None, None, None)), (p, place)
        if p == q: continue
        d = (q[0] - p[0], q[1] - p[1])
        hit = space.ray_cast(p, d)
        expected = brute.first_hit(p, d, bodies)
        got = None if hit is None else (hit.at, hit.body, hit.vertex, hit.edge)
        assert got == expected, (p, q)
        assert space.is_free(p, q) == (expected is None or expected[0] > 1)
    points = sorted({p for ps in bodies.values() for p in ps})
    hull = [bodies[b][v] for b, v in space.hull()]
    corners = brute.convex_hull(points)
    assert set(corners) <= set(hull)
    
if __name__ == "__main__":
    import sys, time
    t=time.time(); n=0
    for f in FAMILIES:
        for scene, space, rng in spaces(f, range(int(sys.argv[1]))):
            check(scene, space, rng, 20); n+=20
        print(f, n, round(time.time()-t,1), flush=True)
