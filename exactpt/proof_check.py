"""Check a proof that a scene has its first contact at a time T, or no contact.

    python3 -I FILE SCENE PROOF [--until T | --partial | --expect ANSWER] [--work N]
    python3 -I FILE FOLDER [--until T | --partial] [--work N]

It imports the standard library alone and uses no floats. docs/proofs.md has the whole argument.
Numbers and the scene are read by `exactpt.proof_scene`; `exactpt check --write-checker FILE` joins
both into one file.

A proof of no contact that ends before the scene is accepted by --until T, T not after its end, or
by --partial. --expect compares with `exactpt collide --json`.

Exit code: 0 accepted, 1 rejected (with the first line that fails, or what is proved and is not
what was wanted), 2 no proof of this scene, 4 not decided: the budget of work is used up.
"""

import sys

if __name__ == "__main__" and not sys.flags.isolated:
    sys.stderr.write("run it as python3 -I FILE SCENE PROOF: without -I, files nearby take part\n")
    sys.exit(2)

import hashlib
import re
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cmp_to_key
from itertools import chain, combinations, pairwise
from pathlib import Path

from exactpt.proof_scene import (
    APART,
    MAX_BYTES,
    Bare,
    Body,
    Dart,
    Exhausted,
    Format,
    NoProofError,
    Point,
    Poly,
    R,
    Rejected,
    Scene,
    Time,
    Track,
    V,
    about,
    are_same,
    between,
    budget,
    check_json,
    dot_of,
    entries,
    file_bytes,
    integer,
    is_rational,
    meet,
    most_words,
    need,
    number,
    orientation_of,
    rational,
    read,
    read_json,
    require,
    say,
    spend,
    surrounds,
    twelve_digits,
    vector_of,
    written,
    zeros,
)

Angle = tuple[int, int, int]
Face = tuple[Dart, ...]


class Proved(str):
    """The proved statement, in words."""

    statement: str  # the words of it that follow the hash, and the word that bodies are modelled
    until: Fraction  # the end of the span of the proof
    whole: bool  # whether the statement covers the whole span of the scene
    left: int  # the work that was not needed
    time: "Time | None"  # of the contact
    incidences: set[Angle]  # (vertex, 0, vertex) or (vertex, 1, first vertex of an edge)
    scene: "Scene"

    def within(self, text: str) -> "Proved":
        """Return the same statement with another text."""
        proved = Proved(text)
        proved.__dict__.update(self.__dict__)
        return proved


def comes_before(d: Point, e: Point) -> bool:
    """Return True if the direction d has a smaller angle than e, both in [0, 2 pi)."""
    p, q = (v[1] < 0 or (v[1] == 0 and v[0] < 0) for v in (d, e))  # the angle is at least pi
    return p < q or (p == q and d[0] * e[1] - d[1] * e[0] > 0)


# ---- Planar maps: half-edges (u, v), and which one follows which around the face on the left.


