"""The benchmarks by name; the module of each is imported when it is run."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from benchmarks.output import Output, Row

__all__ = ["BENCHMARKS", "run"]

BENCHMARKS: Final[dict[str, str]] = {
    "first-contact": "run time against error in the time of the first contact",
    "small": "small questions, building scenes, plans among obstacles, many pieces of motion",
    "crowds": "the first contact of crowds built from arrays and from bodies",
    "doubles": "first contacts of straight bodies beside plain C++ doubles, the floor of run time",
    "auto": "the default method beside all others, on twenty families of everyday scenes",
    "cliffs": "convoys, long spans, turning bodies, lanes: beside the best method",
    "exponents": "how run time grows, on 52 families of questions at three sizes",
    "motions": "first contacts in any motion by turns with version 0.2, with what was aimed at",
    "counts": "slabs, pairs, comparisons, exact decisions: of 30 families of scenes at five sizes",
    "within": "first_within beside first_contact, of the same crowds",
    "wrong-answers": "contacts missed, invented and late, close to degeneracy",
    "arithmetic": "wrong signs, orders and structures by kind of number",
    "stability": "the same answer, and its cost, for extreme input",
    "scaling": "events, certificates, time and memory against the size of a scene",
    "changes": "changes of the tilings of convex bodies beside the paper's bounds",
    "large": "runs of up to a million bodies from arrays: start, memory, events, as users run them",
    "living": "bodies that bounce: contacts a second, audits, changes of plans",
    "points": "changes of the tilings of moving points beside the paper's bounds",
    "statics": "the greedy pseudo-triangulation of one instant against the vertices of a body",
    "skipping": "what is never computed, beside a run that computes all of it",
    "arrays": "many small questions at once, beside one by one, ipctk and Box2D",
    "batch": "many scenes by `exactpt batch`: time and memory, beside one by one",
    "engines": "wrong answers of other engines to hard questions, with reproducers",
    "proofs": "size and cost of proofs and certificates of first contacts, beside the run alone",
    "space": "the two elementary queries in space: other programs against the exact times",
    "kernel": "first roots and their order, beside python-flint, SymPy and mpmath",
}
"""Name of each benchmark, and what it shows."""


def run(name: str, output: Output, *, quick: bool, seed: int) -> list[Row] | None:
    """Run one benchmark; the rows of its table where it returns them.

    Args:
        name: one of `BENCHMARKS`.
        output: the destination of its tables and plots.
        quick: whether to use sizes that take seconds, not minutes.
        seed: seed of everything random.
    """
    module = import_module(f"benchmarks.{name.replace('-', '_')}")
    output.begin(name, BENCHMARKS[name])
    rows: list[Row] | None = module.run(output, module.QUICK if quick else module.FULL, seed)
    return rows
