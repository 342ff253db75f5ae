"""Files of runs: what is in them, and what forged ones do.

That a restored run goes on as if nothing had happened are the laws `simulation/restored` and
`simulation/events`.
"""

import json
import time
from contextlib import suppress
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest

from exactpt import (
    AlgebraicNumber,
    Body,
    BudgetExceeded,
    ExactPTError,
    InputError,
    Scene,
    Simulation,
)
from exactpt.simulation.saved import number_to_json
from exactpt.simulation.store import sealed
from exactpt.testing.scenes import generate


def line(event):
    return json.dumps(event.to_json())


def test_a_file_that_is_saved_twice_is_the_same(tmp_path):
    simulation = Simulation(generate("stars", 2))
    for _ in range(5):
        simulation.step()
    simulation.save(tmp_path / "one.json")
    Simulation.restore(tmp_path / "one.json").save(tmp_path / "two.json")

    assert (tmp_path / "one.json").read_bytes() == (tmp_path / "two.json").read_bytes()


@pytest.mark.parametrize("exact_only", [False, True])
def test_bug_file_depended_on_comparisons_of_the_time_of_the_run(exact_only):
    """A comparison refines the number of the time, which is then in the file of the run.

    After five steps of these mills the time is a root of a polynomial of degree 7, 0.233...
    """
    untouched, compared = (
        Simulation(generate("mills", 1), exact_only=exact_only) for _ in range(2)
    )
    for run in (untouched, compared):
        for _ in range(5):
            run.step()

    middle = (compared.now.low + compared.now.high) / 2

    assert compared.now != middle
    assert not compared.now.is_rational
    assert compared.now.high - compared.now.low < untouched.now.high - untouched.now.low
    assert compared.to_json() == untouched.to_json()


def test_time_that_is_saved_is_the_same_whether_it_is_known_to_be_rational():
    """(2 t - 1)(t^2 + 1), of which 1/2 is the only root: known after a comparison with 1/2."""
    known, unknown = (AlgebraicNumber.root((-1, 2, -1, 2), 0, "2/3") for _ in range(2))

    assert (known == Fraction(1, 2), unknown.is_rational) == (True, False)

    rational = {"polynomial": ["-1", "2"], "low": "1/2", "high": "1/2"}
    assert number_to_json(known) == number_to_json(unknown) == rational


def test_bug_unused_vertices_of_a_restored_run_have_a_name(tmp_path):
    """IndexError: their body was the first one of none."""
    simulation = Simulation(generate("convex", 2), tiling="greedy")
    simulation.remove(simulation.scene.bodies[0].name)
    simulation.save(tmp_path / "run.json")
    vertices = Simulation.restore(tmp_path / "run.json").kinetic.vertices

    assert vertices.free
    assert {vertices.name(v) for v in vertices.free} == {":-1"}


def test_a_contact_at_the_start_is_saved(tmp_path):
    scene = Scene([Body("a", [(0, 0), (2, 0), (0, 2)]), Body("b", [(1, 0), (3, 0), (3, 2)])])
    simulation = Simulation(scene)
    simulation.save(tmp_path / "run.json")
    again = Simulation.restore(tmp_path / "run.json")

    assert [line(e) for e in again.run()] == [line(e) for e in simulation.run()]
    assert again.contact.kind == "initial"


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"exactpt-simulation": 1}', '{"exactpt-simulation": 6}',
     '{"exactpt-simulation": 6, "tiling": "auto", "exact_only": false, "scene": {}}',
     "[" * 100_000, '{"a":' * 100_000, '{"exactpt-simulation": ' + "[" * 900 + "]" * 900 + "}",
     '{"exactpt-simulation": ' + "7" * 10_000 + "}"],
    ids=lambda text: text[:60],
)  # fmt: skip
def test_other_files_are_refused(text, tmp_path):
    path = tmp_path / "run.json"
    path.write_text(text)
    with pytest.raises(InputError, match=r"run\.json"):
        Simulation.restore(path)
    with pytest.raises(InputError, match="cannot be read"):
        Simulation.restore(tmp_path / "none.json")


