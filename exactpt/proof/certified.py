"""Certificates of answers by any search: bodies apart up to L, in contact by H (docs/proofs.md)."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Collection, Iterable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import TYPE_CHECKING, Final, final

import numpy as np

from exactpt.check_apart import WORK, Rejected, are_near, require_passage, surrounds
from exactpt.collision.detector import first_contact
from exactpt.errors import BudgetExceeded, InputError
from exactpt.files import write_atomically
from exactpt.kernel.numbers import QQ, Rational, fraction, rational
from exactpt.pairs.approach import Approach, first_within
from exactpt.pairs.selection import Selection
from exactpt.proof.apart import Floats, Paths, Separation, short
from exactpt.proof.degrees import refuse_degrees
from exactpt.proof.emit import beside, scene_bytes
from exactpt.proof.written import Proof
from exactpt.scene.scene import Scene, a_scene
from exactpt.scene.written import to_json

if TYPE_CHECKING:
    from exactpt.arrays.contacts import Contacts
    from exactpt.collision.search import Search
    from exactpt.collision.searches import Question
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.pairs.contact import Contact

__all__ = ["CertifiedSearch", "certificate_of", "certify", "certify_rows"]

NEAR: Final = 22
"""A contact is enclosed in a part 2^-20 of the time span: L is about 2^-22 of it before."""


def certify(
    scene: Scene,
    *,
    distance: Rational = 0,
    at: Rational | None = None,
    between: Iterable[Sequence[str]] | None = None,
    ignoring: Iterable[Collection[str]] = (),
    since: Rational | None = None,
) -> Proof:
    """The first contact or approach of two bodies, with a certificate (docs/proofs.md).

    >>> import exactpt
    >>> p = exactpt.Body("p", [(0, 0)], exactpt.Translation([0, 1]))
    >>> scene = exactpt.Scene([p, exactpt.Body("q", [(3, 0), (3, 1)])], time=(0, 9))
    >>> exactpt.certify(scene.until(2)).check().split(" ", 2)[2]
    'no two bodies share a point in [0, 2], the whole span'
    >>> exactpt.certify(scene, distance="1/2", at=2).check().split(" ", 2)[2][:41]
    'no two bodies are within 1/2 at t = 2; th'

    Args:
        scene: the scene.
        distance: a number >= 0; if it is not 0, the answer is the first time at which two bodies
            are within this distance, by the Euclidean norm. So a distance less than the least
            one in the time span has a certificate that all stay farther apart.
        at: a time, at which alone bodies are shown to be farther apart than the distance.
        between: pairs of names; other pairs do not count.
        ignoring: groups of body names; two bodies of one group do not count.
        since: a later start of the time span.

    Returns:
        The certificate, with the contact; if a distance or a time is given, ``contact`` is None.

    Raises:
        InputError: if the scene is none, there is no such body or time, no pair counts, a
            coordinate has a degree above 64, bodies are not farther apart than the distance
            at the time, or the first contact is one of a body with itself.
        BudgetExceeded: if bodies come too near to each other before the contact, or it is a touch
            without crossing at an irrational time.
    """
    a_scene(scene)
    groups = ignoring if isinstance(ignoring, str) else list(ignoring)
    named = None if between is None else list(between)
    d, part = rational(distance), scene
    if d < 0:
        raise InputError(f"distance: a number >= 0 is needed, not {distance}")
    contact: Contact | None = None
    approach: Approach | None = None
    span = fraction(scene._start), fraction(scene._end)
    if at is not None:
        t = rational(at)
        if not scene._start <= t <= scene._end:
            raise InputError(f"at: {at} is not in the time span of the scene")
        span = fraction(t), fraction(t)
    else:
        part = scene if since is None else scene.since(since)
        span = fraction(part._start), span[1]
        if d:
            approach = first_within(
                part, distance=distance, norm="euclidean", between=named, ignoring=groups
            )
        else:
            contact = first_contact(part, between=named, ignoring=groups)
    file = scene_bytes(scene)
    made = _Certificate(part, file, Selection(scene, named, groups), fraction(d))
    return Proof(contact, file, made.text(contact or approach, *span))


def certificate_of(scene: Scene, contact: Contact | None, file: bytes | None = None) -> Proof:
    """The certificate of a first contact that is known. Raises: as `certify`."""
    content = scene_bytes(scene) if file is None else file
    made = _Certificate(scene, content, Selection(scene), Fraction(0))
    return Proof(contact, content, made.text(contact, made.start, made.end))


def certify_rows(contacts: Contacts) -> Proof:
    """The certificates of all answers of `exactpt.arrays.first_contacts`, in one file.

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


