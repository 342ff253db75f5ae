"""No circle of imports within the package."""

import pytest


def test_no_module_imports_itself_by_way_of_others():
    """Imports inside of functions count, those for the type checker alone do not."""
    grimp = pytest.importorskip("grimp")  # of import-linter: not among what the tests alone need
    graph = grimp.build_graph("exactpt", exclude_type_checking_imports=True)
    left = {
        module: set(graph.find_modules_directly_imported_by(module)) for module in graph.modules
    }

    while free := {module for module, imported in left.items() if not imported & left.keys()}:
        left = {module: imported for module, imported in left.items() if module not in free}

    assert sorted(left) == []
