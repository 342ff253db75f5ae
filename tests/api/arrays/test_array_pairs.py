"""Pairs of bodies that translate, beside `first_contact` for each of them."""

import numpy as np
import pytest
from array_help import Table, agrees, boxes, some_pairs, stars, ulps

from exactpt import InputError, Scene, first_contact
from exactpt.arrays import blocks, first_contacts
from exactpt.testing import reference


def assert_all_agree(table, ask=reference.first_contact):
    contacts = table.asked()
    count = len(contacts)
    assert [i for i in range(count) if not agrees(contacts, i, ask(contacts.scene(i)))] == []
    return contacts


def generic(rng, n, m, degree=1, scale=1.0):
    motions = rng.uniform(-1.0, 1.0, (n, 2, degree + 1)) * scale
    return Table([s * scale for s in stars(rng, n)], motions, some_pairs(rng, n, m))


def degenerate(rng, n, m, degree=1, scale=1.0):
    motions = rng.integers(-2, 3, (n, 2, degree + 1)) / 2.0 * scale
    closed = rng.integers(0, 4, n) > 0
    return Table([s * scale for s in boxes(rng, n)], motions, some_pairs(rng, n, m), closed)


def triangles(rng, n, spread):
    at = rng.uniform(0.0, spread, (n, 1, 2))
    return (at + rng.uniform(-1.0, 1.0, (n, 3, 2))).reshape(-1, 2), np.arange(0, 3 * n + 1, 3)


@pytest.mark.long
@pytest.mark.parametrize("degree", [1, 2])
def test_generic_pairs(degree):
    contacts = assert_all_agree(generic(np.random.default_rng(degree), 100, 300, degree))

    assert 30 < contacts.found.sum() < 270
    assert contacts.exact_share == 0.0


@pytest.mark.long
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_degenerate_pairs(degree):
    table = degenerate(np.random.default_rng(degree), 100, 400, degree)

    contacts = assert_all_agree(table, lambda scene: first_contact(scene, method="pairs"))

    assert set(contacts.kind.tolist()) == {0, 1, 3, 4}
    assert 0.0 < contacts.exact_share < 1.0


def test_degenerate_pairs_by_a_tiling():
    assert_all_agree(degenerate(np.random.default_rng(4), 40, 60), first_contact)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_many_degenerate_pairs(seed):
    rng = np.random.default_rng((5, seed))
    for degree in (1, 1, 1, 2, 3):
        table = degenerate(rng, 500, 1000, degree)
        table.time = np.array([(0.0, 2.0), (-1.5, 3.0), (0.3, 1.0)][seed % 3])
        assert_all_agree(table, lambda scene: first_contact(scene, method="pairs"))


@pytest.mark.long
@pytest.mark.parametrize("scale", [2.0**-1000, 2.0**-200, 2.0**200, 2.0**900])
@pytest.mark.parametrize("degree", [1, 2])
def test_pairs_of_any_size(scale, degree):
    rng = np.random.default_rng(6)

    assert_all_agree(generic(rng, 40, 60, degree, scale))
    assert_all_agree(degenerate(rng, 40, 60, degree, scale))


@pytest.mark.long
@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_spans_that_start_elsewhere(degree):
    rng = np.random.default_rng(7)
    for table in (generic(rng, 60, 120, degree), degenerate(rng, 60, 120, degree)):
        spans = np.sort(rng.integers(-8, 9, (120, 2)), axis=1) / 4
        spans[:, 1] += spans[:, 0] == spans[:, 1]
        table.time = spans
        assert_all_agree(table)


@pytest.mark.long
@pytest.mark.parametrize("length", [2.0**-300, 2.0**-160, 2.0**160, 2.0**300])
def test_spans_of_any_length(length):
    """Velocities and accelerations are such that the same happens in a unit of length."""
    rng = np.random.default_rng(8)
    for table in (generic(rng, 40, 80, 2), degenerate(rng, 40, 80, 2)):
        table.coefficients = table.coefficients * length ** -np.arange(3.0)
        table.time = table.time * length
        assert assert_all_agree(table).found.any()


