"""Pyodide for `make try-browser` and `make test-pyodide`, into the folder .pyodide.

The core comes from the npm registry, by npm; packages from the address that the page names,
each compared with its hash in the core's lock file; what exactpt needs and that file has not,
or not in such a version, from PyPI, as micropip does, and is added to the file: the tests need no
network. What the tests of the package need comes from PyPI too. What is there already is kept.
"""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
import sys
import tarfile
import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from urllib.request import urlopen

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name, parse_wheel_filename

ROOT = Path(__file__).parents[1]
TESTED_WITH = ("pytest", "pytest-xdist", "hypothesis", "sympy", "python-flint")


def fetch(folder: Path, address: str) -> None:
    """Fetch what is missing in the folder, of the version that the address names."""
    (version,) = re.findall(r"/v([^/]+)/", address)
    if not (folder / "pyodide.mjs").is_file():
        _fetch_core(folder, version)
    place = folder / "pyodide-lock.json"
    lock = json.loads(place.read_text())
    packages = lock["packages"]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    needed = ["micropip"]
    for requirement in map(Requirement, project["dependencies"]):
        name = canonicalize_name(requirement.name)
        if name not in packages or packages[name]["version"] not in requirement.specifier:
            packages[name] = _from_pypi(folder, requirement, lock["info"])
        needed.append(name)
    place.write_text(json.dumps(lock))
    for name in needed:  # it grows
        needed += [other for other in packages[name]["depends"] if other not in needed]
        _fetch_package(folder, address, packages[name])
    if not (folder / "tests").is_dir():
        _download(folder / "tests", lock["info"], *TESTED_WITH)


def _fetch_core(folder: Path, version: str) -> None:
    folder.mkdir(exist_ok=True)
    print(f"fetching pyodide {version}")
    with TemporaryDirectory() as place:
        command = ["npm", "pack", "--silent", "--pack-destination", place, f"pyodide@{version}"]
        subprocess.run(command, check=True)
        (archive,) = Path(place).glob("*.tgz")
        with tarfile.open(archive) as files:
            for member in files:
                member.name = member.name.removeprefix("package/")
                files.extract(member, folder, filter="data")


def _fetch_package(folder: Path, address: str, package: dict[str, Any]) -> None:
    file = package["file_name"]
    if (folder / file).is_file():
        return
    print(f"fetching {file}")
    with urlopen(address + file) as answer:
        content = answer.read()
    if hashlib.sha256(content).hexdigest() != package["sha256"]:
        sys.exit(f"{address}{file} is not the file of pyodide-lock.json")
    (folder / file).write_bytes(content)


def _from_pypi(folder: Path, requirement: Requirement, pyodide: dict[str, str]) -> dict[str, Any]:
    """Fetch a wheel that micropip would choose; its entry in the lock file."""
    with TemporaryDirectory() as place:
        _download(Path(place), pyodide, "--no-deps", str(requirement))
        (wheel,) = Path(place).glob("*.whl")
        content = wheel.read_bytes()
    (folder / wheel.name).write_bytes(content)
    name, version, *_ = parse_wheel_filename(wheel.name)
    return {
        "name": name,
        "version": str(version),
        "file_name": wheel.name,
        "install_dir": "site",
        "sha256": hashlib.sha256(content).hexdigest(),
        "package_type": "package",
        "imports": [name.replace("-", "_")],
        "depends": [],
        "unvendored_tests": False,
    }


def _download(folder: Path, pyodide: dict[str, str], *arguments: str) -> None:
    """Download wheels for Pyodide's platform, or for any."""
    print("fetching", *arguments)
    minor = "".join(pyodide["python"].split(".")[:2])
    platform = f"pyemscripten_{pyodide['abi_version']}_{pyodide['arch']}"
    options = ["--only-binary=:all:", "--implementation=cp", f"--python-version={minor}"]
    options += [f"--abi=cp{minor}", "--abi=none", f"--platform={platform}", "--platform=any"]
    command = [sys.executable, "-m", "pip", "download", "--quiet", *options, "--dest", str(folder)]
    subprocess.run([*command, *arguments], check=True)


if __name__ == "__main__":
    settings = json.loads((ROOT / "docs" / "browser" / "settings.json").read_text())
    fetch(ROOT / ".pyodide", settings["pyodide"])
