"""The language of package, benchmarks and fuzzer: patterns that confuse readers become rarer.

`python tests/system/docs/test_style.py` writes the counts of today to tests/data/style.json.
"""

import ast
import io
import json
import re
import sys
import tokenize
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[3]
STORED = ROOT / "tests" / "data" / "style.json"
ROOTS = ("exactpt", "benchmarks", "fuzz")
PATTERNS = {
    "a first line with 'Whether': Return True if": r"\AWhether\b",
    "a relative clause without its noun (what is ...)": (
        r"\bwhat (is|are|was|it|they|has|have|touches|comes|goes|remains|follows|leads|one|a|the"
        r"|all|of|else|does|happens|can|cannot|may)\b"
    ),
    "'then' at the end of a clause: at that time": r"\bthen[.;,]|\bthen$",
    "'for ever': for all times, identically": r"\bfor ever\b",
    "a word of speech (ask, tell, answer): call, report, return, result": (
        r"\b(asks?|asked|tells?|told|says?|said|answers?|answered)\b"
    ),
    "'is none', 'is no X', 'there is no X': is not a, does not exist, without": (
        r"\b(that|which) (is|are) none\b|\b(is|are) no [a-z]+\b"
    ),
    "meet: touch, intersect, coincide": r"\b(meets?|met)\b",
    "another one, other one: repeat the noun": r"\b(another|other) one\b",
}


def texts_of(path):
    """Docstrings, comments and raised messages of a module."""
    source = path.read_text(encoding="utf-8")
    source = re.sub(r"(?s)# ---- Copied from .*?# ---- End of the copy\.", "", source)
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Raise) and node.exc is not None:
            yield ast.unparse(node.exc)
        elif isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            yield ast.get_docstring(node) or ""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            yield token.string


def counts():
    """For each package and pattern, how often it occurs; those that do not occur are left out."""
    found = {}
    for path in sorted(path for root in ROOTS for path in (ROOT / root).rglob("*.py")):
        package = ".".join(path.relative_to(ROOT).parts[:2]).removesuffix(".py")
        counter = found.setdefault(package, Counter())
        for text in texts_of(path):
            for name, pattern in PATTERNS.items():
                counter[name] += len(re.findall(pattern, text, re.IGNORECASE | re.MULTILINE))
    return {key: {k: n for k, n in c.items() if n} for key, c in found.items() if +c}


def test_no_pattern_becomes_more_frequent():
    stored = json.loads(STORED.read_text(encoding="utf-8"))
    more = [
        f"{package}: {n} of {name}, {stored.get(package, {}).get(name, 0)} before"
        for package, found in counts().items()
        for name, n in found.items()
        if n > stored.get(package, {}).get(name, 0)
    ]

    assert more == []


def test_the_patterns_find_what_they_are_for():
    found = {
        name: re.search(p, EXAMPLE, re.IGNORECASE | re.MULTILINE) for name, p in PATTERNS.items()
    }

    assert [name for name, match in found.items() if match is None] == []


EXAMPLE = """Whether what is asked for is no polygon
meets another one then, for ever."""

if __name__ == "__main__":
    STORED.write_text(json.dumps(counts(), indent=1) + "\n", encoding="utf-8")
    sys.exit(0)
