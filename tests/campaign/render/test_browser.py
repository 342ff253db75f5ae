"""The animation in a real browser: Debian's Chromium, headless."""

import math
import time
from itertools import accumulate
from pathlib import Path

import pytest
from render_scenes import demo, small

from exactpt import AlgebraicNumber, Body, Bounce, Scene, Simulation, Translation, clearance
from exactpt.certificates.one_sided import OneSided
from exactpt.kernel.numbers import QQ, ZZ, nearest_float, power_of_two
from exactpt.kernel.roots import roots_after
from exactpt.pseudotriangulation.shadow import shadow
from exactpt.render.canvas import frame_of
from exactpt.render.film import film_of
from exactpt.render.fixed import near
from exactpt.render.page import page_of
from exactpt.render.palette import body_colour
from exactpt.render.still import still
from exactpt.testing.scenes import generate

pytestmark = pytest.mark.browser

WebDriverWait = pytest.importorskip("selenium.webdriver.support.ui").WebDriverWait
ActionChains = pytest.importorskip(
    "selenium.webdriver", reason="selenium is not installed"
).ActionChains


@pytest.fixture
def page(browser, tmp_path_factory):
    """The demo, freshly loaded; it must not have said anything on the console in the end."""
    path = tmp_path_factory.mktemp("page") / "demo.html"
    path.write_text(page_of(film_of(demo())), encoding="utf-8")
    browser.get(path.as_uri())
    yield browser
    assert browser.get_log("browser") == []


def state(page):
    return page.execute_script("return exactpt.state()")


def click(page, name):
    page.find_element("id", name).click()
    return state(page)


def press(page, key):
    page.find_element("tag name", "body").send_keys(key)
    return state(page)


def pressed(page, name):
    return page.find_element("id", name).get_attribute("aria-pressed") == "true"


def test_it_loads_at_the_start(page):
    shown = state(page)
    assert shown["time"] == "0"
    assert shown["step"] == 0
    assert not shown["isPlaying"]
    assert page.title == "exactpt"
    assert "vertex 0 of boat on edge 6 of harbour" in page.find_element("id", "contact").text


def test_play_and_pause(page):
    assert click(page, "play")["isPlaying"]
    time.sleep(0.6)
    later = click(page, "play")
    assert not later["isPlaying"]
    assert 0 < float(later["time"]) < 8
    assert state(page)["time"] == later["time"]


def test_playing_ends_at_the_contact(page):
    page.execute_script("exactpt.seek('86/10')")
    click(page, "play")
    time.sleep(0.6)
    shown = state(page)
    assert not shown["isPlaying"]
    assert shown["time"].startswith("8.6938795804043")
    clock = page.find_element("class name", "clock").text
    assert "first contact: vertex 0 of boat on edge 6 of harbour" in clock


def test_stepping(page):
    film = film_of(demo())
    assert click(page, "next")["step"] == 1
    assert click(page, "next")["step"] == 2
    shown = press(page, "\ue014")  # arrow right
    assert shown["step"] == 3
    assert float(shown["time"]) == pytest.approx(float(film.steps[2].time), abs=1e-15)
    assert click(page, "previous")["step"] == 2
    assert press(page, "\ue010")["step"] == len(film.steps)  # end
    assert press(page, "\ue011")["step"] == 0  # home
    page.find_elements("class name", "row")[3].click()
    assert state(page)["step"] == 4


def test_scrubbing_and_speed(page):
    page.execute_script(
        "const scrub = document.getElementById('scrub'); scrub.value = 0.5;"
        "scrub.dispatchEvent(new Event('input'));"
    )
    assert float(state(page)["time"]) == pytest.approx(8.693879580404362 / 2, rel=1e-12)
    page.execute_script(
        "const speed = document.getElementById('speed'); speed.value = '0.001';"
        "speed.dispatchEvent(new Event('change'));"
    )
    before = float(click(page, "play")["time"])
    time.sleep(0.4)
    assert 0 < float(click(page, "play")["time"]) - before < 0.01


