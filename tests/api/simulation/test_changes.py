"""New motions, and bodies that come and go, by hand; the laws `simulation/population` have more."""

from fractions import Fraction

import pytest

from exactpt import Body, InputError, Scene, Simulation, Translation, onward
from exactpt.testing import audit

TILINGS = ("greedy", "lazy", "mixed")


@pytest.mark.parametrize("tiling", TILINGS)
def test_body_added_in_a_hole_that_soon_leaves_through_the_wall_touches_it(tiling):
    """From (0, 0) with velocity (1, 0) to the edge x = 1: at t = 1.

    The mixed tiling was built anew at a time when the point was inside the plate, where nothing
    is tiled: the point was connected to nothing, and the contact was missed.
    """
    wide, narrow = (
        [(-90, -90), (90, -90), (90, 90), (-90, 90)],
        [(-1, -1), (1, -1), (1, 1), (-1, 1)],
    )
    simulation = Simulation(Scene([Body("plate", wide, holes=[narrow])], (0, 20)), tiling=tiling)

    simulation.add(Body("point", [(0, 0)], Translation([0, 1])))

    audit(simulation)
    assert simulation.neighbours("point") == ["plate"]
    assert simulation.run_to_contact().time == 1


def two_boxes():
    left = Body("left", [(0, 0), (1, 0), (1, 1), (0, 1)], Translation([0, 1]))
    right = Body("right", [(9, 0), (10, 0), (10, 1), (9, 1)])
    return Simulation(Scene([left, right], (0, 100)))


def at(simulation, t):
    for _ in simulation.run(t):
        pass
    return simulation


# New motions


def test_contact_after_a_new_motion_is_exact():
    """From 2 at speed 1/3: at 9 - 1 after 18 more."""
    simulation = at(two_boxes(), 2)
    simulation.set_motion("left", Translation(["4/3", "1/3"]))

    assert simulation.run_to_contact().time == 20
    assert simulation.contact.kind == "vertex-vertex"
    assert [event.kind for event in simulation.run()] == ["motion", "contact"]


def test_motion_that_jumps_is_refused():
    simulation = at(two_boxes(), 2)
    with pytest.raises(InputError, match=r"vertex 0 jumps at t = 2 from \(2, 0\) to \(0, 0\)"):
        simulation.set_motion("left", Translation())
    simulation.set_motion("left", Translation([2]))
    assert simulation.run_to_contact() is None


def test_motions_of_other_bodies_are_refused():
    simulation = at(two_boxes(), 2)
    with pytest.raises(InputError, match="no body 'middle'"):
        simulation.set_motion("middle", Translation())
    with pytest.raises(InputError, match="is not a motion of"):
        simulation.set_motion("left", Body("left", [(0, 0), (1, 0), (1, 1)]))


def test_motion_after_a_contact_is_refused():
    simulation = at(two_boxes(), 100)
    with pytest.raises(InputError, match="ended with a contact"):
        simulation.set_motion("left", Translation())


def test_motion_at_an_irrational_time_or_at_the_end_is_refused():
    """The point (t, 10 + t - t^2) is on the line y = 7 of the others at t = (1 + sqrt 13) / 2."""
    fall = Body("fall", [(0, 9)], Translation([0, 1], [1, 0, -1]))
    simulation = Simulation(Scene([fall, Body("low", [(0, 7)]), Body("high", [(6, 7)])], (0, 3)))
    while simulation.now.is_rational:
        assert simulation.step()

    with pytest.raises(InputError, match="rational times only"):
        simulation.set_motion("low", Translation())
    with pytest.raises(InputError, match="end of the time span"):
        at(simulation, 3).set_motion("low", Translation())


def test_contacts_are_not_proved_beyond_a_change():
    """Events are looked for up to t = 100 before the point comes at 99."""
    points = Scene([Body(str(i), [(i, i * i)]) for i in range(9)], (0, 100))
    simulation = at(Simulation(points), 99)
    simulation.add(Body("more", [(50, -50)]))

    assert simulation.passed() <= simulation.now.low == 99


@pytest.mark.parametrize("tiling", TILINGS)
def test_many_new_motions_of_one_body_leave_the_last_one(tiling):
    """Motions that no body has any more are forgotten. At speed 1 it is at 8 at t = 8."""
    simulation = at(two_boxes(), 2)
    for k in range(200):
        simulation.set_motion("left", Translation([2 - 2 * k, k], [0]))  # all are at 2 at t = 2
    simulation.set_motion("left", Translation([0, 1]))

    audit(simulation)
    assert simulation.run_to_contact().time == 8


# Bodies that come and go


def test_body_that_touches_another_one_is_not_added():
    simulation = at(two_boxes(), 2)
    with pytest.raises(InputError, match="body 'new' touches body 'left' at t = 2"):
        simulation.add(Body("new", [(3, 0), (4, -1), (4, 1)]))
    with pytest.raises(InputError, match="taken"):
        simulation.add(Body("left", [(30, 0)]))
    with pytest.raises(InputError, match="not a simple polygon"):
        simulation.add(Body("bow", [(30, 0), (40, 1), (40, 0), (30, 1)]))
    simulation.add(Body("new", [(5, 0)]))
    assert simulation.run_to_contact().time == 4


