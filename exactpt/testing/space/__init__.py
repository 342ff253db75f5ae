"""Ground truth for the two elementary queries of continuous collision detection in space.

`vertex_face` and `edge_edge` return the exact first contact of one query whose vertices move
linearly during [0, 1]; `vertex_face_array` and `edge_edge_array` decide many queries of doubles.
`check_vertex_face` and `check_edge_edge` compare a function with the truth over `FAMILIES` of hard
queries. This is an oracle for tests, without bodies, scenes or broad phases in space.
"""

from exactpt.testing.space.checking import (
    assert_same_time,
    check_edge_edge,
    check_vertex_face,
    shrink_query,
)
from exactpt.testing.space.exact import SpaceContact, edge_edge, vertex_face
from exactpt.testing.space.families import FAMILIES, make_query
from exactpt.testing.space.queries import SpaceQuery
from exactpt.testing.space.vectorized import SpaceContacts, edge_edge_array, vertex_face_array

__all__ = [
    "FAMILIES",
    "SpaceContact",
    "SpaceContacts",
    "SpaceQuery",
    "assert_same_time",
    "check_edge_edge",
    "check_vertex_face",
    "edge_edge",
    "edge_edge_array",
    "make_query",
    "shrink_query",
    "vertex_face",
    "vertex_face_array",
]