def test_the_previous_version_is_refused_by_its_number(tmp_path):
    data = Simulation(generate("stars", 2)).to_json()
    (tmp_path / "run.json").write_text(json.dumps(data | {"exactpt-simulation": 5}))

    with pytest.raises(InputError, match="this version reads simulations 6, not 5"):
        Simulation.restore(tmp_path / "run.json")


def places(data, path=()):
    """The places of all values that contain no others."""
    if isinstance(data, (dict, list)):
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            yield from places(value, (*path, key))
    else:
        yield path


def changed(data, path, value):
    """A copy with another value at a place."""
    copy = json.loads(json.dumps(data))
    at = copy
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = value
    return copy


def test_a_changed_file_is_refused(tmp_path):
    """Every value is changed, one at a time; spaces are not part of the values."""
    simulation = Simulation(generate("convex", 2), tiling="greedy")
    for _ in range(3):
        simulation.step()
    data, path = simulation.to_json(), tmp_path / "run.json"
    found = list(places(data))
    path.write_text(json.dumps(data, indent=3))
    assert Simulation.restore(path).to_json() == data
    for place in [*found[:20], *Random(1).sample(found, 100)]:
        path.write_text(json.dumps(changed(data, place, "altered")))
        with pytest.raises(InputError, match=r"checksum mismatch|reads simulations 6"):
            Simulation.restore(path)


def without_seal(data):
    """The data without version and checksum."""
    return {k: v for k, v in data.items() if k not in {"exactpt-simulation", "sha256"}}


def assert_refused(folder, data, message):
    """A file with these data and a checksum of its own is refused."""
    (folder / "run.json").write_text(json.dumps(sealed(data)))
    with pytest.raises(InputError, match=message):
        Simulation.restore(folder / "run.json")


@pytest.mark.long
@pytest.mark.parametrize("value", ["2", 2, -1, 1e300, None, [], {}, "1e99999", "x", True])
def test_a_forged_file_is_refused_or_keeps_its_budget(tmp_path, value):
    """With a checksum of its own: one value of the state is another one."""
    simulation = Simulation(generate("convex", 2), tiling="greedy")
    for _ in range(3):
        simulation.step()
    whole, path = without_seal(simulation.to_json()), tmp_path / "run.json"
    for place in Random(str(value)).sample(list(places(whole)), 60):
        path.write_text(json.dumps(sealed(changed(whole, place, value))))
        with suppress(InputError):
            Simulation.restore(path, max_seconds=5)


NUMBERS = [-1, 2**31, 2**70, -(10**400), 1e308, float("nan"), True, None, "x", "1e99999",
           "9" * 4000, {}, [[[0]]]]  # fmt: skip


@pytest.mark.long("5")
@pytest.mark.parametrize(
    "family, seed, tiling",
    [("convex", 2, "greedy"), ("stars", 2, "greedy"), ("stars", 2, "mixed"), ("stars", 3, "lazy"),
     ("linear_points", 4, "incremental")],
)  # fmt: skip
def test_forged_values_are_refused_by_key_or_keep_the_budget(tmp_path, family, seed, tiling):
    """Of values at 120 places that are junk, with a valid checksum; a run may break an invariant.

    Nothing but an `ExactPTError` leaves the restored run, and no value takes more than its budget.
    """
    simulation = Simulation(generate(family, seed), tiling=tiling)
    for _ in range(3):
        simulation.step()
    whole, path, rng = without_seal(simulation.to_json()), tmp_path / "run.json", Random(seed)
    state = [place for place in places(whole) if place[0] != "scene"]
    refused = []
    for place in rng.sample(state, 120):
        path.write_text(json.dumps(sealed(changed(whole, place, rng.choice(NUMBERS)))))
        began = time.process_time()
        try:
            for _ in Simulation.restore(path, max_seconds=2, max_events=50).run():
                pass
        except InputError as error:
            refused.append(str(error))
        except ExactPTError:  # a wrong enclosure, for example, is noticed when it is needed
            pass
        assert time.process_time() - began < 5
    assert len(refused) > 60
    assert all(line.startswith(f"{path}: ") and len(line) < 500 for line in refused)


