"""Mutants: one operator, constant or condition of a function of the package is changed."""

from __future__ import annotations

import ast
import functools
import inspect
import re
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from pathlib import Path
from random import Random
from types import CodeType, FunctionType
from typing import Any, Final, NamedTuple, TypeAlias

from exactpt.errors import InputError
from fuzz.power.edits import Lines
from fuzz.power.probe import NAME, PROBE, insert_probe

__all__ = ["PARTS", "Mutant", "mutants", "named_mutant"]

ROOT: Final = Path(__file__).parents[2]
PARTS: Final = ("kernel", "geometry", "planar", "motion", "certificates", "filters", "pair",
                "search", "pseudotriangulation", "tiling", "simulation", "query", "scene",
                "arrays", "proof")  # fmt: skip
"""The parts of the package that are changed by default."""

COMPARED: Final = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
                   ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
                   ast.In: ast.NotIn, ast.NotIn: ast.In}  # fmt: skip
COMPUTED: Final = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Add, ast.Div: ast.Mult,
                   ast.FloorDiv: ast.Mult, ast.Mod: ast.Mult, ast.LShift: ast.RShift,
                   ast.RShift: ast.LShift, ast.BitAnd: ast.BitOr,
                   ast.BitOr: ast.BitAnd}  # fmt: skip
"""Operators, and what each of them becomes."""

NAMED: Final = re.compile(r"(?P<function>[\w.]+)\[(?P<number>\d+)\]: .*", re.DOTALL)
"""The name of a mutant."""


class Mutant(NamedTuple):
    """A function of which one place is changed.

    Attributes:
        name: the function, the number of the place in it, and the change, as in
            "exactpt.geometry.boxes.joined[2]: a < b -> a <= b".
        lines: the changed lines, from the beginning of their statement on.
        make: changes the function in this process.
    """

    name: str
    lines: Lines
    make: Callable[[], None]


Change: TypeAlias = Callable[[], str]
"""Changes a node of a syntax tree; returns a text that says how."""


class _Site(NamedTuple):
    """A node that can be changed.

    Attributes:
        first, last: its lines, from the beginning of its statement on.
        change: changes it.
    """

    first: int
    last: int
    change: Change


class _Place(NamedTuple):
    """A place of a function.

    Attributes:
        path: the file.
        names: the names of its classes, and that of the function.
        number: the number of the place in the function.
    """

    path: Path
    names: tuple[str, ...]
    number: int


def mutants(number: int, seed: int, parts: Sequence[str] = PARTS) -> list[Mutant]:
    """Return mutants of as many places, drawn at random among all places of all functions.

    The places are shuffled by the seed; those that cannot be changed are left out.

    Args:
        number: the number of mutants.
        seed: the seed.
        parts: folders of the package.

    Raises:
        InputError: if a part is no folder of the package, or there are too few places.
    """
    places = [place for part in parts for place in _places(part)]
    Random(f"mutants {seed}").shuffle(places)
    made = (_mutant(place) for place in places)
    found = [mutant for mutant, _ in zip((m for m in made if m), range(number), strict=False)]
    if len(found) < number:
        raise InputError(
            f"mutants: {' '.join(parts)} have {len(found)}, got {number}; ask for less"
        )
    return found


def named_mutant(name: str) -> Mutant:
    """Return the mutant of a name.

    Raises:
        InputError: if it is not the name of a mutant of the present text.
    """
    found = NAMED.fullmatch(name)
    path = _path_of(found["function"]) if found else None
    if found is None or path is None:
        raise InputError(f"mutants: no place of exactpt, got {name!r}")
    module = _module_of(path)
    names = tuple(found["function"].removeprefix(f"{module}.").split("."))
    functions = dict(_functions(ast.parse(path.read_text(encoding="utf-8"))))
    number = int(found["number"])
    is_there = names in functions and number < len(_sites(functions[names]))
    mutant = _mutant(_Place(path, names, number)) if is_there else None
    if mutant is None or mutant.name != name:
        what = "no such place" if mutant is None else f"the place is now {mutant.name!r}"
        raise InputError(f"mutants: {what}, got {name!r}; the text of the package has changed")
    return mutant


def _path_of(function: str) -> Path | None:
    """Return the file of a function with the names of its modules; None if there is none."""
    words = function.split(".")
    for length in range(len(words) - 1, 0, -1):
        module = ROOT.joinpath(*words[:length])
        for path in (module.with_suffix(".py"), module / "__init__.py"):
            if path.is_file():
                return path
    return None


def _module_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


def _places(part: str) -> Iterator[_Place]:
    folder = ROOT / "exactpt" / part
    if not folder.is_dir():
        raise InputError(f"mutants: no folder of exactpt, got {part!r}; see ls exactpt")
    for path in sorted(folder.rglob("*.py")):
        for names, function in _functions(ast.parse(path.read_text(encoding="utf-8"))):
            for number in range(len(_sites(function))):
                yield _Place(path, names, number)