@pytest.mark.parametrize("layer", ["tiles", "edges", "bridges", "shadows", "next", "names"])
def test_layers(page, layer):
    was_on = layer not in {"bridges", "shadows"}
    assert pressed(page, f"layer-{layer}") == was_on
    before = pixels(page)
    click(page, f"layer-{layer}")
    assert pressed(page, f"layer-{layer}") != was_on
    assert pixels(page) != before


def test_layers_by_keys(page):
    for key, layer in {"d": "edges", "b": "bridges", "s": "shadows", "x": "next"}.items():
        before = pressed(page, f"layer-{layer}")
        press(page, key)
        assert pressed(page, f"layer-{layer}") != before


@pytest.mark.parametrize("at", [QQ(0), QQ(1, 3), QQ(11, 7)])
def test_shadow_edges_are_those_of_the_engine(browser, tmp_path, at):
    """Of polygons; a point or segment is thin in the engine, and has shadows of its own there."""
    scene = generate("stars", 6)
    path = tmp_path / "stars.html"
    path.write_text(page_of(film_of(scene, tiling="greedy"), at=at), encoding="utf-8")
    simulation = Simulation(scene, tiling="greedy")
    for _ in simulation.run(at):
        pass
    kinetic = simulation.kinetic
    after = OneSided(kinetic.certifier, before=False)
    first = list(accumulate((body.size for body in scene.bodies), initial=0))
    node = [first[v.body] + v.index for v in kinetic.vertices.all]
    mesh = kinetic.mesh
    expected = {}
    for h in mesh.flippable():
        visits = shadow(mesh, h, after)
        edge = tuple(sorted(node[v] for v in mesh.ends(h)))
        expected[edge] = sorted(node[mesh.map.origin[g]] for g in visits)

    browser.get(path.as_uri())
    state(browser)
    found = {
        (u, v): sorted(browser.execute_script("return exactpt.shadow(...arguments)", u, v))
        for u, v in expected
    }

    assert len(expected) > 10
    assert found == expected
    assert browser.get_log("browser") == []


def test_a_hull_edge_has_no_shadow(page):
    u, v, _ = next(edge for edge in state(page)["edges"] if edge[2] != "diagonal")
    assert page.execute_script("return exactpt.shadow(...arguments)", u, v) is None


def pixels(page):
    return page.execute_script("return document.getElementById('canvas').toDataURL()")


def test_zoom_and_pan(page):
    before = state(page)["camera"]
    assert click(page, "closer")["camera"]["scale"] == pytest.approx(1.6 * before["scale"])
    assert click(page, "wider")["camera"]["scale"] == pytest.approx(before["scale"])
    canvas = page.find_element("id", "canvas")
    actions = ActionChains(page)
    actions.drag_and_drop_by_offset(canvas, 100, 50).perform()
    shown = state(page)
    old, new = (shown_x(camera) for camera in (before, shown["camera"]))
    assert old - new == pytest.approx(100 / before["scale"], rel=1e-9)
    click(page, "fit")
    time.sleep(1.2)
    assert state(page)["camera"] == before


def shown_x(camera):
    return float(QQ(int(camera["place"][0])) * power_of_two(-192))


def test_hover_tells_names_and_places(page):
    click(page, "next")
    x, y = state(page)["pixels"][10]  # the bow of the boat
    canvas = page.find_element("id", "canvas")
    size = canvas.size
    ActionChains(page).move_to_element_with_offset(
        canvas, round(x - size["width"] / 2), round(y - size["height"] / 2)
    ).perform()
    tip = page.find_element("id", "tip")
    assert tip.is_displayed()
    assert tip.text.splitlines()[0] == "boat:0"
    assert tip.text.splitlines()[1].startswith("x = 3.")


