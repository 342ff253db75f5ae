"""Copy the reader of scenes, without comments, from `proof_check.py` into `check_apart.py`.

    python .ci/copy_reader.py          rewrites the part between two markers

Both checkers stand alone, so one of them has a copy. A test compares it with what this returns.
Lines that end with "# own" are not copied.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path

PACKAGE = Path(__file__).parent.parent / "exactpt"
SOURCE, TARGET = PACKAGE / "proof_check.py", PACKAGE / "check_apart.py"
BEGIN, END = "# ---- Copied from proof_check.py, by .ci/copy_reader.py.", "# ---- End of the copy."
NAMES = """
Point Dart Json Entry Triple Track Whole Rows ONE Poses NUMBER MAX_BITS MAX_DEGREE NoProofError
Rejected Exhausted Work WORK spend budget PIECE EXACT integer digits written require words
most_words longest Poly vector_of dot_of values turn meet are_same is_simple surrounds Bare need
number rational keys entries check_json polynomial degree Motion cleared Body point vertex
keyframes spin_of spline_of path_of Scene MAX_DIGITS MAX_BYTES is_rational read read_json
file_bytes say MOTION_KEYS BODY_KEYS
""".split()  # noqa: SIM905
METHODS = {  # of classes that are not copied whole
    "Poly": "__new__ __add__ __sub__ __mul__",
    "Body": "__init__ read_motion rows around places check_simple track",
    "Scene": "__init__ read of track place",
}
WIDTH = 118
COMPOUND = re.compile(r"\s*(@|(if|for|while|def|class|with|try|except|else|elif|finally)\b)")


def reader(source: str, *, is_short: bool = True) -> str:
    """Return the copy: definitions of proof_check.py without docstrings, in few lines."""
    made = list[str]()
    source = re.sub(r".*  # own\n", "", source)
    for node in ast.parse(source).body:
        if name_of(node) not in NAMES:
            continue
        if isinstance(node, ast.ClassDef) and node.name in METHODS:
            kept = METHODS[node.name].split()
            node.body = [m for m in node.body if getattr(m, "name", kept[0]) in kept]
        for part in ast.walk(node):
            if isinstance(part, ast.FunctionDef | ast.ClassDef) and ast.get_docstring(part):
                part.body = part.body[1:] or [ast.Pass()]
        made.append(ast.unparse(node))
    text = "\n".join(made)
    return (joined(text) if is_short else text) + "\n"


def name_of(node: ast.stmt) -> str:
    """Return the first name that a statement defines."""
    if isinstance(node, ast.Assign):
        return re.findall(r"\w+", ast.unparse(node.targets[0]))[0]
    return getattr(node, "name", "")


def joined(text: str) -> str:
    """Put short simple statements side by side, and a line of them behind the colon before it."""
    while (shorter := joined_once(text)) != text:
        text = shorter
    return text


def joined_once(text: str) -> str:
    """Put some of them together."""
    lines, made = [line for line in text.split("\n") if line], list[str]()
    for i, line in enumerate(lines):
        last = made[-1] if made else ""
        deep, of_next = depth(line), depth(lines[i + 1]) if i + 1 < len(lines) else -1
        fits = len(last) + len(line.strip()) < WIDTH
        alone = last.endswith(":") and COMPOUND.match(last) and of_next < deep and is_simple(line)
        beside = is_simple(last) and is_simple(line) and depth(last) == deep
        if fits and alone:
            made[-1] = f"{last} {line.strip()}"
        elif fits and beside:
            made[-1] = f"{last}; {line.strip()}"
        else:
            made.append(line)
    return "\n".join(made)


def depth(line: str) -> int:
    """Return the indentation."""
    return len(line) - len(line.lstrip())


def is_simple(line: str) -> bool:
    """Return True for a statement without others inside, or some of them."""
    return bool(line) and not COMPOUND.match(line)


def main() -> None:
    """Rewrite the copy."""
    before, rest = TARGET.read_text(encoding="utf-8").split(f"{BEGIN}\n")
    after = rest.split(f"{END}\n")[1]
    source = SOURCE.read_text(encoding="utf-8")
    copy, plain = reader(source), reader(source, is_short=False)
    if ast.dump(ast.parse(copy)) != ast.dump(ast.parse(plain)):
        raise SystemExit("statements that are put on one line have another meaning")
    TARGET.write_text(f"{before}{BEGIN}\n{copy}{END}\n{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
