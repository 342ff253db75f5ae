"""The page docs/browser in Chromium: Pyodide from a folder beside it, all else as it is shipped."""

import base64
import hashlib
import json
import shutil
import threading
import time
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import urlencode

import pytest

from docs.make_page import PAGE, write
from exactpt.cli.browser import answer

ROOT = Path(__file__).parents[2]
PYODIDE = ROOT / ".pyodide"
LOCK = "pyodide-lock.json"

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(
        not (PYODIDE / "pyodide.mjs").is_file(), reason="no Pyodide: make try-browser"
    ),
]


CORE = ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", LOCK]
OTHER = dict(zip(CORE, CORE[1:] + CORE[:1], strict=True))


def hash_of(path):
    """The hash of a file as the attribute ``integrity`` has it."""
    return f"sha384-{base64.b64encode(hashlib.sha384(path.read_bytes()).digest()).decode()}"


class Quiet(SimpleHTTPRequestHandler):
    """A server of files that prints nothing."""

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """The page's address on a server of its own."""
    folder = tmp_path_factory.mktemp("served")
    write(folder / "browser")
    shutil.copytree(folder / "browser", folder / "alone")
    (folder / "pyodide").symlink_to(PYODIDE)
    settings = json.loads((PAGE / "settings.json").read_text()) | {"pyodide": "../pyodide/"}
    settings["integrity"][LOCK] = hash_of(PYODIDE / LOCK)  # which `.ci/fetch_pyodide.py` extends
    (folder / "browser" / "settings.json").write_text(json.dumps(settings))
    for name in settings["integrity"]:
        place = folder / f"changed-{name}"
        shutil.copytree(folder / "browser", place)
        wrong = settings["integrity"] | {name: settings["integrity"][OTHER[name]]}
        (place / "settings.json").write_text(json.dumps(settings | {"integrity": wrong}))
    settings["pyodide"] = "../nowhere/"
    (folder / "alone" / "settings.json").write_text(json.dumps(settings))
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/browser/index.html"
    server.shutdown()
    server.server_close()


def test_without_pyodide_it_says_so(browser, address):
    open_page(browser, address.replace("/browser/", "/alone/"))
    ask(browser, "graze")

    assert field(browser, "error").text.startswith("Pyodide or exactpt cannot be loaded: ")
    assert field(browser, "status").text == ""
    browser.get_log("browser")  # that it was not found


@pytest.mark.parametrize("name", CORE)
def test_a_file_with_another_hash_is_refused(browser, address, name):
    open_page(browser, address.replace("/browser/", f"/changed-{name}/"))
    ask(browser, "graze")

    assert field(browser, "error").text.startswith("Pyodide or exactpt cannot be loaded: ")
    said = "".join(entry["message"] for entry in browser.get_log("browser"))
    assert "Failed to find a valid digest in the 'integrity' attribute for resource '" in said
    assert f"/pyodide/{name}'" in said


def test_a_script_in_the_page_does_not_run(browser, address):
    open_page(browser, address)
    browser.execute_script(
        "const script = document.createElement('script');"
        "script.textContent = 'window.ran = true';"
        "document.body.append(script);"
    )

    assert browser.execute_script("return window.ran") is None
    assert "violates the following Content Security Policy" in str(browser.get_log("browser"))


@pytest.fixture(scope="module")
def opened(browser, address):
    """The page, with exactpt loaded into its worker by a first question."""
    open_page(browser, address)
    assert field(browser, "status").text.startswith("The first answer loads Pyodide")
    ask(browser, "graze")
    return browser


def open_page(page, address):
    """Open the page, and wait for its first example."""
    page.get(address)
    wait(page, lambda: field(page, "scene").get_property("value"))


def field(page, name):
    return page.find_element("id", name)


def wait(page, done, seconds=120):
    """Wait until something is so."""
    end = time.monotonic() + seconds
    while not done():
        assert time.monotonic() < end, page.get_log("browser")
        time.sleep(0.05)


def complaints(page):
    """What was said on the console, apart from what Pyodide says that it loads."""
    return [entry for entry in page.get_log("browser") if entry["level"] != "INFO"]


def scene(name):
    path = PAGE / "scenes" / f"{name}.json"
    return path.read_text() if path.exists() else (ROOT / "exactpt/data/demo.json").read_text()


