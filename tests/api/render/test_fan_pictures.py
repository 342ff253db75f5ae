"""The fan triangulation in pictures, animations and films: its edges are dashed."""

from itertools import pairwise

import pytest
from commands import code_of
from passing_points import pair, passing

from exactpt import Body, InputError, Scene, Simulation
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.render.film import film_of
from exactpt.testing.scenes import POINTS, generate


@pytest.mark.parametrize("ending", ["svg", "png", "html", "gif"])
def test_fan_of_bodies_that_are_not_points_is_refused_and_nothing_written(tmp_path, capsys, ending):
    Scene([Body("box", [(0, 0), (2, 0), (2, 1)])], (0, 1)).save(tmp_path / "scene.json")
    picture = tmp_path / f"fan.{ending}"
    assert code_of("draw", tmp_path / "scene.json", "--fan", "-o", picture) == 2
    assert capsys.readouterr().err == (
        "exactpt: fan: only points have a fan triangulation, got body 'box' with 3 vertices; "
        "leave the fan out\n"
    )
    assert not picture.exists()


def test_fan_without_a_tiling_or_beside_a_plot_is_refused(tmp_path):
    with pytest.raises(InputError, match="is for a picture with a tiling"):
        passing().draw(tmp_path / "x.svg", tiling=None, fan=True)
    with pytest.raises(InputError, match="is for a picture with a tiling"):
        passing().draw(tmp_path / "x.svg", gap=("p", "q"), fan=True)


def test_picture_has_the_edges_of_the_fan_dashed(tmp_path):
    """At the start: mp and nq."""
    scene = passing()
    scene.draw(tmp_path / "plain.svg")
    scene.draw(tmp_path / "fan.svg", fan=True)
    plain, text = ((tmp_path / f"{name}.svg").read_text() for name in ("plain", "fan"))
    assert text.count('<line class="fan"') == 2
    assert "stroke-dasharray" in text
    assert "2 edges of the fan" in text
    assert "fan" not in plain
    simulation = Simulation(scene, fan=True)
    simulation.draw(tmp_path / "run.svg")
    assert (tmp_path / "run.svg").read_text() == text
    assert simulation._repr_svg_() == text


def test_film_has_each_edge_of_the_fan_for_its_time():
    """Derived in `test_fan`: nq always; mq instead of mp between the two steps."""
    film = film_of(passing(), fan=True)
    names = [body.name for body in film.scene.bodies]
    spans = [
        (pair((names[edge.u], names[edge.v])), edge.first, edge.last)
        for edge in film.edges
        if edge.kind == "fan"
    ]
    assert sorted(spans, key=str) == [
        ("mp", 0, 1),
        ("mp", 2, None),
        ("mq", 1, 2),
        ("nq", 0, None),
    ]


@pytest.mark.parametrize("family", sorted(POINTS))
def test_film_shows_the_fan_of_the_snapshot_between_steps(family):
    scene = generate(family, 2)
    film = film_of(scene, fan=True)
    if not film.tiles:
        return
    times = [AlgebraicNumber(scene.start), *(step.time for step in film.steps)]
    simulation = Simulation(scene)
    for step, (before, after) in enumerate(pairwise(times)):
        if before == after:
            continue
        for _ in simulation.run(rational_between(before, after)):
            pass
        shown = {
            (edge.u, edge.v)
            for edge in film.edges
            if edge.kind == "fan" and edge.first <= step and (edge.last is None or step < edge.last)
        }
        assert shown == set(simulation.tiling.fan)


def test_recorded_run_is_drawn_with_its_fan(tmp_path):
    simulation = Simulation(passing(), fan=True, record=True)
    list(simulation.run())
    simulation.draw(tmp_path / "run.html")
    assert '"fan",0,1]' in (tmp_path / "run.html").read_text()
    assert "&quot;fan&quot;,0,1]" in simulation._repr_html_()


def test_film_of_images_has_the_fan():
    """Pixels whose green and blue are far above their red: the dashes of mp and nq."""
    pytest.importorskip("PIL")
    from exactpt.render.movie import frames_of
    from exactpt.render.raster import image_of

    def teal(fan):
        frame = next(iter(frames_of(film_of(passing(), fan=fan), 1)))
        colours = image_of(frame, "light").getcolors(1 << 24)
        return sum(count for count, (r, g, b) in colours if min(g, b) > r + 60)

    assert teal(fan=True) > teal(fan=False) + 100
