"""Ships and storms, moving features: python examples/ships_and_storms.py 60 found.geojson."""

import argparse
import json
from datetime import UTC, datetime, timedelta
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import exactpt

BEGIN = datetime(2026, 9, 1, tzinfo=UTC)


def moving(kind: str, coordinates: list[object], **properties: object) -> dict[str, object]:
    """A moving feature with a position every hour."""
    dates = [(BEGIN + timedelta(hours=h)).isoformat() for h in range(13)]
    way = {"type": kind, "datetimes": dates, "coordinates": coordinates, "interpolation": "Linear"}
    return {"type": "Feature", "properties": properties, "temporalGeometry": way}


def features(ships: int, rng: Random) -> list[dict[str, object]]:
    """Ships that change their course every hour, and four storms that drift."""
    found = []
    for i in range(ships):
        x, y = rng.uniform(-20, 20), rng.uniform(-20, 20)
        path = [
            [x := x + rng.uniform(-0.4, 0.6), y := y + rng.uniform(-0.4, 0.4)] for _ in range(13)
        ]
        found.append(moving("MovingPoint", path, name=f"ship {i}", mmsi=211_000_000 + i))
    ring = [(2, 0), (1, 2), (-1, 2), (-2, 0), (-1, -2), (1, -2), (2, 0)]
    for i in range(4):
        x, y, u, v = (rng.uniform(-k, k) for k in (15, 15, 0.8, 0.8))
        path = [[[(x + u * h + 2 * p, y + v * h + 2 * q) for p, q in ring]] for h in range(13)]
        found.append(moving("MovingPolygon", path, name=f"storm {i}", category=rng.randint(1, 5)))
    return found


def main() -> None:
    """Print the intervals with dates, and write them with the properties of both bodies."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("ships", type=int)
    parser.add_argument("intervals", type=Path, help="the file of GeoJSON to write")
    given = parser.parse_args()
    data = {"type": "FeatureCollection", "features": features(given.ships, Random(5))}
    with TemporaryDirectory() as folder:
        file = Path(folder) / "ships.mfjson"
        file.write_text(json.dumps(data))
        scene = exactpt.read_shapes(file)
    storms = [body.name for body in scene.bodies if "category" in body.properties]
    ships = [body.name for body in scene.bodies if "mmsi" in body.properties]
    pairs = [(ship, storm) for ship in ships for storm in storms]
    intervals = exactpt.contacts(scene, between=pairs)
    for one in intervals:
        start, end = (exactpt.to_datetime(t).strftime("%H:%M:%S") for t in (one.start, one.end))
        print(f"{one.a} in {one.b} from {start} to {end}")
    found = exactpt.to_features(scene, intervals, dates=True)
    given.intervals.write_text(json.dumps(found))


if __name__ == "__main__":
    main()
