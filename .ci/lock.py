"""The versions that pip chooses today for development, as constraints for pip, a line each.

pip install --dry-run --ignore-installed --report - --editable . --group dev | python .ci/lock.py
"""

from __future__ import annotations

import json
import sys

from packaging.utils import canonicalize_name


def locked(report: str) -> list[str]:
    """Return ``name==version`` of each package in an installation report, but those in folders."""
    found = [item for item in json.loads(report)["install"] if not item["is_direct"]]
    names = [(canonicalize_name(i["metadata"]["name"]), i["metadata"]["version"]) for i in found]
    return [f"{name}=={version}" for name, version in sorted(names)]


if __name__ == "__main__":
    print("\n".join(locked(sys.stdin.read())))
