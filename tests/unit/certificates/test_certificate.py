"""A certificate in the queue is one integer; and which vertices touch which edges now."""

import pytest
from folding import every

from exactpt.certificates import certificate
from exactpt.certificates.certificate import (
    Kind,
    PointKind,
    kind_of,
    pack,
    pack_point,
    part_of,
    point_kind_of,
    point_of,
)
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.incidences import FEW, touches
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.track import Incidence
from exactpt.motion.vertices import Vertices

CODES = [*range(6), 6, 7, *range(8, 14)]
LASTS = {Kind.SHADOW: 13, Kind.OTHER: 7}


@pytest.mark.parametrize("part", [0, 1, 7, 10**6])
def test_no_two_certificates_are_one_integer(part):
    packed = [pack(code, p) for p in (part, part + 1) for code in CODES]

    assert len(set(packed)) == 2 * len(CODES)
    assert [(kind_of(c), part_of(c)) for c in packed[: len(CODES)]] == [(c, part) for c in CODES]


@pytest.mark.parametrize("part", [0, 1, 7, 10**6])
def test_no_two_certificates_of_points_are_one_integer(part):
    packed = [pack_point(kind, p) for p in (part, part + 1) for kind in PointKind]

    assert len(set(packed)) == 2 * len(PointKind)
    assert [(point_kind_of(c), point_of(c)) for c in packed[:4]] == [(k, part) for k in PointKind]


def test_kinds_of_more_than_one_code_overlap_no_others():
    codes = [code for kind in Kind for code in range(kind, LASTS.get(kind, kind) + 1)]

    assert sorted(codes) == CODES


@pytest.mark.plain  # compiled classes have no docstrings
def test_every_kind_has_a_reason_for_its_place_in_the_order_of_repair():
    for kinds in (Kind, PointKind):
        places = [kinds.__doc__.index(kind.name) for kind in kinds]
        assert places == sorted(places)


def test_the_integers_of_compiled_code_are_the_kinds():
    for kind in Kind:
        assert getattr(certificate, kind.name) == kind


SQUARE = Body("square", [(0, 0), (2, 0), (2, 2), (0, 2)])
ON_EDGE = Incidence(1, 0, 0, 1, -1)
ON_VERTEX = Incidence(0, 2, 1, -1, 0)


def touches_now(*bodies):
    vertices = Vertices.of(bodies, QQ(0), QQ(1))
    certifier = Certifier(vertices, QQ(0), QQ(1), exact_only=False)
    return touches(certifier, vertices, vertices.ids())


@every("others", [0, FEW])
@every(
    "body, expected",
    [
        (Body("on an edge", [(2, 1)]), [ON_EDGE]),
        (Body("on the last edge", [(0, 1)]), [Incidence(1, 0, 0, 3, -1)]),
        (Body("on a vertex", [(2, 2)]), [ON_VERTEX]),
        (Body("on a line", [(2, 3)]), []),
        (Body("tip on an edge", [(2, 1), (4, 1), (4, 2)]), [ON_EDGE]),
        (Body("last edge on a vertex", [(3, 1), (3, 2), (1, 3)]), [Incidence(0, 2, 1, 2, -1)]),
        (Body("edge on a vertex", [(1, 3), (3, 1), (3, 3)]), [Incidence(0, 2, 1, 0, -1)]),
        (Body("segment", [(2, 1), (4, 1)]), [ON_EDGE]),
        (
            Body("open chain", [(3, 0), (4, 1), (3, 4), (1, 3), (3, 1)], closed=False),
            [Incidence(0, 2, 1, 3, -1)],
        ),
    ],
)
def test_touches(body, expected, others):
    """With many points, boxes choose the pairs."""
    far = [Body(str(i), [(10 + i, 10)]) for i in range(others)]

    assert touches_now(SQUARE, body, *far) == expected


def test_neighbours_touch_where_their_edge_has_shrunk_to_a_point():
    body = Body("b", [(0, 0), {"x": [0, 1], "y": [0]}, (3, 3)], closed=False)

    assert touches_now(body) == [Incidence(0, 0, 0, -1, 1)]
