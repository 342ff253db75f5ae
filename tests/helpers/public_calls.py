"""One call of each public function and class, on a small world or on one of long values."""

import contextlib
import io
import json
from dataclasses import dataclass
from datetime import UTC, datetime
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import numpy as np

import exactpt
import exactpt.testing
from exactpt import arrays, batch, cli

LONG = Fraction(7**3700, 7**3700 + 2)
"""A number just below 1 with 3,127 digits above and below: more than Python's least limit, 640."""


@dataclass(frozen=True)
class World:
    """Two bodies that touch at the time 3, a little later in the long world, in a folder.

    Attributes:
        folder: an empty folder; commands write there.
        mover, wall: the names of the bodies.
        size: the number of vertices of the mover.
        unit: a factor of some coordinates.
    """

    folder: Path
    mover: str = "mover"
    wall: str = "wall"
    size: int = 4
    unit: Fraction = Fraction(1)

    @property
    def outline(self):
        """A convex polygon from (-1, 0) to (0, u), where u is the unit."""
        arc = [Fraction(i, self.size - 3) for i in range(self.size - 2)]
        return [(-1, 0), (0, 0), *((-x * self.unit, (1 + x - x * x) * self.unit) for x in arc)]

    @property
    def motion(self):
        return exactpt.Translation([0, self.unit])

    @property
    def moving(self):
        return exactpt.Body(self.mover, self.outline, self.motion, properties={"k": [1, "x"]})

    @property
    def standing(self):
        return exactpt.Body(self.wall, [(3, -5), (4, -5), (4, 5), (3, 5)])

    @property
    def scene(self):
        return exactpt.Scene([self.moving, self.standing], time=(0, 10))

    @property
    def curved(self):
        """A scene whose first contact is at the square root of 3."""
        motion = exactpt.Translation([0, 0, self.unit])
        return exactpt.Scene([self.moving.with_motion(motion), self.standing], time=(0, 10))

    def simulation(self, **options):
        simulation = exactpt.Simulation(self.scene, **options)
        list(simulation.run(until=1))
        return simulation

    def file(self):
        path = self.folder / "scene.json"
        self.scene.save(path)
        return path

    def shapes(self):
        path = self.folder / "shapes.geojson"
        exactpt.write_shapes(self.scene, path, at=0)
        return path


def long_world(folder):
    """Return a world of long names, many vertices and long numbers."""
    lines = "a name\nof many lines \x1b[31m" * 200
    return World(folder, mover=lines, wall="w" * 5000, size=40, unit=LONG)


def question(w):
    """Return a question of `exactpt.testing`."""
    return exactpt.testing.make_question("ties", 1, 1)


def checked(w):
    """Return the report about a function that never finds a contact."""
    return exactpt.testing.check(lambda _question: None, families=["ties"], cases=3, seed=1)


