"""The distance of two bodies over time, as a plot: a document, or a strip above the scrubber."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING, Final, NamedTuple

from exactpt.kernel.numbers import QQ, finite, floor, nearest_float, rational
from exactpt.render.fixed import near
from exactpt.render.palette import FONT, style_of
from exactpt.render.words import clean, short, time_in_words

if TYPE_CHECKING:
    from exactpt.search.clearance import Clearance

SAMPLES: Final = 240
"""Number of equal parts of the time span at whose ends the distance is computed."""
MAX_TICKS: Final = 10
WIDTH, HEIGHT, LEFT, TOP, ROOM, BELOW = 800, 300, 70, 64, 20, 44
"""Size of a document in pixels, and its margins: left, above, right, below."""


class Plot(NamedTuple):
    """A curve in shares of the time span and of the largest distance.

    Attributes:
        points: of the curve.
        top: the largest distance.
        least: the point of the minimum.
        ticks: shares of the time span, each with its time in words.
        title: the subject.
        words: the minimum in words.
        heights: distances on the axis, as shares of the largest one, each in words.
        below: the share of a distance that is marked, and its words; None if there is none.
    """

    points: Sequence[tuple[float, float]]
    top: float
    least: tuple[float, float]
    ticks: Sequence[tuple[float, str]]
    title: str
    words: str
    heights: Sequence[tuple[float, str]] = ()
    below: tuple[float, str] | None = None


def plot_of(gap: Clearance, below: QQ | None = None) -> Plot:
    """Return the plot of a distance over its time span, with a mark at a distance ``below``.

    The curve is linear between samples; these include the ends of all pieces and the minimum.
    """
    start, end = (
        gap.pieces[0].start.simplified().exact_low,
        gap.pieces[-1].end.simplified().exact_low,
    )
    least = gap.minimum
    span = end - start
    times = {start + span * k / SAMPLES for k in range(SAMPLES + 1)}
    times |= {min(near(t, span), end) for t in (least.time, *(p.end for p in gap.pieces))}
    curve = [(t, finite(gap(t))) for t in sorted(times)]
    digits = 6 + len(str(floor(max(abs(start), abs(end)) / span)))  # a millionth of the span
    top = max(*(d for _, d in curve), 0.0 if below is None else nearest_float(below))
    scale = top or 1.0
    return Plot(
        points=[(float((t - start) / span), d / scale) for t, d in curve],
        top=top,
        least=(
            float((near(least.time, span) - start) / span),
            finite(float(least)) / scale,
        ),
        ticks=[(float((t - start) / span), text) for t, text in _ticks(start, end)],
        title=f"distance of {short(gap.a)} and {short(gap.b)}",
        heights=[(float(h) / scale, text) for h, text in _ticks(QQ(0), rational(top))],
        below=None
        if below is None
        else (nearest_float(below) / scale, f"{nearest_float(below):.6g}"),
        words=f"least {float(least):.6g} at {time_in_words(least.time.simplified(), digits)}",
    )


def _ticks(start: QQ, end: QQ) -> Iterator[tuple[QQ, str]]:
    """Multiples of 1, 2 or 5 times a power of ten, at most `MAX_TICKS` or so."""
    span = end - start
    step = QQ(10) ** (len(str(span.numerator)) - len(str(span.denominator)) - 2)
    factors = (2, QQ(5, 2), 2)
    k = 0
    while span / step > MAX_TICKS:
        step *= factors[k % 3]
        k += 1
    number = -((-start) // step)
    while number * step <= end:
        t = number * step
        is_short = t.denominator == 1 and abs(t) < 10**9
        yield t, str(t) if is_short else f"{finite(nearest_float(t)):.10g}"
        number += 1


def svg_of_plot(plot: Plot, *, theme: str = "auto") -> str:
    """Return the plot as an SVG document."""
    right, bottom = WIDTH - ROOM, HEIGHT - BELOW
    points = " ".join(f"{x:.2f},{y:.2f}" for x, y in map(_pixel, plot.points))
    x, y = _pixel(plot.least)
    size = f'viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" class="plot-{theme}" {size} role="img">',
        f"<title>{_text(plot.title)}</title>",
        f"<style>{style_of(theme, 'plot', _rules)}</style>",
        f'<rect class="paper" width="{WIDTH}" height="{HEIGHT}"/>',
        f'<text class="caption" x="20" y="27">{_text(plot.title)}</text>',
        f'<text class="news" x="20" y="48">{_text(plot.words)}</text>',
        f'<path class="axis" d="M{LEFT} {TOP}V{bottom}H{right}"/>',
        *(
            f'<path class="axis" d="M{LEFT} {py:.2f}h-5"/>'
            f'<text class="note" x="{LEFT - 8}" y="{py + 4:.2f}" text-anchor="end">{text}</text>'
            for share, text in plot.heights
            for py in [_pixel((0.0, share))[1]]
        ),
        *_threshold(plot, right),
        *(
            f'<path class="axis" d="M{px:.2f} {bottom}v5"/>'
            f'<text class="note" x="{px:.2f}" y="{bottom + 20}" text-anchor="middle">{text}</text>'
            for share, text in plot.ticks
            for px in [_pixel((share, 0.0))[0]]
        ),
        f'<text class="note" x="{right}" y="{HEIGHT - 8}" text-anchor="end">t</text>',
        f'<polyline class="curve" points="{points}"/>',
        f'<path class="drop" d="M{x:.2f} {TOP}V{bottom}"/>',
        f'<circle class="least" cx="{x:.2f}" cy="{y:.2f}" r="4"/>',
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def _threshold(plot: Plot, right: int) -> Iterator[str]:
    if plot.below is not None:
        share, text = plot.below
        y = _pixel((0.0, share))[1]
        yield f'<path class="below" d="M{LEFT} {y:.2f}H{right}"/>'
        yield f'<text class="note" x="{right}" y="{y - 4:.2f}" text-anchor="end">{text}</text>'


def _pixel(point: tuple[float, float]) -> tuple[float, float]:
    x, y = point
    return LEFT + x * (WIDTH - LEFT - ROOM), HEIGHT - BELOW - y * (HEIGHT - TOP - BELOW)


def _rules(colours: dict[str, str]) -> dict[str, str]:
    return {
        "text": f"font-family:{FONT};fill:{colours['ink']}",
        ".paper": f"fill:{colours['paper']}",
        ".caption": "font-size:16px;font-weight:600",
        ".news": f"font-size:14px;font-weight:600;fill:{colours['contact']}",
        ".note": f"font-size:12px;fill:{colours['soft']}",
        ".axis": f"stroke:{colours['soft']};fill:none",
        ".curve": f"stroke:{colours['accent']};fill:none;stroke-width:2;stroke-linejoin:round",
        ".drop": f"stroke:{colours['contact']};stroke-dasharray:3 4",
        ".below": f"stroke:{colours['contact']};stroke-dasharray:8 4",
        ".least": f"fill:{colours['contact']}",
    }


def strip_of(plot: Plot) -> str:
    """Return the plot as part of a page, as wide as the scrubber; its style is in `page.css`."""
    points = " ".join(f"{1000 * x:.2f},{100 - 100 * y:.2f}" for x, y in plot.points)
    x, y = plot.least
    ticks = "".join(
        f'<span class="tick" style="left:{100 * share:.3f}%">{text}</span>'
        for share, text in plot.ticks
    )
    mark = ""
    if plot.below is not None:
        share, text = plot.below
        mark = f'<i class="below" style="bottom:{100 * share:.3f}%">{text}</i>'
    title = _text(f"{plot.title}: {plot.words}")
    return (
        f'<figure class="gap" role="img" aria-label="{title}">'
        '<svg viewBox="0 0 1000 100" preserveAspectRatio="none" aria-hidden="true">'
        f'<polyline points="{points}"/></svg>'
        f"<figcaption>{_text(plot.title)}, up to {plot.top:.6g} <b>{_text(plot.words)}</b>"
        f'</figcaption><i class="drop" style="left:{100 * x:.3f}%"></i>'
        f'<i class="least" style="left:{100 * x:.3f}%;bottom:{100 * y:.3f}%"></i>{mark}{ticks}'
        '<i id="now"></i></figure>'
    )


def _text(text: str) -> str:
    return escape(clean(text))
