"""convert and generate: scenes from files of shapes, and scenes of ready families."""

from __future__ import annotations

import json
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

import click

from exactpt.brief import counted
from exactpt.cli.options import (
    QUIET,
    RATIONAL,
    bounded,
    keep_input,
    max_bytes,
    output,
    typed,
    within_budget,
)
from exactpt.cli.terminal import name_in_words, print_error, print_output
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, shorten, show

if TYPE_CHECKING:
    from exactpt.scene.scene import Scene

_FEW = 3
"""Number of touching pairs of bodies that are named."""


@click.command()
@click.argument("source", type=click.Path(path_type=Path), metavar="IN")
@click.argument("target", type=click.Path(path_type=Path), metavar="OUT")
@click.option("--at", type=RATIONAL, help="The time, if OUT is not a scene; by default the start.")
@click.option(
    "--time",
    type=RATIONAL,
    nargs=2,
    default=("0", "1"),
    show_default=True,
    metavar="START END",
    help="The time span of the new scene; of moving features their own.",
)
@click.option(
    "--tolerance",
    type=float,
    help="Maximum distance of a chord from its curve: by default 0.1 in an SVG that is read, a "
    "hundredth of the radius of a rounded body that is written.",
)
@click.option(
    "--holes",
    type=click.Choice(["keep", "refuse", "fill"]),
    default="keep",
    show_default=True,
    help="What to do with polygons that have holes.",
)
@click.option(
    "--parts",
    type=click.Choice(["keep", "split"]),
    default="keep",
    show_default=True,
    help="Whether a MultiPolygon is one body, or a body for each part.",
)
@click.option(
    "--repair",
    is_flag=True,
    help="Replace polygons that are not valid by those that their rings fill (even-odd rule), "
    "with a message for each.",
)
@click.option("--skip-invalid", is_flag=True, help="Leave out invalid shapes, with a message.")
@click.option(
    "--strict",
    is_flag=True,
    help="Refuse to leave out data, such as heights; without it they are named.",
)
@QUIET
@bounded
def convert(
    source: Path,
    target: Path,
    at: QQ | None,
    time: tuple[QQ, QQ],
    tolerance: float | None,
    holes: Literal["keep", "refuse", "fill"],
    parts: Literal["keep", "split"],
    repair: bool,
    skip_invalid: bool,
    strict: bool,
    quiet: bool,
    max_seconds: float | None,
) -> int:
    """Turn shapes into a scene at rest, or a scene at a time into shapes; moving features too.

    The suffixes determine the formats: .geojson, .mfjson, .svg (needs: pip install
    'exactpt[svg]'), .wkt (needs: pip install 'exactpt[shapely]'), and .json for a scene; a .json
    file that is read may be GeoJSON or MF-JSON too. A shape becomes a body, with its holes, or one
    for each part if these are not the polygons of a MultiPolygon; it is named by the property name
    or id, or by the id in an SVG. A line that ends where it began becomes a polygon.

    Moving features (OGC MF-JSON: points, lines and polygons that move straight from date to date,
    as MobilityDB writes them too) keep their motions both ways; times are seconds since
    1970-01-01T00:00:00Z. Motions that the format cannot represent, such as rotations, are refused.

    Numbers in GeoJSON, MF-JSON and WKT are read as exact decimals. Points of an SVG are computed in
    doubles, which are taken at their exact value, and its y-axis is flipped to point up, as in a
    scene; they are in millimetres if the drawing has a physical size. Shapes are written as the
    doubles nearest to the exact positions.

    Data that would change a shape or a motion and are not understood are an error. Other data that
    the result has no place for are named on standard error ("lost: crs, z of 40 points"); with
    --strict they are an error.

    \b
    Examples:
      exactpt convert countries.geojson scene.json --time 0 10
      exactpt convert drawing.svg scene.json --tolerance 0.01 --holes fill
      exactpt convert parcels.wkt scene.json --repair --skip-invalid
      exactpt convert scene.json then.geojson --at 5/2
      exactpt convert trips.mfjson scene.json
    """
    from exactpt.exchange.files import holds_scene, lost_by_writing, read_shapes, write_shapes
    from exactpt.exchange.losses import lost_line

    keep_input(source, target)
    if time[0] >= time[1]:
        raise InputError(f"--time: the span from {show(time[0])} to {show(time[1])} is empty")
    idle = typed("time", "holes", "parts", "repair", "skip_invalid")

    left_out: list[str] = []
    mended: list[str] = []
    with within_budget(max_seconds):
        if idle and holds_scene(source, max_bytes()):
            raise InputError(f"{idle[0]}: {source} is a scene, which is read as it is")
        scene = read_shapes(
            source,
            time=time if typed("time") else None,
            tolerance=0.1 if tolerance is None else tolerance,
            holes=holes,
            parts=parts,
            repaired=mended.append if repair else None,
            skipped=left_out.append if skip_invalid else None,
            strict=strict,
            max_bytes=max_bytes(),
        )
        remarks = [*mended, *(f"left out: {line}" for line in left_out)]
        lost = (*scene.lost, *lost_by_writing(scene, target, at))
        remarks += [lost_line(lost)] if lost else []
        is_scene = target.suffix.lower() == ".json"
        if is_scene and not quiet:
            remarks += _what_touches(scene)
        if typed("tolerance") and not scene.has_radius and holds_scene(source, max_bytes()):
            raise InputError(f"--tolerance: {source} is a scene, which is read as it is")
        write_shapes(scene, target, at, tolerance=tolerance, strict=strict)
    if not quiet:
        for line in remarks:
            print_error(line)
        if is_scene:
            bodies = counted(len(scene.bodies), "body")
            vertices = counted(scene.vertex_count, "vertex")
            print_output(f"{bodies}, {vertices}: {target}")
    return 0


