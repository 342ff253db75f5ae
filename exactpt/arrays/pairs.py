"""Pairs of polygons, chains, segments and points that translate: their first contacts."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from exactpt.arrays.blocks import Block
from exactpt.arrays.contacts import Contacts, Errors, masks
from exactpt.arrays.motions import relative_motions
from exactpt.arrays.outlines import outlines_of
from exactpt.arrays.spans import read_spans
from exactpt.errors import InputError
from exactpt.kernel.doubles import Indices, finite_rows, first_true, indices
from exactpt.kernel.numbers import QQ, of_double
from exactpt.scene.body_arrays import BodyArrays
from exactpt.scene.scene import Scene, check_valid, scene_of

BLOCK: Final = 1 << 14
"""Number of pairs at a time."""


def first_contacts(
    vertices: ArrayLike,
    offsets: ArrayLike,
    pairs: ArrayLike,
    *,
    velocities: ArrayLike | None = None,
    coefficients: ArrayLike | None = None,
    closed: ArrayLike = True,
    radii: ArrayLike = 0.0,
    time: ArrayLike = (0.0, 1.0),
    errors: Errors = "raise",
) -> Contacts:
    """Return the first contacts of pairs of bodies, of each pair for itself.

    Each result equals that of `exactpt.first_contact` for a scene of the two bodies.

    >>> found = first_contacts(
    ...     [(0, 0), (2, 0), (0, 2), (5, 1), (7, 0), (7, 3)], [0, 3, 6], [(0, 1)],
    ...     velocities=[(1, 0), (-2, 0)], time=(0, 10))
    >>> found.found[0], found.contact(0).time
    (np.True_, AlgebraicNumber('4/3'))

    Polygons and chains of the pairs are validated, in numpy where its bounds allow it.

    Args:
        vertices: shape (N, 2), the vertices of all bodies.
        offsets: shape (n + 1,): body k has the vertices ``offsets[k]`` to ``offsets[k + 1]`` - 1:
            one (a point), two (a segment) or more.
        pairs: shape (m, 2), the numbers of the bodies of each pair, which differ.
        velocities: shape (n, 2); bodies are at rest if neither these nor ``coefficients`` are
            given.
        coefficients: shape (n, 2, d + 1): the translation of body k in x and in y is a polynomial
            in t with these coefficients, constant first. Filters decide where the relative
            motion has degree 1 or 2, or boxes are apart.
        closed: for each body or for all, False for an open chain.
        radii: for each body or for all, its radius.
        time: the start and the end of the closed time span, or of shape (m, 2) one for each pair.
        errors: "mask" leaves pairs with a body that is not simple, or has a number that is not
            finite, without a result (`Contacts.refused`, `Contacts.reasons`); "raise" raises an
            error for the first one.

    Raises:
        InputError: if the shapes do not match, a span is empty, or, unless errors are masked, a
            value is not a finite double or a body of a pair is not simple.
    """
    masked = masks(errors)
    faults: dict[str, dict[int, str]] = {}

    def read(values: ArrayLike, what: str) -> ArrayLike:
        if not masked:
            return values
        array, faults[what] = finite_rows(values, what)
        return array

    bodies = BodyArrays(
        read(vertices, "vertices"),
        offsets,
        velocities=None if velocities is None else read(velocities, "velocities"),
        coefficients=None if coefficients is None else read(coefficients, "coefficients"),
        closed=closed,
        radii=read(radii, "radii"),
    )
    wrong: dict[int, str] = {}
    for what, found in faults.items():
        for row, why in found.items():
            is_vertex = what == "vertices"
            k = int(np.searchsorted(bodies.offsets, row, "right")) - 1 if is_vertex else row
            wrong.setdefault(k, why)
    ij = _pairs(pairs, len(bodies))
    spans = read_spans(time, len(ij))
    used = np.zeros(len(bodies), dtype=np.bool_)
    used[ij.ravel()] = True
    used[list(wrong)] = False
    for k in bodies.doubtful(np.flatnonzero(used)):
        try:
            check_valid(bodies.make(k), QQ(0), QQ(1))
        except InputError as error:
            if not masked:
                raise
            wrong[k] = str(error)

    def scene(k: int) -> Scene:
        i, j = ij[k].tolist()
        start, end = (of_double(float(s[k])) for s in (spans.start, spans.end))
        return scene_of((bodies.make(i), bodies.make(j)), start, end)

    contacts = Contacts(len(ij), scene)
    if wrong:
        for m in np.flatnonzero(np.isin(ij, list(wrong)).any(axis=1)).tolist():
            contacts.refuse(m, next(wrong[k] for k in ij[m].tolist() if k in wrong))
    with np.errstate(over="ignore"):
        reach = bodies.radii[ij].sum(axis=1)
    for some, of in ((reach == 0.0, None), (reach > 0.0, reach)):
        rows = np.flatnonzero(some & ~contacts.refused)
        for first in range(0, len(rows), BLOCK):
            part = rows[first : first + BLOCK]
            numbers, local = np.unique(ij[part], return_inverse=True)
            here, times = bodies.take(numbers), spans.at(part)
            i, j = local.reshape(-1, 2).T
            motions = relative_motions(here.coefficients, i, j, times)
            reaches = None if of is None else of[part]
            outlines = outlines_of(here)
            Block(outlines, here, contacts, part, i, j, times, motions, reaches).answer()
    return contacts


def _pairs(pairs: ArrayLike, n: int) -> Indices:
    ij = indices(pairs, "pairs")
    if not ij.size:
        ij = ij.reshape(0, 2)
    if ij.ndim != 2 or ij.shape[1] != 2:
        raise InputError(f"pairs: shape (m, 2) is needed, not {ij.shape}")
    at = first_true((ij < 0) | (ij >= n))
    if at is not None:
        raise InputError(f"pairs{list(at)}: there is no body {ij[at]} among {n}")
    at = first_true(ij[:, 0] == ij[:, 1])
    if at is not None:
        raise InputError(f"pairs{list(at)}: expected two different bodies, got {ij[at][0]} twice")
    return ij
