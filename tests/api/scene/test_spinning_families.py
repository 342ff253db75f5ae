"""Families of bodies that turn at a constant rate."""

import pickle

import pytest

from exactpt import Scene, Spin
from exactpt.scene.generate import SPINNING, generate


@pytest.mark.parametrize("family", sorted(SPINNING))
def test_they_turn_and_survive_files_and_pickles(family):
    scene = generate(family, 4)

    assert any(isinstance(body.motion, Spin) for body in scene.bodies)
    assert Scene.from_json(scene.to_json()) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert generate(family, 4) == scene != generate(family, 5)
