"""What Hypothesis draws from: outlines, motions, pairs of bodies in motion, whole scenes.

>>> from hypothesis import given, settings
>>> from exactpt.testing import strategies
>>> @settings(max_examples=5)
... @given(strategies.pairs_in_motion(family="grazing_corner"))
... def test(question):
...     assert question.scene.bodies[0].name == "a"
>>> test()

All numbers are doubles, taken at their exact values. Hypothesis shrinks the values drawn; so does
`exactpt.testing.shrink`, if it is a scene.
"""

from __future__ import annotations

from typing import TypeAlias

from exactpt.errors import InputError
from exactpt.geometry.predicates import orientation
from exactpt.kernel.numbers import rational, shorten
from exactpt.motion.motions import Rigid, Translation
from exactpt.scene.scene import Scene
from exactpt.testing.families import FAMILIES, make_question
from exactpt.testing.questions import Moving, Question
from exactpt.testing.scenes import EVERY, generate
from exactpt.testing.scenes.shapes import hull
from exactpt.testing.space.families import make_query
from exactpt.testing.space.queries import Kind, SpaceQuery

try:
    from hypothesis import strategies as st
    from hypothesis.strategies import SearchStrategy
except ImportError:
    raise InputError("this needs Hypothesis: pip install 'exactpt[testing]'") from None

Outline: TypeAlias = list[tuple[float, float]]


def coordinates(size: int = 8) -> SearchStrategy[float]:
    """Doubles up to a size: small integers, halves and quarters (so that ties happen), or any."""
    ties = st.builds(lambda n, d: n / d, st.integers(-size, size), st.sampled_from([1, 1, 2, 4]))
    return st.one_of(ties, ties, st.floats(-size, size, allow_subnormal=False))


def convex_polygons(most: int = 8) -> SearchStrategy[Outline]:
    """Strictly convex polygons of 3 to ``most`` vertices, counter-clockwise."""
    return _points(3, most).map(_hull).filter(lambda outline: len(outline) > 2)


def simple_polygons(most: int = 8) -> SearchStrategy[Outline]:
    """Draw simple polygons of 3 to ``most`` vertices, counter-clockwise, convex or not."""
    return _points(3, most).map(_monotone).filter(lambda outline: len(outline) > 2)


def chains(most: int = 6) -> SearchStrategy[Outline]:
    """Draw simple open chains of 2 to ``most`` vertices; they never turn back in x."""
    return _points(2, most).map(sorted)


def motions(*, degree: int = 1, turning: bool = False) -> SearchStrategy[Translation | Rigid]:
    """Draw translations with polynomials up to a degree; if ``turning``, half of them turn."""
    path = st.lists(coordinates(2), max_size=degree).map(lambda c: [0.0, *c])
    translations = st.builds(Translation, path, path)
    if not turning:
        return translations
    turn = st.sampled_from([-1.0, -0.5, 0.25, 0.5, 1.0]).map(lambda c: [0.0, c])
    turns = st.builds(lambda half, x, y: Rigid(half, x=x, y=y), turn, path, path)
    return st.one_of(translations, turns)


def pairs_in_motion(family: str | None = None) -> SearchStrategy[Question]:
    """Questions about two bodies that translate.

    Those of a family are drawn by their numbers, which are in their names.

    Args:
        family: one of `exactpt.testing.FAMILIES`, most of which are degenerate: grazes, slides,
            ties, far from the origin. If not given: polygons and chains of any kind.

    Raises:
        InputError: if the family does not exist.
    """
    if family is None:
        times = st.tuples(st.just(0.0), st.sampled_from([1.0, 4.0, 16.0]))
        return st.builds(Question, _moving(), _moving(), times)
    make_question(family)  # refuses unknown names
    return st.integers(0, 2**32).map(lambda number: make_question(family, number=number))


def scenes(family: str | None = None) -> SearchStrategy[Scene]:
    """Return a strategy of valid scenes.

    Args:
        family: one of `exactpt.testing.FAMILIES` (two bodies), or one that `exactpt generate`
            knows (several). If not given: any of the latter.

    Raises:
        InputError: if the family does not exist.
    """
    if family in FAMILIES:
        return pairs_in_motion(family).map(lambda question: question.scene)
    if family is not None and family not in EVERY:
        raise InputError(
            f"no family {shorten(family)}; there are: {', '.join([*FAMILIES, *EVERY])}"
        )
    names = st.sampled_from(list(EVERY)) if family is None else st.just(family)
    return st.builds(generate, names, st.integers(0, 2**32))


def space_queries(kind: Kind, family: str | None = None) -> SearchStrategy[SpaceQuery]:
    """Return a strategy of queries about a vertex and a triangle, or about two segments, in space.

    Args:
        kind: "vertex-face" or "edge-edge".
        family: one of `exactpt.testing.space.FAMILIES`, drawn by its number; if not given, any
            vertices with coordinates as `coordinates` draws them.

    Raises:
        InputError: if the kind or family does not exist.
    """
    if family is None:
        make_query(kind, "generic")  # refuses unknown kinds
        number = coordinates()
        four = st.tuples(*[st.tuples(number, number, number)] * 4)
        return st.builds(lambda start, end: SpaceQuery(kind, start, end), four, four)
    make_query(kind, family)  # refuses unknown names
    return st.integers(0, 2**32).map(lambda number: make_query(kind, family, number=number))


def _points(least: int, most: int) -> SearchStrategy[Outline]:
    point = st.tuples(coordinates(), coordinates())
    return st.lists(point, min_size=least, max_size=most, unique=True)


def _hull(points: Outline) -> Outline:
    exact = [(rational(x), rational(y)) for x, y in points]
    return [(float(x), float(y)) for x, y in hull(exact)]


def _monotone(points: Outline) -> Outline:
    """Return the polygon of two chains, below and above the line of its extreme points.

    Each is ordered by x, then by y: so neither chain touches itself, and one is below the other.
    Points on the line are in the lower chain, or in the upper one if no point is above the line.
    """
    first, *inner, last = sorted(points)
    start, end, *others = [(rational(x), rational(y)) for x, y in (first, last, *inner)]
    sides = [orientation(start, end, p) for p in others]
    least = 1 if max(sides) > 0 else 0
    below = [p for p, s in zip(inner, sides, strict=True) if s < least]
    above = [p for p, s in zip(inner, sides, strict=True) if s >= least]
    return [first, *below, last, *above[::-1]] if any(sides) else []


def _moving() -> SearchStrategy[Moving]:
    path = st.lists(coordinates(2), max_size=2).map(lambda c: (0.0, *c))
    closed = st.one_of(convex_polygons(), simple_polygons()).map(lambda v: (v, True))
    outlines = st.one_of(closed, closed, chains().map(lambda v: (v, False)))
    return st.builds(lambda o, x, y: Moving(tuple(o[0]), x, y, o[1]), outlines, path, path)
