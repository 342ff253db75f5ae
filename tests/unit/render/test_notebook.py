"""What a notebook shows of a value."""

import subprocess
import sys
import xml.etree.ElementTree as ET

import pytest
from render_scenes import demo, overlapping, small

from exactpt import Simulation, first_contact
from exactpt.render.words import polynomial_in_words


def groups(svg):
    root = ET.fromstring(svg)
    return {g.get("class"): len(g) for g in root.iter("{http://www.w3.org/2000/svg}g")}


def test_scene():
    shown = groups(demo()._repr_svg_())
    assert shown["bodies"] == 9
    assert shown["tiles"] == 0


@pytest.mark.long
def test_simulation_while_it_runs():
    simulation = Simulation(demo())
    assert groups(simulation._repr_svg_())["tiles"] == len(simulation.snapshot().faces)
    events = simulation.run()
    for _ in range(5):  # the times of events are not rational
        next(events)
        assert groups(simulation._repr_svg_())["tiles"] > 9
    list(events)
    shown = simulation._repr_svg_()
    assert "vertex 0 of boat on edge 6 of harbour" in shown
    assert groups(shown)["contact"] == 4


def test_simulation_of_bodies_that_overlap():
    assert groups(Simulation(overlapping())._repr_svg_())["bodies"] == 2


def test_contact():
    root = ET.fromstring(first_contact(small())._repr_html_())
    assert root.find("b").text == "First contact at t = 3 (vertex-edge)"
    assert [item.text for item in root.iter("li")] == [
        "vertex 1 of box on edge 3 of wall",
        "vertex 2 of box on edge 3 of wall",
    ]
    html = first_contact(demo())._repr_html_()
    assert "a root of 1099 t^2 + 6750 t - 141750" in html
    assert "first and second share a point" in first_contact(overlapping())._repr_html_()


@pytest.mark.parametrize(
    "coefficients, text",
    [
        ([-141750, 6750, 1099], "1099 t^2 + 6750 t - 141750"),
        ([1, -1, 0, -1], "-t^3 - t + 1"),
        ([0, 1], "t"),
        ([-7], "-7"),
        ([], "0"),
    ],
)
def test_polynomials_in_words(coefficients, text):
    assert polynomial_in_words(coefficients) == text


def test_the_package_does_not_import_its_pictures():
    code = "import sys, exactpt; print([m for m in sys.modules if 'exactpt.render' in m])"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout == "[]\n"
