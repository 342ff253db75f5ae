"""Hypothesis profiles, limits, options; CGAL's witness and Chromium as fixtures.

The profile ``dev``, of random examples, is the default. HYPOTHESIS_PROFILE=ci has the same ones in
each run, ``night`` has ten times as many. With --quick there are half as many, the same in each
run, and tests with the marker `long` are left out. With --processor-seconds the table at the end
has what the tests of each folder took.
"""

import gc
import os
import shutil
import warnings
from collections import Counter

import pytest
from hypothesis import HealthCheck, settings

from exactpt import AlgebraicNumber, InputError
from exactpt.certificates import first_root as filters
from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certifier import Certifier
from exactpt.cgal import CgalCheck, find_program

EXAMPLES = {"dev": 50, "ci": 50, "quick": 25, "night": 500}
SAME_IN_EACH_RUN = {"ci", "quick"}
for profile, examples in EXAMPLES.items():
    settings.register_profile(
        profile,
        max_examples=examples,
        derandomize=profile in SAME_IN_EACH_RUN,
        deadline=None,
        suppress_health_check=[HealthCheck.too_slow],
    )

MAX_BITS = 100_000
BEGAN = pytest.StashKey[float]()

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
        "--laws",
        metavar="TIER",
        help="the tier whose cases tests/laws checks; by default full, and quick with --quick",
    )
    parser.addoption(
        "--processor-seconds",
        action="store_true",
        help="report the processor time of the tests of each folder, and of their processes",
    )


def pytest_configure(config):
    is_quick = config.getoption("--quick")
    chosen = "quick" if is_quick else os.environ.get("HYPOTHESIS_PROFILE", "dev")
    settings.load_profile(chosen)


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
    if filters.__file__.endswith(".py"):
        return
    if config.getoption("--exact-only"):
        raise pytest.UsageError("--exact-only is for the plain package: make plain")
    for item in items:
        if item.get_closest_marker("plain"):
            item.add_marker(pytest.mark.skip(reason="patches classes, which are compiled"))


SECONDS = Counter()
"""Processor seconds by folder; with pytest-xdist they are those that the workers report."""


def processor_seconds():
    """Return the seconds of processor time of this process, and of its own that have ended."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_setup(item):
    """Measure a test with its fixtures; the report of the teardown takes the result along."""
    item.stash[BEGAN] = processor_seconds()
    return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    if call.when == "teardown":
        spent = processor_seconds() - item.stash[BEGAN]
        report.user_properties.append(("processor seconds", spent))
    return report


def pytest_runtest_logreport(report):
    if report.when == "teardown":
        folder = report.nodeid.partition("::")[0].rpartition("/")[0]
        SECONDS[folder] += dict(report.user_properties)["processor seconds"]


def pytest_terminal_summary(terminalreporter, config):
    if not config.getoption("--processor-seconds"):
        return
    terminalreporter.section("processor seconds")
    for folder, seconds in SECONDS.most_common():
        terminalreporter.line(f"{seconds:9.1f}  {folder}")
    terminalreporter.line(f"{SECONDS.total():9.1f}  all tests")


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
