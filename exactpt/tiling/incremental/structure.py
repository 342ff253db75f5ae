"""The incremental pseudo-triangulation as two trees, its certificates and its events.

Paper, sections 3.1 and 3.2. Of a point p, u(p) and d(p) are the left ends of its upper and
lower tangent to the hull of the points left of p: its parents in the *upper* and in the
*lower* tree. p *hangs* on its parent. Of several points on one tangent the
nearest is taken: by the rule of `exactpt.certificates.perturbation` for collinear points, the
middle one of three blocks the edge between the others. Below, "a, b, c turn away" means a
left turn in the upper tree and a right turn in the lower tree; three points that are
collinear for all times never turn away.

**Certificates.** One for every pair of neighbours in x-order, and one for every edge of
either tree, from z to b:

* if b has a next sibling n: z, b, n turn away (a *corner* certificate of the tile of n);
* otherwise, if z is not the root, with parent a: a, z, b do not turn away (a *reflex*
  certificate, or one of the hull).

There are 3n - 5 of them; those of edges are orientations of points lo < mid < hi in x-order.

**Lemma 3.1, sharpened**: the certificates certify the structure. Proof by induction on the
x-order: suppose that the trees of the points left of p are correct. Then the hull of these
points is, in either tree, the path from the root that always continues to the last child. Let
p hang on z in the upper tree. (1) The slopes from z to its children increase, by the corner
certificates, up to that of the last child, which is at most the slope from the parent of z to
z, by the reflex certificate. So the tangent at z passes above the hull to the left of z.
(2) Let b be the sibling before p: p is above the line zb. The last child c of b is not above
zb, nor is the last child of c above bc, and so on; so p is above all these lines, and z is the
first vertex that remains visible from above on the way up from the point before p. Slopes
from one point are compared as directions between straight down (included) and straight up
(excluded), so the proof holds for equal x too. Three points that stay collinear are allowed
by (1), not by (2): the nearest one is the tangent point.

**Events.** Each moves edges but preserves the preorder (paper, section 3.2).

* corner, z b n: n becomes the last child of b.
* reflex or hull, a z b: b becomes the sibling after z. (Of the edges ab and zb, the one whose
  right end is latest in the x-order is replaced; the paper omits this rule.)
* exchange of p and the next point q in the x-order: `exchange`.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple, final

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import VertexId
from exactpt.kernel.stored import Stored
from exactpt.tiling.incremental.paths import SearchableTree
from exactpt.tiling.incremental.tree import NONE, TangentTree

UPPER: Final = 0
LOWER: Final = 1


class Exchanged(NamedTuple):
    """The changes of an exchange of two points.

    Attributes:
        edges: for each tree, the right ends of the edges that need new certificates.
        side: the tree in which the later point hung on the earlier one.
        end: the left end r' of its new tangent in that tree; `NONE` if it is the root now.
        old: the left end r of the old tangent of the earlier point in the other tree.
    """

    edges: tuple[list[VertexId], list[VertexId]]
    side: int
    end: VertexId
    old: VertexId


@final
class IncrementalStructure:
    """The incremental pseudo-triangulation of points, without coordinates.

    Attributes:
        order: the points from left to right (of equal x, the upper one first).
        rank: for each point, its position in this order.
        trees: the upper tree and the lower one.
    """

    __slots__ = ("order", "rank", "trees")

    def __init__(self, order: list[VertexId], trees: tuple[TangentTree, TangentTree]) -> None:
        self.order = order
        self.rank = [0] * len(order)
        for i, p in enumerate(order):
            self.rank[p] = i
        self.trees: tuple[TangentTree, TangentTree] = trees

    @classmethod
    def sweep(cls, order: list[VertexId], predicates: Predicates) -> IncrementalStructure:
        """Build the structure from left to right (paper, section 3.1): O(n) after sorting.

        Args:
            order: the points, sorted.
            predicates: the predicates of the time.
        """
        trees = TangentTree(len(order)), TangentTree(len(order))
        for wanted, tree in zip((1, -1), trees, strict=True):
            hull = order[:1]
            for p in order[1:]:
                while len(hull) > 1 and predicates.orientation(hull[-2], hull[-1], p) == wanted:
                    hull.pop()
                tree.append(hull[-1], p)
                hull.append(p)
        return cls(order, trees)

    @classmethod
    def of(
        cls, order: list[VertexId], parents: tuple[list[VertexId], list[VertexId]]
    ) -> IncrementalStructure:
        """Return the structure of these points from left to right with these parents."""
        trees = TangentTree(len(order)), TangentTree(len(order))
        for tree, parent in zip(trees, parents, strict=True):
            for p in order[1:]:
                tree.append(parent[p], p)
        return cls(order, trees)

    def state(self) -> dict[str, Any]:
        """Return the structure, as a JSON object."""
        return {
            "order": list(self.order),
            "parents": [list(tree.parent) for tree in self.trees],
            "steps": [tree.steps for tree in self.trees],
        }

    @classmethod
    def resumed(cls, state: Stored, count: int) -> IncrementalStructure:
        """Return the structure of a saved state.

        Args:
            state: what `state` returned.
            count: the number of points.

        Raises:
            AuditError: if it is none: walks along its trees might not end.
            InputError: if a value is not an index or a count.
        """
        order = state["order"].integers(0, count - 1, length=count)
        if len(set(order)) < count:
            raise AuditError("the x-order does not have every point once")
        upper, lower = (
            parents.integers(int(NONE), count - 1, length=count)
            for parents in state["parents"].entries(2)
        )
        rank = {p: i for i, p in enumerate(order)}
        for parent in (upper, lower):
            for p in order[1:]:
                if parent[p] < 0 or rank[parent[p]] >= rank[p]:
                    raise AuditError(f"point {p} hangs on none to its left")
        points = list(map(VertexId, order))
        parents = list(map(VertexId, upper)), list(map(VertexId, lower))
        structure = cls.of(points, parents)
        for tree, steps in zip(structure.trees, state["steps"].integers(0, length=2), strict=True):
            tree.steps = steps
        return structure

    def take_changes(self) -> set[VertexId] | None:
        """Return the points whose links changed since the last call; None at the first call."""
        upper, lower = (tree.changed for tree in self.trees)
        for tree in self.trees:
            tree.changed = set()
        return None if upper is None or lower is None else (upper | lower) - {NONE}

    def make_searchable(self) -> None:
        """Search chains in O(log n) from now on."""
        upper, lower = self.trees
        self.trees = SearchableTree.of(upper), SearchableTree.of(lower)

    def certificate(
        self, side: int, b: VertexId
    ) -> tuple[VertexId, VertexId, VertexId, bool] | None:
        """Return the certificate of the edge on which b hangs; None if it has none.

        Returns:
            Three points from left to right, and whether they must turn away.
        """
        tree = self.trees[side]
        z = tree.parent[b]
        if z < 0:
            return None
        n = tree.after[b]
        if n >= 0:
            return z, b, n, True
        a = tree.parent[z]
        return None if a < 0 else (a, z, b, False)

    # Events

    def repair(self, side: int, b: VertexId) -> tuple[VertexId, VertexId, VertexId, list[VertexId]]:
        """Repair the edge on which b hangs, whose certificate has failed.

        Returns:
            The point whose tangent has moved, its old and its new left end, and the right ends
            of the edges that need new certificates.
        """
        tree = self.trees[side]
        z, n = tree.parent[b], tree.after[b]
        if n >= 0:
            changed = [b, n]
            changed += [c for c in (tree.last[b], tree.last[n]) if c >= 0]
            tree.detach(n)
            tree.append(b, n)
            return n, z, b, changed
        a = tree.parent[z]
        changed = [b, z]
        changed += [c for c in (tree.before[b], tree.last[b]) if c >= 0]
        tree.detach(b)
        tree.insert_after(z, b)
        return b, z, a, changed

    def exchange(self, p: VertexId, q: VertexId, predicates: Predicates) -> Exchanged | None:
        """Exchange p and the point q after it in the x-order.

        With p above q, q hangs on p in the upper tree and not in the lower one, unless all
        points up to q are collinear. (The other case is the mirror image.)

        * Upper tree: q has no children, since p hides it from above. It is detached from p and
          gets a new tangent to the chain of p; its end r' is on the path from u(p) to the point
          before p.
        * Lower tree: p has no child except possibly q. It is detached from d(p) and hangs on q.

        Both take O(1) time, and one search along the chain for r'. (According to the paper, edge
        r p, r = d(p), is replaced by r' p, and gives one case of the two; it is r' q.)

        Returns:
            None if the trees do not allow the exchange because other repairs have to come first.
        """
        sides = [side for side in (UPPER, LOWER) if self.trees[side].parent[q] == p]
        side = next((s for s in sides if self._may_exchange(s, p, q)), None)
        if side is None:
            return None
        old = self.trees[1 - side].parent[p]
        end, changed = self._insert_before(side, p, q, predicates)
        changed_other = self._hang(self.trees[1 - side], p, q)
        i = self.rank[p]
        self.order[i], self.order[i + 1] = q, p
        self.rank[q], self.rank[p] = i, i + 1
        edges = (changed, changed_other) if side == UPPER else (changed_other, changed)
        return Exchanged(edges, side, end, old)

    def _may_exchange(self, side: int, p: VertexId, q: VertexId) -> bool:
        """Return True if q has no children in this tree, and p none but q in the other."""
        other = self.trees[1 - side]
        alone = other.first[p] == other.last[p] and other.last[p] in (NONE, q)
        return alone and self.trees[side].first[q] < 0

    def _insert_before(
        self, side: int, p: VertexId, q: VertexId, predicates: Predicates
    ) -> tuple[VertexId, list[VertexId]]:
        """Move q, a leaf that hangs on p, before p; the end of its new tangent, changed edges."""
        tree = self.trees[side]
        tree.detach(q)
        start = tree.parent[p]
        if start < 0:
            tree.append(q, p)
            return NONE, [c for c in (p, q, tree.last[p]) if c >= 0]
        sign, wanted = predicates.orientation, 1 if side == UPPER else -1
        end = tree.tangent_end(
            p, self.order[self.rank[p] - 1], lambda z, w: sign(z, w, q) == wanted
        )
        if end == start:
            l = tree.before[p]
            tree.insert_before(p, q)
        else:
            l = tree.last[end]
            tree.append(end, q)
        return end, [q, l] if l >= 0 else [q]

    def _hang(self, tree: TangentTree, p: VertexId, q: VertexId) -> list[VertexId]:
        """Hang p, which has no child except possibly q, on q; returns the changed edges."""
        changed = [p, q]
        if tree.parent[q] == p:
            # q takes the place of p.
            changed += [c for c in (tree.last[q], tree.before[p]) if c >= 0]
            tree.detach(q)
            if tree.parent[p] >= 0:
                tree.insert_after(p, q)
        elif tree.before[p] >= 0:
            changed.append(tree.before[p])
        if tree.parent[p] >= 0:
            tree.detach(p)
        tree.prepend(q, p)
        return changed
