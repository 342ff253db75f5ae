"""Public records of contacts: the time, and the features in contact."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import ClassVar, NamedTuple, final

from exactpt.brief import cut
from exactpt.extensions import extension
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import shorten
from exactpt.motion.track import Incidence
from exactpt.pair.incidences import ContactPoint, details
from exactpt.scene.scene import Scene

__all__ = ["Contact", "ContactPoint", "contact_of"]


class Found(NamedTuple):
    """The touches from which the incidences, points and normals, are computed on demand."""

    scene: Scene
    touches: Sequence[Incidence]


@final
class Contact:
    """A contact of a scene: its time and all incidences at that time. It cannot be changed.

    Contacts are equal if their time, kind, pairs and initial pairs are.

    Args:
        time: the exact time.
        kind: see below.
        pairs: every incidence at that time.
        initial_pairs: see below.

    Attributes:
        kind: "initial" at the start of the scene; "self" if every incidence is one of a body
            with itself; "vertex-edge" if, of the incidences of two different bodies, one or more
            are of a vertex and an edge; "vertex-vertex" if all of these are of two vertices.
        initial_pairs: of a contact at the start, the names of the pairs of bodies that share a
            point: they overlap or touch. Empty for other contacts. The key of JSON is "overlaps".
    """

    __slots__ = ("_pairs", "exact_time", "initial_pairs", "kind")
    __match_args__: ClassVar = ("time", "kind", "pairs", "initial_pairs")
    kind: str
    initial_pairs: tuple[tuple[str, str], ...]
    exact_time: AlgebraicNumber  # in the form in which the search found it; `time` may change it
    _pairs: tuple[ContactPoint, ...] | Found

    def __init__(
        self,
        time: AlgebraicNumber,
        kind: str,
        pairs: tuple[ContactPoint, ...] | Found,
        initial_pairs: tuple[tuple[str, str], ...] = (),
    ) -> None:
        keep = object.__setattr__
        keep(self, "exact_time", time)
        keep(self, "kind", kind)
        keep(self, "_pairs", pairs)
        keep(self, "initial_pairs", initial_pairs)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Contact cannot be changed: {name}")

    @property
    def time(self) -> AlgebraicNumber:
        """The exact time."""
        if not self.exact_time.is_rational:
            self._complete()  # it changes the form of an irrational time
        return self.exact_time

    @property
    def pairs(self) -> tuple[ContactPoint, ...]:
        """Every incidence at that time."""
        return self._complete()

    def _complete(self) -> tuple[ContactPoint, ...]:
        pairs = self._pairs
        if isinstance(pairs, Found):
            time, pairs = details(pairs.scene, self.exact_time, pairs.touches)
            object.__setattr__(self, "exact_time", time)
            object.__setattr__(self, "_pairs", pairs)
        return pairs

    def exact_incidences(self, numbers: Mapping[str, int]) -> list[Incidence]:
        """Return the incidences, bodies numbered by ``numbers``; points are not computed."""
        found = self._pairs
        if isinstance(found, Found):
            order = [numbers.get(body.name, -1) for body in found.scene.bodies]
            return [t._replace(body=order[t.body], other=order[t.other]) for t in found.touches]
        return [
            Incidence(
                numbers[p.body], p.vertex, numbers[p.other],
                -1 if p.edge is None else p.edge, -1 if p.other_vertex is None else p.other_vertex,
            )
            for p in found
        ]  # fmt: skip

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Contact):
            return NotImplemented
        return (
            (self.kind, self.initial_pairs) == (other.kind, other.initial_pairs)
            and self.exact_time == other.exact_time
            and self.pairs == other.pairs
        )

    def __hash__(self) -> int:
        return hash((self.exact_time, self.kind))

    def __reduce__(self) -> tuple[object, ...]:
        return Contact, (self.time, self.kind, self.pairs, self.initial_pairs)

    def __repr__(self) -> str:
        pairs = self.pairs
        first = f", {_in_brief(pairs[0])}" if pairs else ""
        more = f" and {len(pairs) - 1} more" if len(pairs) > 1 else ""
        sharing = ""
        if self.initial_pairs and not pairs:
            one, other = self.initial_pairs[0]
            sharing = f", {shorten(one, 20)} and {shorten(other, 20)} share a point"
        at = str(self.time)
        if len(at) > 90:
            at = f"{float(self.time)!r}..." if self.time.is_rational else repr(self.time)[1:-1]
        return cut(f"<Contact at t = {at}, {self.kind}{first}{more}{sharing}>")

    @property
    def bodies(self) -> tuple[str, ...]:
        """The names of all bodies in contact, in the order in which they first occur."""
        in_incidences = [name for pair in self.pairs for name in (pair.body, pair.other)]
        at_start = [name for pair in self.initial_pairs for name in pair]
        return tuple(dict.fromkeys([*in_incidences, *at_start]))

    def to_json(self) -> dict[str, object]:
        """Return the contact as a JSON object, see docs/format.md."""
        data: dict[str, object] = {
            "time": self.time.to_json(),
            "kind": self.kind,
            "pairs": [pair.to_json() for pair in self.pairs],
        }
        if self.initial_pairs:
            data["overlaps"] = [list(names) for names in self.initial_pairs]
        return data

    def _repr_html_(self) -> str:
        """Return an HTML table of the time and the incidences, for notebooks."""
        return str(extension("table of a contact")(self))


def _in_brief(pair: ContactPoint) -> str:
    """Return an incidence in a few words."""
    feature = f"vertex {pair.other_vertex}" if pair.edge is None else f"edge {pair.edge}"
    body, other = shorten(pair.body, 20), shorten(pair.other, 20)
    return f"vertex {pair.vertex} of {body} on {feature} of {other}"


def contact_of(
    scene: Scene,
    time: AlgebraicNumber,
    touches: Iterable[Incidence],
    initial_pairs: Sequence[tuple[int, int]] = (),
) -> Contact:
    """Return the contact with the given incidences.

    Args:
        scene: the scene.
        time: the time of the contact.
        touches: every incidence at that time.
        initial_pairs: pairs of indices of bodies that share a point at the start.
    """
    touches = sorted(touches)
    names = tuple((scene.bodies[i].name, scene.bodies[j].name) for i, j in initial_pairs)
    return Contact(time, _kind(scene, time, touches), Found(scene, touches), names)


def _kind(scene: Scene, time: AlgebraicNumber, touches: Sequence[Incidence]) -> str:
    if time.compare_rational(scene.exact_start) == 0:
        return "initial"
    of_two = [touch for touch in touches if touch.body != touch.other]
    if not of_two:
        return "self"
    return "vertex-edge" if any(touch.edge >= 0 for touch in of_two) else "vertex-vertex"
