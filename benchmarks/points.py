"""Moving points: changes of the structures, time per event, and long chains, in tables.

    python benchmarks/points.py [changes] [time] [chains] [comparison] [--most 500] [--seed 0]

*changes*: how often the incremental pseudo-triangulation (IPT) and the fan triangulation
change, beside what the paper bounds: n lambda_s(n) for the one (Theorem 3.3) and, in linear
motion, n^(4/3) lambda_s(n) for the other (Theorem 3.4), lambda_s(n) being nearly n. An
exponent p is fitted to count = c n^p by least squares over the logarithms.

*time*: microseconds of processor time an event. *chains*: the same where chains are long,
walked along and searched. *comparison*: integer positions in [0, 10^6]^2, velocities in
[-10^4, 10^4]^2, time 0 to 100. Other programs on the machine change the times, not the counts.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random
from time import process_time
from typing import Final, Literal, NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1]))

from exactpt.kernel.counters import counters
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound
from exactpt.tiling.incremental.incremental import IncrementalTiling

SIZES: Final = (50, 100, 200, 500, 1000, 2000)
Chains = Literal["auto", "linked", "searchable"]


def say(line: str) -> None:
    """Write a line at once."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


class Measured(NamedTuple):
    """A run: what happened and what it cost.

    ``events`` are changes of the IPT, ``steps`` vertices of chains passed in searches.
    """

    events: int
    fan: int
    by_kind: dict[str, int]
    seconds: float
    exact: int
    rebuilds: int
    steps: int


def measure(scene: Scene, *, chains: Chains = "auto", fan: bool = False) -> Measured:
    """Run a scene to its end, or its first contact."""
    vertices = IncrementalTiling.vertices_of(scene.bodies, scene.start, scene.end)
    tiling = IncrementalTiling.begin(vertices, scene.start, scene.end, chains=chains, fan=fan)
    exact, begin = counters.exact, process_time()
    try:
        for _ in tiling.run():
            pass
    except ContactFound:
        say(f"  contact at t = {float(tiling.now)!r}: the run ends there")
    seconds = process_time() - begin
    by_kind = dict(tiling.stats.events)
    by_kind.pop("motion", None)
    return Measured(
        sum(by_kind.values()),
        tiling.stats.fan,
        by_kind,
        seconds,
        counters.exact - exact,
        tiling.stats.rebuilds,
        sum(tree.steps for tree in tiling.structure.trees),
    )


def exponent(sizes: Sequence[int], values: Sequence[float]) -> float:
    """The p of the best c n^p, by least squares over the logarithms."""
    points = [(math.log(n), math.log(v)) for n, v in zip(sizes, values, strict=True) if v > 0]
    if len(points) < 2:
        return math.nan
    mx = sum(x for x, _ in points) / len(points)
    my = sum(y for _, y in points) / len(points)
    return sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)


# Scenes


def random_linear(n: int, seed: int) -> Scene:
    """The input of the comparison."""
    rng = Random(f"linear {n} {seed}")
    return Scene([_random_point(rng, i, 0) for i in range(n)], (0, 100))


def random_quadratic(n: int, seed: int) -> Scene:
    """The same, and each point with an acceleration of its own."""
    rng = Random(f"quadratic {n} {seed}")
    return Scene([_random_point(rng, i, 200) for i in range(n)], (0, 100))


def _random_point(rng: Random, i: int, acceleration: int) -> Body:
    x, y = (
        [0, rng.randint(-(10**4), 10**4)]
        + [rng.randint(-acceleration, acceleration)] * (acceleration > 0)
        for _ in range(2)
    )
    return Body(f"p{i}", [(rng.randint(0, 10**6), rng.randint(0, 10**6))], Translation(x, y))


