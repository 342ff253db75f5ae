"""No circle of imports at run time in the package."""

import pytest

grimp = pytest.importorskip("grimp")  # of import-linter: not among what the tests alone need


def test_no_module_imports_itself_by_way_of_others():
    """Imports inside of functions count, those for the type checker alone do not."""
    graph = grimp.build_graph("exactpt", exclude_type_checking_imports=True)
    left = {
        module: set(graph.find_modules_directly_imported_by(module)) for module in graph.modules
    }
    assert len(left) > 300
    assert sum(map(len, left.values())) > 2000

    while free := {module for module, imported in left.items() if not imported & left.keys()}:
        left = {module: imported for module, imported in left.items() if module not in free}

    assert sorted(left) == []
