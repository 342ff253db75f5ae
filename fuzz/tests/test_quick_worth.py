"""Mutants for the worth of the quick tier: what is changed, and how."""

import ast

from fuzz.quick_worth import _changes, _exchange, mutants, planted

SOURCE = """
def least(values, most):
    found: int = 7
    for k, value in enumerate(values):
        if value < found and k != most:
            found = value + 1
    if found > 9:
        raise ValueError(f"{found} > 9")
    return found
"""


def changed(k):
    tree = ast.parse(SOURCE)
    text = _changes(tree.body[0])[k]()
    return text, ast.unparse(tree)


def test_each_change_is_of_one_place_and_of_no_message_or_annotation():
    number = len(_changes(ast.parse(SOURCE).body[0]))
    found = dict(changed(k) for k in range(number))

    assert set(found) == {
        "7 -> 8", "1 -> 2", "9 -> 10", "value + 1 -> value - 1", "found > 9 -> found >= 9",
        "value < found -> value <= found", "k != most -> k == most", "if not found > 9",
        "if not (value < found and k != most)",
        "value < found and k != most -> value < found or k != most",
    }  # fmt: skip
    plain = ast.unparse(ast.parse(SOURCE))
    assert len(set(found.values()) | {plain}) == number + 1


def test_a_mutant_is_another_code_of_a_function_of_the_package():
    for fault in mutants(5, 1):
        assert fault.make.func is _exchange
        function, code = fault.make.args
        assert function.__module__ == fault.module
        assert function.__code__.co_name == code.co_name
        assert function.__code__ != code
    assert [fault.name for fault in mutants(5, 1)] == [fault.name for fault in mutants(5, 1)]


def test_each_planted_mistake_is_a_fault():
    assert {"planted: events dropped", "planted: swept boxes too small"} <= {
        fault.name for fault in planted()
    }
