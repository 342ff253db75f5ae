"""What the site has besides the pages of this folder; a hook of mkdocs.yml (`make docs`).

The pages of the checkout's root, the API pages, the examples that pages link to, the gallery's
animations, what the page docs/browser needs, and llms.txt: the list of all pages, for programs
that read.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

ROOT: Final = Path(__file__).parents[1]
PAGES: Final = {
    "README.md": "index.md",
    "ARCHITECTURE.md": "architecture.md",
    "CHANGELOG.md": "changes.md",
    "CONTRIBUTING.md": "contributing.md",
    "SECURITY.md": "security.md",
    "CODE_OF_CONDUCT.md": "conduct.md",
}
"""The pages of the root, and their names in the site."""
OUTSIDE: Final = {
    "Makefile": "sources/Makefile.txt",
    "pyproject.toml": "sources/pyproject.toml.txt",
    ".ci/locked.txt": "sources/locked.txt",
    "CITATION.cff": "sources/CITATION.cff.txt",
}
"""Other files of the root that these pages link to."""
TASKS: Final = ("reference/commands.md", "reference/index.md", "scale.md", "testing.md")
"""Pages on tasks, beside those in howto."""
ALONE: Final = "modules"
"""The page of the modules that are in no package."""
LINK: Final = re.compile(r"(\]\(|src=\")(?!\w+:|#)([^)\"#]+)")


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add everything that is no page of this folder."""
    from mkdocs.structure.files import File

    from docs.make_page import made

    def add(path: str, content: str | bytes) -> None:
        files.append(File.generated(config, path, content=content))

    for name, page in PAGES.items():
        add(page, _moved((ROOT / name).read_text(encoding="utf-8"), below=""))
    for name, path in OUTSIDE.items():
        add(path, (ROOT / name).read_text(encoding="utf-8"))
    for path in (ROOT / "examples").glob("*.py"):
        add(f"examples/{path.name}.txt", path.read_text(encoding="utf-8"))
    add("reference/index.md", "# Public names\n\n" + "\n".join(_public()))
    add("reference/packages.md", _packages_page())
    add("reference/commands.md", "\n".join(_commands()))
    for package in (ALONE, *_packages()):
        add(f"reference/{package}.md", "\n".join(_modules(package)))
    for name, page in _animations():
        add(f"gallery/{name}.html", page)
    for path, content in made():
        add(f"browser/{path}", content)
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Links out of this folder lead to where these files are in the site.

    In a search, pages of packages are below all others, and those on tasks above.
    """
    name = page.file.src_uri
    if name.startswith("reference/") and name not in TASKS:
        page.meta["search"] = {"boost": 0.2}
    elif name.startswith("howto/") or name in TASKS:
        page.meta["search"] = {"boost": 2}
    if name in PAGES.values() or name.startswith("reference/"):
        return markdown
    text = _moved(markdown, below="../" * (name.count("/") + 1))
    if name == "gallery.md":
        text = re.sub(r"(!\[[^\]]*\]\(gallery/(\w+)\.svg\))", _played, text)
    return text


def on_post_build(config: MkDocsConfig) -> None:
    """Write llms.txt."""
    site = Path(config.site_dir)
    pages = sorted({path.relative_to(site) for path in site.rglob("*.html")} - {Path("404.html")})
    lines = [f"# {config.site_name}", "", f"> {config.site_description}", "", "## Pages", ""]
    for page in pages:
        found = re.search(r"<title>(.*?)</title>", (site / page).read_text(encoding="utf-8"))
        title = found[1].removesuffix(f" - {config.site_name}") if found else page.stem
        lines.append(f"- [{title}]({page.as_posix()})")
    (site / "llms.txt").write_text("\n".join([*lines, ""]), encoding="utf-8")


def _moved(text: str, *, below: str) -> str:
    """A page with its links to files of the root led to their places in the site."""

    def led(match: re.Match[str]) -> str:
        before, target = match.groups()
        name = target.removeprefix(below) if target.startswith(below) else target
        up = below.removeprefix("../")
        if target.startswith("docs/"):
            return before + target.removeprefix("docs/")
        if target.startswith(below) and name.startswith("examples/") and name.endswith(".py"):
            return f"{before}{up}{name}.txt"
        page = {**PAGES, **OUTSIDE}.get(name) if target.startswith(below) else None
        return before + (target if page is None else up + page)

    return LINK.sub(led, text)


def _played(image: re.Match[str]) -> str:
    """A picture of the gallery, with its animation below."""
    page = f"gallery/{image[2]}.html"
    look = "width:100%;height:34rem;border:0"
    frame = f'<iframe src="{page}" loading="lazy" title="{image[2]}" style="{look}"></iframe>'
    return f'{image[1]}\n\n??? example "Animation"\n\n    {frame}\n\n    [Alone]({page})'


def _animations() -> Iterator[tuple[str, str]]:
    """The animations of the gallery's scenes: their commands, with another ending."""
    from docs.draw_gallery import blocks, run

    for block in blocks():
        moving = re.sub(r"-o (\w+)\.svg", r"-o \1.html", block).replace(" --at contact", "")
        with TemporaryDirectory() as folder:
            page = run(moving, Path(folder), ending="html")
            yield page.stem, page.read_text(encoding="utf-8")


def _public() -> Iterator[str]:
    """The public names of `exactpt`, each with a link to where it is documented."""
    import exactpt

    public = [name for name in dir(exactpt) if name[0] != "_" and name not in ("arrays", "batch")]
    for name in sorted(public, key=str.lower):
        thing = getattr(exactpt, name)
        module = getattr(thing, "__module__", None)
        first = (thing.__doc__ or "").strip().partition("\n")[0]
        link = f"[`{name}`]({name}.md)" if module is None else f"[`{name}`][{module}.{name}]"
        yield f"- {link}: {first}"


def _commands() -> Iterator[str]:
    """The help text of every command, and where exit codes and limits are documented."""
    import click

    from exactpt.cli import all_commands

    yield "# Command line\n\nThe help text of each command. [Exit codes](../format.md#exit-codes)."
    for name, command in sorted(all_commands().items()):
        context = click.Context(command, info_name=f"exactpt {name}", terminal_width=90)
        yield f"\n## `exactpt {name}`\n\n```text\n{command.get_help(context)}\n```"


def _packages() -> list[str]:
    return sorted(path.parent.name for path in (ROOT / "exactpt").glob("*/__init__.py"))


def _packages_page() -> str:
    """The list of packages, each with the first line of its docstring."""
    lines = [f"- [modules of their own]({ALONE}.md): errors, files, the checker of proofs"]
    for package in _packages():
        source = (ROOT / "exactpt" / package / "__init__.py").read_text(encoding="utf-8")
        first = (ast.get_docstring(ast.parse(source)) or "").partition("\n")[0]
        lines.append(f"- [`exactpt.{package}`]({package}.md): {first}")
    return "\n".join(["# Rooms", "", *lines, ""])


def _modules(package: str) -> Iterator[str]:
    yield f"# {'exactpt' if package == ALONE else f'exactpt.{package}'}\n"
    folder = ROOT / "exactpt"
    inside = folder.glob("[a-z]*.py") if package == ALONE else (folder / package).rglob("*.py")
    for path in sorted(inside):
        name = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
        yield f"::: {name}\n    options: {{show_root_full_path: true, show_submodules: false}}\n"
