"""Every public question obeys the groups of a scene, or refuses the scene.

Two scenes have bodies that overlap and ignore each other: whoever counts such a pair says that
there is a contact at the start. A question that takes a scene and is not in `QUESTIONS` fails
`test_every_question_about_a_scene_is_known`.
"""

import inspect
import json
from itertools import combinations

import pytest
from click.testing import CliRunner

import exactpt
import exactpt.testing
from exactpt import Body, InputError, Scene, Translation, arrays, batch
from exactpt.cli import all_commands, cli

LEFT = [(0, 0), (2, 0), (2, 2), (0, 2)]
LONG = [(1, 0), (6, 0), (6, 1), (1, 1)]
RIGHT = [(5, 0), (7, 0), (7, 2), (5, 2)]

SCENES = {
    "two": Scene([Body("a", LEFT), Body("b", LONG)], (0, 10), ignoring=[["a", "b"]]),
    # c moves by 1 in a unit of time, and its side at x = 5 meets that of a at x = 2 at t = 3
    "chain": Scene(
        [Body("a", LEFT), Body("b", LONG), Body("c", RIGHT, Translation([0, -1]))],
        (0, 10),
        ignoring=[["a", "b"], ["b", "c"]],
    ),
}
COUNTED = {"two": set(), "chain": {frozenset("ac")}}
"""The pairs that count. Bodies of such a pair come into contact at t = 3."""


def of_contact(contact):
    """Return the pairs of a contact, which is at t = 3."""
    if contact is None:
        return set()
    assert contact.time == 3
    return {frozenset((pair.body, pair.other)) for pair in contact.pairs}


def of_json(contact):
    """Return the same of the JSON of a contact."""
    if contact is None:
        return set()
    assert contact["time"]["low"] == "3"
    return {frozenset((pair["a"]["body"], pair["b"]["body"])) for pair in contact["pairs"]}


def of_intervals(intervals):
    return {frozenset((interval.a, interval.b)) for interval in intervals}


def askable(scene, ask):
    """Return the pairs about which a question of two named bodies gives an answer."""
    found = set()
    for a, b in combinations([body.name for body in scene.bodies], 2):
        try:
            ask(scene, a, b)
        except InputError as error:
            assert f"bodies '{a}' and '{b}' ignore each other in this scene" in str(error)  # noqa: PT017
        else:
            found.add(frozenset((a, b)))
    return found


def surrounded(scene, ask):
    """Return the pairs of a body and one of those that it has around it."""
    found = set()
    for body in scene.bodies:
        try:
            around = ask(scene, body.name)
        except InputError as error:
            assert "ignores all others in this scene" in str(error)  # noqa: PT017
            continue
        assert {interval.b for interval in around.below(99)} == set(around.others)
        assert around.minimum.body == around.nearest(0)[0] == around.others[0]
        found |= {frozenset((body.name, other)) for other in around.others}
    return found


def certified(scene):
    """Return the pairs of which a certificate says something, by its lines."""
    proof = exactpt.certify(scene)
    rows = [line.split() for line in proof.text.decode().splitlines()]
    numbers = range(len(scene.bodies))
    named = [{int(i) for i in row[1:]} for row in rows if row[0] == "between"]
    groups = [{int(i) for i in row[1:]} for row in rows if row[0] == "ignoring"]
    pairs = named or [set(two) for two in combinations(numbers, 2)]
    said = [pair for pair in pairs if not any(pair <= group for group in groups)]
    assert of_contact(proof.contact) <= {frozenset("ac")}
    return {frozenset(scene.bodies[i].name for i in pair) for pair in said}


def compared(scene):
    """The judge of answers takes the answer that obeys, and no contact at the start."""
    right = exactpt.first_contact(scene)
    exactpt.testing.assert_same_contact(scene, right)
    with pytest.raises(AssertionError):
        exactpt.testing.assert_same_contact(scene, {"time": 0.0})
    return of_contact(right)


def truth(scene):
    (found,) = exactpt.testing.truths([scene])
    if found.time is None:
        return set()
    assert found.time == 3
    return {frozenset(found.pair[side]["body"] for side in "ab")}


def first_approach(approach):
    if approach is None:
        return set()
    assert approach.time == "5/2"  # at the distance 1/2
    return {frozenset(pair) for pair in approach.pairs}


def enclosed(bounds):
    return set() if bounds is None else {frozenset(pair) for pair in bounds.pairs}


