"""The greedy vertical pseudo-triangulation from its definition: every free bitangent, sorted.

Points count as discs of radius 0: their four bitangents have one geometry but four labels.
Fractions only; nothing of exactpt.
"""

from fractions import Fraction
from functools import cmp_to_key
from itertools import combinations
from typing import NamedTuple


class Tangent(NamedTuple):
    """A bitangent from left to right; a side is +1 if the body is on its left."""

    i: int
    a: int
    j: int
    b: int
    side_i: int
    side_j: int


def cross(o, p, q):
    return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])


def sign(x):
    return (x > 0) - (x < 0)


class Scene:
    """Disjoint convex bodies: lists of points, counter-clockwise."""

    def __init__(self, bodies):
        self.bodies = [[(Fraction(x), Fraction(y)) for x, y in body] for body in bodies]

    def point(self, i, a):
        return self.bodies[i][a]

    def left_to_right(self, p, q):
        return (p[0], -p[1]) < (q[0], -q[1])

    def bitangents(self):
        """All free bitangents, four for each pair of bodies."""
        found = []
        for i, j in combinations(range(len(self.bodies)), 2):
            for a, p in enumerate(self.bodies[i]):
                for b, q in enumerate(self.bodies[j]):
                    for si, sj in self._sides(i, p, j, q):
                        t = Tangent(i, a, j, b, si, sj)
                        if not self.left_to_right(p, q):
                            t = Tangent(j, b, i, a, -sj, -si)
                        if self._is_free(t):
                            found.append(t)
        return found

    def _sides(self, i, p, j, q):
        sides = []
        for body in (self.bodies[i], self.bodies[j]):
            signs = {sign(cross(p, q, v)) for v in body} - {0}
            if len(signs) > 1:
                return []
            sides.append(sorted(signs) or [-1, 1])
        return [(si, sj) for si in sides[0] for sj in sides[1]]

    def _is_free(self, t):
        p, q = self.point(t.i, t.a), self.point(t.j, t.b)
        for k, body in enumerate(self.bodies):
            if k in (t.i, t.j):
                continue
            signs = [sign(cross(p, q, v)) for v in body]
            if 0 in signs:
                raise ValueError("three bodies on one line: not generic")
            if min(signs) < 0 < max(signs):  # the line meets the body; does the segment?
                for u, v in zip(body, body[1:] + body[:1], strict=True):
                    if sign(cross(p, q, u)) * sign(cross(p, q, v)) < 0 and (
                        sign(cross(u, v, p)) * sign(cross(u, v, q)) < 0
                    ):
                        return False
        return True

    def theta_order(self, s, t):
        """Negative if theta(s) < theta(t); ties (labels of one geometry) by rank."""
        (p, q), (u, v) = self.ends(s), self.ends(t)
        c = (q[0] - p[0]) * (v[1] - u[1]) - (q[1] - p[1]) * (v[0] - u[0])
        return sign(c) or sign(self._rank(s) - self._rank(t))

    def _rank(self, t):
        return {(1, -1): 0, (1, 1): 1, (-1, -1): 1, (-1, 1): 2}[t.side_i, t.side_j]

    def ends(self, t):
        return self.point(t.i, t.a), self.point(t.j, t.b)

    def crosses(self, s, t):
        """Whether two bitangents cross, inside or at a common end (theory of the paper, 4.1)."""
        (p, q), (u, v) = self.ends(s), self.ends(t)
        if (s.i, s.a, s.j, s.b) == (t.i, t.a, t.j, t.b):
            return {(s.side_i, s.side_j), (t.side_i, t.side_j)} == {(1, -1), (-1, 1)}
        for at_s, at_t in ((0, 0), (0, 1), (1, 0), (1, 1)):
            end_s = (s.i, s.a) if at_s == 0 else (s.j, s.b)
            end_t = (t.i, t.a) if at_t == 0 else (t.j, t.b)
            if end_s != end_t:
                continue
            # The side of the body as seen along the segment, leaving the common end.
            side_s = s.side_i if at_s == 0 else -s.side_j
            side_t = t.side_i if at_t == 0 else -t.side_j
            if side_s == side_t:
                return False
            w = (p, q)[at_s]
            other_s, other_t = (p, q)[1 - at_s], (u, v)[1 - at_t]
            if side_s < 0:
                other_s, other_t = other_t, other_s
            return cross(w, other_s, other_t) < 0
        return (
            sign(cross(p, q, u)) * sign(cross(p, q, v)) < 0
            and sign(cross(u, v, p)) * sign(cross(u, v, q)) < 0
        )

    def greedy(self):
        """The labelled bitangents of the greedy vertical pseudo-triangulation."""
        chosen = []
        for t in sorted(self.bitangents(), key=cmp_to_key(self.theta_order)):
            if not any(self.crosses(t, s) for s in chosen):
                chosen.append(t)
        return chosen

    def edges(self, tangents):
        """Bitangents without their labels: a set of pairs ((body, vertex), (body, vertex))."""
        return {tuple(sorted([(t.i, t.a), (t.j, t.b)])) for t in tangents}
