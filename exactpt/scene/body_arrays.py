"""Bodies in numpy arrays: each becomes a `Body` on first access."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final, TypeVar, final, overload

import numpy as np
from numpy.typing import ArrayLike

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.geometry.ragged import surely_simple
from exactpt.kernel.doubles import Flags, Floats, Indices, doubles, first_true, indices, native
from exactpt.kernel.numbers import shorten
from exactpt.motion.body import Body, is_text
from exactpt.motion.motions import REST, Translation

if TYPE_CHECKING:
    from exactpt.motion.motions import Motion

BLOCK: Final = 1 << 15
"""Number of bodies that are tested at a time."""

Array = TypeVar("Array", bound="np.ndarray[tuple[int, ...], np.dtype[np.generic]]")


@final
class BodyArrays(Sequence[Body]):
    """A sequence of bodies in arrays of doubles, which are copied.

    Args:
        vertices: shape (N, 2), the vertices of all bodies.
        offsets: shape (n + 1,): body k has the vertices ``offsets[k]`` to ``offsets[k + 1]`` - 1.
        velocities: shape (n, 2); at rest if neither these nor ``coefficients`` are given.
        coefficients: shape (n, 2, d + 1): the translation of body k in x and in y is a
            polynomial in t with these coefficients, constant first.
        closed: for each body or for all, whether it is a polygon if it has three or more
            vertices; else it is an open chain.
        names: of the bodies; their numbers if not given.
        radii: for each body or for all, its radius.

    Attributes:
        vertices, offsets: as given.
        coefficients: of shape (n, 2, d + 1), also where velocities were given.
        closed, radii: shape (n,).

    Raises:
        InputError: if the shapes of the arrays do not match, or a value is not a finite double,
            or a name is taken twice. Whether polygons are simple is not tested here.
    """

    def __init__(
        self,
        vertices: ArrayLike,
        offsets: ArrayLike,
        *,
        velocities: ArrayLike | None = None,
        coefficients: ArrayLike | None = None,
        closed: ArrayLike = True,
        names: Sequence[str] | None = None,
        radii: ArrayLike = 0.0,
    ) -> None:
        self.vertices: Floats = _kept(_shaped(doubles(vertices, "vertices"), "vertices", 2))
        self.offsets: Indices = _kept(_offsets(offsets, len(self.vertices)))
        n = len(self.offsets) - 1
        self.coefficients: Floats = _kept(_motions(velocities, coefficients, n))
        self.closed: Flags = _kept(_flags(closed, n))
        self.radii: Floats = _radii(radii, n)
        self._names = None if names is None else _names(names, n)
        self._made: dict[int, Body] = {}

    def __len__(self) -> int:
        return len(self.offsets) - 1

    @overload
    def __getitem__(self, i: int) -> Body: ...
    @overload
    def __getitem__(self, i: slice) -> tuple[Body, ...]: ...
    def __getitem__(self, i: int | slice) -> Body | tuple[Body, ...]:
        if isinstance(i, slice):
            return tuple(self[k] for k in range(len(self))[i])
        k = range(len(self))[i]
        if k not in self._made:
            self._made[k] = self.make(k)
        return self._made[k]

    def make(self, k: int) -> Body:
        """Return a body that is not kept."""
        rows = self.vertices[self.offsets[k] : self.offsets[k + 1]].tolist()
        x, y = self.coefficients[k].tolist()
        motion: Motion = Translation(x, y) if any((*x, *y)) else REST
        radius = float(self.radii[k])
        return Body(self.name(k), rows, motion, closed=bool(self.closed[k]), radius=radius)

    def name(self, k: int) -> str:
        """Return the name of a body."""
        return str(k) if self._names is None else self._names[k]

    def named(self, name: str) -> int | None:
        """Return the number of the body of this name; None if there is none."""
        names = map(str, range(len(self))) if self._names is None else self._names
        return next((k for k, known in enumerate(names) if known == name), None)

    @property
    def vertex_count(self) -> int:
        """The number of vertices of all bodies."""
        return len(self.vertices)

    def take(self, some: Indices) -> BodyArrays:
        """Return some bodies, without names; consecutive ones in increasing order share memory."""
        rows: Indices | slice = some
        ends = np.concatenate(([0], np.cumsum(np.diff(self.offsets)[some])))
        if len(some) and (np.diff(some) == 1).all():
            rows = slice(int(some[0]), int(some[-1]) + 1)
            at: Indices | slice = slice(int(self.offsets[rows.start]), int(self.offsets[rows.stop]))
        else:
            shift = self.offsets[some] - ends[:-1]
            at = np.arange(ends[-1]) + np.repeat(shift, native(np.diff(ends)))
        taken = BodyArrays.__new__(BodyArrays)
        taken.vertices, taken.offsets = self.vertices[at], ends
        taken.coefficients, taken.closed = self.coefficients[rows], self.closed[rows]
        taken.radii, taken._names, taken._made = self.radii[rows], None, {}  # noqa: SLF001
        return taken

    def doubtful(self, some: Indices | None = None, rounded: Floats | None = None) -> list[int]:
        """Return the bodies, all or of some, that the filter does not find simple.

        If coordinates are the doubles nearest to the exact ones, ``rounded`` bounds the errors of
        each body.
        """
        numbers = np.arange(len(self)) if some is None else some
        found: list[int] = []
        for first in range(0, len(numbers), BLOCK):  # in blocks: temporary arrays stay small
            part = numbers[first : first + BLOCK]
            of = self.take(part)
            off = None if rounded is None else rounded[part]
            found += part[~surely_simple(of.vertices, of.offsets, of.closed, off)].tolist()
        return found

    def __iter__(self) -> Iterator[Body]:
        return (self[k] for k in range(len(self)))

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if not isinstance(other, (tuple, BodyArrays)):
            return NotImplemented
        return tuple(self) == tuple(other)

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __reduce__(self) -> tuple[object, ...]:
        return _restored, (
            self.vertices, self.offsets, self.coefficients, self.closed, self._names, self.radii
        )  # fmt: skip

    def __repr__(self) -> str:
        vertices = counted(self.vertex_count, "vertex")
        return f"<BodyArrays: {counted(len(self), 'body')}, {vertices}>"


def _restored(
    vertices: Floats, offsets: Indices, coefficients: Floats, closed: Flags,
    names: list[str] | None, radii: Floats,
) -> BodyArrays:  # fmt: skip
    return BodyArrays(
        vertices, offsets, coefficients=coefficients, closed=closed, names=names, radii=radii
    )


def _kept(array: Array) -> Array:
    copy = array.copy()
    copy.flags.writeable = False
    return copy


def _shaped(array: Floats, what: str, width: int) -> Floats:
    if array.ndim != 2 or array.shape[1] != width:
        raise InputError(f"{what}: shape (N, {width}) is needed, not {array.shape}")
    return array


def _offsets(values: ArrayLike, count: int) -> Indices:
    offsets = indices(values, "offsets")
    if offsets.ndim != 1 or not len(offsets):
        raise InputError(f"offsets: shape (n + 1,) is needed, not {offsets.shape}")
    if offsets[0] != 0 or offsets[-1] != count:
        raise InputError(
            f"offsets: they go from 0 to {count}, the number of vertices, "
            f"not from {offsets[0]} to {offsets[-1]}"
        )
    at = first_true(np.diff(offsets) < 1)
    if at is not None:
        raise InputError(f"offsets: body {at[0]}: at least one vertex is needed")
    return offsets


def _motions(velocities: ArrayLike | None, coefficients: ArrayLike | None, n: int) -> Floats:
    if coefficients is None:
        motions = np.zeros((n, 2, 2))
        if velocities is not None:
            given = _shaped(doubles(velocities, "velocities"), "velocities", 2)
            if len(given) != n:
                raise InputError(f"velocities: {n} are needed, one for each body, not {len(given)}")
            motions[:, :, 1] = given
        return motions
    if velocities is not None:
        raise InputError("give either velocities or coefficients")
    motions = doubles(coefficients, "coefficients")
    if motions.ndim != 3 or motions.shape[:2] != (n, 2) or not motions.shape[2]:
        raise InputError(f"coefficients: shape ({n}, 2, d + 1) is needed, not {motions.shape}")
    return motions


def _flags(closed: ArrayLike, n: int) -> Flags:
    flags = np.asarray(closed)
    if flags.dtype != np.bool_ or flags.shape not in {(), (n,)}:
        raise InputError(f"closed: a boolean or {n} of them are needed: {shorten(closed)}")
    return np.broadcast_to(flags, (n,)).copy()


def _radii(values: ArrayLike, n: int) -> Floats:
    radii = doubles(values, "radii")
    if radii.shape not in {(), (n,)}:
        raise InputError(f"radii: a number or {n} of them are needed, not {radii.shape}")
    at = first_true(radii < 0)
    if at is not None:
        raise InputError(f"radii{list(at) if at else ''}: it is negative: {radii[at]}")
    return np.broadcast_to(radii.copy(), (n,))


def _names(names: Sequence[str], n: int) -> list[str]:
    listed = list(names)
    if isinstance(names, str) or len(listed) != n:
        raise InputError(f"names: {n} are needed, one for each body: {shorten(names)}")
    seen: set[str] = set()
    for name in listed:
        if not is_text(name):
            raise InputError(f"a body's name is a text that is not empty: {shorten(name)}")
        if name in seen:
            raise InputError(f"body {shorten(name)}: the name is taken by another body")
        seen.add(name)
    return listed
