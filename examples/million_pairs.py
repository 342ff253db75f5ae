"""Pairs of moving triangles, as many as the argument names, some bad; then scenes in Parquet."""

import argparse
import json
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
from many_scenes import Random, scene

import exactpt
from exactpt.batch import run


def pairs(count: int) -> exactpt.arrays.Contacts:
    """The first contacts of random triangles, of which a few have a NaN or no area."""
    rng = np.random.default_rng(1)
    angles = np.sort(rng.uniform(0, 2 * np.pi, (2 * count, 3)), axis=1)
    triangles = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    triangles += rng.uniform(-5, 5, (2 * count, 1, 2))
    triangles[::1000, 1] = triangles[::1000, 0]
    return exactpt.arrays.first_contacts(
        triangles.reshape(-1, 2),
        np.arange(0, 6 * count + 1, 3),
        np.arange(2 * count).reshape(-1, 2),
        velocities=rng.uniform(-2, 2, (2 * count, 2)),
        time=(0.0, 4.0),
        errors="mask",
    )


def batch(count: int, folder: Path) -> pa.Table:
    """Answers for scenes of a Parquet file; the column "run" of the user comes back."""
    rng = Random(1)
    scenes = [json.dumps(scene(rng)) for _ in range(count)]
    pq.write_table(pa.table({"run": range(count), "scene": scenes}), folder / "scenes.parquet")
    run(folder / "scenes.parquet", folder / "answers.parquet")
    return pq.read_table(folder / "answers.parquet")


def main() -> None:
    """Print how many touch, how many were refused and why, and a row of the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pairs", type=int)
    count = parser.parse_args().pairs
    found = pairs(count)
    print(f"{found.found.sum()} of {count} pairs touch, {found.refused.sum()} refused:")
    print(found.reasons()[0])
    with TemporaryDirectory() as folder:
        answers = batch(count // 100, Path(folder))
    hits = answers.filter(pc.is_valid(answers["time"]))
    print(f"{len(hits)} of {len(answers)} scenes have a contact; columns:", *answers.column_names)
    print(hits.select(["run", "time", "kind", "body_a", "vertex_a"]).slice(0, 1).to_pylist()[0])


if __name__ == "__main__":
    main()
