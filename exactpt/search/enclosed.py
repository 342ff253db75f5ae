"""Bounds of the time of the first contact, where places of bodies are known within an error.

The pieces of a `Spin`, a `PosePath` or a `Spline` keep each point of body i within e_i of its true
place (`exactpt.motion.displacement`); for other motions e_i = 0.

**Lower bound.** Where two true bodies touch, the given ones are within e_i + e_j: with their
radii larger by e_i and e_j they touch. So no two true bodies touch before the first contact
of the bodies with these radii; nor at all, if there is none. A body that deforms and turns touches
itself when it would without turning, at a time that is known exactly.

**Upper bound.** At certain rational times the given bodies are tested by
`exactpt.pair.sure`: where one pair is sure to touch, the true first contact is not later; nor
where a point is sure to have passed through an edge since a time as long before the contact of the
given bodies. Two bodies with e_i + e_j = 0, and a body and itself, touch at a time known exactly.

**At the start** of the scene the bounds are equal if a contact there is certain. A touch or an
overlap of the given bodies is not enough. Let s_i be the error of body i at the start where it is
known best (`exactpt.motion.displacement.placed_at`). If its formula has the angle 0 there, s_i
is only its assumed error: the bound that a caller stated (`PosePath.with_place_error`), and the
jumps of a curve that were closed. Errors of fitting are not in it: the body is put where the
formula puts it.
Otherwise s_i = e_i. The contact is certain if and only if the true bodies touch wherever they are
within these errors: after every rigid move by them. `exactpt.pair.sure.surely_meet` proves it from
the overlap, which must be at least s_i + s_j (the radii count as overlap); for convex bodies its
condition is necessary, too. So where s_i + s_j > 0 a mere touch is never certain, and where s_i +
s_j = 0 it always is. If no contact at the start is certain, and one is possible, the lower bound is
the start, and the upper bound a later time, if any.

**Width.** Let one pair be concerned, in the approach of a vertex to an edge at a speed of at
least v, and E = e_i + e_j. From the lower bound on, the distance falls by E to that of a contact
in at most E / v, and when it has fallen by another E, in at most E / v, the bodies are sure to
touch, unless an end of the edge is near or the body behind it is thin. Times are tested from the
contact of the given bodies on, in steps of an eighth of the first part, later of a quarter of the
time since then, which are halved to a sixteenth of the whole: the width is at most 17/16 * 2 E /
v. Steps never exceed 1/256 of the time span: a contact that is sure for less may be passed over.
Then the upper bound is that of a later one, or there is none.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError, carrying
from exactpt.geometry.polygon import near_groups
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, ceil, exponent, power_of_two, shorten
from exactpt.motion.body import Body
from exactpt.motion.displacement import Placed, displacement, placed_at
from exactpt.motion.outline import may_touch_itself
from exactpt.pair.contact import Contact
from exactpt.pair.distance import compare_distance
from exactpt.pair.straight import Earliest
from exactpt.pair.sure import surely_meet, surely_passed
from exactpt.scene.scene import Scene, a_scene, scene_of
from exactpt.search.first import first_contact
from exactpt.search.query import Selection

STEPS: Final = 256
"""Minimum number of steps of a whole time span."""
FINEST: Final = 60
"""Binary digits of the number of the shortest steps in a time span."""


@final
@dataclass(frozen=True, slots=True)
class EnclosedContact:
    """Bounds of the time of the first contact, if places are known within an error.

    Attributes:
        low: no two bodies touch before this time.
        high: two bodies touch at this time or before; None if they may just miss each other up to
            the end of the time span.
        pairs: the names of the pairs that may touch at ``low``, each in the order of the scene;
            a body that touches itself is a pair with itself.
    """

    low: AlgebraicNumber
    high: AlgebraicNumber | None
    pairs: tuple[tuple[str, str], ...]

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def is_certain(self) -> bool:
        """True if there is a contact for sure; its time is in [low, high]."""
        return self.high is not None

    def to_json(self) -> dict[str, object]:
        """Return the bounds as a JSON object, see docs/format.md."""
        return {
            "low": self.low.to_json(),
            "high": None if self.high is None else self.high.to_json(),
            "pairs": [list(pair) for pair in self.pairs],
        }


def first_contact_enclosed(
    scene: Scene,
    *,
    between: Iterable[Sequence[str]] | None = None,
    ignoring: Iterable[Iterable[str]] = (),
) -> EnclosedContact | None:
    """Return bounds of the time of the first contact, each `Spin` or `PosePath` at its true angle.

    The result of `first_contact` is about the rational pieces of a motion, this result about the
    angle omega t, or the path of poses, itself, and about all places within the errors that are
    stated (`PosePath.with_place_error`): the first contact in the closed time span is in [low,
    high]; or there is one from low on, or none, since bodies may just miss each other (``high`` is
    None). A stated error counts at every time. So bodies that merely touch at the start are not
    certain to touch if one of them has such an error.

    >>> from exactpt import Body, PosePath, Scene, Spin
    >>> blade = Body("blade", [(0, 0), (2, 0)], Spin(1, error="1/1000"))
    >>> post = Body("post", [(-1, 1), (1, 1), (1, 2), (-1, 2)])
    >>> bounds = first_contact_enclosed(Scene([blade, post], time=(0, 2)))
    >>> float(bounds.low) < 0.7853981633974483 < float(bounds.high)  # pi / 4
    True
    >>> float(bounds.high) - float(bounds.low) < 0.01
    True
    >>> path = PosePath([0, 2], [(1, 0, 0)]).with_place_error("1/10")
    >>> scene = Scene([Body("probe", [(0, 0)], path), Body("wall", [(1, -5), (1, 5)])], time=(0, 2))
    >>> first_contact_enclosed(scene)
    EnclosedContact(low=AlgebraicNumber('0'), high=None, pairs=(('probe', 'wall'),))

    Args:
        scene: the bodies, their motions and the time span. Without a `Spin`, a `PosePath` or a
            `spline` both bounds are the exact time.
        between: pairs of names; contacts of other pairs do not count, nor do those of a body
            with itself. All if not given.
        ignoring: groups of names and patterns as of a `Scene`, beside those of the scene.
            Contacts between two bodies of one group are ignored.

    Returns:
        The bounds; None if bodies certainly do not touch.

    Raises:
        InputError: if the scene is not a `Scene`, a name is unknown, a group is wrong, or a named
            pair is ignored; or if an error is stated of a body itself (`Body.with_errors`): the
            bounds do not take these into account.
    """
    a_scene(scene)
    _refuse_stated_errors(scene)
    with carrying(lambda: scene):
        return _Search(scene, Selection(scene, between, ignoring)).run()


def _refuse_stated_errors(scene: Scene) -> None:
    """Refuse a scene with errors that the bounds would not obey."""
    for body in scene.bodies:
        for key, value in body.exact_errors.given().items():
            raise InputError(
                f"body {shorten(body.name)}: {key}: first_contact_enclosed obeys errors of motions "
                f"only, got {shorten(value)}; leave it out"
            )


@final
class _Start(NamedTuple):
    """The contacts of true bodies at the start.

    Attributes:
        possible: the names of the pairs that may touch there.
        is_certain: True if one of them certainly touches.
    """

    possible: tuple[tuple[str, str], ...]
    is_certain: bool


@final
class _Search:
    def __init__(self, scene: Scene, selection: Selection) -> None:
        self._scene = scene
        self._selection = selection
        self._number = {body.name: i for i, body in enumerate(scene.bodies)}
        self._start, self._end = scene.exact_start, scene.exact_end
        self._errors = [displacement(body, self._start, self._end) for body in scene.bodies]
        self._contact = (
            scene.exact_start
        )  # a rational just after the first contact of the given bodies
        self._passing: list[tuple[Body, Body, int, QQ]] = []  # the points on edges at that time

    def run(self) -> EnclosedContact | None:
        exact = self._known()
        known = exact[0].time if exact else None
        bodies = zip(self._scene.bodies, self._errors, strict=True)
        wide = [body.with_radius(body.exact_radius + e) if e else body for body, e in bodies]
        touch = self._first(wide)
        if touch is None or (known is not None and known < touch.time):
            return None if known is None else EnclosedContact(known, known, self._pairs(*exact))
        pairs = self._pairs(touch)
        if touch.time == self._start:
            start = self._at_start(touch)
            if start.is_certain:
                return EnclosedContact(touch.time, touch.time, start.possible)
            pairs = start.possible or pairs
        sure = self._sure(touch.time, known)
        high = known if sure is None else AlgebraicNumber(sure)
        return EnclosedContact(touch.time, high, pairs)

    def _first(self, bodies: Sequence[Body]) -> Contact | None:
        """Return the first contact that counts of bodies with these names."""
        # Not `Scene.going_on`: the selection has the groups of the scene, too.
        scene = scene_of(bodies, self._start, self._end)
        return first_contact(scene, **self._selection.among(bodies))

    def _pairs(self, *contacts: Contact) -> tuple[tuple[str, str], ...]:
        """Return the names of the pairs that touch, in the order of the scene."""
        order = self._number
        met = {(pair.body, pair.other) for contact in contacts for pair in contact.pairs}
        met.update(pair for contact in contacts for pair in contact.initial_pairs)
        return tuple(sorted({(a, b) if order[a] <= order[b] else (b, a) for a, b in met}))

    def _at_start(self, touch: Contact) -> _Start:
        """Return the contacts at the start, of bodies that are known best at that time."""
        by_name = {
            body.name: placed_at(body, self._start, error) if error else Placed(body, error)
            for body, error in zip(self._scene.bodies, self._errors, strict=True)
        }
        possible, is_certain = list[tuple[str, str]](), False
        for pair in self._pairs(touch):  # of different bodies: each is simple at the start
            check_budget()
            a, b = (by_name[name] for name in pair)
            error = a.error + b.error
            if _may_meet(a.body, b.body, self._start, error):
                possible.append(pair)
                is_certain = is_certain or surely_meet(a.body, b.body, self._start, error)
        return _Start(tuple(possible), is_certain=is_certain)

    def _known(self) -> list[Contact]:
        """Return the first contacts among those whose times are exact."""
        bodies = list(zip(self._scene.bodies, self._errors, strict=True))
        parts = [[body for body, e in bodies if not e]]
        parts += [[body] for body, e in bodies if e and may_touch_itself(body)]
        first: Earliest[Contact] = Earliest()
        for part in parts:
            contact = self._first(part)
            if contact is not None:
                first.add(contact.time, [contact])
        return first.found

    def _sure(self, low: AlgebraicNumber, known: AlgebraicNumber | None) -> QQ | None:
        """Return a time at which two bodies are sure to touch, before a known one."""
        contact = self._first(self._scene.bodies)
        if contact is None:
            return None
        contact.time.refine_to((self._end - self._start) * power_of_two(-FINEST))
        self._contact = contact.time.exact_high
        self._passing = self._points_on_edges(contact)
        before: QQ | None = None
        for t in self._times(low, contact.time):
            check_budget()
            if known is not None and t >= known:
                return None
            if self._is_sure(t):
                return t if before is None else self._earlier(low, before, t)
            before = t
        return None

    def _times(self, low: AlgebraicNumber, begin: AlgebraicNumber) -> Iterator[QQ]:
        """Rational times from a contact of the given bodies to the end, increasing."""
        span = self._end - self._start
        finest = span * power_of_two(-FINEST)
        for time in (low, begin):
            time.refine_to(finest)
        first, step = begin.exact_high, max((begin.exact_high - low.exact_low) / 8, finest)
        t = first
        while t < self._end:
            yield t
            step = min(max(step, (t - first) / 4), span / STEPS)
            unit = power_of_two(exponent(step) - 4)
            t = ceil((t + step) / unit) * unit
        yield self._end

    def _earlier(self, low: AlgebraicNumber, before: QQ, sure: QQ) -> QQ:
        """Return a time of certain contact of two bodies, near a time of possible contact."""
        while sure - before > (sure - low.exact_low) / 16:
            check_budget()
            middle = (before + sure) / 2
            before, sure = (before, middle) if self._is_sure(middle) else (middle, sure)
        return sure

    def _points_on_edges(self, contact: Contact) -> list[tuple[Body, Body, int, QQ]]:
        """Return points on edges in a contact: the bodies, the edge and the sum of the errors."""
        error = {b.name: e for b, e in zip(self._scene.bodies, self._errors, strict=True)}
        return [
            (body, self._scene.body(pair.other), pair.edge, error[pair.body] + error[pair.other])
            for pair in contact.pairs
            for body in [self._scene.body(pair.body)]
            if body.size == 1 and pair.edge is not None
        ]

    def _is_sure(self, t: QQ) -> bool:
        since = max(2 * self._contact - t, self._start)
        if any(surely_passed(a, b, edge, since, t, e) for a, b, edge, e in self._passing):
            return True
        bodies = self._scene.bodies
        return any(
            surely_meet(bodies[i], bodies[j], t, self._errors[i] + self._errors[j])
            for i, j in self._selection.of(near_groups([_corners(body, t) for body in bodies]))
        )


def _may_meet(a: Body, b: Body, t: QQ, error: QQ) -> bool:
    """Return True if two bodies, of which a point is out of place by an error, may touch at t."""
    reach = a.exact_radius + b.exact_radius + error
    return compare_distance(a, b, t, reach * reach) <= 0


def _corners(body: Body, t: QQ) -> list[tuple[QQ, QQ]]:
    """Return two corners of a box that contains a body."""
    (left, right), (bottom, top) = ((min(c), max(c)) for c in zip(*body.exact_at(t), strict=True))
    r = body.exact_radius
    return [(left - r, bottom - r), (right + r, top + r)]
