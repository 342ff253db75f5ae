"""The past of a run: one exact scene, and what happened to its bodies, by hand.

That bodies were where the history has them is the law `simulation/history`.
"""

from fractions import Fraction

import pytest

import exactpt
from exactpt import Body, Bounce, InputError, Pieces, Scene, Simulation, Translation

BALL = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2], [0, "1/3"]))
WALLS = [Body("left", [(-1, -9), (-1, 9)]), Body("right", [(6, -9), (6, 9)])]


def bouncing(until=20):
    simulation = Simulation(Scene([BALL, *WALLS], time=(0, 20)), record=True)
    bounce = Bounce(fixed=["left", "right"])
    return simulation, [event.kind for event in simulation.run(until, on_contact=bounce)]


def test_a_run_that_bounces_is_one_scene_without_contacts():
    simulation, kinds = bouncing()
    history = simulation.history()
    scene = history.scene()

    assert kinds.count("contact") >= 4
    assert [m.kind for m in history.marks].count("contact") == kinds.count("contact")
    plans = [m for m in history.marks if m.kind == "plan"]
    assert [m.bodies for m in plans] == [("ball",)] * kinds.count("contact")
    assert (scene.start, scene.end) == (0, 20)
    assert exactpt.first_contact(scene, method="pairs") is None
    assert simulation.body("ball").at(20) == scene.body("ball").at(20)
    turn = plans[0].time.low
    assert scene.body("ball").at(turn / 2) == BALL.at(turn / 2)


def test_plans_in_pieces_are_cut_to_their_time():
    simulation = Simulation(Scene([BALL], time=(0, 20)), record=True)
    there = [Translation([0, 2], [0, "1/3"]), Translation([6, -1], [0, "1/3"])]
    list(simulation.run(1))
    simulation.set_motion(
        "ball",
        Pieces([("1/2", Translation(["1/2", 1], [0, "1/3"])), (2, there[0]), (None, there[1])]),
    )
    list(simulation.run(3))
    simulation.set_motion("ball", Translation([3], [1]))
    list(simulation.run(5))

    body = simulation.history().scene().body("ball")

    assert body.motion.until == (1, 2, 3)
    for t in (Fraction(1, 2), Fraction(3, 2), Fraction(5, 2), Fraction(7, 2)):
        assert body.at(t)[0] == ((2 * t, t / 3) if t < 2 else (6 - t, t / 3) if t < 3 else (3, 1))


def test_two_plans_at_one_time_are_the_last_one():
    simulation = Simulation(Scene([BALL], time=(0, 20)), record=True)
    list(simulation.run(3))
    simulation.set_motion("ball", Translation([6], [1]))
    simulation.set_motion("ball", Translation([3, 1], [1]))
    list(simulation.run(4))

    history = simulation.history()

    assert [(m.kind, m.bodies) for m in history.marks] == [("plan", ("ball",))]
    assert history.scene().body("ball").at(4)[0] == (7, 1)


def test_comings_and_goings():
    simulation, _ = bouncing(4)
    simulation.add(Body("guest", [(3, 20)]))
    list(simulation.run(5))
    simulation.remove("left")
    list(simulation.run(6))
    simulation.remove("guest")
    simulation.add(Body("guest", [(3, 30), (4, 30)]))
    list(simulation.run(7))
    history = simulation.history()

    spans = {(life.body.name, life.since, life.until) for life in history.lives}
    assert spans == {
        ("ball", 0, 7), ("right", 0, 7), ("left", 0, 5), ("guest", 4, 6), ("guest", 6, 7),
    }  # fmt: skip
    assert [(m.kind, m.time.low) for m in history.marks if m.kind in {"arrival", "departure"}] == [
        ("arrival", 4), ("departure", 5), ("departure", 6), ("arrival", 6),
    ]  # fmt: skip
    assert not history.is_scene
    with pytest.raises(InputError, match="'left' was there from t = 0 to t = 5 only"):
        history.scene()


def test_a_plan_of_another_shape_is_another_life():
    simulation = Simulation(Scene([BALL], time=(0, 20)), record=True)
    list(simulation.run(3))
    simulation.set_motion("ball", Body("ball", [(6, 1), (7, 1), (6, 2)]))
    list(simulation.run(4))

    lives = simulation.history().lives

    assert [(life.body.name, life.since, life.until) for life in lives] == [
        ("ball", 0, 3), ("ball", 3, 4),
    ]  # fmt: skip


def test_a_contact_that_ends_the_run_is_that_of_the_scene():
    simulation = Simulation(Scene([BALL, *WALLS], time=(0, 20)), record=True)
    list(simulation.run())
    history = simulation.history()

    assert history.contact is simulation.contact
    again = exactpt.first_contact(history.scene())
    assert again.to_json() == simulation.contact.to_json()
    assert [m.kind for m in history.marks] == ["contact"]


def test_what_is_not_remembered_is_refused():
    simulation = Simulation(Scene([BALL], time=(0, 20)))
    with pytest.raises(InputError, match="record=True"):
        simulation.history()
    with pytest.raises(InputError, match="no time has passed"):
        Simulation(Scene([BALL], time=(0, 20)), record=True).history().scene()
    recorded, _ = bouncing(3)
    with pytest.raises(InputError, match="record=True"):
        recorded.copy().history()
