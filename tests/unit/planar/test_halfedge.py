"""The planar map: each operation, its inverse, and an audit that sees broken links."""

import pytest

from exactpt.errors import AuditError
from exactpt.indices import NO_VERTEX
from exactpt.planar.halfedge import PlanarMap, found


def polygon(n):
    """A cycle of n vertices: half-edge 2 i leads from i to i + 1, with the inside on its left."""
    m = PlanarMap()
    edges = [m.add_edge(i, (i + 1) % n) for i in range(n)]
    for e, f in zip(edges, [*edges[1:], edges[0]], strict=True):
        m.link(e, f)
        m.link(f ^ 1, e ^ 1)
    return m


def faces(m):
    found = set()
    for h in m.half_edges():
        cycle = [m.origin[g] for g in m.face(h)]
        least = cycle.index(min(cycle))
        found.add(tuple(cycle[least:] + cycle[:least]))
    return found


def test_a_polygon_has_an_inside_and_an_outside():
    m = polygon(5)

    m.audit()
    assert faces(m) == {(0, 1, 2, 3, 4), (0, 4, 3, 2, 1)}
    assert m.star(0) == [0, 9]
    assert m.target(0) == 1


def test_a_split_face_and_its_edge_removed():
    m = polygon(6)
    before = faces(m)

    e = m.split_face(0, 6)

    m.audit()
    assert (m.origin[e], m.target(e)) == (0, 3)
    assert faces(m) == {(0, 1, 2, 3), (0, 3, 4, 5), (0, 5, 4, 3, 2, 1)}
    m.remove_edge(e)
    m.audit()
    assert faces(m) == before
    assert m.origin[e] == m.origin[e ^ 1] == NO_VERTEX


def test_handles_are_used_again():
    m = polygon(6)
    first = m.split_face(0, 6)
    m.remove_edge(first)

    second = m.split_face(2, 8)

    assert second >> 1 == first >> 1
    m.audit()
    assert len(m.half_edges()) == 14


def test_an_edge_slides_along_its_neighbour():
    """A diagonal from 0 to 3 of a hexagon: its origin moves back along the edge before it."""
    m = polygon(6)
    e = m.split_face(0, 6)
    neighbour = m.origin[m.previous[e]]

    m.slide_origin(e)

    m.audit()
    assert (m.origin[e], m.target(e)) == (neighbour, 3)
    assert sorted(map(len, faces(m))) == [3, 5, 6]


def test_a_slid_target_mirrors_a_slid_origin():
    for n in (4, 5, 6, 9):
        m = polygon(n)
        e = m.split_face(0, 4)
        before = faces(m)
        origin, target = m.origin[e], m.target(e)

        m.slide_target(e)
        m.audit()
        assert m.origin[e] == origin
        assert m.target(e) != target
        h = e ^ 1
        m.slide_origin(h)
        m.audit()
        moved = faces(m)
        assert len(moved) == len(before)


def test_a_copy_and_its_original_grow_apart():
    """Vectors share their room as long as nobody appends: a copy shares none."""
    m = polygon(3)
    other = m.copy()
    m.add_edge(0, 2)
    other.add_edge(1, 0)

    assert list(m.origin) == [0, 1, 1, 2, 2, 0, 0, 2]
    assert list(other.origin) == [0, 1, 1, 2, 2, 0, 1, 0]


def test_a_map_does_not_share_the_lists_that_it_is_made_of():
    m = polygon(3)
    origin, following, previous = list(m.origin), list(m.following), list(m.previous)
    other = PlanarMap.of(origin, following, previous, [])
    other.place(0, 5)

    assert origin == list(m.origin)
    assert faces(m) == {(0, 1, 2), (0, 2, 1)}


def test_half_edges_are_integers_side_by_side():
    m = polygon(3)

    for numbers in (m.origin, m.following, m.previous):
        seen = memoryview(numbers)
        assert (seen.itemsize, seen.nbytes) == (8, 48)


def test_a_copy_is_independent():
    m = polygon(4)
    other = m.copy()

    other.split_face(0, 4)

    assert len(m.half_edges()) == 8
    m.audit()
    other.audit()


@pytest.mark.parametrize(
    "damage",
    [
        lambda m: m.previous.__setitem__(2, 4),
        lambda m: m.following.__setitem__(0, 4),
        lambda m: m.origin.__setitem__(2, 3),
        lambda m: m.link(0, 6),
    ],
)
def test_the_audit_sees_a_broken_link(damage):
    m = polygon(5)
    damage(m)

    with pytest.raises(AuditError):
        m.audit()


def test_bug_walks_of_a_forged_map_end():
    """The hostile fuzzer found a saved run that was audited for ever."""
    m = polygon(5)
    m.following[4] = m.following[0]
    with pytest.raises(AuditError, match="the half-edges after 0 return elsewhere"):
        m.face(m.half_edges()[0])

    m = polygon(5)
    m.previous[3] = m.previous[7]
    with pytest.raises(AuditError, match="return elsewhere"):
        list(map(m.star, m.half_edges()))


def test_found_half_edge_that_is_missing_is_a_broken_map():
    """Not a StopIteration, which ends the generator around it, or makes it a RuntimeError."""
    assert found(iter([4, 6]), "edge") == 4
    with pytest.raises(AuditError, match="there is no edge"):
        next(found([], "edge") for _ in range(2))