class PlanarMap:
    """Half-edges: ``after`` is the next one around a face, ``out`` has the neighbours of vertices.

    ``component`` is the number, from 1 on, of that of each vertex.
    """

    def __init__(self, vertices: int) -> None:
        self.after, self.out = dict[Dart, Dart](), [set[int]() for _ in range(vertices)]
        self.component, self.components = [0] * vertices, 0
        self.faces, self.face_of = set[Face](), dict[Dart, Face]()

    def begin(self, cycles: list[list[int]]) -> None:
        """Make the map of these faces: step 2 without bodies."""
        for cycle in cycles:
            require(len(cycle) > 1 or (len(self.out) == 1 == len(cycles)), "a face of one vertex")
            face = list(pairwise([*cycle, cycle[0]])) if len(cycle) > 1 else []
            for d, e in pairwise([*face, *face[:1]]):
                require(d not in self.after and d[0] != d[1], f"the half-edge {d} is there twice")
                self.after[d] = e
                self.out[d[0]].add(d[1])
        for u, v in self.after:
            require((v, u) in self.after, f"the edge {u} {v} has a face on one side alone")
        for v, around in enumerate(self.out):
            require(len(self.clockwise(v)) == len(around), f"vertex {v} has more than one fan")
        for first in range(len(self.out)):
            todo = [first] * (not self.component[first])
            self.components += len(todo)
            while todo:
                v = todo.pop()
                self.component[v] = self.components
                todo += [u for u in self.out[v] if not self.component[u]]
        if len(self.out) == 1:
            self.faces = {()}  # around a single vertex
        self.make_faces(set(self.after))

    def clockwise(self, v: int) -> list[int]:
        """Return the vertices to which v has an edge, in clockwise order."""
        order, u = list[int](), next(iter(self.out[v]), -1)
        while u >= 0 and (not order or u != order[0]):
            order.append(u)
            u = self.after[u, v][1]
        return order

    def change(self, removed: list[Dart], added: list[list[int]]) -> tuple[set[Dart], set[Angle]]:
        """Change the map without its faces; return removed half-edges and new angles."""
        fans = {v: self.clockwise(v) for d in [*removed, *added] for v in d[:2]}
        gone, come = dict[Dart, Dart](), set[Angle]()  # what followed; an edge may come back
        for u, v in removed:
            require((u, v) in self.after, f"there is no edge {u} {v} that could go")
            for a, b in ((u, v), (v, u)):
                fans[a].remove(b)
                self.out[a].remove(b)
                gone[a, b] = self.after.pop((a, b))
        places: list[tuple[int, int, int]] = []  # at a vertex, the new one stands before another
        for u, v, w, x in added:
            require(u != v and v not in self.out[u], f"the edge {u} {v} is there, or no edge")
            one = self.component[u] == self.component[v]
            require(one, f"the edge {u} {v} joins two components of the map")
            self.out[u].add(v)
            self.out[v].add(u)
            places += [(v, u, w), (u, v, x)]
        while places:
            ready = [(v, u, w) for v, u, w in places if w in fans[v]]
            ready = ready or [p for p in places if not fans[p[0]]][:1]
            require(ready, f"the places {places} of new edges are not there")
            for v, u, w in ready:
                fans[v].insert(fans[v].index(w) if w in fans[v] else 0, u)
                places.remove((v, u, w))
        for v, fan in fans.items():
            for u, w in pairwise([*fan, *fan[:1]]):
                if self.after.get((u, v), gone.get((u, v))) != (v, w):
                    come.add((u, v, w))
                self.after[u, v] = v, w
        for u, v, w, x in added:
            placed = self.after[u, v] == (v, w) and self.after[v, u] == (u, x)
            require(placed, f"the edge {u} {v} does not stand where its item says")
        for u, v in removed:
            require(self.joined(u, v), f"without the edge {u} {v} the map is not connected")
        return {d for d in gone if d not in self.after}, come

    def joined(self, u: int, v: int) -> bool:
        """Return True if a path joins two vertices; search from both ends in turn."""
        seen, fronts = ({u}, {v}), [{u}, {v}]
        while all(fronts) and seen[0].isdisjoint(seen[1]):
            spend(100 * len(fronts[0]) + 100 * len(fronts[1]))
            for i in (0, 1):
                fronts[i] = {y for x in fronts[i] for y in self.out[x]} - seen[i]
                seen[i].update(fronts[i])
        return not seen[0].isdisjoint(seen[1])

    def make_faces(self, touched: set[Dart]) -> set[Face]:
        """Make the faces around changed half-edges anew; return the new faces."""
        old = {self.face_of[d] for d in touched if d in self.face_of}
        pool = touched.union(*old)
        spend(100 * len(pool))
        for d in pool:
            self.face_of.pop(d, None)
        pool, new = {d for d in pool if d in self.after}, set[Face]()
        while pool:
            face = [min(pool)]
            while (d := self.after[face[-1]]) != face[0]:
                face.append(d)
            pool.difference_update(face)
            new.add(tuple(face))
            self.face_of.update(dict.fromkeys(face, tuple(face)))
        self.faces -= old
        self.faces |= new
        v, e, f, euler = len(self.out), len(self.after) // 2, len(self.faces), 2 * self.components
        require(v - e + f == euler, f"{v} vertices, {e} edges, {f} faces: V - E + F is not {euler}")
        return new


# ---- The checker. Steps are those of docs/proofs.md.

CONVEX, REFLEX, FLAT, FULL = "convex", "reflex", "flat", "full"


@dataclass
class Lifetime:
    """The lifetime of an angle, of v -> w after u -> v; its kind is known from the sample on."""

    u: int
    since: Time
    line: int
    kind: str = ""

    def form(self, a: Track, p: Track, b: Track) -> Poly:
        """Return the polynomial that vanishes with the angle."""
        return dot_of(a, p, b) if self.kind in (FLAT, FULL) else orientation_of(a, p, b)


