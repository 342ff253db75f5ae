"""Compiles the most used modules by mypyc, where mypyc and a C compiler are found.

The sources are the same; without a compiler, or if it fails, the package is plain Python and
works as well, slower. Only commands that build a wheel compile, not those that make the sdist,
metadata or an editable install: this stays plain, so that what is edited is what runs;
`python setup.py build_ext --inplace` (`make compiled`) compiles a checkout, and `make plain` undoes
it. With EXACTPT_PLAIN=1 in the environment nothing is compiled: the wheel is for any platform, also
for Pyodide's (`make browser`).

The modules are compiled into a few libraries, exactpt/compiled*__mypyc, inside the package: there
every install finds them, and two C compilers can work at a time.

Not compiled is what computes with the integers of GMP: for the type checker they are
``int``, which mypyc would take at its word.

A wheel has the C++ sources of cgal_check too, in exactpt/cgal/sources: `exactpt check --build`.
"""

import os
import runpy
import shutil
import sys
from glob import glob
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py
from setuptools.errors import BaseError, CCompilerError

COMPILED = [
    "exactpt/certificates/*.py",
    "exactpt/filters/*.py",
    "exactpt/indices.py",
    "exactpt/kernel/counters.py",
    "exactpt/motion/course.py",
    "exactpt/motion/float_track.py",
    "exactpt/motion/ring_order.py",
    "exactpt/motion/vertex.py",
    "exactpt/motion/vertices.py",
    "exactpt/planar/halfedge.py",
    "exactpt/pseudotriangulation/*.py",
    "exactpt/search/sweep.py",
    "exactpt/simulation/event.py",
    "exactpt/tiling/*.py",
    "exactpt/tiling/*/*.py",
]
LATER = {
    "exactpt/tiling/driver.py",
    "exactpt/tiling/tiling_search.py",
}
"""Parts of compiled packages that have not been compiled and measured yet."""
EXACT = {
    "exactpt/pseudotriangulation/degenerate.py",
    "exactpt/certificates/perturbation.py",
    "exactpt/tiling/greedy/slope.py",
}


LIBRARIES = {
    "exactpt": "exactpt.compiled",
    "exactpt/filters": "exactpt.compiled_filters",
    "exactpt/search": "exactpt.compiled_filters",
    "exactpt/planar": "exactpt.compiled_tiling",
    "exactpt/pseudotriangulation": "exactpt.compiled_tiling",
    "exactpt/simulation": "exactpt.compiled_tiling",
    "exactpt/tiling": "exactpt.compiled_tiling",
    **dict.fromkeys(
        [f"exactpt/tiling/{name}" for name in ("greedy", "incremental", "lazy", "mixed")],
        "exactpt.compiled_structures",
    ),
}
"""The library of each package and of those within it: four C files of about the same size.

An event of a tiling takes as long as with one file (measured by turns on 2026-11-28).
"""


COMPILING = {"bdist_wheel", "build", "build_ext", "install"}


def sources() -> list[str]:
    """Return the paths of the modules to compile."""
    found = sorted(path for pattern in COMPILED for path in glob(pattern))
    plain = EXACT | LATER
    return [path for path in found if path not in plain and not path.endswith("__init__.py")]


def libraries() -> list[tuple[list[str], str]]:
    """Return the modules of each library, with its name."""
    found: dict[str, list[str]] = {}
    for source in sources():
        package = source.rpartition("/")[0]
        while package not in LIBRARIES:
            package = package.rpartition("/")[0]
        found.setdefault(LIBRARIES[package], []).append(source)
    return [(modules, name) for name, modules in found.items()]


def extensions() -> list[Extension]:
    """Return the extensions; none for other commands, a plain build, or without mypyc."""
    if COMPILING.isdisjoint(sys.argv) or os.environ.get("EXACTPT_PLAIN") == "1":
        return []
    try:
        from mypyc.build import mypycify
    except ImportError:
        return []
    minutes = "this takes two minutes on two idle cores; EXACTPT_PLAIN=1 leaves it out"
    said = f"exactpt: mypyc and a C compiler compile {len(sources())} modules; {minutes}\n"
    sys.stderr.write(said)
    options = ["--config-file=", "--ignore-missing-imports", "--follow-imports=silent"]
    compiled: list[Extension] = mypycify(
        [*options, *sources()], opt_level="2", debug_level="0", separate=libraries()
    )
    for extension in compiled:
        if sys.platform != "win32":  # fused operations round once: enclosures would differ
            extension.extra_compile_args.append("-ffp-contract=off")
    return compiled


class BuildWithSources(build_py):
    """The package, with the sources of cgal_check as data."""

    def run(self) -> None:
        """Copy both into the wheel."""
        super().run()
        if not self.editable_mode and Path("cgal_check").is_dir():
            into = Path(self.build_lib, "exactpt", "cgal", "sources")
            leave = shutil.ignore_patterns("build")
            shutil.copytree("cgal_check", into, ignore=leave, dirs_exist_ok=True)


class BuildExtensions(build_ext):
    """The extensions; in a checkout also the list of sources that ``import exactpt`` compares."""

    def finalize_options(self) -> None:
        """Compile several libraries at a time, unless the command says how many."""
        super().finalize_options()
        self.parallel = self.parallel or os.cpu_count()

    def run(self) -> None:
        """Build them; in a checkout, remove what an earlier build left, and write the list."""
        package, inplace = Path("exactpt"), self.inplace
        if inplace:
            for old in (*package.rglob("*.so"), package / "compiled.txt"):
                old.unlink(missing_ok=True)
        super().run()
        if inplace and any(package.glob("compiled__mypyc.*")):
            runpy.run_path("exactpt/compiled.py")["write"](sources())

    def build_extensions(self) -> None:
        """Build all, or none if the C compiler fails: one module needs the others."""
        try:
            super().build_extensions()
        except (BaseError, CCompilerError) as error:
            self.warn(f"the package is plain Python, without its compiled modules: {error}")
            for made in self.get_outputs():
                Path(made).unlink(missing_ok=True)
            self.extensions = []


setup(
    ext_modules=extensions(),
    cmdclass={"build_ext": BuildExtensions, "build_py": BuildWithSources},
)