def _what_touches(scene: Scene) -> list[str]:
    """Return a line about the bodies that touch at the start, if there are any."""
    from exactpt.pair.start import initial_touches
    from exactpt.search.query import Selection

    try:
        _, touching = initial_touches(scene)
    except InputError as error:  # too many to be listed
        return [str(error)]
    pairs = Selection(scene).of(touching)
    if not pairs:
        return []
    names = [name_in_words(body.name) for body in scene.bodies]
    some = [f"{names[i]} and {names[j]}" for i, j in pairs[:_FEW]]
    more = [counted(len(pairs) - _FEW, "more pair")] if len(pairs) > _FEW else []
    return [
        f"bodies touch at the start, so that the first contact is there: {', '.join(some + more)}"
    ]


class _WithFamilies(click.Command):
    """A command whose help ends with a list of the families, one per line."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the families, grouped by the kind of bodies."""
        super().format_epilog(ctx, formatter)
        from exactpt.testing.scenes import CATALOGUE

        headings = ("Convex bodies", "Simple polygons", "Points", "Rounded bodies",
                 "Bodies with holes and parts", "Bodies whose rings touch",
                 "Bodies that turn at a constant rate")  # fmt: skip
        for heading, families in zip(headings, CATALOGUE.values(), strict=True):
            with formatter.section(heading):
                formatter.write_dl(
                    [(name, family.__doc__ or "") for name, family in families.items()]
                )


SEED: Final = 4
"""The seed if none is given: stars and 24 other families have a first contact after the start."""


@click.command(cls=_WithFamilies)
@click.argument("family")
@click.option("--seed", type=int, default=SEED, show_default=True, help="Seed of the scene.")
@output("The scene file; by default standard output.")
def generate(family: str, seed: int, output: Path | None) -> int:
    """Make a scene of a family; a seed gives the same scene on every machine.

    Many families are nearly or fully degenerate: bodies that touch, slide along each other, or
    all touch at one time.

    \b
    Examples:
      exactpt generate stars -o stars.json
      exactpt generate grids_passing --seed 7 -o grids.json
    """
    from exactpt.scene.written import save, to_json
    from exactpt.testing.scenes import EVERY
    from exactpt.testing.scenes import generate as generated

    if family not in EVERY:
        near = get_close_matches(family, EVERY, n=3) or ["convex"]
        raise InputError(f"no family {shorten(family)}: perhaps {' or '.join(near)} (all: --help)")
    scene = generated(family, seed)
    if output is None:
        click.echo(json.dumps(to_json(scene), indent=1))
    else:
        save(scene, output)
    return 0
