"""Other programs on the two elementary queries of collision detection in space."""

from __future__ import annotations

import contextlib
import math
import multiprocessing
import time as clock
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from benchmarks.output import Output, Row
from benchmarks.peers import is_installed
from benchmarks.programs import with_ipctk
from exactpt.errors import AuditError
from exactpt.testing.space import (
    FAMILIES,
    SpaceQuery,
    edge_edge_array,
    make_query,
    vertex_face_array,
)
from exactpt.testing.space.exact import contact_of
from exactpt.testing.space.queries import KINDS

__all__ = ["FULL", "QUICK", "Engine", "Sizes", "engines", "run", "score"]

Toi: TypeAlias = Callable[[SpaceQuery], "float | None"]

STEPS: Final = 64
"""Steps of the textbook method that bisects."""
PATIENCE: Final = 2.0
"""Seconds that an engine has for one query."""
SAMPLES: Final = 257
"""Times at which the distance of a query without contact is computed."""


class Sizes(NamedTuple):
    """Size of the benchmark: queries for each kind and family."""

    queries: int


QUICK: Final = Sizes(10)
FULL: Final = Sizes(50)


class Engine:
    """A program under test, in a process of its own that is killed if it does not answer.

    Attributes:
        name: its name with its parameters.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self._process: Any = None
        self._pipe: Any = None

    def toi(self, query: SpaceQuery) -> tuple[float | None, float] | None:
        """Return the time of impact or None, and the processor time; None after `PATIENCE`."""
        if self._process is None:
            context = multiprocessing.get_context("spawn")
            self._pipe, other = context.Pipe()
            self._process = context.Process(target=_serve, args=(self.name, other), daemon=True)
            self._process.start()
            other.close()
            self._pipe.recv()  # the engine is imported
        self._pipe.send(query)
        if self._pipe.poll(PATIENCE):
            answer: tuple[float | None, float] = self._pipe.recv()
            return answer
        self.close()
        return None

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._pipe.close()
            self._process = None


def _serve(name: str, pipe: Any) -> None:  # noqa: ANN401 - a connection
    """Answer queries until the pipe is closed."""
    toi = _methods()[name]
    pipe.send("ready")
    with contextlib.suppress(EOFError):
        while True:
            query = pipe.recv()
            begin = clock.process_time()
            answer = toi(query)
            pipe.send((answer, clock.process_time() - begin))


@dataclass
class Score:
    """The results of one engine.

    Attributes:
        missed: contacts that were not reported.
        late: contacts that were reported after the exact time.
        hung: queries without an answer within `PATIENCE` seconds.
        invented: contacts that were reported where there is none.
        nearest: the largest distance at which the sets of an invented contact pass each other,
            computed in doubles at `SAMPLES` times.
        lost: for each contact reported in time, the exact time minus the reported one.
        seconds: processor time of all queries.
        first_missed: a missed query.
    """

    missed: int = 0
    late: int = 0
    hung: int = 0
    invented: int = 0
    nearest: float = 0.0
    seconds: float = 0.0
    lost: list[float] | None = None
    first_missed: SpaceQuery | None = None


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Score every engine on every family, and write a reproducer for each that misses a contact.

    Raises:
        AuditError: if the arrays of exactpt disagree with its exact decisions.
    """
    queries = [
        make_query(kind, family, seed, number)
        for kind in KINDS
        for family in FAMILIES
        for number in range(sizes.queries)
    ]
    known = engines(has_ipctk=output.has("ipctk"))
    rows = []
    for row, missed in score(queries, known, output.progress):
        rows.append(row)
        if missed is not None:
            name = "".join(c if c.isalnum() else "-" for c in str(row["engine"])).strip("-")
            output.write(f"space-missed-{name}.py", _reproducer(missed, str(row["engine"])))
    output.table("space", rows)


