"""Running: steps, contacts, responses, and questions on the way, by hand.

That it does not matter where a run is stopped is the law `simulation/stops`.
"""

import json
from fractions import Fraction

import pytest

from exactpt import (
    Body,
    BudgetExceeded,
    InputError,
    Pieces,
    Scene,
    Simulation,
    Translation,
    stop,
)
from exactpt.testing.scenes import generate

TILINGS = ("greedy", "lazy", "mixed")


def meeting(gap=4):
    """Two segments; one reaches the other after ``gap``."""
    return Scene(
        [
            Body("a", [(0, 0), (0, 2)], Translation([0, 1])),
            Body("b", [(gap, 1), (gap + 1, 1)]),
            Body("c", [(2, 5), (3, 5), (2, 6)]),
        ],
        (0, 9),
    )


def two_points():
    """A point that meets another one at t = 3."""
    return Scene([Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(3, 0)])], (0, 10))


@pytest.mark.parametrize("tiling", TILINGS)
def test_run_ends_with_the_contact_and_stays_there(tiling):
    simulation = Simulation(meeting(), tiling=tiling)

    events = list(simulation.run())

    assert events[-1].kind == "contact"
    assert simulation.now == simulation.contact.time == 4
    assert list(simulation.run()) == simulation.step() == []
    assert simulation.run_to_contact() is simulation.contact
    with pytest.raises(InputError, match="one before it, where run"):
        simulation.snapshot()


def test_run_until_a_time_beyond_the_end_stops_at_the_end():
    simulation = Simulation(meeting(20))

    list(simulation.run(1000))

    assert simulation.now == 9
    assert simulation.contact is None
    assert simulation.snapshot().at == 9


def test_run_until_a_time_that_is_over_is_refused():
    simulation = Simulation(meeting(20))
    list(simulation.run("1/2"))

    with pytest.raises(InputError, match="is over"):
        list(simulation.run("1/4"))

    assert simulation.now == Fraction(1, 2)
    assert list(simulation.run("1/2")) == []


def test_bodies_that_touch_at_the_start_are_an_initial_contact():
    simulation = Simulation(meeting(0))

    assert simulation.now == 0
    assert [event.kind for event in simulation.run()] == ["contact"]
    assert list(simulation.run()) == []
    assert simulation.contact.kind == "initial"
    assert simulation.stats["events"] == 0
    assert simulation.body("b").size == 2


def test_events_are_json():
    events = [event.to_json() for event in Simulation(meeting()).run()]

    assert json.loads(json.dumps(events)) == events
    assert {"time", "kind", "removed", "added"} == set(events[0])


# Responses


@pytest.mark.parametrize("margin", [None, "1/2", "1/3", Fraction(1, 2**2000)])
def test_time_of_a_response_is_before_the_contact_by_at_most_the_margin(margin):
    """By default 2^-80 of the span of 10: less than 2^-70."""
    times = []

    def respond(simulation, contact):
        times.append(simulation.now.low)
        simulation.set_motion("a", Translation([2 * simulation.now.low, -1]))

    run = Simulation(two_points()).run(on_contact=respond, margin=margin)

    assert [event.kind for event in run] == ["contact", "motion"]
    assert 0 < 3 - times[0] <= (Fraction(1, 2**70) if margin is None else Fraction(margin))


def test_margin_that_is_not_positive_is_refused():
    with pytest.raises(InputError, match="margin"):
        next(Simulation(two_points()).run(margin=0))


def test_contact_without_new_motions_ends_the_run():
    contacts = []
    simulation = Simulation(two_points())
    events = list(simulation.run(on_contact=lambda _, contact: contacts.append(contact)))

    assert [event.kind for event in events] == ["contact"]
    assert simulation.now == simulation.contact.time == contacts[0].time == 3
    assert simulation.contacts == 1
    assert list(simulation.run()) == simulation.step() == []


def test_new_motion_of_another_body_does_not_keep_a_contact_away():
    scene = two_points()
    simulation = Simulation(Scene([*scene.bodies, Body("far", [(90, 0)])], scene.time))
    contacts = []

    def look_elsewhere(run, contact):
        contacts.append(contact)
        run.set_motion("far", Translation())

    list(simulation.run(on_contact=look_elsewhere))

    assert len(contacts) == simulation.contacts == 1
    assert simulation.contact.time == 3
    assert simulation.body("far").name == "far"
    with pytest.raises(InputError, match="no body 'owl'"):
        simulation.body("owl")


def test_body_that_stops_stays_there():
    simulation = Simulation(two_points())

    kinds = [event.kind for event in simulation.run(on_contact=stop)]

    assert kinds == ["contact", "motion", "motion"]
    assert simulation.now == 10
    gap = 3 - simulation.scene.at(10)["a"][0][0]
    assert 0 < gap < Fraction(1, 2**70)


def test_new_motions_that_lead_to_the_same_contact_again_end_by_the_budget():
    def closer(simulation, contact):
        assert simulation.now < 3
        simulation.set_motion("a", Translation([0, 1]))

    simulation = Simulation(two_points(), max_events=50)
    with pytest.raises(BudgetExceeded) as spent:
        list(simulation.run(on_contact=closer))
    assert spent.value.reached < 3


