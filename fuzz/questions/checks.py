"""One case of each question: the answers, and whether they are those of the definition."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Final, NamedTuple

from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ, rational
from exactpt.pair.start import initial_touches
from exactpt.pseudotriangulation.flip import flip
from exactpt.pseudotriangulation.shadow import shadow
from exactpt.scene.scene import Scene
from exactpt.scene.written import to_json
from exactpt.search.clearance import Clearance
from exactpt.search.surroundings import clearance
from exactpt.search.within import first_within
from exactpt.testing.audits import audit_certificates
from exactpt.testing.scenes import generate
from exactpt.testing.space.queries import SpaceQuery
from exactpt.tiling.engine import Engine
from exactpt.tiling.start import start_tiling
from fuzz import filter_attacks, overlays
from fuzz.questions import by_cgal
from fuzz.questions.batched import wrong_in_batch
from fuzz.questions.convoys import wrong_in_convoy
from fuzz.questions.curves import wrong_along
from fuzz.questions.in_arrays import wrong_in_arrays
from fuzz.questions.scenes import distant_scene
from fuzz.questions.space import small_query, wrong_in_space
from fuzz.questions.spinning import case_of, path_scene, spinning_scene
from fuzz.questions.stated import stated_case, wrong_after_moves, wrong_at_the_start
from fuzz.questions.touching_rings import touching_pair, wrong_validity
from fuzz.questions.touching_rings import wrong_answer as wrong_answer_of_touching
from fuzz.small_scope.look import looks
from fuzz.small_scope.scope import planned, sizes

HOSTILE: Final = 50
FLIPPED: Final = ("linear_points", "ballistic_points", "turning_points")
FLIPS: Final = 30
DEGREES: Final = (1, 2, 2, 2, 3, 4, 5, 6)

__all__ = ["QUESTIONS", "Checked", "checked"]


class Checked(NamedTuple):
    """A case that has been checked.

    Attributes:
        scene: its scene, the query in space, the case of a filter, or the drawing.
        kind: what happens in it, for the table of a run.
        fault: a difference from the definition; None without one.
        signs: number of signs, roots and orders that CGAL has decided.
    """

    scene: Scene | SpaceQuery | filter_attacks.Case | overlays.Drawing
    kind: str
    fault: str | None
    signs: int = 0

    def to_json(self) -> object:
        """Return the scene, query or case as a JSON object."""
        return to_json(self.scene) if isinstance(self.scene, Scene) else self.scene.to_json()


def checked(question: str, seed: int, number: int) -> Checked:
    """Check the case of a question with this number."""
    return QUESTIONS[question](Random(f"{question} {seed} {number}"))


def _asked(random: Random, scene: Scene, gap: Clearance) -> QQ:
    """A squared distance: small, that at some time, or the least if that is rational."""
    least = gap.minimum.squared.simplified()
    choices = [QQ(random.choice([0, 1, 2, 4, 5]), random.choice([1, 2, 9]))]
    choices.append(rational(gap.squared(random.randint(int(scene.start), int(scene.end)))))
    if least.is_rational:
        choices.append(least.exact_low)
    return random.choice(choices)


def _cgal(random: Random) -> Checked:
    """Signs at the time of first_within, and the minimum of clearance, by CGAL."""
    scene = distant_scene(random)
    gap = clearance(scene, "a", "b")
    squared = _asked(random, scene, gap)
    time = first_within(scene, "a", "b", distance_squared=squared)
    signs, fault = by_cgal.compare(scene, gap, squared, time)
    return Checked(scene, "never" if time is None else "within", fault, signs)


def _spin(random: Random) -> Checked:
    """first_contact_enclosed of bodies that turn at a constant rate."""
    scene = spinning_scene(random)
    return Checked(scene, *case_of(scene))


def _path(random: Random) -> Checked:
    """first_contact_enclosed of bodies that move on paths of poses."""
    scene = path_scene(random)
    return Checked(scene, *case_of(scene))


def _curves(random: Random) -> Checked:
    """Motions along curves with jumps, against the given curves."""
    return Checked(*wrong_along(random))


def _stated(random: Random) -> Checked:
    """first_contact_enclosed at the start, of bodies with stated errors of their places."""
    case = stated_case(random)
    kind, fault = wrong_at_the_start(case)
    return Checked(case.scene, kind, fault or wrong_after_moves(random, case))


def _space(random: Random) -> Checked:
    """Compare first contacts in space, one by one and in an array."""
    query = small_query(random)
    return Checked(query, *wrong_in_space(query))


def _touching_rings(random: Random) -> Checked:
    """Whether bodies whose rings touch are valid, and all questions about pairs of them."""
    if random.random() < 0.5:
        scene, fault = wrong_validity(random)
        return Checked(scene or Scene([]), "valid or not", fault)
    scene = touching_pair(random)
    return Checked(scene, *wrong_answer_of_touching(random, scene))


def _filters(random: Random) -> Checked:
    """Float filters near the limits of their bounds, and polynomials at the ends of these."""
    sure, at = 0, filter_attacks.hostile(random, 2)
    for _ in range(HOSTILE):
        said = filter_attacks.answer(at)
        sure += said[0] != 0
        if len(at.c) < 4 and filter_attacks.answers([at]) != [said]:
            return Checked(at, "wrong", f"{said}, but {filter_attacks.answers([at])} in arrays")
        for case in (at, *filter_attacks.variants(random, at, said)):
            if fault := filter_attacks.judge(case, said):
                return Checked(case, "wrong", f"degree {len(case.c) - 1}, {said}: {fault}")
        make = random.choice([filter_attacks.hostile, filter_attacks.extreme])
        at = make(random, random.choice(DEGREES))
    return Checked(at, f"{10 * round(10 * sure / HOSTILE)} % decided", None)


def _flips(random: Random) -> Checked:
    """Flips of a pseudo-triangulation, after which no certificate is missing or stale."""
    scene = generate(random.choice(FLIPPED), random.getrandbits(20))
    if any(initial_touches(scene)):
        return Checked(scene, "a contact at the start", None)
    tiling = start_tiling(scene, "lazy", scene.start)
    assert isinstance(tiling, Engine)  # noqa: S101
    certified, done = tiling.certified, 0
    flippable = [*certified.mesh.flippable()]
    for h in random.choices(flippable, k=FLIPS if flippable else 0):
        visits = None
        if certified.mesh.map.origin[h] >= 0 and certified.mesh.is_flippable(h):
            visits = shadow(certified.mesh, h, certified.after())
        if visits is not None:
            certified.recertify(flip(certified.mesh, h, visits, certified.after()))
            done += 1
            try:
                audit_certificates(tiling)
            except AuditError as error:
                return Checked(scene, "wrong", f"after {done} flips: {error}")
    return Checked(scene, f"{10 * (done // 10)} flips", None)


def _scope(random: Random) -> Checked:
    """A scene of the small scope by all methods, see `fuzz.small_scope`."""
    number = random.randrange(sum(sizes().values()))
    one = planned(number)
    (seen,) = looks([one])
    faults = [answer for answer in seen.answers if answer.fault is not None]
    said = "; ".join(f"{answer.method}: {answer.fault}" for answer in faults)
    kind = "no contact" if seen.contact is None else seen.contact.kind
    return Checked(one.scene, kind, f"scene {number}: {said}" if faults else None)


def _overlay(random: Random) -> Checked:
    """The parts that rings fill by each rule, and the union of the parts of each ring."""
    drawing = overlays.random_drawing(random)
    return Checked(drawing, drawing.kind, overlays.fault_of_drawing(drawing))


def _convoy(random: Random) -> Checked:
    """The first contact of a crowd that moves almost alike for a very long time."""
    return Checked(*wrong_in_convoy(random))


def _batch(random: Random) -> Checked:
    """A batch of pairs of turning bodies that touch at the start, and each by itself."""
    return Checked(*wrong_in_batch(random))


def _arrays(random: Random) -> Checked:
    """Pairs of rounded bodies in arrays of doubles, and each by itself."""
    return Checked(*wrong_in_arrays(random))


QUESTIONS: Final[dict[str, Callable[[Random], Checked]]] = {
    "small-scope": _scope,
    "flips": _flips,
    "overlay": _overlay,
    "filters": _filters,
    "convoy": _convoy,
    "batch": _batch,
    "arrays": _arrays,
    "touching-rings": _touching_rings,
    "spin": _spin,
    "cgal": _cgal,
    "space": _space,
    "path": _path,
    "stated": _stated,
    "curves": _curves,
}
"""A function from random choices to a case, by question; what most mistakes show in is first."""