def score(
    queries: Sequence[SpaceQuery], known: Sequence[Engine], progress: Callable[[str], None]
) -> Iterator[tuple[Row, SpaceQuery | None]]:
    """Yield for each engine a row of the table, and a contact that it missed or None.

    Raises:
        AuditError: if the arrays of exactpt disagree with its exact decisions.
    """
    truths = [contact_of(query) for query in queries]
    times = [None if truth is None else truth.time for truth in truths]
    yield _own_row(queries, [t is not None for t in times]), None
    for engine in known:
        progress(engine.name)
        found = Score(lost=[])
        for query, exact in zip(queries, times, strict=True):
            reply = engine.toi(query)
            if reply is None:
                found.hung += 1
                continue
            answer, seconds = reply
            found.seconds += seconds
            if exact is None and answer is not None:
                found.invented += 1
                found.nearest = max(found.nearest, _nearest(query))
            elif exact is not None and answer is None:
                found.missed += 1
                found.first_missed = found.first_missed or query
            elif exact is not None and answer is not None:
                found.late += exact < answer
                if exact >= answer and found.lost is not None:
                    found.lost.append(float(exact) - answer)
        engine.close()
        yield (
            _row(engine.name, found, len(queries), sum(t is not None for t in times)),
            found.first_missed,
        )


def engines(*, has_ipctk: bool) -> list[Engine]:
    """Return the engines: two textbook methods written here, and ipctk if it is installed."""
    return [Engine(name) for name in (*TEXTBOOK, *(IPCTK if has_ipctk else ()))]


TEXTBOOK: Final = (
    "textbook: cubic in doubles, epsilon 1e-9 (ours)",
    f"textbook: {STEPS} steps and bisection (ours)",
)
IPCTK: Final[dict[str, tuple[str, dict[str, float]]]] = {
    "ipctk Tight-Inclusion, default": ("tight inclusion", {}),
    "ipctk Tight-Inclusion, tolerance 1e-12, rescaling 1": (
        "tight inclusion",
        {"tolerance": 1e-12, "conservative_rescaling": 1.0},
    ),
    "ipctk additive, default": ("additive", {}),
    "ipctk additive, rescaling 0.9999": ("additive", {"conservative_rescaling": 0.9999}),
}


def _methods() -> dict[str, Toi]:
    """Return the function of each engine by its name."""
    methods: dict[str, Toi] = dict(zip(TEXTBOOK, (_cubic, _bisection), strict=True))
    if is_installed("ipctk"):
        for name, (way, options) in IPCTK.items():
            methods[name] = _with_ipctk(with_ipctk.method_of(way, **options))
    return methods


def _with_ipctk(ccd: Any) -> Toi:  # noqa: ANN401 - a class without types
    def toi(query: SpaceQuery) -> float | None:
        points = np.array(query.start + query.end)
        ask = ccd.point_triangle_ccd if query.kind == "vertex-face" else ccd.edge_edge_ccd
        hit, time = ask(*points)
        return float(time) if hit else None

    return toi


def _own_row(queries: Sequence[SpaceQuery], hits: Sequence[bool]) -> Row:
    seconds, exact = 0.0, 0
    for kind, decide in (("vertex-face", vertex_face_array), ("edge-edge", edge_edge_array)):
        index = [k for k, query in enumerate(queries) if query.kind == kind]
        rows = np.array([queries[k].start + queries[k].end for k in index]).reshape(-1, 8, 3)
        begin = clock.process_time()
        contacts = decide(rows)
        seconds += clock.process_time() - begin
        exact += int(contacts.exact.sum())
        if contacts.hit.tolist() != [hits[k] for k in index]:
            raise AuditError("the arrays of exactpt disagree with its exact decisions")
    found = Score(seconds=seconds, lost=[0.0] * sum(hits))
    name = f"exactpt.testing.space, arrays ({exact / max(1, len(queries)):.0%} decided exactly)"
    return _row(name, found, len(queries), sum(hits))


def _row(name: str, found: Score, count: int, contacts: int) -> Row:
    lost = sorted(found.lost or [])
    return {
        "engine": name,
        "queries": count,
        "contacts": contacts,
        "missed": found.missed,
        "late": found.late,
        "hung": found.hung,
        "invented": found.invented,
        "farthest invented": f"{found.nearest:.1e}" if found.invented else None,
        "lost time, median": f"{lost[len(lost) // 2]:.1e}" if lost else None,
        "lost time, largest": f"{lost[-1]:.1e}" if lost else None,
        "us a query": round(found.seconds / max(1, count) * 1e6, 1),
    }


def _vectors(query: SpaceQuery) -> tuple[np.ndarray, np.ndarray]:
    return np.array(query.start), np.array(query.end)


