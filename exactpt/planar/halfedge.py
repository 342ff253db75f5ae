"""A planar map of half-edges: pure topology, without coordinates or time.

Half-edges come in twins h and h ^ 1, with opposite directions; the face of a half-edge
is on its left. Later edges use the handles of removed ones again.

Source: M. de Berg et al., *Computational Geometry*, 3rd ed., section 2.2 (the doubly
connected edge list).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import final

from librt.vecs import append, vec

from exactpt.errors import AuditError
from exactpt.indices import NO_VERTEX, HalfEdge, Index, VertexId, half_edge_vec, vertex_vec


def twin(h: HalfEdge) -> HalfEdge:
    """Return the half-edge of the same edge in the opposite direction."""
    return h ^ 1  # type: ignore[return-value]  # a cast would be one more call


def found(half_edges: Iterable[HalfEdge], what: str) -> HalfEdge:
    """Return the first of some half-edges, of which a map that is whole has one.

    Raises:
        AuditError: if there is none. A bare ``next`` would end a generator around it.
    """
    for h in half_edges:
        return h
    raise AuditError(f"there is no {what}")


@final
class PlanarMap:
    """Half-edges in parallel vectors; a handle is an index.

    A vector holds its integers themselves, one after the other, where a list points to objects:
    so compiled code walks along a face three to five times as fast. An append may move a vector,
    and the old one is then no longer that of the map: nobody keeps one while edges are added.

    Attributes:
        origin: the vertex where a half-edge starts; `NO_VERTEX` for a free handle.
        following: the next half-edge around the face on the left.
        previous: the half-edge before it around the face on the left.
    """

    def __init__(self) -> None:
        self.origin: vec[VertexId] = vertex_vec()
        self.following: vec[HalfEdge] = half_edge_vec()
        self.previous: vec[HalfEdge] = half_edge_vec()
        self._free: list[HalfEdge] = []
        self._changed: set[HalfEdge] | None = None

    def add_edge(self, u: VertexId, v: VertexId) -> HalfEdge:
        """Add an edge, not linked yet; returns its half-edge from u to v (an even handle)."""
        if self._free:
            h = self._free.pop()
            self.place(h, u)
            self.place(twin(h), v)
        else:
            h = HalfEdge(len(self.origin))
            self.origin = append(append(self.origin, u), v)
            self.following = append(append(self.following, twin(h)), h)
            self.previous = append(append(self.previous, twin(h)), h)
        return h

    def link(self, h: HalfEdge, g: HalfEdge) -> None:
        """Make g the half-edge after h around their face."""
        self.following[h] = g
        self.previous[g] = h
        if self._changed is not None:
            self._changed.add(h)

    def place(self, h: HalfEdge, u: VertexId) -> None:
        """Make u the origin of h."""
        self.origin[h] = u
        if self._changed is not None:
            self._changed.add(h)

    def take_changes(self) -> set[HalfEdge] | None:
        """Return the half-edges that may have another origin or successor since the last call.

        Returns:
            The half-edges; None at the first call.
        """
        changed, self._changed = self._changed, set()
        return changed

    @classmethod
    def of(
        cls,
        origin: Iterable[VertexId],
        following: Iterable[HalfEdge],
        previous: Iterable[HalfEdge],
        free: list[HalfEdge],
    ) -> PlanarMap:
        """Return the map with these half-edges and free handles (last in, first out)."""
        self = cls()
        self.origin = vertex_vec(origin)
        self.following, self.previous = half_edge_vec(following), half_edge_vec(previous)
        self._free = free
        return self

    @property
    def free(self) -> list[HalfEdge]:
        """The free handles (even), left by removed edges; the last one is used first."""
        return self._free

    def copy(self) -> PlanarMap:
        """Return an independent copy."""
        other = PlanarMap()
        other.origin, other._free = self.origin[:], self._free[:]
        other.following, other.previous = self.following[:], self.previous[:]
        return other

    def is_used(self, h: HalfEdge) -> bool:
        """Return True if a handle is that of a half-edge of the map."""
        return 0 <= h < len(self.origin) and self.origin[h] != NO_VERTEX

    def target(self, h: HalfEdge) -> VertexId:
        """Return the vertex where a half-edge ends."""
        return self.origin[h ^ 1]

    def split_face(self, h: HalfEdge, g: HalfEdge) -> HalfEdge:
        """Split the face of h and g by a new edge from the origin of h to the origin of g.

            .--- g <--- o          .--- g <--- o
            v           ^          v       7   ^      e runs from origin[h] to
            :   face    :    =>    :     e/    :      origin[g], with g in the face
            |           |          |     /     |      on its left and h in the one
            o --- h --> .          o --- h --> .      on its right.

        Returns:
            e.
        """
        before_h, before_g = self.previous[h], self.previous[g]
        e = self.add_edge(self.origin[h], self.origin[g])
        self.link(before_h, e)
        self.link(e, g)
        self.link(before_g, twin(e))
        self.link(twin(e), h)
        return e

    def remove_edge(self, h: HalfEdge) -> None:
        """Remove an edge between two different faces, which merge."""
        g = twin(h)
        before_h, after_h = self.previous[h], self.following[h]
        before_g, after_g = self.previous[g], self.following[g]
        self.link(before_h, after_g)
        self.link(before_g, after_h)
        self.place(h, NO_VERTEX)
        self.place(g, NO_VERTEX)
        self._free.append(min(h, g))

    def slide_origin(self, h: HalfEdge) -> None:
        r"""Move the origin of h back along the half-edge a before it.

            b     f     h                b     f
          ----> m ----> o ...>         ----> m ......>      m leaves f at h no longer:
                  a     :                      \\   h         f runs b, h and loses o,
                        : c                  a  7  o        the face g across h runs
                  g     v                    g     : c      twin(h), a, c and gains m.

        Both repairs of a pseudo-triangulation are this operation: that of a corner whose
        angle becomes 0, and that of a reflex angle that becomes straight.
        """
        a = self.previous[h]
        b, t = self.previous[a], twin(h)
        c = self.following[t]
        self.link(b, h)
        self.link(t, a)
        self.link(a, c)
        self.place(h, self.origin[a])

    def slide_target(self, a: HalfEdge) -> None:
        """Move the target of a forward along the half-edge h after it: `slide_origin` mirrored."""
        h = self.following[a]
        b, t = self.following[h], twin(a)
        c = self.previous[t]
        self.link(a, b)
        self.link(h, t)
        self.link(c, h)
        self.place(t, self.origin[h ^ 1])

    def face(self, h: HalfEdge) -> list[HalfEdge]:
        """Return the half-edges of the face of h, in cyclic order from h.

        Raises:
            AuditError: if they do not come back to h, in a map that was forged.
        """
        cycle, following = [h], self.following
        g, most = following[h], len(following)
        while g != h:
            if len(cycle) > most:
                raise AuditError(f"the half-edges after {h} return elsewhere")
            cycle.append(g)
            g = following[g]
        return cycle

    def star(self, h: HalfEdge) -> list[HalfEdge]:
        """Return the star of the origin of h: the half-edges out of it, counter-clockwise from h.

        Raises:
            AuditError: if they do not come back to h, in a map that was forged.
        """
        star, previous = [h], self.previous
        g, most = twin(previous[h]), len(previous)
        while g != h:
            if len(star) > most:
                raise AuditError(f"the half-edges around {h} return elsewhere")
            star.append(g)
            g = twin(previous[g])
        return star

    def half_edges(self) -> list[HalfEdge]:
        """Return all half-edges in use, in increasing order."""
        return [HalfEdge(h) for h, v in enumerate(self.origin) if v != NO_VERTEX]

    def audit_free(self) -> None:
        """Check that a handle is free if and only if no half-edge has it.

        Raises:
            AuditError: if it is not so.
        """
        unused = [h for h, v in enumerate(self.origin) if v == NO_VERTEX]
        if sorted([*self._free, *(h + 1 for h in self._free)]) != unused:
            raise AuditError(f"the free handles are not those of the {len(unused)} without origin")

    def audit(self) -> None:
        """Check the links.

        Raises:
            AuditError: if the links of two half-edges contradict each other.
        """
        for h in self.half_edges():
            g = self.following[h]
            if self.previous[g] != h:
                raise AuditError(f"previous[following[{h}]] is {self.previous[g]}")
            if self.origin[g] != self.target(h):
                raise AuditError(f"half-edge {h} ends at {self.target(h)}, not at {self.origin[g]}")


def without_steps_back(half_edges: Iterable[HalfEdge]) -> list[HalfEdge]:
    """Return a sequence of half-edges with every pair of successive twins cancelled."""
    kept: list[HalfEdge] = []
    for h in half_edges:
        if kept and kept[-1] == twin(h):
            kept.pop()
        else:
            kept.append(h)
    return kept


def edge_key(u: Index, v: Index) -> tuple[Index, Index]:
    """Return the ends of an edge, the smaller one first."""
    return (u, v) if u < v else (v, u)