@pytest.mark.parametrize(
    "key, value, message",
    [
        ("x", ["1e99999", "2"], r'"x"\[0\]: expected a rational as text, "p" or "p/q", got \'1e9'),
        ("x", ["2", "1"], '"x": expected two numbers that do not decrease'),
        ("y", ["1"], '"y": expected a list of 2 entries'),
        ("span", [0, 1], r'"span"\[0\]: expected a rational as text'),
        ("scale", [10**6, 10**6], "unknown key 'scale'"),
        ("time_scale", 10**18, "unknown key 'time_scale'"),
        ("errors", [-1.0], r'"errors"\[0\]: expected a double from 0'),
    ],
)
def test_numbers_of_the_normalisation_are_checked(tmp_path, key, value, message):
    """Exponents of a forged file aborted the process: gmp has no larger numbers."""
    data = without_seal(Simulation(generate("convex", 2), tiling="greedy").to_json())
    data["state"]["frame"][key] = value
    assert_refused(tmp_path, data, message)


@pytest.mark.parametrize("digits", [1000, 4000])
def test_exponents_of_the_normalisation_are_bounded_by_the_digits_read(tmp_path, digits):
    """10^n needs n digits in the file, and its exponent is at most 10 n / 3: it fits in memory."""
    data = without_seal(Simulation(generate("convex", 2), tiling="greedy").to_json())
    data["state"]["frame"]["x"] = ["0", "1" + "0" * digits]
    (tmp_path / "run.json").write_text(json.dumps(sealed(data)))

    simulation = Simulation.restore(tmp_path / "run.json", max_seconds=5)

    assert simulation.kinetic.vertices.normalization.scale[0] < 10 * digits / 3 + 2


def test_key_that_is_there_twice_is_refused(tmp_path):
    """The second value would be taken, and the checksum is about that."""
    path = tmp_path / "run.json"
    Simulation(generate("convex", 2)).save(path)
    path.write_text(path.read_text().replace('"contact": null', '"contact": 1, "contact": null'))

    with pytest.raises(InputError, match="the key 'contact' is there twice"):
        Simulation.restore(path)


def test_a_far_end_is_refused(tmp_path):
    """The run went on to the end of the tiling, and asked for no deadline on the way."""
    simulation = Simulation(generate("convex", 2), tiling="greedy")
    data = without_seal(simulation.to_json())
    assert_refused(
        tmp_path,
        changed(data, ("state", "end"), "1" + "0" * 99),
        r"run\.json: .*the tiling ends at t = 10*\.\.\.",
    )


@pytest.mark.parametrize("slot", [-1, 10**12, 2**70])
def test_a_certificate_of_nothing_is_refused(tmp_path, slot):
    """The queue would have room for all certificates up to it."""
    data = without_seal(Simulation(generate("convex", 2), tiling="greedy").to_json())
    assert_refused(
        tmp_path,
        changed(data, ("state", "queue", 0, 0), slot),
        r'"queue"\[0\]\[0\]: expected (a certificate of this tiling|an integer from 0), got -?\d+',
    )


def test_roots_of_more_than_three_vertices_are_refused(tmp_path):
    """The fourth number would be taken for an exact time."""
    data = without_seal(Simulation(generate("convex", 2), tiling="greedy").to_json())
    assert_refused(
        tmp_path, changed(data, ("state", "roots_now"), [[0, 1, 2, 3]]), "a list of 3 entries"
    )