@pytest.mark.long
def test_a_common_higher_term_does_not_matter():
    """What all bodies do together, such as falling, is no relative motion."""
    rng = np.random.default_rng(9)
    table = generic(rng, 100, 200, 5)
    table.coefficients[:, :, 2:] = table.coefficients[0, :, 2:]

    contacts = assert_all_agree(table)

    assert contacts.found.any()
    assert contacts.exact_share == 0.0


@pytest.mark.long
def test_motions_of_higher_degree_are_decided_exactly_where_boxes_meet():
    contacts = assert_all_agree(generic(np.random.default_rng(10), 60, 100, 4))

    assert contacts.found[contacts.kind != 1].any()
    assert (contacts.exact | ~contacts.found | (contacts.kind == 1)).all()
    assert contacts.exact_share < 1.0


def test_exact_arithmetic_decides_less_than_one_generic_pair_in_a_thousand():
    rng = np.random.default_rng(11)
    vertices, offsets = triangles(rng, 50_000, 30.0)
    pairs = some_pairs(rng, 50_000, 100_000)
    near = np.abs(vertices[3 * pairs[:, 0]] - vertices[3 * pairs[:, 1]]).max(axis=1) < 8.0
    velocities = rng.uniform(-2.0, 2.0, (50_000, 2))

    contacts = first_contacts(vertices, offsets, pairs[near], velocities=velocities)

    assert contacts.exact.sum() < near.sum() / 1000
    assert (contacts.kind == 3).sum() > 100
    assert ulps(contacts).max() <= 2


@pytest.mark.parametrize("most", [40, 3])
def test_bodies_of_many_vertices_are_searched_by_boxes(monkeypatch, most):
    monkeypatch.setattr(blocks, "LARGEST", most)
    table = generic(np.random.default_rng(12), 40, 80)

    contacts = assert_all_agree(table)

    assert 0.0 < contacts.exact_share < 1.0


def test_the_length_of_a_chunk_does_not_matter(monkeypatch):
    table = degenerate(np.random.default_rng(13), 60, 200)
    whole = table.asked()
    monkeypatch.setattr(blocks, "CHUNK", 10)
    monkeypatch.setattr("exactpt.arrays.pairs.BLOCK", 7)

    parts = table.asked()

    for name in ("found", "low", "high", "kind", "body", "vertex", "edge", "other_vertex", "exact"):
        assert np.array_equal(getattr(whole, name), getattr(parts, name)), name


def test_one_body_inside_the_other():
    around = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)]
    inner = [(4.0, 4.0), (5.0, 4.0), (4.0, 5.0)]
    points = [(4.5, 6.0), (9.0, 9.5)]
    vertices = np.array([*around, *inner, *points])
    offsets = [0, 4, 7, 8, 9]
    pairs = [(0, 1), (1, 0), (0, 2), (2, 0), (0, 3)]

    closed = first_contacts(vertices, offsets, pairs)
    chain = first_contacts(vertices, offsets, pairs, closed=[False, True, True, True])

    assert closed.kind.tolist() == [1, 1, 1, 1, 0]
    assert closed.vertex.tolist() == [-1] * 5
    assert chain.kind.tolist() == [0] * 5
    assert closed.contact(0).initial_pairs == (("0", "1"),)


def test_a_body_of_a_pair_is_checked_and_no_other():
    tie = [(0, 0), (2, 2), (2, 0), (0, 1)]
    vertices, offsets = np.array([*tie, (5, 5), (6, 6)]), [0, 4, 5, 6]

    assert len(first_contacts(vertices, offsets, [(1, 2)])) == 1
    with pytest.raises(InputError, match=r"body '0': not a simple polygon"):
        first_contacts(vertices, offsets, [(1, 2), (2, 0)])


def test_contacts_are_those_of_the_scene_from_arrays():
    table = generic(np.random.default_rng(14), 12, 40)
    scene = Scene.from_arrays(
        table.vertices, table.offsets, coefficients=table.coefficients, time=(0, 2)
    )
    contacts = table.asked()

    for i, (a, b) in enumerate(table.pairs.tolist()):
        both = Scene([scene.bodies[a], scene.bodies[b]], (0, 2))
        assert agrees(contacts, i, first_contact(both, method="pairs"))
