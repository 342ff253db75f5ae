"""Films of runs that go on, and films as GIF and MP4."""

import io

import pytest
from render_scenes import small

from exactpt import Body, Bounce, BudgetExceeded, InputError, Scene, Simulation, Translation
from exactpt.kernel import budget
from exactpt.kernel.numbers import QQ
from exactpt.render import draw as draw_module
from exactpt.render import movie, raster
from exactpt.render.data import data_of
from exactpt.render.film import film_of
from exactpt.render.marked import film_of_run
from exactpt.render.movie import frames_of
from exactpt.render.png import png_of
from exactpt.render.svg import svg_of


def run(*, guest):
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2], [0, "1/3"]))
    walls = [Body("left", [(-1, -9), (-1, 9)]), Body("right", [(6, -9), (6, 9)])]
    simulation = Simulation(Scene([ball, *walls], time=(0, 9)), record=True)
    bounce = Bounce(fixed=["left", "right"])
    list(simulation.run(4, on_contact=bounce))
    if guest:
        simulation.add(Body("guest", [(3, 7), (4, 7), (4, 8)]))
        list(simulation.run(6, on_contact=bounce))
        simulation.remove("guest")
    list(simulation.run(on_contact=bounce))
    return simulation


def test_the_film_of_a_run_goes_on_after_contacts():
    simulation = run(guest=False)
    film = film_of_run(simulation.history())
    plain = film_of(simulation.history().scene())

    assert film.end == 9
    assert film.contact is None
    times = [step.time for step in film.steps]
    assert times == sorted(set(times))
    reported = [c.words for step in film.steps for c in step.changes if c.words]
    assert reported.count("a new motion for ball") == reported.count(
        "ball and right come into contact"
    ) + (reported.count("ball and left come into contact"))
    # The same edges and tiles are there at the same times.
    for mine, its in ((film.edges, plain.edges), (film.tiles, plain.tiles)):
        assert [when(film, s) for s in mine] == [when(plain, s) for s in its]
    assert film.edges


def when(film, span):
    number = [None, *(step.time for step in film.steps)]
    return number[span.first], None if span.last is None else number[span.last]


def test_bodies_that_come_and_go_are_there_in_between():
    film = film_of_run(run(guest=True).history())
    data = data_of(film)

    assert [film.is_there(3, t) for t in (QQ(3), QQ(4), QQ(5), QQ(6))] == [False, True, True, False]
    assert [film.is_there(0, t) for t in (QQ(0), QQ(9))] == [True, True]
    assert data["bodies"][3][0] == "guest"
    assert None not in data["bodies"][3][6:]
    assert data["bodies"][0][7] is None
    frames = list(frames_of(film, 9))
    assert [len(frame.shapes) for frame in frames] == [3, 3, 3, 3, 4, 4, 3, 3, 3, 3]


def test_frames_are_those_of_the_film():
    film = film_of(small())
    *before, last = frames_of(film, 10)

    assert len(before) == 10
    assert {frame.window for frame in before} == {last.window}
    assert last.marks
    assert not any(frame.marks for frame in before)
    assert all(frame.tiles and frame.lines for frame in before)


@pytest.mark.long
@pytest.mark.parametrize("ending, start", [(".gif", b"GIF89a"), (".mp4", b"ftyp")])
def test_a_film_as_a_file(tmp_path, ending, start):
    pil = pytest.importorskip("PIL.Image")
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    path, reported = tmp_path / f"film{ending}", []

    film = film_of(small())
    movie.write_movie(film, path, seconds=1, done=lambda k, count: reported.append((k, count)))

    assert reported == [(k, 21) for k in range(1, 22)]

    data = path.read_bytes()
    assert data.startswith(start) or data[4:8] == start
    if ending == ".gif":
        with pil.open(path) as made:
            assert made.n_frames == movie.RATE + 1  # the last one is shown for longer
            first = made.convert("RGB").tobytes()
            made.seek(movie.RATE)
            assert made.convert("RGB").tobytes() != first
    else:
        assert ffmpeg.count_frames_and_secs(path) == (40, 2.0)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("fps", [20, 30, 60])
def test_bug_a_gif_of_30_frames_in_a_second_was_shorter_than_its_seconds(tmp_path, fps):
    """Every frame had the same number of hundredths of a second, rounded down."""
    pil = pytest.importorskip("PIL.Image")
    images = [pil.new("RGB", (8, 8), (k, 255 - k, 0)) for k in range(fps + 1)]

    movie._write_gif(images, images, tmp_path / "film.gif", fps)

    with pil.open(tmp_path / "film.gif") as film:
        shown = []
        for k in range(film.n_frames):
            film.seek(k)
            shown.append(film.info["duration"])
    assert sum(shown) == 2000
    assert max(shown[:-1]) - min(shown[:-1]) <= 10