def _system(query: SpaceQuery, p: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return e, f, g: the coordinates (x, y) of a contact satisfy x e + y f = g."""
    if query.kind == "vertex-face":
        return p[2] - p[1], p[3] - p[1], p[0] - p[1]
    return p[1] - p[0], p[2] - p[3], p[2] - p[0]


def _is_inside(query: SpaceQuery, t: float, epsilon: float) -> bool:
    """Return True if the sets meet at a root of the cubic, in doubles with a tolerance."""
    start, end = _vectors(query)
    e, f, g = _system(query, start + t * (end - start))
    normal = np.cross(e, f)
    size = float(normal @ normal)
    if size < epsilon * epsilon:
        return False
    x, y = float(np.cross(g, f) @ normal) / size, float(np.cross(e, g) @ normal) / size
    if min(x, y) < -epsilon:
        return False
    return x + y <= 1 + epsilon if query.kind == "vertex-face" else max(x, y) <= 1 + epsilon


def _volume(query: SpaceQuery, t: float) -> float:
    start, end = _vectors(query)
    e, f, g = _system(query, start + t * (end - start))
    return float(np.cross(e, f) @ g)


def _cubic(query: SpaceQuery) -> float | None:
    """Return the first root of the cubic, solved in doubles, at which an inside test holds."""
    values = [_volume(query, k / 3) for k in range(4)]
    cubic = np.polyfit([0, 1 / 3, 2 / 3, 1], values, 3)
    roots = np.roots(cubic).tolist() if np.abs(cubic).max() > 1e-12 else []
    real = sorted(r.real for r in roots if abs(r.imag) < 1e-9 and -1e-9 <= r.real <= 1 + 1e-9)
    return next((min(max(t, 0.0), 1.0) for t in real if _is_inside(query, t, 1e-9)), None)


def _bisection(query: SpaceQuery) -> float | None:
    """Return the first sign change of the cubic between steps at which an inside test holds."""
    for k in range(STEPS):
        low, high = k / STEPS, (k + 1) / STEPS
        at_low = _volume(query, low)
        if at_low * _volume(query, high) > 0:
            continue
        for _ in range(50):
            middle = (low + high) / 2
            if at_low * _volume(query, middle) > 0:
                low = middle
            else:
                high = middle
        if _is_inside(query, high, 1e-9):
            return low
    return None


def _nearest(query: SpaceQuery) -> float:
    """Return the least distance of the two sets at the sampled times, in doubles."""
    start, end = _vectors(query)
    return min(
        _distance(query, start + t * (end - start)) for t in np.linspace(0, 1, SAMPLES).tolist()
    )


def _distance(query: SpaceQuery, p: np.ndarray) -> float:
    """Return the least |x e + y f - g| over the polygon of coordinates: inside, or on an edge."""
    e, f, g = _system(query, p)
    zero = np.zeros(3)
    if query.kind == "vertex-face":
        edges = [(zero, e), (zero, f), (e, f)]
    else:
        edges = [(zero, e), (zero, f), (e, e + f), (f, e + f)]
    best = min(_to_segment(g, a, b) for a, b in edges)
    normal = np.cross(e, f)
    size = float(normal @ normal)
    if size > 0:
        x, y = float(np.cross(g, f) @ normal) / size, float(np.cross(e, g) @ normal) / size
        inside = x + y <= 1 if query.kind == "vertex-face" else max(x, y) <= 1
        if min(x, y) >= 0 and inside:
            best = min(best, abs(float(normal @ g)) / math.sqrt(size))
    return best


def _to_segment(g: np.ndarray, a: np.ndarray, b: np.ndarray) -> float:
    d, w = b - a, g - a
    size = float(d @ d)
    s = min(max(float(w @ d) / size, 0.0), 1.0) if size else 0.0
    return float(np.linalg.norm(w - s * d))


def _reproducer(query: SpaceQuery, engine: str) -> str:
    """Return a script of a few lines that shows a missed contact."""
    contact = contact_of(query)
    assert contact is not None  # noqa: S101 - it was missed
    ask = "point_triangle_ccd" if query.kind == "vertex-face" else "edge_edge_ccd"
    points = ",\n    ".join(str(list(p)) for p in query.start + query.end)
    call = f"import ipctk\nimport numpy as np\n\npoints = np.array([\n    {points},\n])\n"
    shown = f"print(ipctk.TightInclusionCCD().{ask}(*points))  # or AdditiveCCD()\n"
    if not engine.startswith("ipctk"):
        call, shown = f"points = [\n    {points},\n]\n", ""
    time = float(contact.time)
    head = f'"""{query.kind}, {query.name}: {engine} misses a contact at t = {time!r}."""\n'
    return f"{head}\n{call}{shown}"