@pytest.mark.parametrize(
    "place, value, message",
    [
        (("order", 2), 1, "does not have every point once"),
        (("parents", 0, 1), 5, "point . hangs on none to its left"),
        (("parents", 1, 3), -1, "point . hangs on none to its left"),
    ],
)
def test_bug_points_that_hang_in_a_circle_are_refused(tmp_path, place, value, message):
    """A walk along the tree had no end, and asked for no deadline; the hostile fuzzer found it."""
    data = without_seal(Simulation(generate("linear_points", 4)).to_json())
    assert data["state"]["structure"]["order"] == [2, 1, 0, 3, 5, 6, 4]
    assert_refused(tmp_path, changed(data, ("state", "structure", *place), value), message)


@pytest.mark.parametrize(
    "place, value, message",
    [
        ((1, "ring", 0, 0), -1, r'"ring"\[0\]\[0\]: expected an integer from 0, got -1'),
        ((1, "ring", 0, 0), 1, "a vertex is there twice, or not at all"),
        ((1, "ring", 2, 1), 0, "expected the vertices of body 'b1' in order"),
    ],
)
def test_bug_rings_without_all_vertices_are_refused(tmp_path, place, value, message):
    """A tiling was built anew from faces that never closed; the hostile fuzzer found it."""
    data = without_seal(Simulation(generate("convex", 2), tiling="greedy").to_json())
    assert_refused(tmp_path, changed(data, ("state", "bodies", *place), value), message)


@pytest.mark.parametrize(
    "number",
    [
        {"polynomial": ["-2", "0", "1"], "low": "2", "high": "3"},
        {"polynomial": ["-2", "0", "1"], "low": "-2", "high": "2"},
        {"polynomial": ["-2", "0", "1"], "low": "2", "high": "1"},
        {"polynomial": ["4", "0", "-4", "0", "1"], "low": "1", "high": "2"},
        {"polynomial": ["-2", "1"], "low": "3", "high": "3"},
        {"polynomial": [], "low": "1", "high": "2"},
    ],
    ids=["none", "two", "no interval", "a double one", "another number", "of nothing"],
)
def test_bug_times_that_are_no_roots_are_refused(tmp_path, number):
    """Their refinement had no end, after the last event, where no deadline was asked for."""
    simulation = Simulation(generate("convex", 2), tiling="greedy")
    simulation.step()
    data = without_seal(simulation.to_json())
    assert_refused(
        tmp_path,
        changed(data, ("state", "now", "exact"), number),
        "expected a polynomial with one root between low and high",
    )


@pytest.mark.long
def test_bug_repairs_of_forged_points_keep_their_budget():
    """The hostile fuzzer found it: a point is elsewhere than its tangents say, for ever."""
    forged = Path(__file__).parents[2] / "data" / "golden" / "forged_points.json"
    simulation = Simulation.restore(forged, max_seconds=0.5)

    with pytest.raises(BudgetExceeded):
        simulation.run_to_contact()


def test_the_size_of_a_file_is_bounded(tmp_path):
    Simulation(generate("stars", 2)).save(tmp_path / "run.json")

    with pytest.raises(InputError, match="more than 100 bytes"):
        Simulation.restore(tmp_path / "run.json", max_bytes=100)


@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
def test_each_mark_of_an_edge_is_that_of_the_rings(tmp_path, tiling):
    """A diagonal taken for the edge of a body, or an edge for a diagonal, gave other events."""
    data = without_seal(Simulation(generate("convex", 2), tiling=tiling).to_json())
    mesh = data["state"]["mesh"]
    for edge, is_marked in enumerate(mesh["boundary"]):
        if mesh["origin"][2 * edge] >= 0:
            forged = changed(data, ("state", "mesh", "boundary", edge), 1 - is_marked)
            assert_refused(tmp_path, forged, r'"boundary": expected 1 for the edges of bodies')


def test_a_certificate_that_is_twice_in_the_queue_is_refused(tmp_path):
    """One of them replaced the other; the part that lost its certificate failed unseen."""
    data = without_seal(Simulation(generate("convex", 2), tiling="greedy").to_json())
    (first, _), *_ = data["state"]["queue"]
    forged = changed(data, ("state", "queue", 1, 0), first)

    assert_refused(tmp_path, forged, r'"queue"\[1\]\[0\]: expected a certificate that is in the')