@pytest.mark.parametrize("tiling", TILINGS)
def test_contact_at_a_breakpoint_can_be_gone_back_from(tiling):
    """AuditError: there was no contact to go back from; a second look had found it.

    The chain moves by (1 - t)^2 to the right and by -t up: its end (0, -2) is at (0, -3) at t = 1.
    """
    motion = Translation([1, -2, 1], [0, -1])
    chain = Body(
        "g", [(0, 0), (3, 0), (0, -2)], Pieces([(1, motion), (None, motion)]), closed=False
    )
    scene = Scene([chain, Body("o", [(0, -3), (0, -4)])], (0, 3))

    simulation = Simulation(scene, tiling=tiling)
    events = list(simulation.run(on_contact=stop))

    assert [event.time for event in events if event.kind == "contact"] == [1]
    assert simulation.contact is None


# Questions on the way


def test_questions_of_a_simulation_are_those_of_its_space():
    boxes = [Body(f"b{i}", [(4 * i, 0), (4 * i + 2, 0), (4 * i + 2, 2)]) for i in range(3)]
    simulation = Simulation(Scene(boxes, (0, 1)))

    assert simulation.locate((1, "1/2")).body == "b0"
    assert simulation.ray_cast((3, 1), (1, 0)).body == "b1"
    assert not simulation.is_free((3, 1), (7, 1))
    assert simulation.path((3, 1), (7, 1)).bends in ((("b1", 0), ("b1", 1)), (("b1", 2),))
    assert simulation.shortest_path((3, 1), (3, "3/2")).length == 0.5
    assert simulation.shorten([(3, 1), (3, "3/2")]).length == 0.5
    assert len(simulation.hull()) == 9
    assert simulation.relative_hull("b1") == [("b1", 0), ("b1", 1), ("b1", 2)]
    assert simulation.neighbours("b0") == ["b1"]
    assert simulation.tiling == simulation.snapshot()


def test_space_after_the_next_event_is_refused():
    scene = generate("convex", 3)
    simulation = Simulation(scene)
    simulation.step()

    with pytest.raises(InputError, match="next event"):
        simulation.space(scene.end)


def test_space_is_built_once_for_a_time():
    simulation = Simulation(meeting())
    list(simulation.run("1/3"))

    space = simulation.space()

    assert space.at == Fraction(1, 3)
    assert space is simulation.space() is simulation.space("1/3")
    assert space.locate(("1/3", 1)).body == "a"


def test_space_at_an_irrational_time_is_refused():
    """The point (t, 10 + t - t^2) is on the line y = 7 of the others at t = (1 + sqrt 13) / 2."""
    fall = Body("fall", [(0, 9)], Translation([0, 1], [1, 0, -1]))
    simulation = Simulation(Scene([fall, Body("low", [(0, 7)]), Body("high", [(6, 7)])], (0, 3)))
    while simulation.now.is_rational:
        assert simulation.step()

    for question in (simulation.snapshot, lambda: simulation.locate((0, 0))):
        with pytest.raises(InputError, match="is not rational: give a rational time after it"):
            question()


@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("run_out", [Simulation.run_to_contact, lambda s: list(s.run())])
def test_tiling_at_a_contact_at_an_irrational_time_is_refused(tiling, run_out):
    """The vertex (0, 1 + t^2) meets the line y = 3 at t = sqrt 2: no tiling holds there."""
    rising = Body("rising", [(0, 0), (1, 0), (0, 1)], Translation([0], [0, 0, 1]))
    wall = Body("wall", [(-9, 3), (9, 3), (0, 4)])
    simulation = Simulation(Scene([rising, wall], (0, 3)), tiling=tiling)
    run_out(simulation)

    assert simulation.now.polynomial == (-2, 0, 1)
    for question in (lambda: simulation.tiling, simulation.snapshot, simulation.space):
        with pytest.raises(InputError, match=r"no tiling: the first contact is at t = 1\.41421356"):
            question()


@pytest.mark.parametrize("tiling", ["lazy", "mixed"])
def test_space_is_of_its_time_or_says_that_it_cannot_be(tiling):
    """The box leaves the cup. The loop around the cup is of a mixed tiling, made when asked for."""
    cup = [(0, 0), (9, 0), (9, 8), (8, 8), (8, 1), (1, 1), (1, 8), (0, 8)]
    jump = Pieces([(2, Translation()), (None, Translation(0, [-80, 40]))])
    box = Body("box", [(4, 3), (5, 3), (5, 4), (4, 4)], jump)
    scene = Scene([Body("cup", cup), box], (0, 3))
    asked, kept = (Simulation(scene, tiling=tiling) for _ in range(2))
    spaces = []
    for simulation in (asked, kept):
        list(simulation.run(1))
        spaces.append(simulation.space())
    hull = spaces[0].relative_hull("cup")
    for simulation in (asked, kept):
        list(simulation.run("5/2"))

    assert asked.space("5/2").relative_hull("cup") != hull
    assert spaces[0].relative_hull("cup") == hull
    if tiling == "mixed":
        assert spaces[1].relative_hull("cup") == hull
    else:
        with pytest.raises(InputError, match="make the space anew"):
            spaces[1].relative_hull("cup")
