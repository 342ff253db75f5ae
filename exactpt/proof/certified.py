"""Certificates of first contacts, by any search (docs/proofs.md).

Bodies are apart up to a time L, and two are in contact by a time H.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import combinations
from typing import TYPE_CHECKING, Any, Final, final

from exactpt.cached_property import cached_property
from exactpt.check_apart import is_bounded
from exactpt.errors import AuditError, BudgetExceeded, InputError
from exactpt.files import write_atomically
from exactpt.kernel.numbers import QQ, Rational, fraction, rational, shorten, show
from exactpt.motion.tileable import refuse_touching_rings
from exactpt.pair.contact import Contact
from exactpt.proof.apart import Separation
from exactpt.proof.degrees import refuse_degrees
from exactpt.proof.emit import may_write_beside, write_beside
from exactpt.proof.meeting import Meetings
from exactpt.proof.paths import Paths, short
from exactpt.proof.written import Proof
from exactpt.proof_scene import Rejected, written
from exactpt.scene.groups import groups_given
from exactpt.scene.scene import Scene, a_scene
from exactpt.scene.written import scene_bytes, to_json
from exactpt.search.first import first_contact
from exactpt.search.query import Selection
from exactpt.search.within import Approach, first_within

if TYPE_CHECKING:
    from exactpt.arrays.contacts import Contacts
    from exactpt.motion.body import Body
    from exactpt.search.first import ContactQuery, Search

NEAR: Final = 22
"""A contact is enclosed in a part 2^-20 of the time span: L is about 2^-22 of it before."""
MOST_WITH_OVERLAPPING_GROUPS: Final = 200
"""Maximum number of bodies of which all pairs that count are named."""


def certify(
    scene: Scene,
    *,
    distance: Rational = 0,
    at: Rational | None = None,
    between: Iterable[Sequence[str]] | None = None,
    ignoring: Iterable[Iterable[str]] = (),
    since: Rational | None = None,
) -> Proof:
    """Return the first contact or approach of two bodies, with a certificate (docs/proofs.md).

    >>> import exactpt
    >>> p = exactpt.Body("p", [(0, 0)], exactpt.Translation([0, 1]))
    >>> scene = exactpt.Scene([p, exactpt.Body("q", [(3, 0), (3, 1)])], time=(0, 9))
    >>> exactpt.certify(scene.until(2)).check().split(" ", 2)[2]
    'no two bodies share a point in [0, 2], the whole span'
    >>> exactpt.certify(scene, distance="1/2", at=2).check().split(" ", 2)[2][:41]
    'no two bodies are within 1/2 at t = 2; th'

    Args:
        scene: the scene.
        distance: a number >= 0; if it is not 0, the result is the first time at which two bodies
            are within this distance. So a distance less than the least one in the time span has a
            certificate that all stay farther apart.
        at: a time, at which alone bodies are shown to be farther apart than the distance.
        between: pairs of names; other pairs do not count.
        ignoring: groups of names and patterns as of a `Scene`, beside those of the scene; two
            bodies of one group do not count.
        since: a later start of the time span.

    Returns:
        The certificate, with the contact; if a distance or a time is given, ``contact`` is None.

    Raises:
        InputError: if the scene is none, a body or time does not exist, no pair counts, rings of a
            body touch, a coordinate has a degree above 64, a body is inside another body at that
            time, or the first contact is one of a body with itself.
        BudgetExceeded: if bodies come too near to each other before the contact, or are not
            farther apart than the distance at the time, or the contact is a touch without
            crossing at an irrational time.
    """
    a_scene(scene)
    _refuse_touching_rings(scene.bodies)
    groups = groups_given(ignoring)
    named = None if between is None else list(between)
    d, part = rational(distance), scene
    if d < 0:
        raise InputError(f"distance: a number >= 0 is needed, not {show(d)}")
    contact: Contact | None = None
    approach: Approach | None = None
    span = fraction(scene.exact_start), fraction(scene.exact_end)
    if at is not None:
        t = rational(at)
        if not scene.exact_start <= t <= scene.exact_end:
            raise InputError(f"at: {show(t)} is not in the time span of the scene")
        span = fraction(t), fraction(t)
    else:
        part = scene if since is None else scene.since(since)
        span = fraction(part.exact_start), span[1]
        if d:
            approach = first_within(part, distance=distance, between=named, ignoring=groups)
        else:
            contact = first_contact(part, between=named, ignoring=groups)
    file = scene_bytes(scene)
    made = _Certificate(part, file, Selection(scene, named, groups), fraction(d))
    proof = Proof(contact, file, made.text(contact or approach, *span))
    if at is not None:  # no search has seen whether a body is inside another
        try:
            proof.check()
        except AuditError:
            raise InputError(f"a body is inside another body at t = {shorten(at)}") from None
    return proof


def certificate_of(scene: Scene, contact: Contact | None, file: bytes | None = None) -> Proof:
    """Return the certificate of a first contact that is known. Raises: as `certify`."""
    content = scene_bytes(scene) if file is None else file
    made = _Certificate(scene, content, Selection(scene), Fraction(0))
    return Proof(contact, content, made.text(contact, made.start, made.end))


def certify_rows(contacts: Contacts) -> Proof:
    """Return the certificates of all results of `exactpt.arrays.first_contacts`, in one file.

    Its scene file has a line for each pair, the scene of its two bodies. A pair that is refused,
    or whose contact has no certificate, is "open": nothing is shown of it.
    """
    scenes, rows = list[str](), list[str]()
    for k in range(len(contacts)):
        scene = contacts.scene(k)
        scenes.append(json.dumps(to_json(scene), separators=(",", ":")))
        try:
            text = certificate_of(scene, contacts.contact(k), b"").text.decode()
            rows.append(";".join(text.splitlines()[2:]))
        except (InputError, BudgetExceeded):
            rows.append("open")
    file = "".join(f"{line}\n" for line in scenes).encode()
    head = ["exactpt-apart-rows 1", f"scenes sha256 {hashlib.sha256(file).hexdigest()}"]
    return Proof(None, file, "".join(f"{line}\n" for line in [*head, *rows]).encode())


def _refuse_touching_rings(bodies: Iterable[Body]) -> None:
    """Refuse bodies that the checkers do not accept: those with rings that touch.

    Raises:
        InputError: if there is one.
    """
    refuse_touching_rings(bodies, "there is no certificate about such bodies yet")


@final
class CertifiedSearch:
    """A search for the first contact, with a certificate of its result.

    Args:
        search: the search.
        scene: the bodies and the time span of the search.
        question: the question, with the path of the certificate, and the scene's file or a scene
            with an earlier start.
    """

    def __init__(self, search: Search, scene: Scene, question: ContactQuery) -> None:
        assert question.certificate is not None  # noqa: S101
        self._search, self._path = search, question.certificate
        self._file = question.scene_file or scene_bytes(question.given or scene)
        may_write_beside(self._path, self._file)  # refused before the search, not after it
        selection = Selection(scene, question.between, question.ignoring)
        self._made = _Certificate(scene, self._file, selection, Fraction(0))

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - of the search
        return getattr(self._search, name)

    def run_to_contact(self) -> Contact | None:
        """Write the certificate, and return the first contact, or None. Raises: as `certify`."""
        found = self._search.run_to_contact()
        try:
            text = self._made.text(found, self._made.start, self._made.end)
        except BudgetExceeded as spent:
            spent.answer = (found,)
            raise
        write_beside(self._path, self._file)
        write_atomically(self._path, text)
        return found


def _stated(selection: Selection, count: int) -> tuple[Sequence[int], list[tuple[int, int]] | None]:
    """Return the pairs that count in the two forms that a certificate can state.

    Args:
        selection: the pairs that count.
        count: the number of bodies.

    Returns:
        a number for each body, such that bodies with equal ones do not count as a pair; and the
        pairs that count, by name, or None if the numbers say it all. A body has one number in a
        certificate: where a body is in several groups, all pairs that count are named.

    Raises:
        InputError: if these pairs are too many.
    """
    alone = range(count)
    if selection.named is not None:
        return alone, selection.named
    groups = selection.disjoint_groups()
    if groups is None and not selection.of(combinations(alone, 2)):
        return [count] * count, None  # no pair counts: as if all were in one group
    if groups is None:
        if count > MOST_WITH_OVERLAPPING_GROUPS:
            raise InputError(
                f"a certificate names each pair that counts where a body is in several groups that "
                f"ignore each other: of at most {MOST_WITH_OVERLAPPING_GROUPS} bodies, got {count};"
                " give between="
            )
        return alone, selection.of(combinations(alone, 2))
    numbers = list(alone)
    for group in groups:
        for i in group:
            numbers[i] = count + group[0]
    return numbers, None


@final
class _Certificate:
    """The certificate of a first contact of the pairs of bodies that count.

    Args:
        scene: the bodies and the time span.
        file: the bytes of the scene's file.
        selection: the pairs that count.
        distance: the distance that they keep.
    """

    def __init__(self, scene: Scene, file: bytes, selection: Selection, distance: Fraction) -> None:
        _refuse_touching_rings(scene.bodies)
        refuse_degrees(scene.bodies)
        self.start, self.end = fraction(scene.exact_start), fraction(scene.exact_end)
        self._file, self._distance = file, distance
        self._number = {body.name: i for i, body in enumerate(scene.bodies)}
        self._bodies = scene.bodies
        self._group, self._named = _stated(selection, len(scene.bodies))
        if self._named == []:
            raise InputError("no pair of bodies counts: there is nothing to certify")

    @cached_property
    def _paths(self) -> Paths:
        return Paths(self._bodies, self._distance, (self.start, self.end))

    @cached_property
    def _meetings(self) -> Meetings:
        return Meetings(self._paths)

    def _counts(self, bodies: set[int]) -> bool:
        """See `exactpt.check_apart.Checker.count`."""
        if self._named is None:
            return len({self._group[i] for i in bodies}) > 1
        if len(bodies) ** 2 < len(self._named):
            return not self._named_set.isdisjoint(combinations(sorted(bodies), 2))
        return any(i in bodies and j in bodies for i, j in self._named)

    @cached_property
    def _named_set(self) -> frozenset[tuple[int, int]]:
        return frozenset(self._named or ())

    def text(self, found: Contact | Approach | None, start: Fraction, end: Fraction) -> bytes:
        """Return the bytes of the certificate. Raises: as `certify`."""
        try:
            return self._text(found, start, end)
        except OverflowError:
            raise BudgetExceeded(
                "no certificate: a number is out of the range of doubles", None
            ) from None

    def _text(self, found: Contact | Approach | None, start: Fraction, end: Fraction) -> bytes:
        last, until = ["none"], end
        if found is not None:
            last, until = self._last(found, start)
        head = ["exactpt-apart 1", f"scene sha256 {hashlib.sha256(self._file).hexdigest()}"]
        head.append(f"span {written(start)} {written(until)}")
        head += self._chosen()
        if self._distance:
            head.append(f"distance {written(self._distance)}")
        if found is None or start < until:
            head += Separation(self._paths, self._group, self._counts, self._named).lines(
                start, until
            )
        lines = [*head, *last]
        if not all(is_bounded(line.split()) for line in lines):
            raise BudgetExceeded("no certificate: a number has more than 10,000 digits", None)
        return "".join(f"{line}\n" for line in lines).encode()

    def _chosen(self) -> Iterator[str]:
        """Yield the lines that select the pairs that count."""
        if self._named is not None:  # those that ignore each other are not among them
            yield from (f"between {i} {j}" for i, j in self._named)
            return
        groups: dict[int, list[int]] = {}
        for i, group in enumerate(self._group):
            groups.setdefault(group, []).append(i)
        yield from (
            f"ignoring {' '.join(map(str, some))}" for some in groups.values() if len(some) > 1
        )

    def _last(self, found: Contact | Approach, start: Fraction) -> tuple[list[str], Fraction]:
        """Return the last line, which shows a contact, and a time up to which there is none."""
        if isinstance(found, Contact):  # without the points and normals of its incidences
            names, time, touches = (
                found.initial_pairs,
                found.exact_time,
                found.exact_incidences(self._number),
            )
        else:
            names, time, touches = found.pairs, found.time, []
        touches = [touch for touch in touches if touch.body != touch.other]
        pairs = {(touch.body, touch.other) for touch in touches}
        pairs |= {(self._number[a], self._number[b]) for a, b in names}
        if not pairs:
            raise InputError("there is no certificate of a contact of a body with itself")
        width = QQ((self.end - start) / 2 ** (NEAR + 5))
        time.refine_to(width)
        while time.exact_low <= start and time.compare_rational(start) > 0:
            width /= 2**16
            time.refine_to(width)
        low, high = fraction(time.exact_low), fraction(time.exact_high)
        if high == start:
            return [self._meetings.at(sorted(pairs), touches, start)], start
        near = (self.end - start) / 2**NEAR * (3 if low == high else 1)
        near = min(near, (low - start) / 4)
        until = fraction(short(rational(low - near), float(near) / 4))
        units = (rational(high + near * k / 4) for k in (1, 4, 7))
        later = (fraction(short(t, float(near) / 8)) for t in units)
        times = [high] * (low == high) + [min(t, self.end) for t in later]
        for t in times:
            with suppress(Rejected):
                return [self._meetings.at(sorted(pairs), touches, t)], until
        for touch in touches:
            if touch.edge >= 0:
                v = self._paths.first[touch.body] + touch.vertex
                item = self._meetings.items(touch.other)[touch.edge]
                with suppress(Rejected):
                    return [self._meetings.passage(v, item, until, low, high, times[-1])], until
        raise BudgetExceeded(
            "a touch without crossing, at an irrational time, has no certificate", None
        )
