"""Rounding modes, flushed subnormals and numpy's error handling of the caller's thread."""

import contextlib
import ctypes
import gc
import platform
import threading
from fractions import Fraction

import numpy as np
import pytest

import exactpt
from exactpt import InputError, Polynomial, arrays
from exactpt.certificates.kinetic import CertificateQueue
from exactpt.cli import main
from exactpt.errors import RoundingError
from exactpt.filters.rounding import check_rounding
from exactpt.kernel.budget import check_budget
from exactpt.kernel.collection import collector_at_rest
from exactpt.testing import space
from exactpt.testing.scenes import FAMILIES, generate

DOWN, UP, TO_ZERO, FTZ, DAZ = 0x2000, 0x4000, 0x6000, 0x8000, 0x0040
"""Bits of MXCSR, the control register of SSE."""
SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
APART = np.array([[(0, 0, 9), (1, 0, 0), (0, 1, -9), (0, 0, -9)] * 2], float)
"""A query in space that the float filter decides alone: no contact."""


def _library():
    """The C library, if fesetenv writes MXCSR at byte 28 of fenv_t: glibc on x86-64."""
    if platform.machine() not in ("x86_64", "AMD64") or platform.libc_ver()[0] != "glibc":
        return None
    with contextlib.suppress(OSError):
        return ctypes.CDLL("libm.so.6")
    return None


LIBM = _library()
needs_mxcsr = pytest.mark.skipif(LIBM is None, reason="sets MXCSR by glibc on x86-64")


@contextlib.contextmanager
def mxcsr(bits):
    """Within the context, the thread computes with these bits set."""
    before = ctypes.create_string_buffer(64)
    LIBM.fegetenv(before)
    changed = ctypes.create_string_buffer(before.raw, 64)
    register = int.from_bytes(before.raw[28:32], "little") | bits
    changed[28:32] = register.to_bytes(4, "little")
    LIBM.fesetenv(changed)
    try:
        yield
    finally:
        LIBM.fesetenv(before)


def _scene():
    ball = exactpt.Body("ball", [(0, 0), (1, 0), (0, 1)], exactpt.Translation([0, 1]))
    wall = exactpt.Body("wall", [(5, -9), (6, -9), (6, 9), (5, 9)])
    return exactpt.Scene([ball, wall], (0, 20))


def _questions():
    """Public calls whose answers depend on float filters; each begins when it is called."""
    scene = _scene()
    ball, wall = scene.bodies
    simulation, planner = exactpt.Simulation(scene), exactpt.Planner([wall], (0, 20))
    watched = CertificateQueue(until=3)
    watched.watch("f", 2 - Polynomial([0, 0, 1]))
    still = [(0, 0), (9, 9)]
    yield "arrays", lambda: arrays.first_contacts([*SQUARE, (5, 0)], [0, 4, 5], [(0, 1)])
    yield "queries", lambda: arrays.point_segment_contacts([still[0]], [still[1]], [(9, 8)])
    yield "vertex_face_array", lambda: space.vertex_face_array(APART)
    yield "edge_edge_array", lambda: space.edge_edge_array(APART)
    yield "from_arrays", lambda: exactpt.Scene.from_arrays(SQUARE, [0, 4])
    yield "Scene", lambda: exactpt.Scene([ball, wall])
    yield "from_json", lambda: exactpt.Scene.from_json(scene.to_json())
    for method in ("auto", "pairs", "kinetic"):
        yield method, lambda method=method: exactpt.first_contact(scene, method=method)
    yield "exact", lambda: exactpt.first_contact(scene, method="kinetic", exact_only=True)
    yield "selected", lambda: exactpt.first_contact(scene, after_start=True)
    yield "enclosed", lambda: exactpt.first_contact_enclosed(scene)
    yield "within", lambda: exactpt.first_within(scene, distance=1)
    yield "contacts", lambda: exactpt.contacts(scene)
    yield "intervals", lambda: exactpt.contact_intervals(scene, "ball", "wall")
    yield "clearance", lambda: exactpt.clearance(scene, "ball", "wall")
    yield "distance", lambda: exactpt.distance(scene, "ball", "wall", 1)
    yield "prove", lambda: exactpt.prove(scene)
    yield "planner", lambda: planner.first_contact([(0, 0), (1, 1)], exactpt.Translation([0, 1]))
    yield "Planner", lambda: exactpt.Planner([wall])
    yield "Simulation", lambda: exactpt.Simulation(scene)
    yield "step", simulation.copy().step
    yield "run", lambda: list(simulation.copy().run())
    yield "to_contact", simulation.copy().run_to_contact
    yield "space", simulation.copy().space
    yield "set_motion", lambda: simulation.copy().set_motion("ball", exactpt.Translation())
    yield "advance", watched.advance
    yield "watch", lambda: watched.watch("g", Polynomial([1, -1]))
    yield "ask", check_budget


@needs_mxcsr
@pytest.mark.parametrize("bits", [DOWN, UP, TO_ZERO, FTZ, DAZ, DOWN | FTZ | DAZ])
def test_every_question_refuses_another_environment(bits):
    refused = []
    questions = dict(_questions())
    for name, question in questions.items():
        with mxcsr(bits), contextlib.suppress(RoundingError):
            question()
            continue
        refused.append(name)
        question()  # and answers in the default one
    assert refused == list(questions)


