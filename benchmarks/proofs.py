"""Proofs and certificates of first contacts: their size, and the cost of writing and checking them.

Beside the run alone, which the checker in C++ should not exceed. Processor time throughout; the
checker in C++ is a process of its own. Both checkers must accept every proof. A second table has
the shares of the steps of docs/proofs.md in the time of the checker in Python. A third one has
certificates of a scene of each family, beside the search by pairs; a fourth one its medians.
"""

from __future__ import annotations

import os
import time
from collections import defaultdict
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from random import Random
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any, Final, NamedTuple
from unittest.mock import patch

from benchmarks.methods.own import fresh
from benchmarks.output import Output, Row
from benchmarks.point_scenes import random_linear
from benchmarks.shapes import combs, crowd, deforming, tangle, thin_and_fast
from benchmarks.timing import timed
from exactpt import (
    AuditError,
    BudgetExceeded,
    InputError,
    Proof,
    Scene,
    first_contact,
    proof_check,
    proof_scene,
    prove,
)
from exactpt.cgal import check_proof, find_program
from exactpt.kernel.numbers import QQ
from exactpt.proof import certificate_of
from exactpt.testing.scenes import EVERY, generate

__all__ = ["FULL", "QUICK", "Sizes", "run"]


class Sizes(NamedTuple):
    """Sizes of the scenes.

    Attributes:
        bodies: number of bodies of the crowds and lanes, and of points.
        vertices: number of vertices of each of two combs.
        deforming: number of bodies that deform.
        families: number of families of scenes that are certified.
    """

    bodies: int
    vertices: int
    deforming: int
    families: int


STEPS: Final[dict[str, list[tuple[object, str]]]] = {
    "reading": [(proof_check, "read"), (proof_check, "Scene")],
    "1 scene": [(proof_check.Checker, "read_body")],
    "2 map": [
        *((proof_check.PlanarMap, name) for name in ("begin", "change", "make_faces")),
        (proof_check.Checker, "check_insides"),
    ],
    "3 lives": [(proof_check.Checker, "end_lives")],
    "4, 5 faces": [(proof_check.Checker, "look_at")],
    "6 clusters": [(proof_check.Checker, "check_clusters")],
    "7 times": [(proof_check.Checker, "read_time"), (proof_check, "between")],
    "8 contact": [(proof_check.Checker, "check_contact"), (proof_check.Checker, "proved")],
}
"""The functions of the checker in Python that do the steps of docs/proofs.md."""

PARTS: Final = ("write : search", "check : search", "both : search")
"""Columns of ratios in the table of certificates."""