def enter(page, text):
    page.execute_script("document.getElementById('scene').value = arguments[0]", text)


def ask(page, name, text=None):
    """Ask about an example or a text, and wait for the end of the answer."""
    enter(page, scene(name) if text is None else text)
    field(page, "answer").click()
    wait(page, field(page, "answer").is_enabled)


def played_to(page):
    """The last time of the animation that is shown."""
    page.switch_to.frame(field(page, "picture"))
    try:
        wait(page, lambda: page.execute_script("return typeof exactpt === 'object'"))
        field(page, "scrub").send_keys("\ue010")  # end
        return float(page.execute_script("return exactpt.state().time"))
    finally:
        page.switch_to.default_content()


@pytest.mark.parametrize("name", ["demo", "graze", "near-miss", "discs"])
def test_it_answers_as_the_package_does_here(opened, name):
    expected = json.loads(answer(scene(name), "auto", "auto"))

    ask(opened, name)

    assert field(opened, "error").text == ""
    assert field(opened, "words").text == expected["words"]
    assert field(opened, "json").get_property("textContent") == expected["json"]
    contact = json.loads(expected["json"])["contact"]
    assert played_to(opened) == pytest.approx(contact["time"]["approx"] if contact else 4)
    assert complaints(opened) == []


@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
def test_methods_can_be_chosen(opened, tiling):
    for name, choice in {"method": "kinetic", "tiling": tiling}.items():
        field(opened, name).send_keys(choice)

    ask(opened, "demo")

    assert json.loads(field(opened, "json").get_property("textContent"))["tiling"] == tiling
    for name in ("method", "tiling"):
        field(opened, name).send_keys("auto")


@pytest.mark.parametrize(
    "text", ['{"exactpt": 1, "time": [0, 1]}', "{", '{"exactpt": 1, "time": [0, 1], "bodies": 3}']
)
def test_bad_input_gets_the_line_of_the_command_and_no_answer(opened, text):
    ask(opened, "bad", text)

    assert field(opened, "error").text == json.loads(answer(text, "auto", "auto"))["error"]
    assert not field(opened, "words").is_displayed()
    assert not field(opened, "picture").is_displayed()
    assert complaints(opened) == []


def test_it_fits_a_phone(opened):
    ask(opened, "demo")
    emulated = {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True}
    opened.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", emulated)
    wide = opened.execute_script(
        "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    opened.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    assert wide == [390, 390]


def test_a_link_contains_the_scene(opened, address):
    given = {"scene": '{"exactpt": 1}', "method": "pairs", "tiling": "no such"}

    opened.get("about:blank")
    opened.get(f"{address}#{urlencode(given)}")
    wait(opened, lambda: field(opened, "scene").get_property("value") == given["scene"])

    assert field(opened, "method").get_property("value") == "pairs"
    assert field(opened, "tiling").get_property("value") == "auto"
    enter(opened, scene("graze"))
    field(opened, "link").click()
    linked = opened.current_url
    opened.get("about:blank")
    opened.get(linked)
    wait(opened, lambda: field(opened, "scene").get_property("value") == scene("graze"))


def test_a_run_is_stopped_and_the_next_one_answers(opened, address):
    opened.get("about:blank")
    open_page(opened, address)
    assert not field(opened, "stop").is_enabled()
    field(opened, "answer").click()
    field(opened, "stop").click()
    assert field(opened, "status").text.startswith("Stopped")
    assert field(opened, "answer").is_enabled()

    field(opened, "scene").send_keys("\ue009\ue007")  # Control+Enter
    wait(opened, field(opened, "answer").is_enabled)

    assert field(opened, "words").text.startswith("first contact at t = 8.693879580404362")


def test_what_breaks_pyodide_is_told_and_the_next_question_is_answered(opened):
    """Pyodide has less stack than JSON nested so deeply needs."""
    ask(opened, "deep", "[" * 100_000)
    assert field(opened, "error").text.startswith("Pyodide broke off, and starts again with the ")
    opened.get_log("browser")  # what Pyodide says about it

    ask(opened, "graze")

    assert field(opened, "words").text.startswith("first contact at t = 1.7320508075688772")
    assert complaints(opened) == []