def test_bug_the_canvas_was_empty_until_the_frame_after_a_resize(page):
    size, box = page.get_window_size(), page.find_element("id", "canvas")
    page.execute_script("requestAnimationFrame = () => 0;")
    before = box.size
    try:
        page.set_window_size(size["width"] - 90, size["height"] - 60)
        WebDriverWait(page, 10).until(lambda _: box.size != before)
        assert page.execute_script("""
            const box = document.getElementById("canvas"), pen = box.getContext("2d");
            return pen.getImageData(0, 0, box.width, box.height).data.some((v) => v);
        """)
    finally:
        page.set_window_size(size["width"], size["height"])


def test_light_and_dark(page):
    before = pixels(page)
    click(page, "theme")
    assert pixels(page) != before
    assert page.execute_script("return document.documentElement.dataset.theme") in {"light", "dark"}


@pytest.mark.parametrize("width, height", [(390, 844), (844, 390)])
def test_it_fits_a_phone(page, width, height):
    emulated = {"width": width, "height": height, "deviceScaleFactor": 2, "mobile": True}
    page.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", emulated)
    page.refresh()
    wide = page.execute_script(
        "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    boxes = [
        page.execute_script(
            "return document.querySelector(arguments[0]).getBoundingClientRect().toJSON()", name
        )
        for name in (".clock", ".layers")
    ]
    page.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert wide[0] <= wide[1]
    assert boxes[0]["bottom"] <= boxes[1]["top"]