QUICK: Final = Sizes(50, 64, 16, 3)
FULL: Final = Sizes(1000, 1024, 256, len(EVERY))


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Prove and check a scene of each kind."""
    rows: list[Row] = []
    steps: list[Row] = []
    for name, (tiling, make) in _scenes(sizes).items():
        output.progress(name)
        scene = make(Random(f"proofs:{name}:{seed}"))
        proof = prove(fresh(scene), tiling=tiling)
        rows.append({"scene": name, **_row(scene, tiling, proof)})
        steps.append({"scene": name, **_shares(proof)})
    output.table("proofs", rows)
    output.table("proof-steps", steps)
    certified = list[Row]()
    for family in sorted(EVERY)[: sizes.families]:
        output.progress(family)
        if (row := _certificate(family, seed)) is not None:
            certified.append(row)
    output.table("certificates", certified)
    output.table("certificate-costs", [_cost(part, certified) for part in PARTS])


def _scenes(sizes: Sizes) -> dict[str, tuple[str, Callable[[Random], Scene]]]:
    """By name, tilings and the scenes that they run."""
    k = sizes.bodies
    return {
        "dense crowd": ("lazy", lambda rng: crowd(k, rng, radius=450, end=10)),
        "sparse crowd": ("lazy", lambda rng: crowd(k, rng, radius=60, end=100)),
        "sparse, greedy": ("greedy", lambda rng: crowd(k // 10, rng, radius=60, end=100)),
        "lanes": ("lazy", lambda rng: thin_and_fast(k, rng)),
        "combs": ("lazy", lambda _: tangle(combs(sizes.vertices))),
        "deforming": ("lazy", lambda rng: deforming(sizes.deforming, rng)),
        "points": ("incremental", lambda rng: random_linear(k, rng).until(QQ(1, 4))),
    }


def _row(scene: Scene, tiling: str, proof: Proof) -> Row:
    first_contact(Scene([]), tiling=tiling)  # imports on first use are not timed
    _, alone = timed(lambda: first_contact(fresh(scene), tiling=tiling))
    _, proving = timed(lambda: prove(fresh(scene), tiling=tiling))
    events = [line for line in proof.text.splitlines() if line.startswith(b"event ")]
    _, python = timed(proof.check)
    cpp = _in_cpp(proof)
    return {
        "vertices": scene.vertex_count,
        "events": len(events),
        "bytes an event": round(sum(map(len, events)) / len(events)) if events else None,
        "kB": round(len(proof.text) / 1000),
        "run s": round(alone, 3),
        "with proof s": round(proving, 3),
        "C++ s": None if cpp is None else round(cpp, 3),
        "Python s": round(python, 3),
        "C++ : run": None if cpp is None else round(cpp / alone, 2),
        "Python : run": round(python / alone, 1),
    }


def _certificate(family: str, seed: int) -> Row | None:
    """Return the least times of three runs after a first one; None if there is no certificate."""
    try:
        runs = [_certified(generate(family, seed)) for _ in range(4)]
    except (InputError, BudgetExceeded):
        return None
    search, write, check = (min(run[k] for _, *run in runs[1:]) for k in range(3))
    return {
        "family": family,
        "items": sum(len(body.edges) or 1 for body in generate(family, seed).bodies),
        "bytes": len(runs[0][0].text),
        "search ms": round(1e3 * search, 2),
        "write ms": round(1e3 * write, 2),
        "check ms": round(1e3 * check, 2),
        "write : search": round(write / search, 2),
        "check : search": round(check / search, 2),
        "both : search": round((write + check) / search, 2),
    }


def _cost(part: str, certified: list[Row]) -> Row:
    """Return the least, the median and the largest of a ratio."""
    ratios = [float(row[part] or 0) for row in certified]
    return {
        "cost": part,
        "certificates": len(ratios),
        "least": min(ratios),
        "median": round(median(ratios), 1),
        "largest": max(ratios),
    }


def _certified(scene: Scene) -> tuple[Proof, float, float, float]:
    """Return a certificate, and the times of the search, of writing and of checking it."""
    contact, search = timed(lambda: first_contact(scene, method="pairs"))
    proof, write = timed(lambda: certificate_of(scene, contact))
    proof_scene.rational.cache_clear()  # which knows the numbers of the run before
    return proof, search, write, timed(proof.check)[1]


def _shares(proof: Proof) -> Row:
    """Return the percentage of the time of each step, without other steps that it calls."""
    spent, running = defaultdict[str, float](float), ["else"]
    last = time.process_time()

    def charge() -> None:
        nonlocal last
        now = time.process_time()
        spent[running[-1]] += now - last
        last = now

    def timing(step: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def timed_function(*arguments: Any) -> Any:  # noqa: ANN401 - of any function
            charge()
            running.append(step)
            try:
                return function(*arguments)
            finally:
                charge()
                running.pop()

        return timed_function

    with ExitStack() as changed:
        for step, functions in STEPS.items():
            for owner, name in functions:
                changed.enter_context(patch.object(owner, name, timing(step, getattr(owner, name))))
        proof_check.check(proof.scene, proof.text)
    charge()
    whole = sum(spent.values())
    return {f"{step} %": round(100 * spent[step] / whole, 1) for step in (*STEPS, "else")}


def _in_cpp(proof: Proof) -> float | None:
    """The processor time of the checker in C++; None if it has not been built.

    Raises:
        AuditError: if it rejects the proof.
    """
    try:
        find_program()
    except InputError:
        return None
    with TemporaryDirectory() as folder:
        path = Path(folder) / "proof"
        proof.save(path)
        before = os.times()
        verdict = check_proof(f"{path}.scene.json", path)
        after = os.times()
    if not verdict.accepted:
        raise AuditError(verdict.line)
    used = (t.children_user + t.children_system for t in (after, before))
    return next(used) - next(used)
