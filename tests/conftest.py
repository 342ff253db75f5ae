"""Hypothesis profiles, limits, three options; CGAL's witness and Chromium as fixtures.

``dev`` (random, short) is the default; HYPOTHESIS_PROFILE=ci is derandomized and longer. With
--quick it is ``quick``, and tests with the marker `long` are left out.
"""

import gc
import os
import shutil
import warnings
from datetime import date

import pytest
from hypothesis import HealthCheck, settings
from rotation import turn_of

from exactpt import AlgebraicNumber, InputError
from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certifier import Certifier
from exactpt.cgal import CgalCheck, find_program
from exactpt.kernel import filters

settings.register_profile(
    "dev", max_examples=50, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile(
    "ci",
    max_examples=150,
    derandomize=True,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile(
    "quick", max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)

MAX_BITS = 100_000

FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--window-size=1280,800",
)


def pytest_addoption(parser):
    parser.addoption(
        "--exact-only", action="store_true", help="switch the float filters off in every test"
    )
    parser.addoption("--quick", action="store_true", help="no long tests")
    parser.addoption(
        "--rotating",
        metavar="DATE",
        type=date.fromisoformat,
        help="of the tests that -m selects only those whose turn it is on this date",
    )


def pytest_configure(config):
    default = "quick" if config.getoption("--quick") else "dev"
    settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", default))


def is_long(item):
    """Return True if the marker `long` names no cases, or this one."""
    marker = item.get_closest_marker("long")
    if marker is None or not marker.args:
        return marker is not None
    if not hasattr(item, "callspec"):
        cases = ", ".join(map(repr, marker.args))
        raise pytest.UsageError(f"{item.nodeid}: long({cases}) names cases, and there are none")
    return item.callspec.id in marker.args


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config, items):
    if config.getoption("--quick"):
        late = [item for item in items if is_long(item)]
        config.hook.pytest_deselected(items=late)
        items[:] = [item for item in items if not is_long(item)]
        gc.collect()
        gc.freeze()
    if day := config.getoption("--rotating"):
        turn = turn_of(items, day)
        config.hook.pytest_deselected(items=list(set(items).difference(turn)))
        items[:] = turn
    if filters.__file__.endswith(".py"):
        return
    if config.getoption("--exact-only"):
        raise pytest.UsageError("--exact-only is for the plain package: make plain")
    for item in items:
        if item.get_closest_marker("plain"):
            item.add_marker(pytest.mark.skip(reason="patches classes, which are compiled"))


@pytest.fixture(scope="session", autouse=True)
def _switch(request):
    """With --exact-only, every certificate, static predicate and queue is exact."""
    if not request.config.getoption("--exact-only"):
        yield
        return

    def switched_off(init):
        def exact(self, *args, **options):
            init(self, *args, **(options | {"exact_only": True}))

        return exact

    with pytest.MonkeyPatch.context() as patch:
        for kind in (Certifier, PredicatesAt):
            patch.setattr(kind, "__init__", switched_off(kind.__init__))
        yield


@pytest.fixture(scope="session", autouse=True)
def _bounded_refinement():
    """Refinement that runs away fails at once; no test needs a tenth of these bits."""
    refine = AlgebraicNumber.refine

    def bounded(self):
        if max(q.denominator.bit_length() for q in (self.low, self.high)) > MAX_BITS:
            raise AssertionError(f"refined beyond {MAX_BITS} bits: {self.polynomial}")
        refine(self)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(AlgebraicNumber, "refine", bounded)
        yield


@pytest.fixture(scope="session")
def program():
    """The witness: where it is missing the tests fail, they are not skipped."""
    try:
        return find_program()
    except InputError as error:
        return pytest.fail(str(error))


@pytest.fixture(scope="module")
def witness(program):
    with CgalCheck(program) as running:
        yield running


@pytest.fixture(scope="module")
def browser():
    """Chromium, headless, with what pages say on the console in its log."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="selenium is not installed")
    chromium, chromedriver = shutil.which("chromium"), shutil.which("chromedriver")
    if chromium is None or chromedriver is None:
        pytest.fail("Chromium is not installed; `make test-browser` does that")
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for flag in FLAGS:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(chromedriver))
    yield driver
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        driver.quit()
