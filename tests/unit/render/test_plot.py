"""The distance of two bodies as a plot: the curve, its minimum, its ruler."""

import re
from xml.etree import ElementTree

import pytest
from commands import code_of, run
from render_scenes import small

from exactpt import Body, Scene, Translation, clearance
from exactpt.kernel.numbers import QQ
from exactpt.render.film import film_of
from exactpt.render.page import page_of
from exactpt.render.plot import plot_of, strip_of, svg_of_plot

PIER = Body("pier", [(0, 0), (2, 0), (2, 2), (0, 2)])
NAME = 'ship <b> & "x"\x01'


def passing(time=(0, 20)):
    ship = Body(NAME, [(-9, 3), (-7, 3), (-8, 4)], Translation([0, 1], [0, "1/3", "-1/40"]))
    return clearance(Scene([ship, PIER], time), NAME, "pier")


def test_the_curve_is_the_distance_at_its_samples():
    gap = passing()
    plot = plot_of(gap)

    assert plot.points[0][0] == 0
    assert plot.points[-1][0] == 1
    assert [x for x, _ in plot.points] == sorted(x for x, _ in plot.points)
    for x, y in plot.points:
        assert y * plot.top == pytest.approx(gap(QQ(20) * QQ(*x.as_integer_ratio())), abs=1e-9)
    assert max(y for _, y in plot.points) == 1
    assert plot.least[1] == min(y for _, y in plot.points)
    assert plot.least[0] * 20 == pytest.approx(float(gap.minimum.time))
    assert plot.words == "least 1.6014 at t ≈ 11.36632"


@pytest.mark.parametrize(
    "time, texts",
    [
        ((0, 20), [str(2 * k) for k in range(11)]),
        ((-3, 4), [str(k) for k in range(-3, 5)]),
        (("1/3", "1/2"), ["0.34", "0.36", "0.38", "0.4", "0.42", "0.44", "0.46", "0.48", "0.5"]),
        ((10**12, 10**12 + 20), None),
        ((0, "1e-400"), None),
        ((0, "1e400"), None),
    ],
)
def test_the_times_on_the_ruler(time, texts):
    ticks = plot_of(clearance(Scene([Body("a", [(0, 0)]), PIER], time), "a", "pier")).ticks

    assert 4 <= len(ticks) <= 11
    assert texts is None or [text for _, text in ticks] == texts
    assert all(0 <= share <= 1 for share, _ in ticks)


def test_bodies_that_meet_for_ever():
    plot = plot_of(clearance(Scene([Body("a", [(1, 1)]), PIER]), "a", "pier"))

    assert (plot.top, plot.least, plot.words) == (0, (0, 0), "least 0 at t = 0")
    assert {y for _, y in plot.points} == {0}


@pytest.mark.parametrize("theme", ["auto", "light", "dark"])
def test_the_document_is_well_formed(theme):
    root = ElementTree.fromstring(svg_of_plot(plot_of(passing()), theme=theme))
    texts = [node.text for node in root.iter("{http://www.w3.org/2000/svg}text")]

    assert texts[:2] == [
        'distance of ship <b> & "x"\ufffd and pier',
        "least 1.6014 at t ≈ 11.36632",
    ]
    assert texts[-2:] == ["20", "t"]
    circle = root.find("{http://www.w3.org/2000/svg}circle")
    curve = root.find("{http://www.w3.org/2000/svg}polyline").get("points").split()
    lowest = max(curve, key=lambda p: float(p.split(",")[1]))
    assert (circle.get("cx"), circle.get("cy")) == tuple(lowest.split(","))


def test_a_page_has_it_above_the_scrubber():
    scene = Scene([Body("ship", [(-9, 3), (-7, 3), (-8, 4)], Translation([0, 1])), PIER], (0, 20))
    film = film_of(scene)
    with_plot = page_of(film, gap=clearance(scene, "ship", "pier"))
    without = page_of(film)

    assert '<div class="scrub plotted">' in with_plot
    figure = re.search("<figure.*</figure>", with_plot).group()
    ElementTree.fromstring(figure)
    assert "<b>least 1 at t = 7</b>" in figure
    assert '<i id="now"></i>' in figure
    assert "<figure" not in without
    assert "<b>" not in strip_of(plot_of(passing())).replace("<b>least", "")


@pytest.fixture
def scene(tmp_path):
    small().save(tmp_path / "scene.json")
    return tmp_path / "scene.json"


@pytest.mark.parametrize("ending", ["svg", "png", "html"])
def test_on_the_command_line(scene, ending):
    if ending == "png":
        pytest.importorskip("resvg_py")
    names = ",".join(body.name for body in small().bodies[:2])
    path = scene.with_name(f"gap.{ending}")

    assert run("draw", scene, "--clearance", names, "-o", path).exit_code == 0
    data = path.read_bytes()
    assert data.startswith({"svg": b"<svg", "png": b"\x89PNG", "html": b"<!DOCTYPE"}[ending])
    if ending == "html":  # up to the contact, where the animation ends
        assert "least 0 at t = 3<" in data.decode()


@pytest.mark.parametrize("ending", ["svg", "html"])
def test_a_distance_is_marked_in_pictures_and_in_pages(scene, ending):
    """A page had no mark."""
    names = ",".join(body.name for body in small().bodies[:2])
    path = scene.with_name(f"gap.{ending}")

    assert run("draw", scene, "--clearance", names, "--below", "999/2", "-o", path).exit_code == 0
    drawn = path.read_text(encoding="utf-8")
    assert drawn.count('class="below"') == drawn.count(">499.5<") == 1


def test_a_negative_distance_is_not_marked(scene, capsys):
    names = ",".join(body.name for body in small().bodies[:2])
    path = scene.with_name("gap.html")

    assert code_of("draw", scene, "--clearance", names, "--below", "-1/2", "-o", path) == 2
    assert "below: a distance is not negative: -1/2" in capsys.readouterr().err
    assert not path.exists()


def test_a_page_of_bodies_that_touch_at_the_start(tmp_path):
    """The animation ends there; the plot shows the whole time span."""
    path = tmp_path / "scene.json"
    Scene([Body("a", [(2, 1)], Translation([0, 1])), PIER], (0, 8)).save(path)

    assert run("draw", path, "--clearance", "a,pier", "-o", tmp_path / "x.html").exit_code == 0
    page = (tmp_path / "x.html").read_text(encoding="utf-8")
    assert "up to 8" in page
    assert "least 0 at t = 0" in page


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["--clearance", "box", "-o", "x.html"], "--clearance: not the names of two bodies"),
        (["--clearance", "a,nobody", "-o", "x.html"], "--clearance: there is no body"),
        (["--below", "1", "-o", "x.svg"], "below: 1 is for a plot of the clearance"),
        (["--clearance", "a,b", "--at", "1", "-o", "x.svg"], "--at: a plot of the clearance"),
    ],
)
def test_wrong_plots(scene, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(scene.parent)
    assert code_of("draw", scene, *arguments) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1
    assert not list(scene.parent.glob("x.*"))


def test_marks_on_the_axis_and_a_threshold():
    plot = plot_of(passing(), QQ(5, 2))
    document = svg_of_plot(plot)

    assert plot.heights[0] == (0.0, "0")
    assert len(plot.heights) > 3
    assert plot.below == (2.5 / plot.top, "2.5")
    assert document.count('class="below"') == 1
    high = plot_of(passing(), QQ(1000))
    assert (high.top, high.below[0]) == (1000.0, 1.0)
