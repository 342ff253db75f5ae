"""The incremental pseudo-triangulation as two trees, and the rules by which it changes.

Paper, sections 3.1 and 3.2. Of a point p, u(p) and d(p) are the left ends of its upper and
lower tangent to the hull of the points left of p: its parents in the *upper* and in the
*lower* tree. Of several points on one tangent the nearest is taken: that is the rule for
collinear points of `exactpt.certificates.perturbation`, by which the middle one of three hits the
edge between the others. Below, "a, b, c bend away" means a left turn in the upper tree and a
right turn in the lower; three points that are collinear for ever never do.

**Certificates.** One for every pair of neighbours in x-order, and one for every edge of
either tree, from z to b:

* if b has a next sibling n: z, b, n bend away (a *corner* certificate of the tile of n);
* else, if z is not the root, with parent a: a, z, b do not bend away (a *reflex*
  certificate, or one of the hull).

These are 3n - 5, and every one is an orientation of points lo < mid < hi in x-order.

**Lemma 3.1, sharpened**: they certify the structure. Proof by induction on the x-order: let
the trees of the points left of p be right. Their hull is then the path that leads from the
root always to the last child, in either tree. Let p hang on z in the upper tree. (1) The
slopes from z to its children increase, by the corner certificates, up to that of the last
child, which is at most the slope from the parent of z to z, by the reflex certificate. So
the tangent at z passes above the hull to the left of z. (2) Let b be the sibling before p:
p is above the line zb. The last child c of b is not, nor is its last child above the line
bc, and so on; so p is above all these lines, and z is the first vertex on the way up from
the point before p that stays visible from above. Slopes from one point are compared as
directions between straight down (included) and straight up (not included), so this holds
for equal x too. Where three points stay collinear, (1) allows it and (2) does not: the
nearest one is the tangent point.

**Events.** Theory, section 2.3: every one moves one edge, and keeps the preorder.

* corner, z b n: n becomes the last child of b.
* reflex or hull, a z b: b becomes the sibling after z. (Of the edges ab, zb the one whose
  right end is latest in x-order gives way; the paper omits this rule.)
* p and the next point q exchange their places in the x-order: `exchange`.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple, final

from exactpt.certificates.predicates import Predicates
from exactpt.tiling.incremental.paths import SearchableTree
from exactpt.tiling.incremental.tree import NONE, TangentTree

__all__ = ["LOWER", "UPPER", "Exchanged", "IncrementalStructure"]

UPPER: Final = 0
LOWER: Final = 1


class Exchanged(NamedTuple):
    """What the exchange of two points has changed.

    Attributes:
        edges: of each tree, the right ends of the edges that need new certificates.
        side: the tree in which the later point hung on the earlier one.
        end: the left end r' of its new tangent there; `NONE` if it is the root now.
        old: the left end r of the tangent that the earlier point had in the other tree.
    """

    edges: tuple[list[int], list[int]]
    side: int
    end: int
    old: int


@final
class IncrementalStructure:
    """The incremental pseudo-triangulation of points, without coordinates.

    Attributes:
        order: the points from left to right (of equal x, the upper one first).
        rank: where each point is in this order.
        trees: the upper tree and the lower one.
    """

    __slots__ = ("order", "rank", "trees")

    def __init__(self, order: list[int], trees: tuple[TangentTree, TangentTree]) -> None:
        self.order = order
        self.rank = [0] * len(order)
        for i, p in enumerate(order):
            self.rank[p] = i
        self.trees: tuple[TangentTree, TangentTree] = trees

    @classmethod
    def sweep(cls, order: list[int], predicates: Predicates) -> IncrementalStructure:
        """Build the structure from left to right (paper, section 3.1): O(n) after sorting.

        Args:
            order: the points, sorted.
            predicates: of the time.
        """
        trees = TangentTree(len(order)), TangentTree(len(order))
        for wanted, tree in zip((1, -1), trees, strict=True):
            hull = order[:1]
            for p in order[1:]:
                while len(hull) > 1 and predicates.sign(hull[-2], hull[-1], p) == wanted:
                    hull.pop()
                tree.append(hull[-1], p)
                hull.append(p)
        return cls(order, trees)

    @classmethod
    def of(cls, order: list[int], parents: tuple[list[int], list[int]]) -> IncrementalStructure:
        """The structure with these points from left to right, which hang on these others."""
        trees = TangentTree(len(order)), TangentTree(len(order))
        for tree, parent in zip(trees, parents, strict=True):
            for p in order[1:]:
                tree.append(parent[p], p)
        return cls(order, trees)

    def state(self) -> dict[str, Any]:
        """The structure as JSON data."""
        return {
            "order": list(self.order),
            "parents": [list(tree.parent) for tree in self.trees],
            "steps": [tree.steps for tree in self.trees],
        }

    @classmethod
    def resumed(cls, state: dict[str, Any]) -> IncrementalStructure:
        """The structure with that state."""
        upper, lower = state["parents"]
        structure = cls.of(state["order"], (upper, lower))
        for tree, steps in zip(structure.trees, state["steps"], strict=True):
            tree.steps = steps
        return structure

    def make_searchable(self) -> None:
        """From now on, search chains in O(log n)."""
        upper, lower = self.trees
        self.trees = SearchableTree.of(upper), SearchableTree.of(lower)

    def certificate(self, side: int, b: int) -> tuple[int, int, int, bool] | None:
        """What certifies the edge on which b hangs, if anything does.

        Returns:
            Three points from left to right, and whether they must bend away.
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

    def repair(self, side: int, b: int) -> tuple[int, int, int, list[int]]:
        """Let the edge on which b hangs follow the failure of its certificate.

        Returns:
            The point whose tangent has moved; the left ends that it had and has; and the
            right ends of the edges that need new certificates.
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

    def exchange(self, p: int, q: int, predicates: Predicates) -> Exchanged | None:
        """Let p and the point q after it exchange their places in the x-order.

        With p above q, q hangs on p in the upper tree and, but for collinear points that
        come first of all, not in the lower one. (The other case is the mirror image.)

        * Upper tree: q has no children, since p hides it from above. It leaves p and gets
          a new tangent, to the chain of p: its end r' is on the path from u(p) to the
          point before p.
        * Lower tree: nothing hangs on p but perhaps q. p leaves d(p) and hangs on q.

        Both in O(1), with one search along the chain for r'. (The paper says that edge r p,
        r = d(p), is switched with r' p, and gives one case of the two; it is r' q.)

        Returns:
            None if the trees do not allow it: other events come first.
        """
        sides = [side for side in (UPPER, LOWER) if self.trees[side].parent[q] == p]
        side = next((s for s in sides if self._may_exchange(s, p, q)), None)
        if side is None:
            return None
        old = self.trees[1 - side].parent[p]
        end, changed = self._leave(side, p, q, predicates)
        changed_other = self._hang(self.trees[1 - side], p, q)
        i = self.rank[p]
        self.order[i], self.order[i + 1] = q, p
        self.rank[q], self.rank[p] = i, i + 1
        edges = (changed, changed_other) if side == UPPER else (changed_other, changed)
        return Exchanged(edges, side, end, old)

    def _may_exchange(self, side: int, p: int, q: int) -> bool:
        """Whether nothing hangs on q in this tree, and nothing but q on p in the other."""
        other = self.trees[1 - side]
        alone = other.first[p] == other.last[p] and other.last[p] in (NONE, q)
        return alone and self.trees[side].first[q] < 0

    def _leave(self, side: int, p: int, q: int, predicates: Predicates) -> tuple[int, list[int]]:
        """Let q, a leaf on p, come before p: the end of its new tangent, changed edges."""
        tree = self.trees[side]
        tree.detach(q)
        start = tree.parent[p]
        if start < 0:
            tree.append(q, p)
            return NONE, [c for c in (p, q, tree.last[p]) if c >= 0]
        sign, wanted = predicates.sign, 1 if side == UPPER else -1
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

    def _hang(self, tree: TangentTree, p: int, q: int) -> list[int]:
        """Let p, a leaf or the parent of q alone, hang on q: changed edges."""
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
