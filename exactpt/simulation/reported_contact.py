"""The last contact passed to a callback, so that it is not reported twice."""

from __future__ import annotations

from typing import NamedTuple

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.motion.body import Body
from exactpt.pair.contact import Contact
from exactpt.simulation.mutable_scene import MutableScene


class ReportedContact(NamedTuple):
    """A contact, with the motions that its bodies had just before it.

    Attributes:
        time: the exact time.
        bodies: the bodies of its incidences, by name.
    """

    time: AlgebraicNumber
    bodies: dict[str, Body]

    def is_again(self, other: ReportedContact) -> bool:
        """Return True if another contact has the same time, bodies and motions."""
        mine, theirs = self.bodies, other.bodies
        return (
            self.time.compare(other.time) == 0
            and mine.keys() == theirs.keys()
            and all(mine[name] is theirs[name] for name in mine)
        )

    def may_recur(self, mutable: MutableScene) -> bool:
        """Return True if all of its bodies still have the same motions."""
        return all(mutable.has(body) for body in self.bodies.values())


def with_motions_of(contact: Contact, mutable: MutableScene) -> ReportedContact:
    """Return a contact ahead of a scene, with the current motions of its bodies."""
    names = {name for pair in contact.pairs for name in (pair.body, pair.other)}
    return ReportedContact(contact.time, {name: mutable.body(name) for name in names})
