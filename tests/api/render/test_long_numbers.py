"""Numbers of more digits than Python writes as a decimal number, in pictures and in words."""

import pytest

from exactpt import Body, Scene, Simulation, Translation, first_contact

FAR = 10**5000 + 1


@pytest.fixture
def scene():
    ball = Body("ball", [(0, 0)], Translation([0, 1]))
    return Scene([ball, Body("wall", [(FAR, -1), (FAR, 1)])], time=(0, 2 * FAR))


def test_bug_a_contact_at_a_long_time_has_a_table(scene):
    assert "First contact at t ≈ " in first_contact(scene)._repr_html_()


def test_bug_a_scene_with_a_long_time_is_drawn(scene, tmp_path):
    scene.draw(tmp_path / "contact.svg", at="contact")
    scene.draw(tmp_path / "film.html")
    scene.draw(tmp_path / "gap.svg", gap=("ball", "wall"))
    simulation = Simulation(scene, record=True)
    list(simulation.run())
    simulation.draw(tmp_path / "run.html")

    assert len(list(tmp_path.iterdir())) == 4