def of_batch(answer, every):
    assert "error" not in answer, answer
    if every:
        return {frozenset((i["a"], i["b"])) for i in answer["intervals"]}
    return of_json(answer["contact"])


def batched(scene, **options):
    (answer,) = batch.answers([json.dumps(scene.to_json())], batch.Options(**options))
    return of_batch(answer, options.get("every"))


def run_command(folder, scene, name, *arguments):
    """Return the result of a command about the scene in a file."""
    path = folder / "scene.json"
    scene.save(path)
    return CliRunner().invoke(cli, [name, str(path), *map(str, arguments)])


def shown(result):
    """Return the JSON that a command has printed."""
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


def refused(folder, scene, name, *arguments):
    """Raise the error of a command that refuses the scene: `exactpt.cli.main` prints its line."""
    result = run_command(folder, scene, name, *arguments)
    assert isinstance(result.exception, InputError), result.output
    raise result.exception


def batch_command(scene, folder):
    (folder / "scenes.jsonl").write_text(json.dumps(scene.to_json()) + "\n")
    arguments = ["batch", str(folder / "scenes.jsonl"), "-o", str(folder / "out.jsonl"), "-q"]
    assert CliRunner().invoke(cli, arguments).exit_code == 0
    return of_batch(json.loads((folder / "out.jsonl").read_text()), every=False)


def drawn(scene, folder, **options):
    """Draw the bodies at t = 1, which is after a contact at the start if one counted."""
    scene.draw(folder / "picture.svg", at=1, **options)
    return COUNTED["chain" if len(scene.bodies) > 2 else "two"]


def drawn_by_command(scene, folder, *arguments):
    result = run_command(folder, scene, "draw", "--at", 1, "-o", folder / "picture.svg", *arguments)
    if result.exception:
        raise result.exception
    return COUNTED["chain" if len(scene.bodies) > 2 else "two"]


QUESTIONS = {
    "first_contact": lambda s, _: of_contact(exactpt.first_contact(s)),
    "first_contact exact_only": lambda s, _: of_contact(exactpt.first_contact(s, exact_only=True)),
    "first_contact pairs": lambda s, _: of_contact(exactpt.first_contact(s, method="pairs")),
    "first_contact after_start": lambda s, _: of_contact(
        exactpt.first_contact(s, after_start=True)
    ),
    "first_contact since": lambda s, _: of_contact(exactpt.first_contact(s, since=1)),
    "first_contact certificate": lambda s, folder: of_contact(
        exactpt.first_contact(s, certificate=folder / "a.apart")
    ),
    "first_contact_enclosed": lambda s, _: enclosed(exactpt.first_contact_enclosed(s)),
    "first_within": lambda s, _: first_approach(exactpt.first_within(s, distance="1/2")),
    "first_within two": lambda s, _: askable(s, lambda *two: exactpt.first_within(*two, 1)),
    "contacts": lambda s, _: of_intervals(exactpt.contacts(s)),
    "contact_intervals": lambda s, _: askable(s, exactpt.contact_intervals),
    "distance": lambda s, _: askable(s, lambda *two: exactpt.distance(*two, at=0)),
    "clearance": lambda s, _: askable(s, exactpt.clearance),
    "clearance of one": lambda s, _: surrounded(s, exactpt.clearance),
    "Surroundings": lambda s, _: surrounded(s, exactpt.Surroundings),
    "certify": lambda s, _: certified(s),
    "arrays.Contacts": None,  # of arrays: its scenes are made of them, without groups
    "batch.Options.answer": lambda s, _: of_batch(batch.Options().answer(s), every=False),
    "batch.answers": lambda s, _: batched(s),
    "batch.answers every": lambda s, _: batched(s, every=True),
    "testing.assert_same_contact": lambda s, _: compared(s),
    "testing.truths": lambda s, _: truth(s),
    "testing.shrink": lambda s, _: of_contact(
        exactpt.first_contact(exactpt.testing.shrink(s, lambda smaller: smaller == s))
    ),
    "to_features": lambda s, _: {  # shows what it is given
        frozenset((feature["properties"]["a"], feature["properties"]["b"]))
        for feature in exactpt.to_features(s, exactpt.contacts(s))["features"]
    },
    "Scene.draw": drawn,
    "collide": lambda s, folder: of_json(
        shown(run_command(folder, s, "collide", "--json"))["contact"]
    ),
    "collide --all": lambda s, folder: {
        frozenset((i["a"], i["b"]))
        for i in shown(run_command(folder, s, "collide", "--all", "--json"))["intervals"]
    },
    "collide --max-events": lambda s, folder: of_json(
        shown(run_command(folder, s, "collide", "--json", "--max-events", 9))["contact"]
    ),
    "collide --enclosed": lambda s, folder: {
        frozenset(pair)
        for pair in (
            shown(run_command(folder, s, "collide", "--enclosed", "--json"))["enclosed"] or {}
        ).get("pairs", ())
    },
    "batch": batch_command,
    "draw": drawn_by_command,
}  # fmt: skip
"""Each with the pairs that it counts, of a scene and a folder to write into."""

