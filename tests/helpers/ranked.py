"""A structure of its own, as docs/extending.md tells: bodies in the order of first vertices."""

from itertools import pairwise

from exactpt.certificates.at_time import sorted_by_x
from exactpt.certificates.certificate import OTHER, pack
from exactpt.errors import AuditError
from exactpt.tiling.catalogue import Bodies, Entry
from exactpt.tiling.lazy import LazyRules
from exactpt.tiling.rules import Rules

RANKED = Entry("ranked", Bodies.ANY, "ranked:RankedRules", is_canonical=False)


class RankedRules(Rules):
    """Any pseudo-triangulation; and the first vertices of the bodies from left to right."""

    build = staticmethod(LazyRules.build)

    def __init__(self, certified, log):
        super().__init__(certified, log)
        self.rank = []

    def audit(self, instant):
        if self.rank != sorted_by_x(instant, self._first_vertices()):
            raise AuditError("another order than the static one")

    def state(self):
        return {"rank": self.rank[:]}

    def resume(self, state):
        self.rank = state["rank"]

    def certify(self):
        self._rank(self._first_vertices())

    def certify_body(self, i):  # noqa: ARG002
        self.certify()

    def failed(self, certificates):
        if certificates:
            self.certify()
            self.log.record("rank", (), ())

    def enter(self, i):  # noqa: ARG002
        self.certify()

    def leave(self, i):
        gone = self.certified.vertices.bodies[i].ring[0]
        self._rank([v for v in self._first_vertices() if v != gone])

    def _first_vertices(self):
        return [moving.ring[0] for moving in self.certified.vertices.bodies]

    def _rank(self, vertices):
        """Put vertices in order just after now, and certify each against the next one."""
        certifier, table = self.certified.certifier, self.certified.table
        for place in range(len(self.rank)):
            table.schedule(pack(OTHER, place), None)
        self.rank = sorted_by_x(self.certified.after(), vertices)
        for place, (a, b) in enumerate(pairwise(self.rank)):
            if not certifier.keeps_x_order(a, b):
                table.schedule(pack(OTHER, place), certifier.x_order(a, b)[1])
