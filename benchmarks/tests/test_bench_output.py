"""Tables, plots, peers that are skipped by name; `exactpt bench`."""

import sys
from itertools import islice
from random import Random

import pytest

from benchmarks.floor import CERTIFICATES, floor
from benchmarks.machine import machine
from benchmarks.peers import PEERS, is_installed
from benchmarks.plots import draw_lines, draw_shares, series_of
from benchmarks.shapes import crowd
from benchmarks.tests.bench_help import Results
from benchmarks.timing import exponent, memory_of, microseconds, timed
from exactpt.tiling.driver import Driver
from exactpt.tiling.start import start_tiling


def test_a_table_is_written_and_told(tmp_path):
    results = Results(tmp_path / "new" / "folder")
    results.output.table(
        "t", [{"name": "a, b", "n": 1, "x": 0.5}, {"name": "c", "n": 20, "x": None}]
    )
    assert (results.folder / "t.csv").read_text() == 'name,n,x\n"a, b",1,0.5\nc,20,\n'
    assert results.said == ["", "name   n    x", "a, b   1  0.5", "c     20    -"]
    assert results.names() == ["t.csv"]


@pytest.mark.parametrize("package", PEERS)
def test_a_peer_that_is_missing_is_skipped_by_name_once(tmp_path, monkeypatch, package):
    monkeypatch.setitem(sys.modules, PEERS[package], None)
    assert not is_installed(package)
    results = Results(tmp_path)
    assert not results.output.has(package)
    assert not results.output.has(package)
    extra = "engines" if package == "python-fcl" else "bench"
    assert results.said == [f"skipped: {package} is not installed (pip install 'exactpt[{extra}]')"]


def test_plots_are_skipped_without_matplotlib(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    results = Results(tmp_path)
    results.output.lines("l", "title", ("x", "y"), {"a": [(1.0, 2.0)]})
    results.output.shares("s", "title", ["r"], ["c"], [[0.5]])
    assert results.names() == []
    assert len(results.said) == 1


def test_no_plot_is_drawn_of_nothing(tmp_path):
    results = Results(tmp_path)
    results.output.lines("l", "title", ("x", "y"), {"a": []})
    assert (results.names(), results.said) == ([], [])


@pytest.mark.long
def test_a_plot_is_the_same_every_time():
    pytest.importorskip("matplotlib")
    drawn = [draw_lines("t", ("x", "y"), {"exactpt": [(1, 2), (3, 4)]}) for _ in range(2)]
    assert drawn[0] == drawn[1]
    assert "exactpt" in drawn[0]
    assert "<svg" in drawn[0]


@pytest.mark.long
def test_a_field_shows_shares():
    pytest.importorskip("matplotlib")
    drawn = draw_shares("t", ["row"], ["a", "b", "c"], [[0.0, None, 0.25]])
    assert "25%" in drawn
    assert "row" in drawn


def test_the_machine_names_every_package():
    text = "\n".join(machine())
    assert all(name in text for name in ("exactpt", "gmpy2", "numpy", *PEERS))


def test_a_power_law_is_found():
    assert exponent([1, 2, 4, 8], [3, 12, 48, 192]) == pytest.approx(2.0)
    assert str(exponent([1, 2], [0, 5])) == "nan"


def test_timing_returns_the_answers():
    answer, seconds = timed(lambda: 7)
    assert answer == 7
    assert seconds >= 0.0
    assert microseconds(lambda n: n + 1, [1, 2])[1] == [2, 3]


def test_memory_is_that_of_what_is_kept():
    assert 950 < memory_of(lambda: bytearray(1 << 20)) < 1100


def test_lines_are_read_out_of_a_table():
    rows = [{"a": "p", "x": 1, "y": 2.5}, {"a": "q", "x": "3", "y": 0}, {"a": "p", "x": 2, "y": 1}]
    assert series_of(rows, "a", "x", "y") == {"p": [(1.0, 2.5), (2.0, 1.0)], "q": []}


def test_a_tiling_goes_on_unchanged():
    scene = crowd(30, Random(1), radius=60, end=100)
    measured, other = (start_tiling(scene, "lazy", scene.exact_start) for _ in range(2))

    assert floor(measured, 100) > 0

    assert measured.queue.slots() == other.queue.slots()
    events = [
        [(e.kind, e.removed, e.added, e.time.low) for e in islice(driver.events(scene.end), 50)]
        for driver in (Driver(scene, kinetic) for kinetic in (measured, other))
    ]
    assert len(events[0]) == 50
    assert events[0] == events[1]


def test_each_event_computes_its_certificates():
    scene = crowd(30, Random(2), radius=60, end=100)
    kinetic = start_tiling(scene, "lazy", scene.exact_start)
    before = kinetic.certifier.made

    floor(kinetic, 10)

    assert kinetic.certifier.made == before + 10 * CERTIFICATES
