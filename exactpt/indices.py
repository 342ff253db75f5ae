"""Indices of vertices, half-edges and certificates, distinct types for the type checker.

At run time, and for mypyc, they are plain integers. The index of a body has no type of its own: it
is counted, computed (arc 2 i is the left extreme of body i) and read from arrays and files, and
each of these would be a conversion, while hardly a function takes it beside another index.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, NewType, TypeAlias, TypeVar

from librt.vecs import vec
from mypy_extensions import i64

VertexId = NewType("VertexId", i64)
"""A vertex: its position among the moving vertices of a scene, or in a planar map."""

HalfEdge = NewType("HalfEdge", i64)
"""A half-edge of a planar map; its twin is h ^ 1."""

CertificateId = NewType("CertificateId", i64)
"""A certificate in the queue: its kind and its part (`exactpt.certificates.certificate`)."""

Index = TypeVar("Index", bound=i64)
"""One of these types, or int."""

Ends: TypeAlias = tuple[VertexId, VertexId]
"""The ends of an edge."""

Triple: TypeAlias = tuple[VertexId, VertexId, VertexId]
"""Three vertices with an orientation: those of an angle, its apex in the middle."""

NO_VERTEX: Final = VertexId(-1)
NO_HALF_EDGE: Final = HalfEdge(-1)


def vertex_vec(vertices: Iterable[VertexId] = ()) -> vec[VertexId]:
    """Return a vector of vertices; at run time a type of vectors has no item types but i64."""
    return vec[i64](vertices)  # type: ignore[return-value]


def half_edge_vec(half_edges: Iterable[HalfEdge] = ()) -> vec[HalfEdge]:
    """Return a vector of half-edges, as `vertex_vec`."""
    return vec[i64](half_edges)  # type: ignore[return-value]