def test_discs_are_drawn_in_a_frame_of_little_height(browser, tmp_path):
    path = tmp_path / "discs.html"
    discs = Scene([Body("a", [(0, 0)], radius=1), Body("b", [(0, 3)], radius=1)], time=(0, 1))
    path.write_text(page_of(film_of(discs)), encoding="utf-8")
    emulated = {"width": 1280, "height": 150, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", emulated)
    browser.get(path.as_uri())
    shown = state(browser)
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    below, above = (shown["pixels"][i][1] for i in range(2))
    assert below > above
    assert browser.get_log("browser") == []


@pytest.mark.parametrize("at", ["0", "5/2", "31/7", "8", "contact"])
def test_the_picture_at_a_time_is_the_svg_of_that_time(page, at):
    if at == "contact":
        shown = page.execute_script(
            "exactpt.goTo(exactpt.film.steps.length); return exactpt.state()"
        )
        picture = still(demo(), None)
    else:
        shown = page.execute_script("exactpt.seek(arguments[0]); return exactpt.state()", at)
        picture = still(demo(), QQ(at))
    frame = frame_of(picture)
    svg = [pixel for shape in frame.shapes for pixel in shape.pixels]
    canvas = shown["pixels"]
    # Both are the plane, scaled and moved; the canvas by this much from the SVG.
    unit = QQ(2) ** page.execute_script("return exactpt.film.lengthUnit")
    scale = shown["camera"]["scale"] / float(unit * frame.window.scale)
    dx, dy = canvas[0][0] - scale * svg[0][0], canvas[0][1] - scale * svg[0][1]
    for (x, y), (u, v) in zip(svg, canvas, strict=True):
        assert (scale * x + dx, scale * y + dy) == pytest.approx((u, v), abs=1e-6)
    tiles = [
        tuple(nodes)
        for nodes, inside in zip(shown["tiles"], insides(page), strict=True)
        if (not inside)
    ]
    assert {frozenset(t) for t in tiles} == {frozenset(f.nodes) for f in picture.tiling.faces}
    edges = {(u, v) for u, v, _ in shown["edges"]}
    assert edges == {(e.u, e.v) for e in picture.tiling.edges if e.hull or e.kind == "diagonal"}


def insides(page):
    return page.execute_script(
        "return exactpt.film.after(exactpt.state().step).tiles.map((tile) => tile.inside)"
    )


def test_colours_are_where_the_bodies_are(page):
    page.execute_script(
        "for (const k of ['names', 'next', 'edges']) "
        "document.getElementById(`layer-${k}`).click(); exactpt.seek('5/2')"
    )
    shown = state(page)["pixels"]
    frame = frame_of(still(demo(), QQ(5, 2)))
    first = 0
    for shape in frame.shapes:
        own = shown[first : first + len(shape.pixels)]
        first += len(shape.pixels)
        if shape.name in {"boat", "buoy", "wheel", "ball", "raft"}:
            x, y = (sum(c) / len(own) for c in zip(*own, strict=True))
            assert colour(page, x, y) == shape.colour


def colour(page, x, y):
    """The colour of the canvas at a pixel."""
    found = page.execute_script(
        """
        const [x, y] = arguments;
        const one = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
        one.drawImage(document.getElementById("canvas"),
          x * devicePixelRatio, y * devicePixelRatio, 1, 1, 0, 0, 1, 1);
        return [...one.getImageData(0, 0, 1, 1).data];
        """,
        x,
        y,
    )
    return "#" + "".join(f"{c:02x}" for c in found[:3])


@pytest.mark.parametrize("digits", [10, 40, 100])
def test_zoomed_in_near_the_contact_it_stays_true(page, digits):
    """The gap between the bow and the quay, 2**-digits before the contact, in pixels."""
    scene = demo()
    simulation = Simulation(scene)
    contact = simulation.run_to_contact()
    at = near(contact.time, QQ(10)) - power_of_two(-digits)
    places = [place for body in scene.bodies for place in body.at(at)]
    bow, a, b = places[10], places[6], places[7]
    dx, dy = b[0] - a[0], b[1] - a[1]
    cross = dx * (bow[1] - a[1]) - dy * (bow[0] - a[0])
    gap = abs(nearest_float(cross * power_of_two(digits))) / math.hypot(float(dx), float(dy))
    magnification = 2.0 ** (digits - 3)
    page.execute_script(
        "exactpt.seek(arguments[0]); exactpt.look(arguments[1], arguments[2])",
        str(at),
        [str(c) for c in bow],
        magnification,
    )
    shown = state(page)
    unit = 2.0 ** page.execute_script("return exactpt.film.lengthUnit")
    expected = gap * shown["camera"]["scale"] / unit * 2.0**-digits
    (x1, y1), (x2, y2) = page.execute_script("return exactpt.segment(6, 7)")
    x, y = shown["pixels"][10]
    found = abs((x2 - x1) * (y - y1) - (y2 - y1) * (x - x1)) / math.hypot(x2 - x1, y2 - y1)
    assert 1 < expected < 1000
    assert found == pytest.approx(expected, abs=0.01)


def test_the_plot_of_a_clearance_follows_the_time(browser, tmp_path):
    """The cursor is above the thumb of the scrubber, and the minimum above its time."""
    scene = generate("convex", 0)
    names = [body.name for body in scene.bodies[:2]]
    film = film_of(scene)
    path = tmp_path / "gap.html"
    path.write_text(page_of(film, gap=clearance(scene, *names)), encoding="utf-8")
    browser.get(path.as_uri())
    share = 0.25
    at = scene.start + (near(film.end, QQ(100)) - scene.exact_start) / 4
    browser.execute_script("exactpt.seek(arguments[0]); exactpt.state()", str(at))

    left = browser.execute_script("return document.getElementById('now').style.left")
    assert float(left.rstrip("%")) == pytest.approx(100 * share, abs=0.1)
    plot, ruler = (
        browser.execute_script(f"return document.querySelector('{q}').getBoundingClientRect()")
        for q in (".gap", "#ticks")
    )
    assert plot["left"] == pytest.approx(ruler["left"], abs=2)
    assert plot["bottom"] < ruler["top"]
    assert browser.get_log("browser") == []


def test_a_hole_is_not_filled(browser, tmp_path):
    """In the hole there is the colour of the paper, and no body under the pointer."""
    hole = [(1, 1), (9, 1), (9, 9), (1, 9)]
    frame = Body("frame", [(0, 0), (10, 0), (10, 10), (0, 10)], holes=[hole])
    path = tmp_path / "frame.html"
    path.write_text(page_of(film_of(Scene([frame])), title="frame"), encoding="utf-8")
    browser.get(path.as_uri())
    browser.execute_script("document.getElementById('layer-names').click()")
    corners = state(browser)["pixels"]
    middles = [[(corners[u][k] + corners[v][k]) / 2 for k in (0, 1)] for u, v in ((0, 2), (0, 4))]
    in_hole, in_body = (colour(browser, *middle) for middle in middles)
    assert in_body == body_colour(0) != in_hole
    assert browser.get_log("browser") == []


def test_a_disc_is_drawn_and_told_of(browser, tmp_path):
    scene = Scene(
        [Body("disc", [(0, 0)], radius=2), Body("bar", [(5, 0), (9, 0)], radius=1)], (0, 1)
    )
    path = tmp_path / "disc.html"
    path.write_text(page_of(film_of(scene)), encoding="utf-8")
    browser.get(path.as_uri())
    x, y = state(browser)["pixels"][0]
    assert colour(browser, x + 20, y) == body_colour(0)
    hover(browser, x + 20, y + 20)
    assert browser.find_element("id", "tip").text.splitlines() == ["disc", "point, rounded"]
    assert browser.get_log("browser") == []


def hover(page, x, y):
    canvas = page.find_element("id", "canvas")
    size = canvas.size
    ActionChains(page).move_to_element_with_offset(
        canvas, round(x - size["width"] / 2), round(y - size["height"] / 2)
    ).perform()


@pytest.mark.parametrize("at", [QQ(0), QQ(4), QQ(31, 7)])
def test_the_certificates_of_a_tile_have_the_roots_of_the_engine(page, at):
    """The polynomials computed again from the positions, and their roots by `roots_between`."""
    page.execute_script("exactpt.seek(arguments[0])", str(at))
    tiles = state(page)["tiles"]
    scene = demo()
    owner = [(body, i) for body in scene.bodies for i in range(body.size)]
    seen = 0
    for index in range(len(tiles)):
        reported = page.execute_script("return exactpt.certificates(arguments[0])", index)
        roots = [QQ(c["root"]) for c in reported if c["root"] is not None]
        assert roots == sorted(roots)
        for certificate in reported:
            f = [int(c) for c in certificate["polynomial"]]
            for t in (at, at + QQ(1, 1000)):
                (ax, ay), (bx, by), (cx, cy) = (
                    body.at(t)[i] for body, i in (owner[v] for v in certificate["nodes"])
                )
                turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
                value = sum(c * t**k for k, c in enumerate(f))
                assert (turn > 0) - (turn < 0) == (value > 0) - (value < 0)
            piece = min(
                (p for v in certificate["nodes"]
                 if (p := owner[v][0].exact_piece_after(at).until) is not None),
                default=scene.end,
            )  # fmt: skip
            end = min(QQ(piece), near(page_end(), QQ(10)))
            expected = first_root(f, at, end)
            if expected is None:
                assert certificate["root"] is None
            else:
                assert float(certificate["root"]) == pytest.approx(float(expected), rel=1e-15)
                seen += 1
    assert seen > 10


def first_root(f, start, end):
    integers = tuple(map(ZZ, f))
    found = roots_after(integers, AlgebraicNumber(start), end)
    return next((r.time for r in found if r.time.compare_rational(end) < 0), None)


def page_end():
    return film_of(demo()).end


def test_a_tile_shows_its_proof(page):
    page.execute_script("exactpt.seek('4')")
    shown = state(page)
    nodes = next(n for n in shown["tiles"] if len(n) == 3 and len({*n}) == 3)
    hover(page, *(sum(shown["pixels"][v][k] for v in nodes) / 3 for k in (0, 1)))
    text = page.find_element("id", "tip").text
    assert "corners" in text
    assert " ≠ 0" in text or "no certificate of it can fail" in text


def test_no_name_covers_more_than_its_body(page):
    """Names vanish from bodies that are too small on the screen, and come back by zooming in."""
    whole = page.execute_script("return exactpt.labels().map((l) => l.text)")
    page.execute_script("exactpt.look(['0', '0'], 1 / 8); exactpt.state()")
    small = page.execute_script("return exactpt.labels().map((l) => l.text)")
    assert set(small) <= {"spark", "needle"}  # which have no room inside, and are named above
    assert {"harbour", "wheel"} <= set(whole)


def test_what_lies_over_the_picture_has_solid_ground(page):
    for theme in ("light", "dark"):
        page.execute_script("document.documentElement.dataset.theme = arguments[0]", theme)
        grounds = [ground(page, name) for name in (".clock", ".ruler", "#layer-tiles", "#follow")]
        assert all(g.startswith("rgb(") for g in grounds)  # without an alpha below one
        assert grounds[2] != grounds[3]  # pressed, and not


def ground(page, selector):
    return page.execute_script(
        "return getComputedStyle(document.querySelector(arguments[0])).backgroundColor", selector
    )


@pytest.mark.parametrize("calm", [False, True])
def test_the_moving_picture_of_the_readme(browser, calm):
    value = "reduce" if calm else "no-preference"
    features = [{"name": "prefers-reduced-motion", "value": value},
                {"name": "prefers-color-scheme", "value": "dark"}]  # fmt: skip
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    browser.get((Path(__file__).parents[3] / "docs" / "demo.svg").as_uri())
    shown = [
        browser.execute_script(
            "return getComputedStyle(document.querySelector(arguments[0])).display", name
        )
        for name in (".moves", ".rests")
    ]
    fill = browser.execute_script("return getComputedStyle(document.querySelector('.paper')).fill")
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    assert [name == "none" for name in shown] == [calm, not calm]
    assert fill == "rgb(14, 18, 24)"
    assert browser.title.startswith("The demo's tiling flexes")


def test_a_run_that_goes_on(browser, tmp_path):
    """Its contacts, plans, comings and goings are events; bodies are there in their time only."""
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
    scene = Scene([ball, Body("wall", [(6, -9), (6, 9)])], (0, 8))
    simulation = Simulation(scene, record=True)
    bounce = Bounce(fixed=["wall"])
    list(simulation.run(4, on_contact=bounce))
    simulation.add(Body("guest", [(2, 3), (4, 3), (4, 5), (2, 5)]))
    list(simulation.run(6, on_contact=bounce))
    simulation.remove("guest")
    list(simulation.run(on_contact=bounce))
    simulation.draw(tmp_path / "run.html")
    browser.get((tmp_path / "run.html").as_uri())

    names = []
    for at in ("3", "5", "7"):
        browser.execute_script("exactpt.seek(arguments[0])", at)
        x, y = (sum(p[k] for p in state(browser)["pixels"][5:9]) / 4 for k in (0, 1))
        names.append(
            (
                "guest" in browser.execute_script("return exactpt.labels().map((l) => l.text)"),
                colour(browser, x + 20, y + 20) == body_colour(2),
            )
        )
    rows = [row.text for row in browser.find_elements("class name", "row")]

    assert names == [(False, False), (True, True), (False, False)]
    assert [row.splitlines()[0] for row in rows] == ["plan", "contact", "arrival", "departure"]
    assert "ball and wall come into contact" in rows[1]
    assert browser.get_log("browser") == []


def test_notebooks_play(browser, tmp_path):
    """The player works in a frame that may run scripts and nothing else."""
    (tmp_path / "cell.html").write_text(small()._repr_html_(), encoding="utf-8")
    browser.get((tmp_path / "cell.html").as_uri())
    browser.switch_to.frame(browser.find_element("tag name", "iframe"))
    browser.find_element("id", "next").click()
    shown = browser.execute_script("return exactpt.state().step")
    browser.switch_to.default_content()
    assert shown == 1
    assert browser.get_log("browser") == []
