"""A certificate in the queue is one integer, and tells its kind and its part again."""

import pytest

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