@needs_mxcsr
def test_bug_rounding_down_misses_contacts_of_huge_squares():
    """In FE_DOWNWARD an overflow gives the largest double: 55 of 4,000 such pairs were wrong."""
    first, second = (SQUARE + np.array(place) for place in ((0, -1), (-10, -8)))
    corners = np.concatenate([first, second]) * 1e200
    velocities = np.array([(-3.0, 0.0), (1.0, 3.0)]) * 1e200

    def found():
        options = {"velocities": velocities, "time": (0.0, 20.0)}
        return arrays.first_contacts(corners, [0, 4, 8], [(0, 1)], **options)

    assert abs(float(found().contact(0).time) - 2.25) < 1e-9
    with mxcsr(DOWN), pytest.raises(RoundingError, match="does not round to nearest"):
        found()


@needs_mxcsr
def test_bug_flushed_velocities_miss_a_contact():
    """A velocity below 2^-1022 was taken for 0."""
    corners = np.array([(0, 0), (1, 0), (0, 1), (5, 0), (6, 0), (5, 1)]) * 4e-308
    velocities = np.array([(2e-308, 0.0), (0.0, 0.0)])

    def found():
        options = {"velocities": velocities, "time": (0.0, 50.0)}
        return arrays.first_contacts(corners, [0, 3, 6], [(0, 1)], **options)

    assert found().found[0]
    with mxcsr(FTZ | DAZ), pytest.raises(RoundingError, match="-ffast-math"):
        found()


@needs_mxcsr
def test_a_callback_that_changes_the_environment_is_noticed():
    scene, left = _scene(), contextlib.ExitStack()
    simulation = exactpt.Simulation(scene)

    def respond(_simulation, _contact):
        left.enter_context(mxcsr(UP))

    with left, pytest.raises(RoundingError):
        list(simulation.run(on_contact=respond))
    events = list(simulation.run(on_contact=lambda *_: None))
    assert [event.kind for event in events] == ["contact"]
    assert simulation.contact.time == 4


@needs_mxcsr
def test_a_run_goes_on_when_the_environment_is_reset():
    scene = generate("turning", 1)
    whole = [event.to_json() for event in exactpt.Simulation(scene, tiling="greedy").run()]
    assert len(whole) > 5
    simulation = exactpt.Simulation(scene, tiling="greedy")
    events = [event.to_json() for event in simulation.step()]
    with mxcsr(TO_ZERO), pytest.raises(RoundingError):
        list(simulation.run())
    events += [event.to_json() for event in simulation.run()]
    assert events == whole


@needs_mxcsr
def test_the_command_line_refuses_it_in_one_line(tmp_path, capsys):
    path = tmp_path / "scene.json"
    _scene().save(path)
    with mxcsr(UP), pytest.raises(SystemExit) as end:
        main(["collide", str(path)])
    out, err = capsys.readouterr()
    assert (end.value.code, out, err.count("\n")) == (2, "", 1)


@needs_mxcsr
def test_other_threads_keep_their_environment():
    failed = []

    def ask_again():
        try:
            check_rounding()
        except RoundingError as error:
            failed.append(error)

    ready, over = threading.Event(), threading.Event()

    def wait_and_ask():
        ready.set()
        over.wait()
        ask_again()

    other = threading.Thread(target=wait_and_ask)
    other.start()
    ready.wait()
    with mxcsr(DOWN):
        over.set()
        other.join()
    assert failed == []


def _tiny_and_huge():
    body, moves = exactpt.Body, exactpt.Translation
    for u in (Fraction(1, 10**310), Fraction(10) ** 300, Fraction(1)):
        left = body("a", [(0, 0), (3 * u, 0), (0, 3 * u)], moves([0, u]))
        right = body("b", [(7 * u, u / 3), (9 * u, u), (9 * u, -u)], moves([0], [0, u / 7]))
        yield exactpt.Scene([left, right], (0, 20))


@pytest.mark.long
@pytest.mark.parametrize("handling", ["raise", "call"])
def test_bug_errstate_of_numpy_does_not_leak(handling):
    """A coordinate near 0 raised FloatingPointError: underflow encountered in nextafter."""
    called = []
    scenes = [generate(family, 1) for family in FAMILIES] + list(_tiny_and_huge())
    with np.errstate(all=handling, call=lambda *about: called.append(about)):
        for scene in scenes:
            exactpt.Scene(scene.bodies, (scene.start, scene.end))
            exactpt.first_contact(scene, method="pairs")
            with contextlib.suppress(InputError):  # a tiling that does not support the bodies
                exactpt.Simulation(scene, max_events=20)
            if scene.vertex_count < 20 and len(scene.bodies) > 1:
                exactpt.contacts(scene)
                exactpt.first_within(scene, distance=Fraction(1, 7))
        for scale in (1e-307, 1.0, 1e307):
            corners = np.concatenate([SQUARE, SQUARE + 5]) * scale
            found = arrays.first_contacts(
                corners, [0, 4, 8], [(0, 1)], velocities=corners[[2, 0]], time=(0, 9)
            )
            assert found.found.tolist() == [True]
    assert called == []


# The collector rests within the context, and is afterwards what it was before


@pytest.fixture(autouse=True)
def _as_it_was():
    was_on = gc.isenabled()
    yield
    (gc.enable if was_on else gc.disable)()


def fail_within():
    with collector_at_rest():
        with collector_at_rest():
            assert not gc.isenabled()
        assert not gc.isenabled()
        raise ValueError("within")


@pytest.mark.parametrize("was_on", [True, False])
def test_it_is_afterwards_what_it_was(was_on):
    (gc.enable if was_on else gc.disable)()

    with pytest.raises(ValueError, match="within"):
        fail_within()

    assert gc.isenabled() is was_on
