"""The structure of drawings: sizes, copies, nested drawings, style sheets, and refusals by name."""

from fractions import Fraction

import pytest
from folding import every

from exactpt import Body, InputError, Scene, read_shapes, write_shapes
from exactpt.exchange.losses import Losses
from exactpt.exchange.svg import shapes_of

RECT = '<rect id="r" x="1" y="2" width="3" height="4"/>'


def read(inside, attributes="", losses=None):
    text = f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{inside}</svg>'
    return list(shapes_of(text, 0.1, losses))


def box(shape):
    """The least x, the least y downwards, width and height."""
    xs, ys = [x for x, _ in shape.points], [-y for _, y in shape.points]
    return min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys)


MM = Fraction(254, 960)
"""A pixel in millimetres: an inch has 96."""


@every(
    "attributes, expected",
    [
        ("", (1, 2, 3, 4)),
        ('viewBox="0 0 10 10"', (1, 2, 3, 4)),
        ('width="500" height="500" viewBox="0 0 10 10"', (1, 2, 3, 4)),
        ('width="100%" height="100%" viewBox="0 0 10 10"', (1, 2, 3, 4)),
        ('width="100mm" height="100mm" viewBox="0 0 10 10"', (10, 20, 30, 40)),
        ('width="10cm" height="10cm" viewBox="0 0 10 10"', (10, 20, 30, 40)),
        ('width="10in" viewBox="0 0 10 10"', [Fraction("25.4") * k for k in (1, 2, 3, 4)]),
        ('height="720pt" viewBox="0 0 10 10"', [Fraction("25.4") * k for k in (1, 2, 3, 4)]),
        ('width="6pc" viewBox="0 0 1 1"', [Fraction("25.4") * k for k in (1, 2, 3, 4)]),
        ('width="10px" height="10px" viewBox="0 0 10 10"', [MM * k for k in (1, 2, 3, 4)]),
        ('width="100mm" height="100"', [MM * k for k in (1, 2, 3, 4)]),
        ('style="width: 20mm" viewBox="0 0 10 10"', (2, 4, 6, 8)),
        # 100 mm by 200 mm for 10 by 10: the box is inside (10), covers (20), is stretched (10, 20).
        ('width="100mm" height="200mm" viewBox="0 0 10 10"', (10, 20, 30, 40)),
        ('width="100mm" height="200mm" viewBox="-5 3 10 10"', (10, 20, 30, 40)),
        ('width="100mm" height="200mm" viewBox="0 0 10 10" preserveAspectRatio="xMinYMin slice"',
         (20, 40, 60, 80)),
        ('width="100mm" height="200mm" viewBox="0 0 10 10" preserveAspectRatio="none"',
         (10, 40, 30, 80)),
    ],
)  # fmt: skip
def test_a_physical_size_gives_millimetres(attributes, expected):
    (shape,) = read(RECT, attributes)

    assert box(shape) == tuple(expected)


def test_a_tolerance_is_in_units_of_the_scene():
    """A drawing of 10 units in 1000 mm: a chord stays within 0.1 mm, 0.001 units."""
    (fine,) = read('<circle r="1"/>', 'width="1000mm" viewBox="0 0 10 10"')
    (coarse,) = read('<circle r="100"/>')

    assert len(fine.points) == len(coarse.points)


def test_written_drawings_have_a_size_and_keep_their_numbers(tmp_path):
    """0.1 is the double, which is what is written and read."""
    scene = Scene([Body("a", [(-7.3, 0.1), (5, 2), (1e-3, 40)]), Body("dot", [(300, -2)])])
    write_shapes(scene, tmp_path / "a.svg")

    text = (tmp_path / "a.svg").read_text()
    assert 'width="307.3mm"' in text
    assert read_shapes(tmp_path / "a.svg").at(0) == {
        name: [(Fraction(float(x)), Fraction(float(y))) for x, y in places]
        for name, places in scene.at(0).items()
    }


