"""The last contact passed to a callback, so that it is not reported twice."""

from __future__ import annotations

from typing import NamedTuple

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.motion.body import Body
from exactpt.pairs.contact import Contact
from exactpt.simulation.living import LivingScene


class Met(NamedTuple):
    """A contact, with the motions that its bodies had just before it.

    Attributes:
        time: the exact time.
        bodies: the bodies of its incidences, by name.
    """

    time: AlgebraicNumber
    bodies: dict[str, Body]

    def is_again(self, other: Met) -> bool:
        """Return True if another contact has the same time, bodies and motions."""
        mine, theirs = self.bodies, other.bodies
        return (
            self.time.compare(other.time) == 0
            and mine.keys() == theirs.keys()
            and all(mine[name] is theirs[name] for name in mine)
        )

    def may_recur(self, living: LivingScene) -> bool:
        """Return True if all of its bodies still have the same motions."""
        return all(living.has(body) for body in self.bodies.values())


def met(contact: Contact, living: LivingScene) -> Met:
    """Return a contact that lies ahead of a scene."""
    names = {name for pair in contact.pairs for name in (pair.body, pair.other)}
    return Met(contact.time, {name: living.body(name) for name in names})
