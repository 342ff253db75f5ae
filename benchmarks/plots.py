"""Plots as SVG, through matplotlib; the same bytes for the same numbers."""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Series", "draw_lines", "draw_shares", "series_of"]

Series: TypeAlias = Sequence[tuple[float, float]]

MARKERS: Final = "osD^v<>pPX*h8"


def series_of(
    rows: Iterable[Mapping[str, object]], line: str, x: str, y: str
) -> dict[str, list[tuple[float, float]]]:
    """The positive points (x, y) of a table, grouped by the values of column ``line``."""
    series: dict[str, list[tuple[float, float]]] = {}
    for row in rows:
        points = series.setdefault(str(row[line]), [])
        at, value = (float(str(row[column] or 0)) for column in (x, y))
        if at > 0 and value > 0:
            points.append((at, value))
    return series


def draw_lines(title: str, axes: tuple[str, str], series: Mapping[str, Series]) -> str:
    """Points joined by lines, one line for each name, with logarithmic axes."""
    figure, plot = _figure(8.0, 5.0)
    for i, (name, points) in enumerate(series.items()):
        xs, ys = [x for x, _ in points], [y for _, y in points]
        own = name.startswith("exactpt")
        plot.plot(
            xs,
            ys,
            marker=MARKERS[i % len(MARKERS)],
            label=name,
            linewidth=2.0 if own else 1.0,
            markersize=10 if own else 5,
            zorder=3 if own else 2,
        )
    plot.set(title=title, xlabel=axes[0], ylabel=axes[1], xscale="log", yscale="log")
    plot.grid(visible=True, alpha=0.3)
    plot.legend(fontsize="small", loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False)
    return _svg(figure)


def draw_shares(
    title: str,
    rows: Sequence[str],
    columns: Sequence[str],
    values: Sequence[Sequence[float | None]],
) -> str:
    """A table of shares from 0 to 1 in colours; None for cells without a value."""
    figure, plot = _figure(2.5 + 0.9 * len(columns), 1.5 + 0.35 * len(rows))
    shades = [[float("nan") if v is None else v for v in line] for line in values]
    plot.imshow(shades, cmap="Reds", vmin=0.0, vmax=1.0, aspect="auto")
    plot.set_title(title)
    plot.set_xticks(range(len(columns)), columns, rotation=30, ha="right")
    plot.set_yticks(range(len(rows)), rows)
    for i, j, value in _cells(values):
        colour = "white" if value is not None and value > 0.6 else "black"
        text = "-" if value is None else "0" if value == 0 else f"{value:.0%}"
        plot.text(j, i, text, ha="center", va="center", color=colour, fontsize="small")
    return _svg(figure)


def _cells(
    values: Sequence[Sequence[float | None]],
) -> Iterable[tuple[int, int, float | None]]:
    return ((i, j, value) for i, line in enumerate(values) for j, value in enumerate(line))


def _figure(width: float, height: float) -> tuple[Figure, Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    return figure, figure.subplots()


def _svg(figure: Figure) -> str:
    import matplotlib as mpl

    text = io.StringIO()
    # Identifiers come from hashes, and a date is written by default: both vary between runs.
    with mpl.rc_context({"svg.hashsalt": "exactpt", "svg.fonttype": "none"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()
