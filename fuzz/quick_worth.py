"""The worth of the quick tier: which faults that the tests find are found by `make quick`.

    python -m fuzz.quick_worth RESULTS --mutants 100 --seed 1

Faults are the mistakes of `fuzz.planted` and mutants: one operator, constant or condition of a
function of the package is changed. For each fault a process is forked after the collection of
the tests. Tests of the quick tier run first, those of the changed part of the package before the
others, up to the first failure or a limit of processor time; if none fails, tests that `make
test` runs besides. A test that fails without the fault too does not count. Tests that start the
command in a new process do not see the fault.
"""

from __future__ import annotations

import ast
import functools
import inspect
import json
import os
import resource
import sys
import time as clock
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from importlib import import_module
from pathlib import Path
from random import Random
from types import CodeType, FunctionType
from typing import Any, Final, NamedTuple

import click
import pytest
from _pytest.runner import runtestprotocol
from hypothesis import settings

from exactpt.errors import InputError
from fuzz.planted import PLANTED

__all__ = ["Fault", "mutants", "planted"]

ROOT: Final = Path(__file__).parents[1]
PARTS: Final = ("kernel", "geometry", "planar", "motion", "certificates", "pairs", "collision",
                "pseudotriangulation", "tiling", "simulation", "query", "scene",
                "arrays", "proof")  # fmt: skip
"""The parts of the package that are changed."""

SEARCHES: Final = ("collision", "tiling", "simulation", "certificates", "kernel", "motion")
"""The parts whose tests run first for mistakes of `fuzz.planted`."""

COMPARED: Final = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
                   ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
                   ast.In: ast.NotIn, ast.NotIn: ast.In}  # fmt: skip
COMPUTED: Final = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Add, ast.Div: ast.Mult,
                   ast.FloorDiv: ast.Mult, ast.Mod: ast.Mult, ast.LShift: ast.RShift,
                   ast.RShift: ast.LShift, ast.BitAnd: ast.BitOr,
                   ast.BitOr: ast.BitAnd}  # fmt: skip


class Fault(NamedTuple):
    """A fault.

    Attributes:
        name: what it is.
        parts: the parts of the package whose tests run first.
        module: the changed module; "" if there are several.
        make: makes the fault in this process.
    """

    name: str
    parts: tuple[str, ...]
    module: str
    make: Callable[[], object]


def planted() -> list[Fault]:
    """Return the mistakes of `fuzz.planted`."""
    return [Fault(f"planted: {name}", SEARCHES, "", functools.partial(_enter, mistake.made))
            for name, mistake in PLANTED.items()]  # fmt: skip


_ENTERED: Final[list[object]] = []
"""Contexts in which mistakes are made: one that nobody refers to is closed, and unmade, at once."""


def _enter(make: Callable[[], Any]) -> None:
    context = make()
    _ENTERED.append(context)
    context.__enter__()


def mutants(number: int, seed: int) -> list[Fault]:
    """Return mutants of as many places, drawn at random among all places of all functions."""
    places = list(_places())
    found = []
    for place in Random(f"quick worth {seed}").sample(places, 3 * number):
        mutant = _mutant(*place)
        if mutant is not None:
            found.append(mutant)
        if len(found) == number:
            return found
    raise InputError(f"mutants: {len(found)} of {number} places can be changed")


def _places() -> Iterator[tuple[Path, tuple[str, ...], int]]:
    """Each place: the file, the names of classes and function, its number in the function."""
    for part in PARTS:
        for path in sorted((ROOT / "exactpt" / part).rglob("*.py")):
            for names, function in _functions(ast.parse(path.read_text(encoding="utf-8"))):
                for k in range(len(_changes(function))):
                    yield path, names, k


def _functions(
    tree: ast.Module | ast.ClassDef, names: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], ast.FunctionDef]]:
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            yield (*names, node.name), node
        elif isinstance(node, ast.ClassDef):
            yield from _functions(node, (*names, node.name))


