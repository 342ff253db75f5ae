"""Wounds: one value of a valid file is changed, or its text is damaged."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator
from random import Random
from typing import Any, Final, TypeAlias

__all__ = ["Json", "damaged", "with_another_value", "with_another_word"]

Json: TypeAlias = Any


def nested(depth: int) -> Json:
    """Lists around each other."""
    value: Json = []
    for _ in range(depth):
        value = [value]
    return value


VALUES: Final[list[Json]] = [
    None, True, False, 0, -1, 7, 1.5, 10**30, -(10**400), 1e308, 5e-324, [], {}, "", "x", "1/0",
    "1/-2", "--1", "1e5", "1e400", "1e-399", "1e99999", "1e999999999", "NaN", "Infinity", "0x10",
    "1_000", "\uff11", "1 ", "\x00", "\x1b[31m", "\x9b31m", "\u202e", "a,b", "\n", [[]], [["0"]],
    ["0", "1", "2"], ["0"] * 300, {"x": ["0", "1"]}, {"x": ["0"], "z": ["1"]}, {"rigid": {}},
    {"rigid": {"half_turn": ["0", "1e30"]}}, {"pieces": []}, {"affine": {"matrix": []}},
    "9" * 500, "9" * 10_001, [["0", "0"]] * 3, [["0", "0"], ["1", "1"], ["2", "2"]],
    2**31, -(2**31) - 1, 2**63, -(2**63) - 1, 10**18, float("nan"), float("inf"), nested(300),
]  # fmt: skip
"""Values put in the place of another one."""

WORDS: Final = [
    "", "0", "-", "1e999", "1e-999", "1e308", "-1e308", "5e-324", "1e9999999", "NaN", "Infinity",
    "null", "[", "]", "{", "}", "(", ")", "<", ">", '"', ",", "\\", "\x00", "\x1b", "\u202e",
    "EMPTY", "%", "url(#x)", "#t", "none", "1/0", "M", "a", "Z", "use", "style", "id", "&lt;",
    "&#0;", "<!--", "GEOMETRYCOLLECTION (", "9" * 400,
]  # fmt: skip
"""Words put into a text."""

_WORD: Final = re.compile(r"[\w.+-]+")


def with_another_value(data: Json, rng: Random) -> Json:
    """A copy of JSON data with one value changed: junk, or another value of the data."""
    data = copy.deepcopy(data)
    places = list(_places(data))
    path = rng.choice(places)
    parent = _at(data, path[:-1])
    others = [rng.choice(VALUES), copy.deepcopy(_at(data, rng.choice(places)))]
    if isinstance(parent[path[-1]], str):
        others.append(_near(parent[path[-1]], rng))
    parent[path[-1]] = rng.choice(others)
    return data


def _near(text: str, rng: Random) -> str:
    """A number of another size, or a text with one character changed."""
    i = rng.randrange(len(text) + 1)
    return rng.choice([f"-{text}", f"{text}e9", f"{text}/3", text[:i] + text[i + 1 :], text * 3])


def _places(data: Json, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    if path:
        yield path
    if isinstance(data, (dict, list)):
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            yield from _places(value, (*path, key))


def _at(data: Json, path: tuple[Any, ...]) -> Json:
    for key in path:
        data = data[key]
    return data


def with_another_word(text: str, rng: Random) -> str:
    """A text with one word or number changed."""
    words = list(_WORD.finditer(text))
    if not words:
        return rng.choice(WORDS)
    word = rng.choice(words)
    new = rng.choice([rng.choice(WORDS), rng.choice(words)[0], f"-{word[0]}", f"{word[0]}e7"])
    return text[: word.start()] + new + text[word.end() :]


def damaged(text: str, rng: Random) -> bytes:
    """A text cut, doubled, nested, or with words and bytes put in."""
    for _ in range(rng.choice([1, 1, 2, 5])):
        i, j = sorted(rng.randrange(len(text) + 1) for _ in range(2))
        j = min(j, i + rng.choice([0, 1, 3, 30, 300]))
        match rng.randrange(6):
            case 0:
                text = text[:i] + rng.choice(WORDS) + text[j:]
            case 1:
                text = text[:i] + text[i:j] * rng.choice([2, 50]) + text[j:]
            case 2:
                text = text[:i]
            case 3:
                depth = rng.choice([5, 200, 5000])
                left, right = rng.choice(["[]", "()", ("<g>", "</g>"), ('{"a":', "}")])
                text = text[:i] + left * depth + text[i:j] + right * depth + text[j:]
            case 4:
                text = text[:i] + json.dumps(rng.choice(VALUES)) + text[j:]
            case _:
                text = text[:i] + text[j:]
    content = text.encode("utf-8", "surrogatepass")
    if rng.random() < 0.2:
        k = rng.randrange(len(content) + 1)
        content = content[:k] + rng.randbytes(rng.choice([1, 4, 40])) + content[k:]
    return content
