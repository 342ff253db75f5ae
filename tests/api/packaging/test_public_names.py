"""Names, attributes and parameters that were public in 0.1.0 exist; no circle of imports.

A name that is to go keeps an alias for a version, which warns.
"""

import inspect
from pathlib import Path

import pytest
from folding import every

import exactpt
from exactpt import Body, Scene, Simulation

LINES = (Path(__file__).parent / "public_0_1.txt").read_text(encoding="utf-8").split()


@pytest.fixture(scope="module")
def made():
    """Instances of the classes whose constructors set public attributes."""
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], exactpt.Translation([0, 1]))
    simulation = Simulation(Scene([ball, Body("wall", [(5, -9), (5, 9)])], (0, 20)))
    return {"Simulation": simulation, "FreeSpace": simulation.space()}


@every("line", LINES)
def test_a_public_name_of_the_first_version_is_still_there(line, made):
    """``Name``, ``Name.attribute``, ``name(parameter)`` or ``Name.method(parameter)``."""
    place, _, parameter = line.rstrip(")").partition("(")
    name, _, attribute = place.partition(".")
    found = getattr(exactpt, name)
    if attribute and not hasattr(found, attribute):
        assert hasattr(made[name], attribute)
        return
    if attribute:
        found = getattr(found, attribute)
    former = vars(found).get("renamed", ()) if inspect.isfunction(found) else ()
    assert not parameter or parameter in {*inspect.signature(found).parameters, *former}


def test_no_module_imports_itself_by_way_of_others():
    """Imports inside of functions count, those for the type checker alone do not."""
    grimp = pytest.importorskip("grimp")  # of import-linter: not among what the tests alone need
    graph = grimp.build_graph("exactpt", exclude_type_checking_imports=True)
    left = {
        module: set(graph.find_modules_directly_imported_by(module)) for module in graph.modules
    }
    assert len(left) > 300
    assert sum(map(len, left.values())) > 2000

    while free := {module for module, imported in left.items() if not imported & left.keys()}:
        left = {module: imported for module, imported in left.items() if module not in free}

    assert sorted(left) == []