@every(
    "inside, attributes, expected",
    [
        # A symbol of 10 by 10 in 20 by 20 at (5, 5): twice as large.
        ((f'<symbol id="s" viewBox="0 0 10 10">{RECT}</symbol>'
         '<use href="#s" x="5" y="5" width="20" height="20"/>'), "", (7, 9, 6, 8)),
        # The same in 40 by 20, in the middle: 10 units of free width before it.
        ((f'<symbol id="s" viewBox="0 0 10 10">{RECT}</symbol>'
         '<use href="#s" width="40" height="20"/>'), "", (12, 4, 6, 8)),
        (f'<svg x="10" y="20" width="50" height="50">{RECT}</svg>', 'viewBox="0 0 99 99"',
         (11, 22, 3, 4)),
        (f'<svg x="10" width="50%" height="50%" viewBox="0 0 10 10">{RECT}</svg>',
         'viewBox="0 0 200 200"', (20, 20, 30, 40)),
        ('<rect x="10%" y="10%" width="50%" height="50%"/>', 'viewBox="0 0 200 100"',
         (20, 10, 100, 50)),
        ('<rect width="1in" height="72pt"/>', "", (0, 0, 96, 96)),
        (f"<style>rect {{transform: translate(5px, 0)}}</style>{RECT}", "", (6, 2, 3, 4)),
        (f"<style>#r {{width: 9px}} rect {{width: 7px}}</style>{RECT}", "", (1, 2, 9, 4)),
        (f"<style>rect {{width: 7px !important}} #r {{width: 9px}}</style>{RECT}", "",
         (1, 2, 7, 4)),
        (f'<style>.a {{display: none}}</style><g class="a b"><path d="M0 0h9"/></g>{RECT}', "",
         (1, 2, 3, 4)),
        (f'<g x="50" width="70" d="M0 0h9">{RECT}</g>', 'x="9" y="9"', (1, 2, 3, 4)),
        ((f'<switch><g requiredExtensions="a"><path d="M0 0h9"/></g>{RECT}<path d="M0 0h9"/>'
         "</switch>"), "", (1, 2, 3, 4)),
        (f'<g visibility="hidden"><path d="M0 0h9"/><g visibility="visible">{RECT}</g></g>', "",
         (1, 2, 3, 4)),
        ((f'<g clip-path="url(#c)">{RECT}</g><clipPath id="c"><rect width="9" height="9"/>'
         "</clipPath>"), "", (1, 2, 3, 4)),
        (f'<mask id="m"><path d="M0 0h9"/></mask><marker id="k"><path d="M0 0h9"/></marker>{RECT}',
         "", (1, 2, 3, 4)),
        (f'<g transform="rotate(90)">{RECT}</g>', "", (-6, 1, 4, 3)),
        ("<path style=\"d: path('M1 2h3v4h-3z')\"/>", "", (1, 2, 3, 4)),
    ],
)  # fmt: skip
def test_structure_is_resolved(inside, attributes, expected):
    (shape,) = read(inside, attributes)

    assert box(shape) == expected


@every(
    "inside, attributes, message",
    [
        (f'<g mask="url(#m)">{RECT}</g>', "", "g: mask: 'url.#m.' is not supported"),
        (f'<g clip-path="url(#c)">{RECT}</g><clipPath id="c"><circle r="9"/></clipPath>', "",
         "clip-path: only one rectangle"),
        ((f'<g clip-path="url(#c)">{RECT}</g><clipPath id="c"><rect width="2" height="9"/>'
         "</clipPath>"), "", "outline 'r' is not all inside of clip-path of g"),
        (f'<svg x="10" y="20" width="3" height="50">{RECT}</svg>', "",
         "outline 'r' is not all inside of svg, which cuts it"),
        ('<rect width="2em" height="1"/>', "", "rect: width: the unit 'em' has no size here"),
        ('<rect width="50%" height="1"/>', "", "'50%' of an unknown size; give a viewBox"),
        ('<rect width="calc(1px + 2px)" height="1"/>', "", "width: not a length"),
        (RECT, 'width="10ex" viewBox="0 0 1 1"', "svg: width: the unit 'ex' has no size"),
        (RECT, 'width="10mm" viewBox="0 0 1"', "viewBox: not four numbers"),
        (RECT, 'width="10mm" viewBox="0 0 0 1"', "viewBox: it has no size"),
        (RECT, 'width="0mm" viewBox="0 0 1 1"', "width: it has no size"),
        (RECT, 'width="1e-300mm" viewBox="0 0 1e300 1"', "no size for a viewBox"),
        (RECT, 'viewBox="0 0 1 1" preserveAspectRatio="middle"', "preserveAspectRatio: 'middle'"),
        (f'<g transform="rotate(9) warp(3)">{RECT}</g>', "", r"transform: 'warp\(3\)' is not"),
        (f'<g transform="rotate(9)" transform-origin="5 5">{RECT}</g>', "", "transform-origin"),
        (f'<g style="rotate: 9deg">{RECT}</g>', "", "g: rotate: '9deg' is not supported"),
        (f'<g style="animation-name: a">{RECT}</g>', "", "animation-name"),
        (f"<style>g > rect {{display: none}}</style>{RECT}".replace("g >", "g &gt;"), "",
         "the selector 'g > rect' with 'display'"),
        (f"<style>@media print {{rect {{display: none}}}}</style>{RECT}", "", "@media print"),
        (f"<style>@import 'a.css';</style>{RECT}", "", "@import"),
        ('<use href="#none"/>', "", "use: this file has no element '#none'"),
        ('<use href="other.svg#a"/>', "", "this file has no element 'other.svg#a'"),
        ('<rect width="1" height="1"><animate attributeName="x" to="9"/></rect>', "",
         "animate of 'x': a drawing that moves"),
        (f'{RECT}<defs><animate href="#r" attributeName="x" to="9"/></defs>', "",
         "animate of 'x': a drawing that moves"),
        (f'{RECT}<animateMotion path="M0 0h9"/>', "", "animateMotion: a drawing that moves"),
        ('<g systemLanguage="en"><path d="M0 0h9"/></g>', "", "systemLanguage is not supported"),
        ('<path d="M0 0h1v1z wobble"/>', "", "path: path data: 'wobble' is not understood"),
        ('<polygon points="0,0 1,1 2"/>', "", "polygon: points: an odd number"),
        ('<polygon points="0,0 1,1 2,x"/>', "", "polygon: points: 'x' is not understood"),
    ],
)  # fmt: skip
def test_what_changes_an_outline_and_is_not_understood_is_refused(inside, attributes, message):
    with pytest.raises(InputError, match=message) as refused:
        read(inside, attributes)

    assert "\n" not in str(refused.value)