REFUSING = {
    "first_contact kinetic": lambda s, _: exactpt.first_contact(s, method="kinetic"),
    "first_contact tiling": lambda s, _: exactpt.first_contact(s, tiling="greedy"),
    "first_contact proof": lambda s, folder: exactpt.first_contact(s, proof=folder / "a.proof"),
    "prove": lambda s, _: exactpt.prove(s),
    "Simulation": lambda s, _: exactpt.Simulation(s),
    "Scene.draw tiling": lambda s, folder: drawn(s, folder, tiling="mixed"),
    "testing.Question.from_scene": lambda s, _: exactpt.testing.Question.from_scene(s),
    "write_shapes .geojson": lambda s, folder: exactpt.write_shapes(
        s, folder / "shapes.geojson", strict=True
    ),
    "write_shapes .wkt": lambda s, folder: exactpt.write_shapes(
        s, folder / "shapes.wkt", strict=True
    ),
    "write_shapes .svg": lambda s, folder: exactpt.write_shapes(
        s, folder / "shapes.svg", strict=True
    ),
    "write_shapes .mfjson": lambda s, folder: exactpt.write_shapes(
        s, folder / "shapes.mfjson", strict=True
    ),
    "collide --tiling": lambda s, folder: refused(folder, s, "collide", "--tiling", "greedy"),
    "simulate": lambda s, folder: refused(folder, s, "simulate"),
    "tile": lambda s, folder: refused(folder, s, "tile"),
    "check": lambda s, folder: refused(folder, s, "check"),
    "collide --proof": lambda s, folder: refused(folder, s, "collide", "--proof", folder / "p"),
    "convert": lambda s, folder: refused(folder, s, "convert", folder / "a.geojson", "--strict"),
    "draw --tiling": lambda s, folder: drawn_by_command(s, folder, "--tiling", "mixed"),
}


def asked(question):
    """Return the function that an entry of a table is about."""
    return question.split(" ")[0]


def takes_scene(function):
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return False
    return any(word in str(p.annotation) for p in parameters for word in ("Scene", "Asked"))


def public_functions(module, prefix):
    """Yield the public functions, classes and methods of a module, with their names."""
    for name in module.__all__:
        value = getattr(module, name)
        if not callable(value):
            continue
        yield f"{prefix}{name}", value.__init__ if inspect.isclass(value) else value
        if inspect.isclass(value):
            for method in (key for key in vars(value) if not key.startswith("_")):
                if callable(getattr(value, method, None)):
                    yield f"{prefix}{name}.{method}", getattr(value, method)


def test_every_question_about_a_scene_is_known():
    """A new public function, method or command that takes a scene belongs into a table above."""
    modules = {
        "": exactpt, "arrays.": arrays, "batch.": batch, "testing.": exactpt.testing
    }  # fmt: skip
    questions = {
        name
        for prefix, module in modules.items()
        for name, function in public_functions(module, prefix)
        if takes_scene(function)
    }
    arguments = {"scene", "scenes", "source"}
    questions |= {
        name
        for name, command in all_commands().items()
        if arguments & {parameter.name for parameter in command.params}
    }

    assert questions - {asked(name) for name in (*QUESTIONS, *REFUSING)} == set()


@pytest.mark.parametrize("which", SCENES)
@pytest.mark.parametrize("question", [name for name, ask in QUESTIONS.items() if ask])
def test_question_about_a_scene_with_groups_counts_the_pairs_that_count(question, which, tmp_path):
    assert QUESTIONS[question](SCENES[which], tmp_path) == COUNTED[which]


@pytest.mark.parametrize("which", SCENES)
@pytest.mark.parametrize("question", REFUSING)
def test_question_that_cannot_obey_groups_refuses_them_in_one_line(question, which, tmp_path):
    with pytest.raises(InputError, match="ignor") as caught:
        REFUSING[question](SCENES[which], tmp_path)
    assert "\n" not in str(caught.value).strip()