@final
class CertifiedSearch:
    """A search for the first contact, with a certificate of its answer.

    Args:
        search: the search.
        scene: the bodies and the time span of the search.
        question: the question, with the path of the certificate, and the scene's file or a scene
            with an earlier start.
    """

    def __init__(self, search: Search, scene: Scene, question: Question) -> None:
        assert question.certificate is not None  # noqa: S101
        self._search, self._path = search, question.certificate
        self._file = question.scene_file or scene_bytes(question.given or scene)
        selection = Selection(scene, question.between, question.ignoring)
        self._made = _Certificate(scene, self._file, selection, Fraction(0))

    @property
    def name(self) -> str | None:
        """See `Search.name`."""
        return self._search.name

    @property
    def stats(self) -> dict[str, object]:
        """See `Search.stats`."""
        return self._search.stats

    def passed(self) -> Fraction | None:
        """See `Search.passed`."""
        return self._search.passed()

    def run_to_contact(self) -> Contact | None:
        """Write the certificate, and return the first contact, or None. Raises: as `certify`."""
        found = self._search.run_to_contact()
        text = self._made.text(found, self._made.start, self._made.end)
        write_atomically(beside(self._path), self._file)
        write_atomically(self._path, text)
        return found


@final
class _Certificate:
    """The certificate of an answer about the pairs of bodies that count."""

    def __init__(self, scene: Scene, file: bytes, selection: Selection, distance: Fraction) -> None:
        refuse_degrees(scene.bodies)
        if selection.named == []:
            raise InputError("no pair of bodies counts: there is nothing to certify")
        self.start, self.end = fraction(scene._start), fraction(scene._end)
        self._bodies, self._file, self._distance = scene.bodies, file, distance
        self._number = {body.name: i for i, body in enumerate(scene.bodies)}
        self._selection = selection
        self._paths = Paths(scene.bodies)

    def _counts(self, bodies: set[int]) -> bool:
        """See `exactpt.check_apart.Checker.count`."""
        named = self._selection.named
        if named is None:
            return len({self._selection.group[i] for i in bodies}) > 1
        return any(i in bodies and j in bodies for i, j in named)

    def text(self, found: Contact | Approach | None, start: Fraction, end: Fraction) -> bytes:
        """The bytes of the certificate. Raises: as `certify`."""
        WORK.left = WORK.usual
        last, until = ["none"], end
        if found is not None:
            last, until = self._last(found, start)
        head = ["exactpt-apart 1", f"scene sha256 {hashlib.sha256(self._file).hexdigest()}"]
        head.append(f"span {start} {until}")
        head += self._chosen()
        if self._distance:
            head.append(f"distance {self._distance}")
        if found is None or start < until:
            groups, named = self._selection.group, self._selection.named
            several = groups if named is None else range(len(groups))
            separation = Separation(
                self._paths, self._bodies, several, self._counts, self._distance
            )
            head += separation.lines(start, until)
        return "".join(f"{line}\n" for line in [*head, *last]).encode()

    def _chosen(self) -> Iterator[str]:
        """The lines that select the pairs that count."""
        if self._selection.named is not None:  # those that ignore each other are not among them
            yield from (f"between {i} {j}" for i, j in self._selection.named)
            return
        groups: dict[int, list[int]] = {}
        for i, group in enumerate(self._selection.group):
            groups.setdefault(group, []).append(i)
        yield from (
            f"ignoring {' '.join(map(str, some))}" for some in groups.values() if len(some) > 1
        )

    def _last(self, found: Contact | Approach, start: Fraction) -> tuple[list[str], Fraction]:
        """The last line, which shows a contact, and a time up to which there is none."""
        names = (
            set(found.pairs)
            if isinstance(found, Approach)
            else {*((pair.body, pair.other) for pair in found.pairs), *found.overlaps}
        )
        pairs = [(self._number[a], self._number[b]) for a, b in sorted(names) if a != b]
        if not pairs:
            raise InputError(
                "the first contact is one of a body with itself: there is no certificate"
            )
        low, high = self._bounds(found.time, self.end - start)
        if high == start:
            return [self._meeting(pairs, start)], start
        near = (self.end - start) / 2**NEAR * (3 if low == high else 1)
        near = min(near, (low - start) / 4)
        until = short(low - near, float(near) / 4)
        later = (short(high + near * k / 4, float(near) / 8) for k in (1, 4, 7))
        times = [high] * (low == high) + [min(t, self.end) for t in later]
        for t in times:
            with suppress(Rejected):
                return [self._meeting(pairs, t)], until
        if not isinstance(found, Approach):
            for pair in found.pairs:
                if pair.edge is not None:
                    v = self._paths.first[self._number[pair.body]] + pair.vertex
                    item = self._item(self._number[pair.other], pair.edge)
                    with suppress(Rejected):
                        return [self._passage(v, item, until, low, high, times[-1])], until
        raise BudgetExceeded(
            "a touch without crossing, at an irrational time, has no certificate", None
        )

    def _bounds(self, time: AlgebraicNumber, span: Fraction) -> tuple[Fraction, Fraction]:
        """Bounds of a time: near to each other, and equal if it is rational."""
        time.refine_to(QQ(span / 2 ** (NEAR + 5)))
        return fraction(time._low), fraction(time._high)

    def _item(self, body: int, edge: int) -> int:
        """The number of an edge of a body."""
        first = next(k for k, item in enumerate(self._paths.items) if item[0] == body)
        return first + edge

    def _meeting(self, pairs: Sequence[tuple[int, int]], t: Fraction) -> str:
        """A last line by two bodies at a time.

        Raises:
            Rejected: if there is none.
        """
        for i, j in pairs:
            at = [
                [(fraction(x), fraction(y)) for x, y in self._bodies[k]._at(QQ(t))] for k in (i, j)
            ]
            far = self._distance + self._bodies[i].radius + self._bodies[j].radius
            items = [
                [
                    (k, u - first, v - first)
                    for k, (b, u, v) in enumerate(self._paths.items)
                    if b == body
                ]
                for body, first in ((i, self._paths.first[i]), (j, self._paths.first[j]))
            ]
            for k, m in _nearest(at, items):
                ends = [at[0][u] for u in items[0][k][1:]] + [at[1][u] for u in items[1][m][1:]]
                if are_near(ends, far):
                    return f"meet {t} {items[0][k][0]} {items[1][m][0]}"
            for one, other, k in ((i, j, 0), (j, i, 1)):
                rings = self._bodies[other].rings if self._bodies[other].has_interior else ()
                for ring in self._bodies[one].rings:
                    p = at[k][ring[0]]
                    if sum(surrounds([at[1 - k][v] for v in r], p) for r in rings) % 2:
                        return f"inside {t} {self._paths.first[one] + ring[0]} {other}"
        raise Rejected("no two bodies share a point")

    def _passage(
        self, v: int, item: int, until: Fraction, low: Fraction, high: Fraction, end: Fraction
    ) -> str:
        """A last line by a vertex that passes through an edge.

        Raises:
            Rejected: if it is not one.
        """
        _, a, b = self._paths.items[item]
        for u in (v, a):
            breaks = self._paths.of(u).breaks
            until = max([until, *(q for q in breaks if q <= low)])
            end = min([end, *(q for q in breaks if q >= high)])
        require_passage([self._paths.track(u, until) for u in (v, a, b)], until, end)
        return f"cross {until} {end} {v} {item}"