@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize(
    ("vertices", "other"),
    [
        ([(3, 3), (5, 3), (5, 5), (3, 5)], "dot"),
        ([(4, 4)], "dot"),
        ([(4, 3), (4, 5)], "dot"),
        ([(8, 5)], "ring"),
        ([(-1, -1), (10, -1), (10, 10), (-1, 10)], "ring"),
        ([("17/2", 4), ("35/4", 4), ("35/4", 5)], "ring"),
        ([(5, 5), (20, 5)], "ring"),
    ],
    ids=["around", "on it", "across", "on an edge", "around all", "inside", "through a wall"],
)
def test_body_around_on_or_inside_another_one_is_not_added(tiling, vertices, other):
    ring = Body("ring", [(0, 0), (9, 0), (9, 9), (0, 9), (0, 8), (8, 8), (8, 1), (0, 1)])
    simulation = Simulation(Scene([ring, Body("dot", [(4, 4)])], (0, 9)), tiling=tiling)

    with pytest.raises(InputError, match=f"body 'new' touches body '{other}' at t = 0"):
        simulation.add(Body("new", vertices))

    simulation.add(Body("fits", [(-5, 5), (5, 5)]))
    audit(simulation)
    assert [body.name for body in simulation.scene.bodies] == ["ring", "dot", "fits"]


@pytest.mark.parametrize("tiling", TILINGS)
def test_last_body_goes_and_others_come(tiling):
    simulation = Simulation(Scene([Body("a", [(0, 0), (2, 0), (0, 2)])], (0, 9)), tiling=tiling)
    simulation.remove("a")
    assert simulation.scene.bodies == ()
    assert not simulation.tiling.edges
    audit(simulation)
    at(simulation, 1)
    for name, x in (("b", 0), ("c", 5), ("d", -5)):
        simulation.add(Body(name, [(x, 0), (x + 2, 0), (x, 2)], Translation([0], [0, x])))
        audit(simulation)
    assert simulation.locate(("1/2", "1/2")).body == "b"
    assert simulation.neighbours("b") == ["c", "d"]


def test_tiling_for_any_bodies_stays_when_the_one_that_is_not_convex_has_gone():
    chevron = [(20, 0), (28, 0), (21, 1), (20, 8)]
    simulation = two_boxes()
    assert simulation.stats["why"] == "all bodies stay convex"

    simulation.add(Body("chevron", chevron))
    assert simulation.stats["why"] == "body 'chevron' need not stay convex"
    simulation.remove("chevron")

    assert simulation.stats["tiling"] == simulation.name == "mixed"
    assert simulation.stats["why"] == "mixed is for any bodies"
    audit(simulation)


@pytest.mark.parametrize(
    "outline, rebuilds",
    [([(0, 0), (4, 0), (0, 4)], 0), ([(0, 0), (8, 0), (1, 1), (0, 8)], 1)],
    ids=["ids used again", "built anew"],
)
def test_names_in_an_event_are_those_of_then(outline, rebuilds):
    """They are read when "old" is gone, and a new body may have the numbers of its vertices."""

    def run():
        bodies = [
            Body("old", [(0, 0), (4, 0), (0, 4)], Translation([0, 1])),
            Body("far", [(9, 30), (13, 30), (9, 34)], Translation([0, "1/3"], [30, 0, -1])),
            Body("high", [(-9, 60), (-5, 60), (-9, 64)], Translation([0, "7/3"])),
        ]
        simulation = Simulation(Scene(bodies, (0, 20)))
        yield from simulation.run(3)
        simulation.remove("old")
        yield from simulation.run(4)
        simulation.add(Body("new", [(x - 200, y) for x, y in outline], Translation([0, 9])))
        assert simulation.stats["rebuilds"] == rebuilds
        yield from simulation.run(8)

    at_once = [event.to_json() for event in run()]
    late = [event.to_json() for event in list(run())]

    assert late == at_once
    assert any("old" in str(event) for event in at_once)
    assert any("new" in str(event) for event in at_once)


@pytest.mark.long
def test_points_beside_a_long_arc_get_new_motions_and_are_saved(tmp_path):
    """The chain along the arc is walked along, and searched once that has taken too long.

    Two points change places beside it, and points of the arc leave it slowly.
    """
    logs = []
    for is_saved in (False, True):
        arc = [Body(f"a{i}", [(-(i * i), 2 * i)]) for i in range(-80, 81)]
        points = [*arc, Body("p", [(40000, 100)]), Body("q", [(39999, -100)])]
        simulation, log = Simulation(Scene(points, (0, 80))), []
        for k in range(40):
            log += [event.to_json() for event in simulation.run(2 * k)]
            velocity = -2 if k % 2 else 2
            leaving = f"a{37 * k % 161 - 80}"
            for name, towards in (("q", (velocity, 0)), (leaving, (0, Fraction(k % 3 - 1, 400)))):
                simulation.set_motion(name, onward(simulation.body(name), 2 * k, towards))
            if is_saved and k % 7 == 3:
                simulation.save(tmp_path / "run.json")
                simulation = Simulation.restore(tmp_path / "run.json")
        audit(simulation)
        log += [event.to_json() for event in simulation.run()]
        logs.append(log)

    assert len(logs[0]) > 40
    assert logs[0] == logs[1]


