"""The examples of five users run, and print what they are about."""

import importlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import exactpt

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"


def output(name, *words):
    """What an example prints; it has twenty seconds of processor time."""
    run = subprocess.run(
        [sys.executable, str(EXAMPLES / f"{name}.py"), *map(str, words)],
        capture_output=True, text=True, check=False, env=os.environ | {"PYTHONPATH": str(ROOT)},
        preexec_fn=limit_processor_time,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    return run.stdout


def limit_processor_time():
    import resource

    resource.setrlimit(resource.RLIMIT_CPU, (20, 20))


@pytest.mark.long
def test_a_robot_on_a_spline_of_poses(tmp_path):
    pytest.importorskip("scipy")
    said = output("robot_cell", tmp_path / "cell.svg")

    low, high = map(float, re.search(r"between ([\d.]+) and ([\d.]+) s", said).groups())
    assert 0 < high - low < 2e-5
    near = re.findall(r"within 5 mm of obstacle \d+: ([\d.]+) to ([\d.]+) s", said)
    assert len(near) > 3
    assert float(near[0][0]) < low < float(near[0][1])
    assert (tmp_path / "cell.svg").stat().st_size > 1000


@pytest.mark.long
def test_an_arm_of_three_links():
    """The bounds contain the contact of the true arm, sampled in doubles."""
    pytest.importorskip("scipy")
    shapely = pytest.importorskip("shapely")
    said = output("robot_arm")
    low, high = map(float, re.search(r"from ([\d.]+) to ([\d.]+) s", said).groups())
    link, x, y = re.search(r"'link (\d)', 'box (\S+) (\S+)'", said).groups()

    def gap(t):
        from scipy.interpolate import CubicSpline

        joints = np.array([[0, 0, 0], [0.8, -0.5, 0.3], [1.2, 0.9, -1], [2, 0.4, 0.6]])
        angles = CubicSpline([0, 1, 2.5, 4], np.cumsum(joints, axis=1), bc_type="clamped")(t)
        ends = np.concatenate([[0], np.cumsum([2.0, 1.5, 1.0] * np.exp(1j * angles))])
        k = int(link)
        arm = shapely.LineString([(z.real, z.imag) for z in ends[k - 1 : k + 1]])
        u, v = float(x), float(y)
        return arm.distance(shapely.box(u, v, u + 0.3, v + 0.3)) - 0.1

    assert 0 < high - low < 1e-5
    assert gap(low - 1e-6) > 0 > gap(high + 1e-6)


@pytest.fixture
def robot_arm(monkeypatch):
    pytest.importorskip("scipy")
    monkeypatch.syspath_prepend(str(EXAMPLES))
    arm = importlib.import_module("robot_arm")
    monkeypatch.setattr(arm, "WAYPOINTS", [0, 0.7, 2.3, 4])
    return arm


@pytest.mark.long
def test_an_arm_with_waypoints_between_even_knots(robot_arm, capsys):
    """The time was computed in doubles by other means: distances of segments of the true arm."""
    robot_arm.main()

    low, high = map(
        float, re.search(r"from ([\d.]+) to ([\d.]+) s", capsys.readouterr().out).groups()
    )
    assert low <= 1.179422273 <= high
    assert high - low < 1e-5


def test_an_arm_with_pieces_across_waypoints_is_refused(robot_arm, monkeypatch):
    """Across a waypoint the spline is not one polynomial: a piece ends 10^-5 beside it."""
    monkeypatch.setattr(robot_arm.np, "union1d", lambda even, _: np.append(even, 4.0))
    with pytest.raises(AssertionError):
        robot_arm.arm()


@pytest.mark.long
def test_an_engine_with_a_mistake(tmp_path):
    said = output("game_engine", tmp_path / "test_found.py")

    wrong, right = said.split("family")[1:]
    assert "early (" in wrong
    assert "(" not in right, "both bodies' axes make no mistakes"
    assert "sticks_and_points" not in said
    assert (tmp_path / "test_found.py").read_text().count("def test_") == wrong.count("vertices)")


@pytest.mark.long
def test_a_table_of_polygons():
    said = output("billiards", 60, 2)

    assert re.search(r"t = 2: \d\d+ contacts, energy changed by -?\d\.\de-(1\d|09)", said)
    assert "velocity of p1: 0 1" in said


@pytest.mark.long
def test_ships_in_storms(tmp_path):
    said = output("ships_and_storms", 60, tmp_path / "found.geojson").splitlines()

    features = json.loads((tmp_path / "found.geojson").read_text())["features"]
    assert len(features) == len(said) > 10
    assert re.fullmatch(r"ship \d+ in storm \d from [\d:]{8} to [\d:]{8}", said[0])
    assert {"a_mmsi", "b_category", "start", "end"} <= set(features[0]["properties"])


@pytest.mark.slow
def test_clients_of_gis_read_the_answers_and_the_moving_features(tmp_path):
    geopandas = pytest.importorskip("geopandas")
    output("ships_and_storms", 60, tmp_path / "found.geojson")

    table = geopandas.read_file(tmp_path / "found.geojson")
    assert set(table.geom_type) == {"Point"}
    assert table["a_mmsi"].min() >= 211_000_000
    assert (table["start"] <= table["end"]).all()


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # those of movingpandas and pandas
def test_movingpandas_reads_moving_features(tmp_path):
    movingpandas = pytest.importorskip("movingpandas")
    ship = exactpt.Body("ship", [(0, 0)], exactpt.Velocity(1, 0), properties={"mmsi": 7})
    exactpt.write_shapes(exactpt.Scene([ship], time=(0, 60)), tmp_path / "ship.mfjson")

    found = movingpandas.read_mf_json(str(tmp_path / "ship.mfjson"), traj_id_property="mmsi")
    trajectory = getattr(found, "trajectories", [found])[0]
    assert trajectory.get_end_location().x == 60.0


@pytest.mark.long
def test_many_pairs_and_scenes():
    pytest.importorskip("pyarrow")
    said = output("million_pairs", 3000)

    assert ", 6 refused" in said
    assert "of 30 scenes have a contact" in said
    assert "'kind': 'vertex-edge'" in said