def crossing_lines(n: int, seed: int) -> Scene:
    """Half the points on a line, half on another that passes through it; slightly uneven."""
    rng = Random(f"lines {n} {seed}")
    bodies = []
    for i in range(n):
        line, k = i % 2, i // 2
        x, y = 10**6 * k + rng.randint(0, 10**5), rng.randint(-10, 10)
        if line:
            at = (x // 3 - 10**6 * n // 4, 10**6 * n // 8 + x // 5 + y)
            bodies.append(Body(f"p{i}", [at], Translation([0, 10**6], [0, -(10**5) * 3])))
        else:
            bodies.append(Body(f"p{i}", [(x, y)]))
    return Scene(bodies, (0, n))


def parabola_on_line(n: int, seed: int) -> Scene:
    """A parabola, open to the left, sweeps over points close to a steep line."""
    rng = Random(f"parabola {n} {seed}")
    m = n // 2
    bodies = []
    for i in range(m):
        y = 2 * i - m
        at = (-1000 * y * y + rng.randint(0, 999), 1000 * y + rng.randint(0, 9))
        bodies.append(Body(f"a{i}", [at], Translation([0, 1000 * m])))
    for i in range(n - m):
        at = (rng.randint(1000, 2000) * (i + 1), 1000 * (2 * i - m) + rng.randint(10, 999))
        bodies.append(Body(f"b{i}", [at], Translation([0, rng.randint(-30, 30)])))
    return Scene(bodies, (0, 2 * m))


def turns_beside_arc(n: int, seed: int) -> Scene:
    """Points that are, turn by turn, the first one right of an arc, and see all of it.

    The arc is a parabola at rest. Point k of the others is at far + (k^2 - 2 k t), which is
    least of all near t = k, above or below the arc in turn.
    """
    rng = Random(f"turns {n} {seed}")
    m = n // 2
    bodies = []
    for i in range(m):
        y = 2 * i - m
        bodies.append(Body(f"a{i}", [(-1000 * y * y, 8000 * y + rng.randint(0, 99))]))
    for k in range(n - m):
        y = (1 if k % 2 else -1) * (40000 * m + 20 * k + rng.randint(0, 9))
        x = [1000 * (4 * m * m + k * k) + rng.randint(0, 99), -2000 * k - rng.randint(0, 9)]
        bodies.append(Body(f"b{k}", [{"x": x, "y": [y]}]))
    return Scene(bodies, (0, n - m))


def swaps_beside_arc(n: int, seed: int) -> Scene:
    """Two points beside a long arc change places 400 times: every time r r' is all the arc."""
    del seed
    m, swaps = n - 2, 400
    bodies = []
    for i in range(m):
        y = 2 * i - m
        bodies.append(Body(f"a{i}", [(-y * y, 2 * y)]))
    for name, s, y in (("p", 1, 3 * m), ("q", -1, -3 * m)):
        frames = [(t, [(m * m + (s if t % 2 else -s), y)]) for t in range(swaps + 1)]
        bodies.append(Body(name, keyframes=frames))
    return Scene(bodies, (0, swaps))


FAMILIES: Final[dict[str, Callable[[int, int], Scene]]] = {
    "random, linear": random_linear,
    "random, quadratic": random_quadratic,
    "two lines crossing": crossing_lines,
    "parabola sweeps a line": parabola_on_line,
    "turns beside an arc": turns_beside_arc,
}


# Tables


def changes(sizes: Sequence[int], seed: int) -> None:
    """Structural changes against n."""
    say("\nChanges of the IPT / of the fan triangulation, exponents fitted to c n^p")
    say("bounds: IPT n lambda_s(n), about n^2; fan n^(4/3) lambda_s(n), about n^2.33 (linear)")
    say(f"{'':24}" + "".join(f"{n:>18}" for n in sizes) + f"{'p IPT':>8}{'p fan':>7}")
    for name, family in FAMILIES.items():
        runs = [measure(family(n, seed), fan=True) for n in sizes]
        cells = "".join(f"{f'{run.events} / {run.fan}':>18}" for run in runs)
        p = exponent(sizes, [run.events for run in runs])
        q = exponent(sizes, [run.fan for run in runs])
        say(f"{name:24}{cells}{p:>8.2f}{q:>7.2f}")


def times(sizes: Sequence[int], seed: int) -> None:
    """Time per event against n."""
    say("\nMicroseconds an event; p: exponent from n = 500 on")
    say(f"{'':24}" + "".join(f"{n:>9}" for n in sizes) + f"{'p':>8}")
    for name, family in FAMILIES.items():
        costs = [
            1e6 * run.seconds / run.events for run in (measure(family(n, seed)) for n in sizes)
        ]
        _row(name, sizes, costs)


def _row(name: str, sizes: Sequence[int], costs: Sequence[float]) -> None:
    large = [(n, c) for n, c in zip(sizes, costs, strict=True) if n >= 500]
    p = exponent([n for n, _ in large], [c for _, c in large])
    say(f"{name:24}" + "".join(f"{c:>9.1f}" for c in costs) + f"{p:>8.2f}")


def chains(_sizes: Sequence[int], seed: int) -> None:
    """Chains walked along, and searched; of the same sizes always."""
    for title, family, largest in (
        ("short chains: random, linear", random_linear, 500),
        ("long: an exchange beside an arc, with two new plans of motion", swaps_beside_arc, 2000),
    ):
        sizes = [n for n in SIZES if n <= largest]
        say(f"\nMicroseconds an event ({title}); p: exponent from n = 500 on")
        say(f"{'':24}" + "".join(f"{n:>9}" for n in sizes) + f"{'p':>8}")
        kinds: tuple[Chains, ...] = ("linked", "searchable", "auto")
        for kind in kinds:
            runs = [measure(family(n, seed), chains=kind) for n in sizes]
            _row(kind, sizes, [1e6 * run.seconds / run.events for run in runs])


def comparison(sizes: Sequence[int], seed: int) -> None:
    """The input that other programs were measured on."""
    say("\nn points, positions in [0, 10^6]^2, velocities in [-10^4, 10^4]^2, time 0 to 100")
    say(
        f"{'n':>6}{'events':>9}{'x-order':>9}{'corner':>8}{'reflex':>8}{'hull':>6}"
        f"{'us/event':>10}{'events/s':>10}{'exact':>7}{'rebuilds':>9}"
    )
    for n in sizes:
        run = measure(random_linear(n, seed))
        kinds = "".join(
            f"{run.by_kind.get(kind, 0):>{width}}"
            for kind, width in (("x-order", 9), ("corner", 8), ("reflex", 8), ("hull", 6))
        )
        cost = 1e6 * run.seconds / run.events
        say(
            f"{n:>6}{run.events:>9}{kinds}{cost:>10.1f}{1e6 / cost:>10.0f}"
            f"{run.exact:>7}{run.rebuilds:>9}",
        )


TABLES: Final = {"changes": changes, "time": times, "chains": chains, "comparison": comparison}


def main() -> None:
    """Print the tables that are asked for; all by default."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0] if __doc__ else None)
    parser.add_argument("tables", nargs="*", choices=[*TABLES, []], help="all by default")
    parser.add_argument("--most", type=int, default=500, help="the largest n (default 500)")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    sizes = [n for n in SIZES if n <= given.most]
    for name in given.tables or TABLES:
        TABLES[name](sizes, given.seed)


if __name__ == "__main__":
    main()
