"""Planted answers are those of the plain exact search, and what is asked is asked in doubles."""

from random import Random

import pytest
from folding import every

from benchmarks.methods.method import Method
from benchmarks.methods.own import OWN
from benchmarks.planted import FAMILIES, Planted
from benchmarks.wrong_answers import Wrong, count_wrong
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from fuzz.questions.all_pairs import first_contact_allpairs

NO_CONTACT = {"graze, gap 2^-40", "tangential, gap 2^-47"}
ALWAYS_CONTACT = {"exact graze", "graze, overlap 2^-40", "tangential touch"}
ALWAYS_CONTACT |= {"tangential, crossing 2^-47"}
NO_DOUBLES = {"rational grid", "offset 2^30 to 2^50"}


def planted(family, count=4):
    return [FAMILIES[family](Random(f"{family}:test:{i}")) for i in range(count)]


@every("family", FAMILIES)
def test_the_planted_answer_is_true(family):
    for scene, truth in planted(family):
        contact = first_contact_allpairs(scene)
        assert (contact and contact.time) == truth
        assert family not in NO_CONTACT or truth is None
        assert family not in ALWAYS_CONTACT or truth is not None


@pytest.mark.parametrize("family", sorted(set(FAMILIES) - NO_DOUBLES))
def test_coordinates_are_doubles(family):
    for scene, _ in planted(family):
        for body in scene.bodies:
            for track in body._piece_after(scene.start).tracks:
                for c in (*track.x, *track.y):
                    value = QQ(c, track.w[0])
                    assert QQ(*float(value).as_integer_ratio()) == value


def method_that_says(answer):
    return Method("test", "", lambda _: lambda: answer)


def test_wrong_answers_are_counted():
    scene = planted("exact graze", 1)[0].scene
    scenes = [Planted(scene, AlgebraicNumber(1)), Planted(scene, None)]
    assert count_wrong(method_that_says(None), scenes) == Wrong(2, missed=1)
    assert count_wrong(method_that_says(1.0), scenes) == Wrong(2, invented=1)
    assert count_wrong(method_that_says(1.0 + 1e-8), scenes) == Wrong(2, invented=1, off=1)
    assert count_wrong(method_that_says(1.0 + 1e-10), scenes) == Wrong(2, invented=1)


def test_of_exactpt_any_error_counts(monkeypatch):
    late = Method(*[getattr(OWN[0], a) for a in ("name", "setting")], lambda _: lambda: 1.0 + 1e-15)
    monkeypatch.setattr("benchmarks.wrong_answers.EXACT", (late,))
    scenes = [Planted(planted("exact graze", 1)[0].scene, AlgebraicNumber(1))]
    assert count_wrong(late, scenes) == Wrong(1, off=1)