# Bodies with holes

FRAME = [(0, 0), (12, 0), (12, 12), (0, 12)]
HOLE = [(1, 1), (11, 1), (11, 11), (1, 11)]
ISLE = [(2, 2), (4, 2), (2, 4)]


def room(*bodies, **options):
    frame = Body("frame", parts=[{"vertices": FRAME, "holes": [HOLE]}, ISLE], **options)
    return Scene([frame, *bodies], (0, 20))


def ball(speed=(0, 0)):
    return Body("ball", [(6, 6), (7, 6), (6, 7)], Translation([0, speed[0]], [0, speed[1]]))


@pytest.mark.parametrize("tiling", TILINGS)
def test_frame_with_a_new_motion_meets_the_ball_in_it(tiling):
    """Its edge x = 1 + (t - 1) is at the ball, x = 6, at t = 6; its isle is below the ball.

    On the way "late" comes and goes.
    """
    simulation = at(Simulation(room(ball()), tiling=tiling), 1)
    simulation.set_motion("frame", Translation([-1, 1], [0]))
    audit(simulation)
    simulation.add(Body("late", [(3, 8), (4, 8)]))
    simulation.add(Body("inner", [(9, 9)]))
    simulation.remove("late")
    audit(simulation)

    assert simulation.run_to_contact().time == 6
    assert simulation.contact.bodies == ("ball", "frame")


def test_body_with_holes_is_added_around_another_one():
    """Its isle, up to (2, 4 + t), passes the ball; its edge y = 1 + t is there at t = 5."""
    simulation = Simulation(Scene([ball()], (0, 20)))
    simulation.add(room().bodies[0].with_motion(Translation([0], [0, 1])))

    assert simulation.run_to_contact().time == 5
    other = Simulation(Scene([Body("x", [("1/2", "1/2")])], (0, 2)))
    with pytest.raises(InputError, match="touches"):
        other.add(room().bodies[0])


@pytest.mark.parametrize(
    "vertices",
    [
        [("1/4", "1/4"), ("1/2", "1/4"), ("1/2", "1/2")],
        [(2, 1), (3, "3/2"), ("5/2", "3/2")],
        [(-5, -5), (50, -5), (50, 50), (-5, 50)],
    ],
    ids=["in the frame", "on the edge of the hole", "around the frame"],
)
def test_body_that_touches_one_with_holes_is_not_added(vertices):
    simulation = Simulation(room(ball()))
    with pytest.raises(InputError, match="touches body 'frame' at t = 0"):
        simulation.add(Body("new", vertices))


def test_body_with_holes_begins_to_deform():
    """From t = 1 on its hole moves to the right by t - 1: to the outline, x = 12, at t = 2."""
    simulation = at(Simulation(room(ball())), 1)
    hole = [{"x": [x - 1, 1], "y": [y]} for x, y in HOLE]
    frame = Body("frame", parts=[{"vertices": FRAME, "holes": [hole]}, ISLE])
    simulation.set_motions({"frame": frame})

    assert simulation.stats["rebuilds"] == 1
    list(simulation.run())
    assert (simulation.contact.kind, simulation.contact.time) == ("self", 2)


def test_inside_of_a_deforming_body_is_tiled_around_its_holes():
    """The hole moves up by t / 9, from 1 below the outline: they touch at t = 9."""
    hole = [{"x": [x], "y": [y, "1/9"]} for x, y in HOLE]
    simulation = Simulation(Scene([Body("frame", FRAME, holes=[hole]), ball()], (0, 20)))
    audit(simulation)

    list(simulation.run())
    assert (simulation.contact.kind, simulation.contact.time) == ("self", 9)


def test_body_with_holes_that_stops_keeps_its_rings():
    simulation = Simulation(room(ball((1, 0))))

    assert simulation.run_to_contact().time == 4
    frame = simulation.body("frame").halted(4)
    assert frame.parts == simulation.body("frame").parts
    assert frame == room().bodies[0]


@pytest.mark.parametrize("tiling", ["lazy", "mixed"])
def test_body_with_reflex_corners_that_closes_touches_itself(tiling):
    """It is added while others are there, and its inside is tiled, as it deforms.

    The tip of the right arm moves from x = 7 to that of the left one, at x = 1: at t = 6.
    """
    simulation = Simulation(
        Scene([Body("far", [(50, 0), (51, 0), (50, 1)])], (0, 20)), tiling=tiling
    )
    tip = {"x": [7, -1], "y": [5]}
    grip = Body("grip", [(7, 1), (1, 1), (1, 5), (0, 5), (0, 0), (8, 0), (8, 5), tip])

    simulation.add(grip)

    audit(simulation)
    assert simulation.stats["rebuilds"] == 0  # a diagonal outside the ring would need one
    contact = simulation.run_to_contact()
    assert (contact.time, contact.kind) == (6, "self")