class Checker:
    """Checks a proof, interval by interval; ``line`` is the number of the current line."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.end, self.line = scene, scene.end, 0
        self.now, self.name, self.named = Time(scene.start), Poly(), set[int]()
        self.map = PlanarMap(len(scene.body_of))
        self.body_darts = {d for b in scene.bodies for u, v in b.edges for d in ((u, v), (v, u))}
        self.rings: list[list[int]] = []  # of rigid closed bodies, which are on their left
        self.holes: list[int] = []  # a vertex of each of those that bound holes
        self.ahead: dict[int, int] = {}  # on a ring of a closed body, which is on the left
        self.rigid, self.solid, self.life = list[bool](), set[Dart](), dict[Dart, Lifetime]()
        self.new_angles, self.new_faces, self.outer = set[Dart](), set[Face](), set[Face]()

    # The lines, and step 7: times increase.

    def check_rows(self, rows: list[tuple[int, list[str]]]) -> Proved:
        """Check the lines of a proof from the third on; return what is proved."""
        self.line, (_, first, last) = rows[0]
        start, self.end = rational(first), rational(last)
        within = start == self.scene.start < self.end <= self.scene.end
        require(within, "the time span is not one of the scene")
        for body in self.scene.bodies:
            self.read_body(body)
        faces = [row for row in rows if row[1][0] in ("face", "inside", "outer")]
        cycles, time, k = list[list[int]](), self.now, 0
        for self.line, row in faces:
            cycles.append(self.vertices(row[1:]))
        if cycles:
            self.begin(cycles)
        for line, row in rows[1 + len(faces) :]:
            made, self.line = self.line, line
            k = next((i for i, w in enumerate(row) if w in STARTS), len(row))
            time = self.read_time(row[1:k]) if k > 1 else Time(self.end)
            require(time.compare_rational(self.end) <= 0, "a time after the time span")
            if cycles:
                sample = between(self.now, time, start, (self.end - start) / 2**APART)
                self.line = made
                self.look_at(sample)
                self.line = line
            elif row != ["none"] or self.scene.bodies:
                at_start = row[0] == "contact" and time.compare_rational(start) == 0
                require(at_start, "there is no map")
                self.now = time = Time(start)  # the interval of a root has other ends
            if row[0] == "event":
                self.event(time, row[k:])
        vanishing = self.end_lives(self.life, time)
        if row == ["none"]:
            self.check_clusters(vanishing, time)
            return self.proved(None, set(), "")
        claim = self.check_contact(row[k:], time)
        if not cycles:
            return self.proved(time, set(), claim)
        # All faces together, whatever clusters they are in: docs/proofs.md.
        found = self.incidences({d for face in vanishing for d in face}, time)
        return self.proved(time, found, root_in_words(row[1:k], time, self.name))

    # What is proved, in words: b2.1 is vertex 1, or the edge from it on, of the body 2.

    def proved(self, time: Time | None, found: set[Angle], what: str) -> Proved:
        """Return what is proved."""
        start, end, last, named = self.scene.start, self.end, self.scene.end, set[int]()
        if time is None:
            a, b, c = map(written, (start, end, last))
            rest = f"span of the scene is [{a}, {c}]: nothing is said of ({b}, {c}]"
            text = f"no contact in [{a}, {b}]"
            text += f"; the {rest}" if end < last else ", the whole span"
        elif not found:
            text, named = f"contact at the start t = {written(start)}: {what}", self.named
        else:
            on = "at", "on edge"
            shown = [f"{self.short(u)} {on[k]} {self.short(v)}" for u, k, v in sorted(found)]
            text = f"first contact at T = {what}: incidences exactly {', '.join(shown)}"
            named = {self.scene.body_of[v] for u, _, w in found for v in (u, w)}
        names = ", ".join(f"b{i} is {self.scene.bodies[i].name!a}" for i in sorted(named))
        proved = Proved(text + (f" ({names})" if names else ""))
        proved.until, proved.whole = end, time is not None or end == last
        proved.time, proved.incidences, proved.scene = time, found, self.scene
        return proved

    def short(self, v: int) -> str:
        """Return the short name of a vertex."""
        return f"b{self.scene.body_of[v]}.{v - self.scene.of(v).first}"

    def read_time(self, words: list[str]) -> Time:
        """Return the time that these words denote."""
        low, high = rational(words[0]), rational(words[1])
        if words[2:3] == ["@"]:
            v = self.vertices(words[3:])
            breaks = self.scene.breaks_in(v, low, high) - {high}
            require(
                not breaks, f"a breakpoint is between {written(low):.200} and {written(high):.200}"
            )
            p = [self.scene.track(u, low) for u in v]
            f = orientation_of(*p) if len(p) == 3 else vector_of(*p)[0]
        else:
            f = Poly(map(integer, words[2:]))
        self.name = f.primitive()
        if low == high and (len(words) == 2 or (f and f.sign_at(low) == 0)):
            return Time(low)
        require(f, "no time is named by what is always 0")
        if low < high and f.sign_at(low) and f.sign_at(high) and f.variations(low, high) == 1:
            time = Time(low, high, f)
        else:
            roots = list(f.square_free().roots(low, high, DEPTH)) if low < high else []
            require(
                len(roots) == 1,
                f"{len(roots)} roots between {written(low):.200} and {written(high):.200}, not one",
            )
            time = roots[0]
        while (time.high - time.low) * 2**20 > self.end - self.scene.start:
            time.refine()  # for speed alone
        return time

    def vertices(self, words: Iterable[str]) -> list[int]:
        """Return the vertices that these words denote."""
        n, found = len(self.scene.body_of), [int(w) for w in words]
        for v in found:
            require(v < n, f"not a vertex, 0 to {n - 1}: {v}")
        return found

    # Step 1: the scene.

    def read_body(self, body: Body) -> None:
        """Check a body by itself."""
        self.rigid.append(self.scene.is_rigid(body, self.end))
        if not body.closed:
            return
        for ring, is_hole in body.rings:
            place = [self.scene.at(v, self.scene.start) for v in ring]
            turns = pairwise([*place, place[0]])
            area = sum(p[0] * q[1] - p[1] * q[0] for p, q in turns)
            require(area, f"{body.name!a} has no area at the start")
            cycle = [*ring] if (area > 0) != is_hole else [*ring[::-1]]
            edges = [*pairwise([*cycle, cycle[0]])]
            self.ahead.update(edges)
            if self.rigid[-1]:
                self.rings.append(cycle)
                self.holes += cycle[:1] if is_hole else []
                self.solid.update(edges)

    # Step 2: the map, and its changes.

    def begin(self, cycles: list[list[int]]) -> None:
        """Make the map at the start and check it."""
        self.map.begin([*cycles, *self.rings])
        for u, v in self.body_darts:
            require((u, v) in self.map.after, f"the body edge {u} {v} is missing")
        # Each component is in a hole of its own of a rigid body, but for one.
        inner = {self.map.component[v] for v in self.holes}
        apart = len(inner) == len(self.holes) == self.map.components - 1
        require(apart, "the map is not connected: a component is not alone in a hole")
        self.outermost = set(self.map.component) - inner
        self.check_insides(self.ahead)
        self.new_faces = self.map.faces.copy()
        self.begin_lives((u, v, w) for (u, v), (_, w) in self.map.after.items())

    def check_insides(self, vertices: Iterable[int]) -> None:
        """Check that edges from vertices into the inside of their body lead to that body."""
        for v in vertices:
            # Clockwise from the edge behind v, up to the one ahead, is the inside.
            order = self.map.clockwise(v)
            i = next(i for i, u in enumerate(order) if self.ahead.get(u) == v)
            order = order[i:] + order[:i]
            for u in order[: order.index(self.ahead[v])]:
                same = self.scene.body_of[u] == self.scene.body_of[v]
                require(same, f"the edge {v} {u} runs inside a body to another one")

    def begin_lives(self, angles: Iterable[Angle]) -> None:
        """Start the lives of angles at the current time."""
        for u, v, w in angles:
            if (v, w) not in self.solid:
                self.life[v, w] = Lifetime(u, self.now, self.line)
                self.new_angles.add((v, w))

    def event(self, time: Time, words: list[str]) -> None:
        """Apply and check all changes at one time."""
        item, items = list[int](), {kind: list[list[int]]() for kind in "-+="}
        for word in words:
            if word in items:
                items[word].append(item := [])
            else:
                item += self.vertices([word])
        removed, renewed = ([(u, v) for u, v in items[sort]] for sort in "-=")
        for u, v, *_ in [*items["-"], *items["+"]]:
            require((u, v) not in self.body_darts, f"the body edge {u} {v} cannot go or come")
        for d in renewed:
            require(d in self.life, f"there is no angle of {d} to be taken anew")
        gone, come = self.map.change(removed, items["+"])
        for u, v, w in come:
            require((u, v) not in self.solid, f"an edge inside a rigid body, {v} {w}")
        # Angles that end, in the faces of the map before: steps 3 and 6.
        new = {(v, w) for _, v, w in come}
        again = [(self.life[d].u, *d) for d in renewed if d not in gone | new]
        ended = {d for d in [*gone, *new, *renewed] if d in self.life}
        self.check_clusters(self.end_lives(ended, time), time)
        self.now = time
        self.new_faces = self.map.make_faces(gone | new | {(u, v) for u, v, _ in come})
        self.new_faces |= {self.map.face_of[v, w] for _, v, w in again}
        self.outer &= self.map.faces
        self.check_insides({v for _, v, _ in come if v in self.ahead})
        self.begin_lives([*come, *again])

    # Steps 3, 4, 5: the interval after now.

    def look_at(self, sample: Fraction) -> None:
        """Check new angles and faces at a rational time inside the interval that begins now."""
        for v, w in self.new_angles:
            u = self.life[v, w].u
            tracks = [self.scene.track(x, sample) for x in (u, v, w)]
            turn = orientation_of(*tracks).sign_at(sample)
            along = dot_of(*tracks).sign_at(sample) if turn == 0 else 0
            straight = along > 0 if u == w else along < 0
            require(turn or straight, f"the angle {u} {v} {w} is 0 at t = {written(sample):.200}")
            kind = CONVEX if turn > 0 else REFLEX if turn < 0 else FULL if u == w else FLAT
            self.life[v, w].kind = kind
        for f in self.new_faces:
            self.check_face(f, sample)
        require(len(self.outer) == 1, f"{len(self.outer)} faces without a convex angle, not one")
        for v in {v for v, _ in self.new_angles}:
            # The next edge counter-clockwise passes the direction 0 once in all.
            d = [self.direction(v, u, sample) for u in reversed(self.map.clockwise(v))]
            passes = sum(not comes_before(d[i - 1], e) for i, e in enumerate(d))
            require(passes == 1, f"the edges of vertex {v} go around it {passes} times")
        self.new_angles.clear()
        if self.now.compare_rational(start := self.scene.start) == 0:
            lives = [((life.u, *d), d, life) for d, life in self.life.items()]
            forms = [(d, k.form(*(self.scene.track(x, start) for x in u))) for u, d, k in lives]
            vanishing = {self.map.face_of[d] for d, f in forms if f.sign_at(start) == 0}
            self.check_clusters(vanishing, self.now)

    def check_face(self, face: Face, sample: Fraction) -> None:
        """Check a face: step 4."""
        self.outer.discard(face)
        if face and face[0] in self.solid:
            return
        kinds = [self.life[d].kind for d in face]
        convex, shown = kinds.count(CONVEX), " ".join(str(u) for u, _ in face)
        if convex == 0:
            within = any(self.map.component[v] not in self.outermost for v, _ in face)
            require(not within, f"the face {shown} of a hole has no convex angle")
            self.outer.add(face)
            return
        require(convex >= 3, f"the face {shown} has {convex} convex angles")
        require(FULL not in kinds, f"the face {shown} has a dead end")
        if convex > 3:
            require(REFLEX not in kinds, f"the face {shown} has {convex} convex angles, not three")
            # The edges turn left, or not at all: count how often they pass the direction 0.
            d = [self.direction(u, v, sample) for u, v in face]
            turns = sum(comes_before(e, d[i - 1]) for i, e in enumerate(d))
            require(turns == 1, f"the face {shown} turns {turns} times")

    def direction(self, u: int, v: int, t: Fraction) -> Point:
        """Return the direction from u to v at a rational time."""
        (a, b), (c, d) = self.scene.at(u, t), self.scene.at(v, t)
        spend(4000 + 50 * most_words((a, c)) ** 2)
        return c - a, d - b

    def end_lives(self, darts: Iterable[Dart], time: Time) -> set[Face]:
        """Check lives that end at a time: step 3. Return the faces with a vanishing angle."""
        return {self.map.face_of[d] for d in sorted(darts) if self.end_life(d, time)}

    def end_life(self, d: Dart, time: Time) -> bool:
        """Check the life of an angle; return True if the angle vanishes at its end."""
        life = self.life.pop(d)
        angle, i = (life.u, *d), self.scene.body_of[d[0]]
        if self.rigid[i] and all(self.scene.body_of[v] == i for v in angle):
            return False
        shown = f"the {life.kind} angle {life.u} {d[0]} {d[1]} of line {life.line}"
        vanishes = False
        for start, end, tracks in self.scene.pieces(angle, life.since, time):
            straight = life.kind in (CONVEX, REFLEX) or not orientation_of(*tracks)
            require(straight, f"{shown} is not straight throughout its life")
            f = life.form(*tracks)
            require(f, f"{shown} vanishes throughout a piece of its life")
            inside, vanishes = zeros(f, start, end)
            ends = end is time or not vanishes
            require(ends and not inside, f"{shown} vanishes during its life")
        return vanishes

    # Step 6: a contact at a time between intervals.

    def check_clusters(self, faces: set[Face], time: Time) -> None:
        """Check that the clusters of these faces have no contact."""
        while faces:
            todo, cluster = [faces.pop()], set[Dart]()
            while todo:
                face = set(todo.pop())
                cluster |= face
                across = {self.map.face_of[v, u] for u, v in face - self.body_darts} & faces
                todo += across
                faces -= across
            if found := self.incidences(cluster, time):
                u, on, v = min(found, key=lambda touch: (touch[1], touch))
                what = f"vertices {u} and {v} coincide"
                what = f"vertex {u} is on the edge {v} {self.after_on_ring(v)}" if on else what
                raise Rejected(f"{what} at t = {time!s:.200}")

    def incidences(self, darts: set[Dart], time: Time) -> set[Angle]:
        """Return all incidences at a time among the vertices and body edges of half-edges."""
        tracks = self.scene.tracks_at({v for v, _ in darts}, time)
        spend(len(tracks) * (2000 + 160 * most_words(chain(*chain(*tracks.values()))) ** 2))

        def order(u: int, v: int) -> int:
            x, y = vector_of(tracks[v], tracks[u])
            return time.sign_of(x) or time.sign_of(y)

        groups, rank = list[list[int]](), dict[int, int]()
        for v in sorted(tracks, key=cmp_to_key(order)):
            if not groups or order(groups[-1][0], v):
                groups.append([])
            groups[-1].append(v)
            rank[v] = len(groups) - 1
        found = {(min(u, v), 0, max(u, v)) for g in groups for u, v in combinations(g, 2)}
        for u, w in {(min(d), max(d)) for d in darts & self.body_darts}:
            first, last = sorted((rank[u], rank[w]))
            for group in groups[first + 1 : last]:
                if time.sign_of(orientation_of(tracks[u], tracks[group[0]], tracks[w])) == 0:
                    edge = u if self.after_on_ring(u) == w else w
                    found |= {(v, 1, edge) for v in group}
        return found

    # Step 8: the contact.

    def after_on_ring(self, v: int) -> int:
        """Return the next vertex of a ring or chain, in the order of the scene."""
        body = self.scene.of(v)
        ring = next(ring for ring, _ in body.rings if v in ring)
        return v + 1 if v + 1 in ring else ring[0]

    def check_contact(self, row: list[str], time: Time) -> str:
        """Check that the contact is there at a time; return it in words."""
        scene, kind = self.scene, " ".join(w for w in row if w.isalpha())
        numbers = [w for w in row if not w.isalpha()]
        if kind == "vertex inside":
            require(int(numbers[1]) < len(scene.bodies), f"there is no body {numbers[1]}")
            numbers[1:] = map(str, scene.bodies[int(numbers[1])].vertices)
        v = self.vertices(numbers)
        other, there = scene.of(v[-1]), False
        at_start = time.compare_rational(scene.start) == 0 and scene.of(v[0]) is not other
        if kind in ("vertex vertex", "vertex edge"):
            tracks = scene.tracks_at(v, time)
            there = v[0] not in v[1:] and (len(v) == 2 or (v[1], v[2]) in self.body_darts)
            c, a, b = (tracks[u] for u in (v[0], v[1], v[-1]))
            there = there and time.sign_of(orientation_of(c, a, b)) == 0
            there = there and time.sign_of(dot_of(a, c, b)) <= 0
        elif kind == "edge edge":
            there = at_start and {(v[0], v[1]), (v[2], v[3])} <= self.body_darts
            there = there and meet(*(scene.place(u, scene.start) for u in v))
        elif at_start and other.closed:
            place = {u: scene.place(u, scene.start) for u in v}
            rings = ([place[u] for u in ring] for ring, _ in other.rings)
            there = sum(surrounds(ring, place[v[0]]) for ring in rings) % 2 == 1
            p = place[v[0]]
            there |= any(meet(p, p, *(place[u] for u in e)) for e in other.edges)
        require(there, f"there is no such contact at t = {time!s:.200}: {' '.join(row):.200}")
        self.named = {scene.body_of[v[0]], scene.body_of[v[-1]]}
        if kind == "vertex inside":
            return f"{self.short(v[0])} in the inside of b{scene.body_of[v[-1]]}"
        if kind == "vertex vertex":
            return f"{self.short(min(v))} at {self.short(max(v))}"
        one, two = (self.short(a if self.after_on_ring(a) == b else b) for a, b in (v[:2], v[-2:]))
        if kind == "edge edge":
            return f"edge {one} meets edge {two}"
        return f"{self.short(v[0])} on edge {two}"


def root_in_words(row: list[str], time: Time, f: Poly) -> str:
    """Return a time as a proof has it: a number, or a root of f in an interval."""
    low, high = rational(row[0]), rational(row[1])
    if low == high:
        return written(low)
    f_in_words = " ".join(map(written, f))
    span = f"[{written(low)}, {written(high)}]"
    return f"{twelve_digits(time)}..., the root of {f_in_words} in {span}"


# ---- The file.

DEPTH = 64  # so often an interval in a proof is halved to find its root
MAX_TERMS, MAX_DIGITS_OF_TIME = 193, 20_000  # of the polynomial that names a time
TIME = f"{R} {R}( @( {V}){{2,3}}|( -?[0-9]++)*+)"
ITEM = f" -( {V}){{2}}| =( {V}){{2}}| [+]( {V}){{4}}"
WHAT = f"vertex {V} (vertex|inside|edge {V}) {V}|edge {V} {V} edge {V} {V}"
LINES = {  # by their first words
    "exactpt-proof": "exactpt-proof 1",
    "scene": "scene sha256 [^ ]+",
    "span": f"span {R} {R}",
    **{kind: f"{kind}( {V})+" for kind in ("face", "inside", "outer")},
    "event": f"event {TIME}({ITEM})*+",
    "contact": f"contact {TIME} ({WHAT})",
    "none": "none",
}
FORMS = {word: re.compile(form) for word, form in LINES.items()}
STARTS = ("-", "+", "=", "vertex", "edge")  # of what follows the time in a line
ORDER = "exactpt-proof scene span( face| inside| outer)*+( event)*+ (contact|none)"


def is_bounded(row: list[str]) -> bool:
    """Return True if the numbers of a line and the polynomial of its time are small enough."""
    if row[0] not in ("span", "event", "contact"):
        return True
    end = next((i for i, w in enumerate(row) if w in (*STARTS, "@")), len(row))
    digits = sum(len(c.removeprefix("-")) for c in row[3:end])
    is_short = end - 3 <= MAX_TERMS and digits <= MAX_DIGITS_OF_TIME
    return is_short and all(map(is_rational, row[1:3]))


FORMAT = Format(FORMS, ORDER, is_bounded)


def check(scene_file: bytes, proof_file: bytes, work: int | None = None) -> Proved:
    """Check a proof; return what it proves. Raises `Rejected`, `NoProofError`, or `Exhausted`."""
    checker = None
    with budget(work, len(scene_file) + len(proof_file)) as spent:
        try:
            need(max(len(scene_file), len(proof_file)) <= MAX_BYTES, "or the proof: too many bytes")
            rows, text = read(proof_file, FORMAT), scene_file.decode("utf-8-sig")
            digest = hashlib.sha256(scene_file).hexdigest()
            if rows[1][1][2] != digest:
                raise NoProofError(
                    "the proof is of another scene: the hash of its file is another one"
                )
            scene = Scene(text)
            need(not any(body.radius for body in scene.bodies), "a radius: no proof is possible")
            require(
                not scene.groups,
                "a proof by a tiling counts all pairs, this scene ignores some",
            )
            checker = Checker(scene)
            proved = checker.check_rows(rows[2:])
        except UnicodeDecodeError:
            raise NoProofError("a file is not UTF-8") from None
        except Rejected as verdict:
            where = f"line {checker.line}: " if checker else ""
            raise Rejected(f"rejected: {where}{verdict}") from None
        proved.left, proved.statement = spent.left, str(proved)
        of_bodies = about(is_modelled=scene.is_modelled)
        return proved.within(f"accepted: {digest[:16]} {of_bodies}{proved}")


# ---- What is wanted.


def wishes(arguments: list[str]) -> tuple[list[Path], dict[str, str]]:
    """Return the paths and the options of a call."""
    paths, given, rest = list[Path](), dict[str, str](), iter(arguments)
    for word in rest:
        if word in ("--partial", "--until", "--expect", "--work"):
            given[word] = "" if word == "--partial" else next(rest, "-")
        else:
            paths.append(Path(word))
    until, work = given.get("--until", "0"), given.get("--work", "0")
    one = len(given.keys() - {"--work"}) <= 1 and not any(str(p)[:2] == "--" for p in paths)
    ok = one and is_rational(until) and re.fullmatch("[0-9]{1,18}", work)
    if not ok or len(paths) not in (1, 2) or (len(paths) == 1 and "--expect" in given):
        raise NoProofError(f"usage: {USAGE}")
    return paths, given


def judge(proved: Proved, given: dict[str, str], answer: bytes) -> None:
    """Check that the statement is the requested one."""
    if "--expect" in given:
        reason = differs(proved, answer)
        require(not reason, f"rejected: {reason} {given['--expect']!a}; proved is: {proved}")
    elif not proved.whole and "--partial" not in given:
        enough = "--until" in given and rational(given["--until"]) <= proved.until
        require(
            enough, f"rejected: proved up to {written(proved.until)} only (see --until, --partial)"
        )


def differs(proved: Proved, answer: bytes) -> str:
    """Return how the output of `exactpt collide --json` differs from the statement; "" if not."""
    try:
        check_json(data := read_json(answer.decode("utf-8-sig")), 32)
        contact, pairs = data["contact"], set[Angle]()
        if contact is None:
            is_same = proved.time is None and proved.until >= number(data["until"])
            return "" if is_same else "no contact is the answer of"
        terms = entries(contact["time"]["polynomial"])
        need(all(re.fullmatch("-?[0-9]+", c) for c in terms), "no polynomial:", terms)
        f = Poly(map(integer, terms))
        low, high = (number(contact["time"][k]) for k in ("low", "high"))
        need(f and (low != high or not f.sign_at(low)), "no time:", contact["time"])
        bodies, is_start = {b.name: b for b in proved.scene.bodies}, contact["kind"] == "initial"
        for pair in entries(contact["pairs"]):
            on = "edge" in pair["b"]
            sides = (pair["a"], "vertex"), (pair["b"], "edge" if on else "vertex")
            shown = [s[k] for s, k in sides if (type(s["body"]), type(s[k])) == (str, Bare)]
            need(len(shown) == 2 and all(re.fullmatch(V, i) for i in shown), "no feature:", pair)
            u, v = (bodies[s["body"]].vertices[int(s[k])] for s, k in sides)
            pairs.add((u, 1, v) if on else (min(u, v), 0, max(u, v)))
    except (ValueError, LookupError, TypeError, RecursionError, NoProofError) as error:
        raise NoProofError(f"the answer is none of exactpt collide --json: {error!a:.60}") from None
    if proved.time is None:
        return "a contact is the answer of"
    within = proved.time.compare_rational(low) >= 0 >= proved.time.compare_rational(high)
    if not within or proved.time.sign_of(f) != 0:
        return "another time is the answer of"
    if is_start:
        return "" if not proved.incidences else "a contact at the start is the answer of"
    return "" if pairs == proved.incidences else "other incidences are in the answer of"


USAGE = "python3 -I FILE SCENE PROOF [--until T | --partial | --expect ANSWER] [--work N] or FOLDER"


def main(arguments: list[str]) -> int:
    """Check a file or a folder; return the exit code."""
    try:
        if arguments == ["--version"]:
            return say(hashlib.sha256(Path(__file__).read_bytes()).hexdigest(), 0, sys.stdout)
        paths, given = wishes(arguments)
        work = int(given["--work"]) if "--work" in given else None
        answer = file_bytes(Path(given["--expect"])) if "--expect" in given else b""
        scene, *proof = map(file_bytes, paths) if paths[1:] else [b""]
        proved = check(scene, proof[0], work) if proof else check_chain(paths[0], work)
        judge(proved, given, answer)
        return say(proved, 0, sys.stdout)
    except (Rejected, Exhausted) as verdict:
        return say(str(verdict), 1 if isinstance(verdict, Rejected) else 4, sys.stdout)
    except (NoProofError, OSError, ValueError) as error:
        return say(str(error), 2, sys.stderr)


# ---- Chains: proofs one after the other, of the parts of one run.


def check_chain(folder: Path, work: int | None = None) -> Proved:
    """Check ``1.proof`` with ``1.scene.json``, and so on; each begins where the last one ends."""
    stems = [path.stem for path in folder.glob("*.proof")]
    numbers = sorted(int(stem) for stem in stems if re.fullmatch("[1-9][0-9]{0,8}", stem))
    if not numbers or numbers[0] != 1:
        reason = "has no 1.proof" if folder.is_dir() else "is no folder"
        raise NoProofError(f"{str(folder)!a} {reason}")
    require(numbers[-1] == len(numbers), "rejected: the numbers of the parts have a gap")
    seams, last, start, chain = list[str](), None, Fraction(0), ["exactpt-chain 1"]
    is_modelled = False  # in one of the parts
    for k in numbers:
        try:
            scene, proof = (file_bytes(folder / f"{k}.{e}") for e in ("scene.json", "proof"))
            proved = check(scene, proof, work)
        except Rejected as verdict:
            raise Rejected(f"{verdict} (part {k})") from None
        work, here = work and proved.left, proved.scene
        start = here.start if last is None else start
        is_modelled |= here.is_modelled
        seams += [] if last is None else seam(last, proved, k)
        a, b, before = (hashlib.sha256(x).hexdigest() for x in (scene, proof, chain[-1].encode()))
        chain.append(f"{k} {a} {b} {written(here.start)} {written(proved.until)} {before}")
        last = proved
    manifest = folder / "run.chain"
    if manifest.exists():
        same = file_bytes(manifest) == ("\n".join(chain) + "\n").encode()
        require(same, "rejected: the parts are not those of run.chain")
    assert last is not None  # noqa: S101
    digest, said = hashlib.sha256(chain[-1].encode()).hexdigest()[:16], last.statement
    if last.time is None:
        said = said.replace(f"[{written(last.scene.start)}, ", f"[{written(start)}, ", 1)
    along = f"along {len(numbers)} parts from t = {written(start)}"
    text = f"accepted: {digest} {along}: {about(is_modelled=is_modelled)}{said}"
    return last.within("; ".join([text, *seams]))


def seam(before: Proved, after: Proved, k: int) -> list[str]:
    """Check that a part begins where the last one ends; return which bodies come and go there."""
    t = after.scene.start
    require(before.time is None, f"rejected: part {k - 1} ends with a contact")
    require(
        before.until == t,
        f"rejected: part {k} begins at {written(t):.200}, not at {written(before.until):.200}",
    )
    old, new = ({body.name: body for body in p.scene.bodies} for p in (before, after))
    for name, a, b in [(name, old[name], new[name]) for name in new if name in old]:
        one, other = ([(r.start - x.first, h) for r, h in x.rings] for x in (a, b))
        same = one == other and a.closed == b.closed and a.size == b.size
        same = same and are_same(a.places(t), b.places(t))
        require(same, f"rejected: part {k}: {name!a:.200} is not what or where it was")
    come, go = [n for n in new if n not in old], [n for n in old if n not in new]
    changes = ("enters", come), ("leaves", go)
    words = [f"{word} {', '.join(map(ascii, names))}" for word, names in changes if names]
    return [f"at t = {written(t)} {' and '.join(words)}"] if words else []


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
