"""What is drawn is valid; without Hypothesis one line says what to install."""

import builtins
import importlib
import sys
from itertools import combinations, product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from exactpt import Body, InputError, Rigid, Scene, first_contact
from exactpt.geometry.predicates import orientation
from exactpt.testing import FAMILIES, Question, strategies
from exactpt.testing.scenes import EVERY
from exactpt.testing.strategies import _monotone


@pytest.mark.long
@given(strategies.convex_polygons())
def test_convex_polygons_are_convex(outline):
    n = len(outline)
    Scene([Body("a", outline)])
    exact = Body("a", outline).at(0)
    assert all(orientation(exact[i - 2], exact[i - 1], exact[i]) > 0 for i in range(n))


@pytest.mark.long
@given(strategies.simple_polygons(), strategies.chains())
def test_polygons_and_chains_are_simple(outline, chain):
    Scene([Body("a", outline), Body("b", chain, closed=False)])


def test_bug_polygons_with_points_on_the_line_of_the_extreme_ones_are_simple():
    """The closing edge went through a point on that line if none was above it."""
    grid = [(float(x), float(y)) for x, y in product(range(3), repeat=2)]
    outlines = [
        (points, _monotone([*points])) for k in (3, 4, 5) for points in combinations(grid, k)
    ]

    made = [(points, outline) for points, outline in outlines if outline]

    assert len(made) == 328  # all but those on one line
    for points, outline in made:
        assert sorted(outline) == [*points]
        Scene([Body("a", outline)])


@given(strategies.motions(degree=2, turning=True))
def test_motions_begin_in_place(motion):
    at = Body("a", [(1, 2)], motion).at(0)
    assert at == ([(1, 2)])


def test_motions_turn_on_request():
    seen = st.lists(strategies.motions(turning=True), min_size=8).map(
        lambda ms: any(isinstance(m, Rigid) for m in ms)
    )

    @given(seen)
    @settings(max_examples=5, database=None)
    def check(turns):
        found.add(turns)

    found = set()
    check()
    assert True in found


@pytest.mark.parametrize("family", [None, *FAMILIES])
def test_pairs_are_questions(family):
    @given(strategies.pairs_in_motion(family))
    @settings(max_examples=4, database=None)
    def check(question):
        assert Question.from_json(question.to_json()) == question
        first_contact(question.scene)

    check()


@pytest.mark.parametrize("family", [None, "apex", "row", "linear_points"])
def test_scenes_are_scenes(family):
    @given(strategies.scenes(family))
    @settings(max_examples=3, database=None)
    def check(scene):
        assert scene.bodies

    check()


@pytest.mark.parametrize("make", [strategies.pairs_in_motion, strategies.scenes])
def test_a_wrong_family_is_refused(make):
    with pytest.raises(InputError, match="no family 'circles'; there are: corner_to_corner"):
        make("circles")


def test_without_hypothesis_one_line_says_what_to_install(monkeypatch):
    real = builtins.__import__

    def missing(name, *rest):
        if name.startswith("hypothesis"):
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.delitem(sys.modules, "exactpt.testing.strategies")
    monkeypatch.setattr(builtins, "__import__", missing)
    with pytest.raises(
        InputError, match=r"this needs Hypothesis: pip install 'exactpt\[testing\]'"
    ):
        importlib.import_module("exactpt.testing.strategies")


def test_bug_families_of_generate_that_were_refused():
    @given(st.data())
    @settings(max_examples=1, database=None)
    def check(data):
        for family in EVERY:
            assert isinstance(data.draw(strategies.scenes(family)), Scene)

    check()