def _changes(function: ast.FunctionDef) -> list[Callable[[], str]]:
    """Return the changes of the function, one for each place; they return a text."""
    found: list[Callable[[], str]] = []
    waiting: list[ast.AST] = list(function.body)
    while waiting:
        node = waiting.pop(0)
        if isinstance(node, ast.Raise | ast.Assert | ast.JoinedStr):
            continue
        if isinstance(node, ast.AnnAssign):
            waiting += [node.value] if node.value else []
            continue
        waiting += ast.iter_child_nodes(node)
        if isinstance(node, ast.Compare) and type(node.ops[0]) in COMPARED:
            found.append(functools.partial(_compare, node))
        elif isinstance(node, ast.BinOp | ast.AugAssign) and type(node.op) in COMPUTED:
            found.append(functools.partial(_compute, node))
        elif isinstance(node, ast.BoolOp):
            found.append(functools.partial(_connect, node))
        elif isinstance(node, ast.If | ast.While | ast.IfExp):
            found.append(functools.partial(_negate, node))
        elif isinstance(node, ast.Constant) and type(node.value) in (int, bool, float):
            found.append(functools.partial(_count, node))
    return found


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


def _mutant(path: Path, names: tuple[str, ...], k: int) -> Fault | None:
    """Return the mutant; None if the function cannot be replaced."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    node = next(f for found, f in _functions(tree) if found == names)
    place = _changes(node)[k]
    text = place()
    relative = path.relative_to(ROOT).with_suffix("")
    module = ".".join(relative.parts).removesuffix(".__init__")
    code = compile(ast.fix_missing_locations(tree), str(path), "exec")
    new = _code(code, names, node)
    try:
        function = _function(import_module(module), names)
    except (AttributeError, ImportError):
        return None
    if new is None or function is None or function.__code__.co_freevars != new.co_freevars:
        return None
    if function.__code__ == new:
        return None
    name = f"{module}.{'.'.join(names)}: {text}"
    return Fault(name, (relative.parts[1],), module, functools.partial(_exchange, function, new))


def _exchange(function: FunctionType, code: CodeType) -> None:
    function.__code__ = code


def _code(code: CodeType, names: Sequence[str], node: ast.FunctionDef) -> CodeType | None:
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


class _Hunt:
    """A plugin of pytest that runs the tests on each fault."""

    def __init__(
        self, faults: Sequence[Fault], results: Path, limits: tuple[float, float], until: float
    ) -> None:
        self.faults = faults
        self.results = results
        self.limits = limits
        self.until = until
        self.right: dict[str, bool] = {}

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        conftest = next(p for p in session.config.pluginmanager.get_plugins()
                        if hasattr(p, "is_long"))  # fmt: skip
        quick, others = list[pytest.Item](), list[pytest.Item]()
        for item in session.items:
            tier = item.nodeid.split("/")[1]
            is_quick = tier in ("unit", "api") and not conftest.is_long(item)
            (quick if is_quick else others).append(item)
        done = set()
        if self.results.exists():
            done = {json.loads(line)["fault"] for line in self.results.read_text().splitlines()}
        for fault in self.faults:
            if clock.time() > self.until:
                break
            if fault.name not in done:
                self._record(fault, quick, others)
        return True

    def _record(self, fault: Fault, quick: list[pytest.Item], others: list[pytest.Item]) -> None:
        row: dict[str, object] = {"fault": fault.name, "tier": None, "test": None}
        for tier, items, limit in zip(("quick", "test"), (quick, others), self.limits, strict=True):
            found = self._hunt(fault, self._ordered(fault, items, tier), tier, limit)
            row[f"{tier} all"] = found[1]
            if found[0] is not None:
                row |= {"tier": tier, "test": found[0]}
                break
        with self.results.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")

    @staticmethod
    def _ordered(fault: Fault, items: list[pytest.Item], tier: str) -> list[pytest.Item]:
        texts: dict[Path, bool] = {}

        def names_it(item: pytest.Item) -> bool:
            if item.path not in texts:
                text = item.path.read_text(encoding="utf-8")
                texts[item.path] = bool(fault.module) and fault.module in text
            return texts[item.path]

        order = items.copy()
        Random(fault.name + tier).shuffle(order)
        folders = {f"/{part}/" for part in fault.parts}
        return sorted(order, key=lambda i: (
            not names_it(i), not any(folder in i.nodeid for folder in folders)))  # fmt: skip

    def _hunt(
        self, fault: Fault, items: list[pytest.Item], tier: str, limit: float
    ) -> tuple[str | None, bool]:
        """Return the first test that fails, and whether all tests ran within the limit."""
        items = [item for item in items if self.right.get(item.nodeid, True)]
        while True:
            test, is_all = _forked(items, fault, tier, limit)
            if test is None or test in self.right:
                return test, is_all
            item = next(item for item in items if item.nodeid == test)
            self.right[test] = _forked([item], None, tier, 2 * limit)[0] is None
            if self.right[test]:
                return test, is_all
            items = [item for item in items if item.nodeid != test]


def _forked(
    items: list[pytest.Item], fault: Fault | None, tier: str, limit: float
) -> tuple[str | None, bool]:
    """Return the first test that fails on a fault, in a process of its own."""
    receiving, sending = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(receiving)
        try:
            _run(items, fault, tier, limit, sending)
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(0)
    os.close(sending)
    with os.fdopen(receiving) as pipe:
        lines = pipe.read().split("\n")
    os.waitpid(child, 0)
    *_, last, _end = lines if len(lines) > 1 else ["", "limit", ""]
    if last in ("all", "limit"):
        return None, last == "all"
    return last, False  # a test that was begun, and failed or never ended


def _run(
    items: list[pytest.Item], fault: Fault | None, tier: str, limit: float, sending: int
) -> None:
    null = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1, 2):
        os.dup2(null, descriptor)
    settings.load_profile("quick" if tier == "quick" else "dev")
    most = int(limit) + (20 if tier == "quick" else 40)
    began = clock.process_time()
    resource.setrlimit(resource.RLIMIT_CPU, (most + int(began) + 1, most + int(began) + 5))
    with ExitStack():
        if fault is not None:
            fault.make()
        for k, item in enumerate(items):
            if clock.process_time() - began > limit:
                os.write(sending, b"limit\n")
                return
            os.write(sending, f"{item.nodeid}\n".encode())
            following = items[k + 1] if k + 1 < len(items) else None
            reports = runtestprotocol(item, log=False, nextitem=following)
            if any(report.failed for report in reports):
                return
    os.write(sending, b"all\n")


@click.command()
@click.argument("results", type=click.Path(dir_okay=False, path_type=Path))
@click.option("--mutants", "number", type=click.IntRange(min=0), default=100, show_default=True)
@click.option("--seed", type=int, default=1, show_default=True)
@click.option("--quick-seconds", default=15.0, show_default=True, help="Limit of the quick tier.")
@click.option("--other-seconds", default=30.0, show_default=True, help="Limit of other tests.")
@click.option("--seconds", default=86400.0, show_default=True, help="Limit in all.")
@click.option("--share", default="0/1", show_default=True, help="K/N: every N-th fault from K on.")
def main(
    results: Path, number: int, seed: int, quick_seconds: float, other_seconds: float,
    seconds: float, share: str,
) -> None:  # fmt: skip
    """Hunt each fault; a run that was stopped continues from RESULTS, one JSON line a fault."""
    k, n = map(int, share.split("/"))
    faults = [*planted(), *mutants(number, seed)]
    Random("order").shuffle(faults)  # a run that is stopped has some of both
    faults = faults[k::n]
    hunt = _Hunt(faults, results, (quick_seconds, other_seconds), clock.time() + seconds)
    tests = [str(ROOT / "tests" / tier) for tier in ("unit", "api", "system")]
    pytest.main([*tests, "-q", "-p", "no:cacheprovider", "-m", "not slow and not browser",
                 "-W", "ignore::pytest.PytestAssertRewriteWarning"], [hunt])  # fmt: skip
    rows = [json.loads(line) for line in results.read_text(encoding="utf-8").splitlines()]
    for kind, is_planted in (("planted", True), ("mutants", False)):
        of_kind = [row for row in rows if row["fault"].startswith("planted: ") == is_planted]
        quick = sum(row["tier"] == "quick" for row in of_kind)
        found = sum(row["tier"] is not None for row in of_kind)
        click.echo(f"{kind}: {len(of_kind)}, found {found}, of them by the quick tier {quick}")


if __name__ == "__main__":
    sys.path.insert(0, str(ROOT))
    main()