def command(*arguments):
    """Return the exit code of a command and its output."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            cli.main([str(argument) for argument in arguments])
        except SystemExit as end:
            return end.code, out.getvalue(), err.getvalue()
    raise AssertionError("a command ends with an exit code")


def lines_file(w):
    path = w.folder / "scenes.jsonl"
    path.write_text(json.dumps(w.scene.to_json()) + "\n", encoding="utf-8")
    return path


def fresh(w, name):
    """Return a path at which there is no file."""
    path = w.folder / name
    path.unlink(missing_ok=True)
    return path


def ended(w):
    """Return the number of looks at the clock of a search."""
    with exactpt.testing.ending_at(None) as clock:
        exactpt.first_contact(w.scene, max_seconds=60)
    return clock.looks


CALLS = {
    # exactpt: one entry for each name, under this name
    "Affine": lambda w: exactpt.Affine([[[1, w.unit], 0], [0, 1]], x=[0, w.unit]),
    "AlgebraicNumber": lambda w: exactpt.AlgebraicNumber(w.unit),
    "Approach": lambda w: exactpt.first_within(w.scene, distance=1),
    "Body": lambda w: w.moving,
    "Bounce": lambda w: list(
        exactpt.Simulation(w.scene).run(6, on_contact=exactpt.Bounce(fixed=[w.wall]))
    ),
    "Clearance": lambda w: exactpt.clearance(w.scene, w.mover, w.wall),
    "Contact": lambda w: exactpt.first_contact(w.scene),
    "ContactInterval": lambda w: exactpt.contact_intervals(w.scene, w.mover, w.wall)[0],
    "Distance": lambda w: exactpt.distance(w.scene, w.mover, w.wall, at=w.unit),
    "EnclosedContact": lambda w: exactpt.first_contact_enclosed(w.scene),
    "RunEvent": lambda w: exactpt.Simulation(w.scene).step(),
    "FreeSpace": lambda w: w.simulation().space(),
    "History": lambda w: w.simulation(record=True).history(),
    "Hit": lambda w: w.simulation().ray_cast((2, w.unit), (1, w.unit)),
    "ContactPoint": lambda w: exactpt.first_contact(w.scene).pairs[0],
    "ShortestPath": lambda w: w.simulation().shortest_path((2, w.unit), (6, w.unit)),
    "Pieces": lambda w: exactpt.Pieces([(w.unit, w.motion), (None, exactpt.Translation(w.unit))]),
    "Place": lambda w: w.simulation().locate((3, w.unit)),
    "Planner": lambda w: exactpt.Planner([w.standing], time=(0, w.unit * 9)),
    "Polynomial": lambda w: exactpt.Polynomial([w.unit] * w.size),
    "PosePath": lambda w: exactpt.PosePath([0, w.unit], [([0, w.unit], [w.unit], [0, 1])]),
    "Proof": lambda w: exactpt.prove(w.scene),
    "Rigid": lambda w: exactpt.Rigid([0, w.unit], pivot=(w.unit, 2)),
    "Scene": lambda w: w.scene,
    "Simulation": lambda w: w.simulation(),
    "Spin": lambda _: exactpt.Spin("1/7", error="1/1000"),
    "Surroundings": lambda w: exactpt.clearance(w.scene, w.mover),
    "Translation": lambda w: w.motion,
    "Units": lambda _: exactpt.Units(length="mm", time="s"),
    "Velocity": lambda w: exactpt.Velocity(w.unit, 1, since=w.unit),
    "certify": lambda w: exactpt.certify(w.scene),
    "union": lambda w: exactpt.union([w.standing], name="one"),
    "clearance": lambda w: exactpt.clearance(w.scene, w.mover, w.wall).minimum,
    "contact_intervals": lambda w: exactpt.contact_intervals(w.scene, w.mover, w.wall),
    "contacts": lambda w: exactpt.contacts(w.scene),
    "distance": lambda w: exactpt.distance(w.scene, w.mover, w.wall, at=0),
    "first_contact": lambda w: exactpt.first_contact(w.curved),
    "first_contact_enclosed": lambda w: exactpt.first_contact_enclosed(w.curved),
    "first_within": lambda w: exactpt.first_within(w.scene, distance="1/2"),
    "from_datetime": lambda _: exactpt.from_datetime(datetime(2026, 1, 1, tzinfo=UTC)),
    "in_local_time": lambda w: exactpt.in_local_time([(w.unit, w.motion), (None, w.motion)]),
    "onward": lambda w: exactpt.onward(w.moving, w.unit, (w.unit, 1)),
    "prove": lambda w: exactpt.prove(w.scene).check(),
    "read_shapes": lambda w: exactpt.read_shapes(w.shapes()),
    "spline": lambda _: exactpt.spline(SimpleNamespace(c=np.zeros((2, 3, 2)), x=np.arange(4.0))),
    "stop": lambda w: list(exactpt.Simulation(w.scene).run(5, on_contact=exactpt.stop)),
    "to_datetime": lambda _: exactpt.to_datetime(1),
    "to_features": lambda w: exactpt.to_features(w.scene, exactpt.contacts(w.scene)),
    "write_shapes": lambda w: exactpt.write_shapes(w.scene, w.folder / "shapes.svg", at=0),
    # exactpt.arrays, exactpt.batch and exactpt.testing
    "arrays.first_contacts": lambda _: arrays.first_contacts(
        np.array([(0.0, 0.0), (1, 0), (3, -1), (3, 1)]), np.array([0, 2, 4]), np.array([(0, 1)]),
        velocities=np.array([(1.0, 0.0), (0, 0)]), time=(0, 10),
    ),
    "arrays.point_segment_contacts": lambda _: arrays.point_segment_contacts(
        np.zeros((1, 2)), np.ones((1, 2)), np.full((1, 2), 2.0)
    ),
    "batch.answers": lambda w: list(batch.answers([json.dumps(w.scene.to_json()).encode()])),
    "batch.run": lambda w: batch.run(lines_file(w), fresh(w, "results.jsonl"), jobs=1),
    "batch.Options": lambda _: batch.Options(),
    "batch.Summary": lambda w: batch.run(lines_file(w), fresh(w, "results.jsonl"), jobs=1),
    "testing.Counterexample": lambda w: checked(w).counterexamples,
    "testing.Moving": lambda w: question(w).a,
    "testing.Question": question,
    "testing.Report": checked,
    "testing.Table": lambda w: checked(w).table,
    "testing.Truth": lambda w: next(iter(exactpt.testing.truths([question(w)]))),
    "testing.assert_same_contact": lambda w: exactpt.testing.assert_same_contact(
        w.scene, exactpt.first_contact(w.scene)
    ),
    "testing.audit": lambda w: exactpt.testing.audit(w.simulation()),
    "testing.check": checked,
    "testing.ending_at": ended,
    "testing.make_question": question,
    "testing.shrink": lambda w: exactpt.testing.shrink(
        w.scene, lambda scene: exactpt.first_contact(scene) is not None
    ),
    "testing.truths": lambda w: list(exactpt.testing.truths([question(w)])),
    # Methods that read or write, and pictures
    "Proof.save": lambda w: exactpt.prove(w.scene).save(w.folder / "a.proof"),
    "Scene.load": lambda w: exactpt.Scene.load(w.file()),
    "Scene.draw": lambda w: w.scene.draw(w.folder / "scene.html"),
    "Scene.to_shapely": lambda w: w.scene.to_shapely(0),
    "Simulation.restore": lambda w: (
        w.simulation().save(w.folder / "run.json"),
        exactpt.Simulation.restore(w.folder / "run.json"),
    )[1],
    "Simulation.tiling": lambda w: w.simulation().tiling,
    "Simulation.max_seconds": lambda w: w.simulation(max_seconds=60, max_memory=10**12),
    # Commands
    "collide": lambda w: command("collide", w.file(), "--json", "--max-seconds", 60),
    "collide --all": lambda w: command("collide", w.file(), "--all"),
    "simulate": lambda w: command("simulate", w.file(), "--events", w.folder / "e.jsonl"),
    "tile": lambda w: command("tile", w.file(), "--at", "1/3"),
    "draw": lambda w: command("draw", w.file(), "-o", w.folder / "scene.svg"),
    "convert": lambda w: command("convert", w.shapes(), w.folder / "converted.json"),
    "generate": lambda _: command("generate", "stars"),
    "batch": lambda w: command("batch", lines_file(w), "-o", fresh(w, "out.jsonl"), "-q"),
    "batch --jobs": lambda w: command(
        "batch", lines_file(w), "-o", fresh(w, "out.jsonl"), "-q", "--jobs", 2
    ),
    "a command that is none": lambda _: command("collate"),
}  # fmt: skip

REFUSED = {
    "a scene that is none": lambda _: exactpt.first_contact(5),
    "a file that is missing": lambda w: exactpt.Scene.load(w.folder / "none.json"),
    "a span that is empty": lambda w: exactpt.Scene([w.moving], time=(w.unit, -w.unit)),
    "a vertex that is none": lambda _: exactpt.Body("a", [(0, "x")]),
    "a budget that is used up": lambda w: exactpt.first_contact(w.scene, max_seconds=0),
    "a run without memory": lambda w: exactpt.Simulation(w.scene, max_memory=1),
    "a file of no format": lambda w: exactpt.read_shapes(w.folder),
    "a proof of another scene": lambda w: exactpt.prove(w.scene)._replace(scene=b"{}").check(),
    "a proof that is none": lambda w: exactpt.prove(w.scene)._replace(text=b"?\n" * 9).check(),
    "an array of no numbers": lambda _: arrays.first_contacts([["x"]], [0], [(0, 1)]),
    "a response that fails": lambda w: list(
        exactpt.Simulation(w.scene).run(9, on_contact=lambda *_: 1 / 0)
    ),
}