def _nearest(
    at: Sequence[Sequence[tuple[Fraction, Fraction]]], items: Sequence[Sequence[tuple[int, ...]]]
) -> list[tuple[int, int]]:
    """Some pairs of items of two bodies that are near each other, by doubles; the nearest first."""
    (a, b), (c, d) = (
        np.array([[[float(x) for x in at[k][u]] for u in item[1:]] for item in items[k]]).swapaxes(
            0, 1
        )
        for k in (0, 1)
    )
    a, b, c, d = a[:, None], b[:, None], c[None], d[None]

    def gap(p: Floats, q: Floats, r: Floats) -> Floats:
        along = r - q
        square = (along**2).sum(axis=2)
        k = ((p - q) * along).sum(axis=2) / np.where(square > 0, square, 1.0)
        away = p - q - np.clip(k, 0, 1)[..., None] * along
        return np.asarray((away**2).sum(axis=2))

    def turn(p: Floats, q: Floats, r: Floats) -> Floats:
        u, v = q - p, r - p
        return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])

    gaps = gap(a, c, d), gap(b, c, d), gap(c, a, b), gap(d, a, b)
    least: Floats = np.minimum.reduce(gaps)
    crossing = (turn(a, b, c) * turn(a, b, d) < 0) & (turn(c, d, a) * turn(c, d, b) < 0)
    least = np.where(crossing, -1.0, least)
    order = np.argsort(least, axis=None)[:6]
    return [(int(k), int(m)) for k, m in zip(*np.unravel_index(order, least.shape), strict=True)]