def _functions(
    tree: ast.Module | ast.ClassDef, names: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], ast.FunctionDef]]:
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            yield (*names, node.name), node
        elif isinstance(node, ast.ClassDef):
            yield from _functions(node, (*names, node.name))


def _sites(function: ast.FunctionDef) -> list[_Site]:
    """Return the sites of a function, the outer ones first."""
    found: list[_Site] = []
    waiting: list[tuple[ast.AST, int]] = [(node, node.lineno) for node in function.body]
    while waiting:
        node, first = waiting.pop(0)
        if isinstance(node, ast.Raise | ast.Assert | ast.JoinedStr):
            continue
        if isinstance(node, ast.stmt):
            first = node.lineno
        if isinstance(node, ast.AnnAssign):
            waiting += [(node.value, first)] if node.value else []
            continue
        waiting += [(child, first) for child in ast.iter_child_nodes(node)]
        change = _change(node)
        if change is not None:
            changed = node.test if isinstance(node, ast.If | ast.While) else node
            found.append(_Site(first, getattr(changed, "end_lineno", first), change))
    return found


def _change(node: ast.AST) -> Change | None:
    """Return the change of a node; None if it is left as it is."""
    if isinstance(node, ast.Compare) and type(node.ops[0]) in COMPARED:
        return functools.partial(_compare, node)
    if isinstance(node, ast.BinOp | ast.AugAssign) and type(node.op) in COMPUTED:
        return functools.partial(_compute, node)
    if isinstance(node, ast.BoolOp):
        return functools.partial(_connect, node)
    if isinstance(node, ast.If | ast.While | ast.IfExp):
        return functools.partial(_negate, node)
    if isinstance(node, ast.Constant) and type(node.value) in (int, bool, float):
        return functools.partial(_count, node)
    return None


def _compare(node: ast.Compare) -> str:
    old = ast.unparse(node)
    node.ops[0] = COMPARED[type(node.ops[0])]()
    return f"{old} -> {ast.unparse(node)}"


def _compute(node: ast.BinOp | ast.AugAssign) -> str:
    old = ast.unparse(node)
    node.op = COMPUTED[type(node.op)]()
    return f"{old} -> {ast.unparse(node)}"


def _connect(node: ast.BoolOp) -> str:
    old = ast.unparse(node)
    node.op = ast.Or() if isinstance(node.op, ast.And) else ast.And()
    return f"{old} -> {ast.unparse(node)}"


def _negate(node: ast.If | ast.While | ast.IfExp) -> str:
    node.test = ast.copy_location(ast.UnaryOp(ast.Not(), node.test), node.test)
    return f"if {ast.unparse(node.test)}"


def _count(node: ast.Constant) -> str:
    old: Any = node.value
    node.value = not old if isinstance(old, bool) else old + 1
    return f"{old!r} -> {node.value!r}"


def _mutant(place: _Place) -> Mutant | None:
    """Return the mutant; None if the function cannot be replaced."""
    path, names, number = place
    tree = ast.parse(path.read_text(encoding="utf-8"))
    node = next(function for found, function in _functions(tree) if found == names)
    site = _sites(node)[number]
    text = site.change()
    module = _module_of(path)
    whole = compile(ast.fix_missing_locations(tree), str(path), "exec")
    code = _code(whole, names, node)
    try:
        function = _function(import_module(module), names)
    except (AttributeError, ImportError):
        return None
    if code is None or function is None or function.__code__ == code:
        return None
    if function.__code__.co_freevars != code.co_freevars:
        return None
    insert_probe(node, site.first)
    probing = _code(compile(tree, str(path), "exec"), names, node)
    assert probing is not None  # noqa: S101 - the same functions as before
    lines = Lines(str(path.relative_to(ROOT)), site.first, site.last)
    name = f"{module}.{'.'.join(names)}[{number}]: {text}"
    return Mutant(name, lines, functools.partial(_exchange, function, probing))


def _exchange(function: FunctionType, code: CodeType) -> None:
    function.__globals__[NAME] = PROBE
    function.__code__ = code


def _code(code: CodeType, names: Sequence[str], node: ast.FunctionDef) -> CodeType | None:
    """Return the code of a function in that of its module."""
    first = min([node.lineno, *(d.lineno for d in node.decorator_list)])
    for inner in code.co_consts:
        if isinstance(inner, CodeType) and inner.co_name == names[0]:
            if len(names) > 1:
                found = _code(inner, names[1:], node)
                if found is not None:
                    return found
            elif inner.co_firstlineno in (first, node.lineno):
                return inner
    return None


def _function(module: object, names: Sequence[str]) -> FunctionType | None:
    """Return the function below properties, class methods, caches and contexts."""
    owner: Any = module
    for name in names:
        owner = inspect.getattr_static(owner, name)
    for attribute in ("fget", "__func__", "func"):
        owner = getattr(owner, attribute, owner) if not inspect.isfunction(owner) else owner
    while hasattr(owner, "__wrapped__"):
        owner = owner.__wrapped__
    return owner if inspect.isfunction(owner) and owner.__name__ == names[-1] else None
