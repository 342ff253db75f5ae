"""Bodies with holes and several parts, made from other ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from exactpt.motion.body import Body
from exactpt.motion.shape import VertexLike

__all__ = ["parts_of"]

Vertex = TypeVar("Vertex", bound=VertexLike)


def parts_of(body: Body, vertices: Sequence[Vertex]) -> list[dict[str, object]]:
    """The parts of a body, with other vertices in the places of its own."""
    return [
        {
            "vertices": [vertices[i] for i in outline],
            "holes": [[vertices[i] for i in hole] for hole in holes],
        }
        for outline, *holes in body.parts
    ]