@every(
    "inside",
    [
        '<rect height="4"/>',
        '<rect width="0" height="4"/>',
        '<rect width="auto" height="4"/>',
        "<circle/>",
        '<circle r="0"/>',
        "<ellipse/>",
        '<ellipse rx="0" ry="4"/>',
        "<path/>",
        '<path d="none"/>',
        '<polygon points=""/>',
    ],
)
def test_a_basic_shape_without_a_size_is_not_drawn(inside):
    """svgelements took 1 for a length that is not given."""
    assert read(inside) == []


@every(
    "inside, expected",
    [
        ('<ellipse rx="4"/>', (-4, -4, 8, 8)),
        ('<ellipse rx="auto" ry="4"/>', (-4, -4, 8, 8)),
        ('<ellipse cx="1" rx="4" ry="2"/>', (-3, -2, 8, 4)),
        ('<circle cy="3" r="2"/>', (-2, 1, 4, 4)),
        ('<line x2="5"/>', (0, 0, 5, 0)),
        ('<rect width="9" height="8" ry="2"/>', (0, 0, 9, 8)),
    ],
)
def test_lengths_that_are_not_given_are_those_of_the_standard(inside, expected):
    (shape,) = read(inside)

    assert [float(length) for length in box(shape)] == pytest.approx(expected)


@pytest.mark.parametrize(
    "inside", ['<rect width="3" height="-4"/>', '<circle r="-1"/>', '<ellipse rx="-1" ry="2"/>']
)
def test_negative_sizes_are_refused(inside):
    with pytest.raises(InputError, match="it is negative: -"):
        read(inside)


def test_style_sheets_of_other_files_are_refused():
    text = f'<?xml version="1.0"?><?xml-stylesheet href="a.css"?><svg>{RECT}</svg>'

    with pytest.raises(InputError, match="xml-stylesheet: style sheets of other files"):
        list(shapes_of(text, 0.1))


@every(
    "inside, lost",
    [
        (RECT, ()),
        (f"<style>g &gt; rect {{fill: red}}</style>{RECT}", ()),
        (f'<text>a</text><g display="none"><text>b</text></g><image href="a"/>{RECT}',
         ("text of 1 element", "image of 1 element")),
        ('<g stroke="red" stroke-width="3"><path d="M0 0h9"/><path d="M0 5h9"/></g>',
         ("stroke-width of 2 outlines",)),
        ('<path stroke-width="3" d="M0 0h9"/>', ()),
        ('<path marker-end="url(#m)" filter="url(#f)" d="M0 0h9"/>',
         ("filter of 1 element", "marker-end of 1 outline")),
        ('<foreignObject/><blob/><script>x</script><path d="M0 0h9"/>',
         ("foreignObject of 1 element", "blob of 1 element", "script of 1 element")),
        ('<rect width="1" height="1"><animate attributeName="fill" to="red"/></rect>', ()),
    ],
)  # fmt: skip
def test_drawn_content_that_is_no_outline_is_named(inside, lost):
    losses = Losses()
    read(inside, losses=losses)

    assert losses.texts() == lost