def test_a_gif_that_stores_changes_alone_shows_every_pixel(tmp_path):
    pil = pytest.importorskip("PIL.Image")
    images = [pil.new("RGB", (40, 30), "white") for _ in range(6)]
    for k, image in enumerate(images):
        image.paste((200, 40 * (k // 2), 0), (3 * k, 2, 3 * k + 9, 20))

    movie._write_gif(iter(images), images, tmp_path / "film.gif", 20)

    with pil.open(tmp_path / "film.gif") as film:
        assert film.n_frames == len(images)
        for k, image in enumerate(images):
            film.seek(k)
            assert film.convert("RGB").tobytes() == image.tobytes()


@pytest.mark.long
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_frames_of_a_film_look_like_their_svg_pictures(theme):
    """One pixel in 250 differs by three eighths of the scale: edges have other half-tones."""
    pytest.importorskip("resvg_py")
    pil, chops = pytest.importorskip("PIL.Image"), pytest.importorskip("PIL.ImageChops")
    bodies = [
        Body("holed", [(0, 0), (9, 0), (9, 9), (0, 9)], holes=[[(2, 2), (2, 7), (7, 7), (7, 2)]]),
        Body("round", [(12, 1), (15, 1), (13, 3)], radius="1/2"),
        Body("disc", [(13, 7)], radius=1),
        Body("point", [(17, 8)]),
        Body("chain", [(17, 0), (18, 3), (17, 5)], closed=False),
        Body("inside", [(4, 4), (5, 4), (5, 5)], Translation([0, 1], [0])),
    ]
    scene = Scene(bodies, time=(0, 9))
    films = [film_of(scene), film_of(Scene(b for b in bodies if not b.radius))]
    for film in films:
        *_, frame = frames_of(film, 4)
        image = raster.image_of(frame, theme)
        png = png_of(svg_of(frame, theme=theme), zoom=1)
        below = (0, 60, *image.size)  # the captions have other fonts
        with pil.open(io.BytesIO(png)) as other:
            apart = chops.difference(image.crop(below), other.convert("RGB").crop(below))
        assert sum(apart.convert("L").histogram()[96:]) < image.width * image.height / 250


@pytest.mark.parametrize("options", [{"seconds": 0}, {"fps": 0}, {"fps": 2.5}, {"seconds": 10**5}])
def test_films_without_frames_are_refused(tmp_path, options):
    with pytest.raises(InputError, match="a film has from 1 to 100000 frames"):
        small().draw(tmp_path / "film.gif", **options)


@pytest.mark.parametrize("ending", [".gif", ".mp4"])
def test_bug_the_frames_of_a_film_had_no_time_limit(tmp_path, ending):
    pytest.importorskip("imageio_ffmpeg")
    reported = []

    def done(k, count):
        reported.append((k, count))
        budget._LIMITS.look = budget._LIMITS.deadline = 0.0

    with pytest.raises(BudgetExceeded, match="time limit exceeded"):
        draw_module.draw(small(), tmp_path / f"x{ending}", max_seconds=1000, done=done)
    assert reported == [(1, 161)]
    assert list(tmp_path.iterdir()) == []


def test_a_run_as_a_page_and_as_a_picture(tmp_path):
    simulation = run(guest=True)
    simulation.draw(tmp_path / "run.html")
    simulation.draw(tmp_path / "now.svg")

    assert "ball and right come into contact" in (tmp_path / "run.html").read_text(encoding="utf-8")
    assert "guest" not in (tmp_path / "now.svg").read_text(encoding="utf-8")
    with pytest.raises(InputError, match="ends in one of"):
        simulation.draw(tmp_path / "run.txt")
    with pytest.raises(InputError, match="record=True"):
        Simulation(small()).draw(tmp_path / "other.html")
    with pytest.raises(InputError, match="seconds and fps are for a film"):
        simulation.draw(tmp_path / "run.html", fps=5)


def test_a_film_of_a_run_has_the_length_that_is_given(tmp_path):
    image = pytest.importorskip("PIL.Image")
    run(guest=False).draw(tmp_path / "run.gif", seconds="1/2", fps=10)
    with image.open(tmp_path / "run.gif") as film:
        assert film.n_frames == 6


def test_without_pillow(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "PIL", None)
    with pytest.raises(InputError, match=r"pip install 'exactpt\[film\]'"):
        small().draw(tmp_path / "film.gif")
    with pytest.raises(InputError, match="a film has all times"):
        draw_module.draw(small(), tmp_path / "film.gif", at=QQ(0))
    assert list(tmp_path.iterdir()) == []


def test_notebooks_get_the_player():
    assert 'srcdoc="&lt;!DOCTYPE html' in small()._repr_html_()
    assert "new motion for ball" in run(guest=False)._repr_html_()
    assert Simulation(small())._repr_html_() is None
    assert Simulation(small(), record=True)._repr_html_() is None
