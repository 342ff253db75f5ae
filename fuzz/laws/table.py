"""The table of laws: what holds, in which scenes, and its share of the time."""

from __future__ import annotations

from typing import Final

from fuzz.laws.agreement import as_defined, two_ways_agree, way_is_as_defined
from fuzz.laws.alive import (
    changed_run_is_a_new_scene,
    events_are_the_same_in_any_way,
    history_is_what_happened,
    pockets_are_tiled_again,
)
from fuzz.laws.choices import choices_are_each_pair_alone, chosen_contacts_are_part_of_all
from fuzz.laws.confirmed import (
    contacts_are_confirmed,
    distances_are_confirmed,
    first_contact_is_confirmed,
    spaces_are_confirmed,
    unions_are_confirmed,
)
from fuzz.laws.contacts import bodies_touch_in_their_intervals
from fuzz.laws.costs import (
    bystander_costs_nothing,
    change_costs_nothing_elsewhere,
    later_end,
    many_far_bodies,
    one_body_in_pieces,
    one_far_body,
    one_fast_body,
    one_frame_around,
    one_large_body,
)
from fuzz.laws.distances import clearance_is_the_distance, surroundings_are_of_each_pair
from fuzz.laws.drawn import (
    as_asked,
    curves_are_within_their_errors,
    descriptions_change_nothing,
    drawings_have_their_parts,
    filters_say_what_is_true,
    hostile_files_are_refused,
    predicates_are_as_defined,
    queries_in_space_are_as_defined,
    small_scope_is_as_defined,
    stated_errors_are_kept,
    touching_rings_are_valid_or_not,
)
from fuzz.laws.enclosed import bounds_contain_the_truth
from fuzz.laws.exchange import results_survive_a_pickle, scene_is_read_as_written
from fuzz.laws.fans import fan_events_lead_from_fan_to_fan, fan_goes_on_after_a_change
from fuzz.laws.images import first_contact_of_image, pairs_of_image
from fuzz.laws.irrational import irrational_tiling_is_that_just_after
from fuzz.laws.law import Law
from fuzz.laws.limits import (
    ended_run_is_true,
    ended_search_is_true,
    numbers_of_events_are_kept,
    searches_look_at_the_clock,
)
from fuzz.laws.order import distances_are_ordered_as_their_values
from fuzz.laws.points import points_are_where_bodies_touch
from fuzz.laws.proofs import certificates_are_accepted, proofs_are_accepted
from fuzz.laws.runs import (
    bounces_are_first_contacts,
    living_run_is_static,
    restored_run_goes_on,
    stops_change_nothing,
)
from fuzz.laws.space import paths_are_shortest, places_are_as_defined
from fuzz.laws.spins import spins_are_their_pieces
from fuzz.laws.tilings import (
    arrays_are_tiled_as_bodies,
    at_once_is_one_by_one,
    events_lead_to_the_next_tiling,
    filters_decide_exactly,
    general_position_needs_no_rebuild,
    greedy_in_two_ways,
    kinetic_is_static,
    mixed_tiling_has_its_regions,
    most_decisions_are_of_filters,
    tiling_is_as_defined,
    tilings_at_events_are_whole,
)
from fuzz.laws.together import (
    array_queries_are_first_contacts,
    arrays_are_single_calls,
    batch_is_single_calls,
    rounded_pairs_in_arrays,
    turning_pairs_in_a_batch,
)
from fuzz.laws.walks import relative_hulls_are_taut, shortened_walks_are_taut
from fuzz.laws.witnessed import (
    cgal_accepts_runs,
    compiled_is_plain,
    definitions_agree,
    old_engine_agrees,
)

__all__ = ["LAWS"]

MOVING: Final = ("turning", "deforming", "curved", "pieces")
TINY: Final = ("tiny/pair", "tiny/touching", "tiny/meeting", "tiny/fractions", "scope")
CLOSE: Final = ("tiny/pair+awkward", "tiny/meeting+awkward", "tiny/fractions", "pair",
                "pair+awkward", "pair+nudged", "tiny/pair+nudged")  # fmt: skip
COUNTED: Final = tuple(
    f"whole/{name}"
    for name in ("convex", "row", "convoy", "ballistic", "turning", "deforming", "pieces",
                 "stars", "frames", "discs", "linear_points")
)  # fmt: skip
"""Whole scenes of families, in which costs are compared."""
FAMILY: Final = ("family", "family+awkward", "family+thin")
TILED: Final = ("whole", *FAMILY, "many", "points")
"""Faults of tilings need many bodies; those of filters and of thin bodies need few."""
GENERAL: Final = tuple(
    f"whole/{name}"
    for name in ("convex", "mixed_shapes", "ballistic", "turning", "deforming", "pieces",
                 "keyframed", "linear_points", "ballistic_points", "piecewise_points")
)  # fmt: skip
"""Families in general position."""

LAWS: Final[dict[str, Law]] = {
    "first contact/reference": Law(
        as_defined("first contact", several=4),
        (*TINY, *CLOSE, "tiny/rounded", "tiny/scaled", "tiny/sliders", "tiny/grazing", "case"),
        share=4,
        most=30,
    ),
    "first contact/methods": Law(
        two_ways_agree("first contact"),
        (*FAMILY, *CLOSE, "case", "radii", "rings", "tiny/rings", "far", "planks", "tiny/scaled"),
        share=3,
    ),
    "first contact/points": Law(
        points_are_where_bodies_touch,
        (
            "tiny/crossed",
            "tiny/touching",
            *FAMILY,
            *MOVING,
            "radii",
            "rings",
            "tiny/rounded",
            "tiny/scaled",
            "pair",
            "planks",
        ),
    ),
    "first contact/images": Law(
        first_contact_of_image, ("family", "pair", "tiny/pair", "scope"), share=2
    ),
    "tiling/static": Law(kinetic_is_static, (*TILED, "tiny/fractions", "scope", "case"), share=6),
    "tiling/filters": Law(
        filters_decide_exactly,
        (*TILED, "family+nudged", "tiny/fractions", "general", "many+nudged"),
        share=4,
    ),
    "tiling/at once": Law(at_once_is_one_by_one, ("many", "whole", "family"), share=0.5),
    "tiling/defined": Law(
        tiling_is_as_defined,
        ("points", "convex", "points+awkward", "convex+awkward", "whole/linear_points"),
        most=40,
    ),
    "tiling/two ways": Law(
        greedy_in_two_ways, ("convex", "many", "convex+awkward", "tiny/fractions"), share=0.5
    ),
    "tiling/regions": Law(
        mixed_tiling_has_its_regions, ("whole", "family", "rings", "many"), share=0.5
    ),
    "tiling/events": Law(
        events_lead_to_the_next_tiling,
        ("whole", "points", "many", "convex+awkward", "long"),
        share=0.5,
    ),
    "tiling/whole": Law(tilings_at_events_are_whole, ("whole", "family", "tiny/fractions", "case")),
    "tiling/arrays": Law(
        arrays_are_tiled_as_bodies, ("many/doubles", "many/doubles+rounded"), share=0.5
    ),
    "tiling/irrational": Law(
        irrational_tiling_is_that_just_after,
        ("curved", "points", "curved+awkward", "turning"),
        share=0.5,
        most=40,
    ),
    "contacts/reference": Law(
        as_defined("contacts"),
        ("tiny/meeting", "tiny/pair", "tiny/rounded", "tiny/meeting+awkward", "pair+nudged"),
        share=1.5,
        most=14,
    ),
    "contacts/methods": Law(
        two_ways_agree("contacts"),
        (*FAMILY, "pair+awkward", "radii", "rings", "tiny/rings", "walkers", "tiny/scaled"),
        share=0.5,
        most=60,
    ),
    "contacts/times": Law(
        bodies_touch_in_their_intervals,
        ("whole", *FAMILY, *MOVING, "radii", "rings", "walkers", "planks", "wheels"),
    ),
    "pairs/images": Law(
        pairs_of_image, ("family", *MOVING, "pair", "tiny/distant", "pair+nudged"), share=1.5
    ),
    "first within/reference": Law(
        as_defined("first within"),
        ("tiny/distant", "tiny/crowded", "tiny/rounded", "tiny/distant+nudged", "tiny/touching"),
        most=14,
    ),
    "first within/methods": Law(
        two_ways_agree("first within"),
        (*FAMILY, *MOVING, "crowd", "radii", "rings", "tiny/scaled", "walkers", "wheels"),
        share=0.5,
        most=60,
    ),
    "distance/reference": Law(
        as_defined("distance"),
        ("tiny/distant", "tiny/distant+awkward+nudged", "pair+awkward+nudged", "family+awkward"),
        share=1.5,
        most=40,
    ),
    "distance/below": Law(
        as_defined("below"),
        ("tiny/distant", "tiny/pair", "tiny/rounded", "tiny/distant+awkward"),
        most=10,
    ),
    "distance/clearance": Law(
        clearance_is_the_distance,
        (
            *MOVING,
            "turning+awkward",
            "deforming+awkward",
            "family",
            "pair+nudged",
            "tiny/distant",
            "tiny/rounded",
            "radii",
            "wheels",
            "wheels",
        ),
        share=4,
        most=60,
    ),
    "distance/order": Law(
        distances_are_ordered_as_their_values,
        ("tiny/rounded", "radii", "tiny/distant", "radii+awkward"),
        share=0.5,
    ),
    "distance/least": Law(
        as_defined("least distance"),
        ("tiny/distant", "tiny/rounded", "tiny/pair+awkward", "tiny/distant+nudged", "pair"),
        share=0.5,
        most=10,
    ),
    "distance/surroundings": Law(
        surroundings_are_of_each_pair,
        ("tiny/crowded", "radii", "tiny/fractions", "family", "tiny/crowded+awkward", "radii"),
        share=0.5,
        most=30,
    ),
    "new contact/reference": Law(
        as_defined("new contact"),
        (
            "tiny/touching",
            "tiny/meeting",
            "tiny/rounded",
            "tiny/threads",
            "tiny/touching+awkward",
        ),
        most=18,
    ),
    "new contact/methods": Law(
        two_ways_agree("new contact"),
        (*FAMILY, *MOVING, "radii", "rings", "tiny/touching+awkward", "pair+nudged"),
        share=0.5,
        most=60,
    ),
    "space/places": Law(
        places_are_as_defined,
        (
            "family",
            "family+awkward",
            "tiny/fractions",
            "tiny/crowded",
            "tiny/fractions+nudged",
            "points",
            "rings",
            "pair",
            "tiny/one point",
        ),
        share=1.5,
        most=40,
    ),
    "space/paths": Law(
        paths_are_shortest,
        ("family", "tiny/fractions", "tiny/crowded", "rings", "tiny/crowded+awkward", "pair"),
        most=16,
    ),
    "space/walks": Law(
        shortened_walks_are_taut,
        ("family", "tiny/fractions", "tiny/crowded", "rings", "family+awkward", "pair"),
        most=40,
    ),
    "space/hulls": Law(
        relative_hulls_are_taut,
        ("family", "tiny/crowded", "rings", "family+awkward"),
        share=0.5,
        most=40,
    ),
    "simulation/restored": Law(restored_run_goes_on, ("family", "tiny/meeting", "pair"), most=40),
    "simulation/living": Law(living_run_is_static, ("own",)),
    "batch/single": Law(
        batch_is_single_calls,
        (
            "pair",
            "pair+rounded",
            "tiny/pair+rounded",
            "family",
            "turning",
            "turning+rounded",
            "tiny/turned",
        ),
        most=60,
    ),
    "arrays/single": Law(
        arrays_are_single_calls,
        ("pair", "pair+rounded", "family", "family+rounded", "radii+rounded"),
        most=90,
    ),
    "certificate/checked": Law(
        certificates_are_accepted, ("family", "tiny/pair", "pair+awkward", "scope"), most=30
    ),
    "proof/checked": Law(
        proofs_are_accepted, ("whole", "family", "tiny/pair", "scope", "family+awkward"), share=2
    ),
    "budget/searches": Law(
        ended_search_is_true,
        (
            "tiny/crowded",
            "pair",
            "family",
            "tiny/fractions",
            "crowd",
            "far/relay",
            "far/relay+awkward",
        ),
        share=2,
        most=400,
    ),
    "budget/runs": Law(
        ended_run_is_true, ("family", "tiny/crowded", *MOVING, "points", "rings"), most=60
    ),
    "budget/events": Law(
        numbers_of_events_are_kept,
        ("family", "tiny/crowded", "points", "tiny/fractions"),
        share=0.5,
        most=60,
    ),
    "budget/looks": Law(searches_look_at_the_clock, ("chevrons",), share=0.5, cases=3),
    "first contact/choices": Law(
        choices_are_each_pair_alone,
        ("tiny/crowded", "tiny/fractions", "tiny/touching", "tiny/crowded+awkward", "planks"),
        most=80,
    ),
    "first contact/spins": Law(spins_are_their_pieces, ("spinning", "tiny/rings"), most=40),
    "contacts/choices": Law(
        chosen_contacts_are_part_of_all,
        ("tiny/crowded", "tiny/fractions", "tiny/touching", "tiny/crowded+awkward"),
        share=0.5,
        most=24,
    ),
    "reference/reference": Law(
        definitions_agree,
        ("tiny/pair", "tiny/meeting", "tiny/rounded", "tiny/fractions", "tiny/pair+nudged"),
        share=0.5,
        most=12,
    ),
    "enclosed/spins": Law(bounds_contain_the_truth, ("spinning",), share=0.5, most=60),
    "enclosed/poses": Law(bounds_contain_the_truth, ("poses",), share=0.5),
    "enclosed/errors": Law(stated_errors_are_kept, ("own",), share=0.5),
    "enclosed/curves": Law(curves_are_within_their_errors, ("own",), share=0.5),
    "simulation/bounces": Law(
        bounces_are_first_contacts,
        (
            "pair",
            "tiny/corners",
            "tiny/fractions",
            "tiny/crossing points",
            "tiny/crowded",
            "family",
        ),
        most=24,
    ),
    "simulation/population": Law(
        changed_run_is_a_new_scene,
        (
            *MOVING,
            "family",
            "tiny/crowded",
            "tiny/fractions",
            "points",
            "tiny/crossing points",
            "rings",
            "family+awkward",
        ),
        share=3,
        most=120,
    ),
    "simulation/pockets": Law(
        pockets_are_tiled_again,
        ("pockets", "pockets", "family/combs", "pockets+awkward", "rings"),
        most=120,
    ),
    "simulation/events": Law(
        events_are_the_same_in_any_way,
        (*MOVING, "family", "tiny/crowded", "tiny/fractions", "points", "rings"),
        most=60,
    ),
    "simulation/history": Law(
        history_is_what_happened,
        ("tiny/crowded", *MOVING, "family", "tiny/fractions", "rings"),
        share=0.5,
        most=60,
    ),
    "simulation/fan": Law(
        fan_events_lead_from_fan_to_fan,
        ("points", "whole/linear_points", "points+awkward", "tiny/crossing points", "far/arc"),
        share=0.5,
        most=70,
    ),
    "simulation/fan changed": Law(
        fan_goes_on_after_a_change,
        ("points", "whole/linear_points", "points+awkward", "tiny/crossing points"),
        share=0.5,
        most=70,
    ),
    "simulation/stops": Law(
        stops_change_nothing,
        ("family", "tiny/fractions", "points", "tiny/crowded", "family+nudged"),
        most=60,
    ),
    "arrays/queries": Law(
        array_queries_are_first_contacts,
        ("pair", "tiny/pair", "pair+rounded", "tiny/pair+rounded", "family/chains_on_grid"),
        most=60,
    ),
    "arrays/adversary": Law(rounded_pairs_in_arrays, ("own",), share=0.5),
    "batch/adversary": Law(turning_pairs_in_a_batch, ("own",), share=3),
    "first contact/small scope": Law(small_scope_is_as_defined, ("own",)),
    "first contact/far": Law(
        way_is_as_defined("first contact", "pairs"),
        ("far/convoy", "far/relay", "far/convoy", "far/relay+awkward"),
    ),
    "tiling/flips": Law(as_asked("flips"), ("own",)),
    "description/same": Law(descriptions_change_nothing, ("own",)),
    "exchange/scenes": Law(
        scene_is_read_as_written,
        ("family", "tiny/pair+awkward", "radii", "rings", "spinning", "poses", "tiny/rings"),
        share=0.5,
    ),
    "exchange/results": Law(
        results_survive_a_pickle, ("tiny/pair", "pair", "tiny/meeting+awkward"), share=0.5
    ),
    "exchange/hostile files": Law(hostile_files_are_refused, ("own",), share=0.5),
    "exchange/drawings": Law(drawings_have_their_parts, ("own",), share=0.5),
    "scene/touching rings": Law(touching_rings_are_valid_or_not, ("own",), share=0.5),
    "filters/adversary": Law(filters_say_what_is_true, ("own",)),
    "filters/predicates": Law(predicates_are_as_defined, ("own",)),
    "space queries/reference": Law(queries_in_space_are_as_defined, ("own",), share=0.5),
    "tiling/cgal": Law(
        cgal_accepts_runs, ("family", "scope", "tiny/fractions"), most=40, needs="cgal"
    ),
    "cgal/first contact": Law(
        first_contact_is_confirmed,
        (*TINY, *CLOSE, "tiny/rounded", *MOVING, "rings", "family"),
        share=1.5,
        most=40,
        needs="cgal",
    ),
    "cgal/contacts": Law(
        contacts_are_confirmed,
        ("tiny/meeting", "tiny/rounded", *MOVING, "rings", "tiny/rings", "pair+nudged", "family"),
        most=40,
        needs="cgal",
    ),
    "cgal/distance": Law(
        distances_are_confirmed,
        ("tiny/distant", "tiny/rings", *MOVING, "rings", "pair+awkward+nudged", "family+awkward"),
        most=60,
        needs="cgal",
    ),
    "cgal/space": Law(
        spaces_are_confirmed,
        ("family", "family+awkward", "tiny/touching", "rings", "pair"),
        most=40,
        needs="cgal",
    ),
    "cgal/union": Law(
        unions_are_confirmed,
        ("rings", "tiny/rings", "family", "family+awkward"),
        share=0.5,
        most=60,
        needs="cgal",
    ),
    "old engine/same": Law(
        old_engine_agrees,
        ("family", "pair+nudged", "tiny/pair+awkward"),
        most=60,
        needs="old engine",
    ),
    "compiled/plain": Law(
        compiled_is_plain,
        ("family", "tiny/pair+awkward", "family+nudged", "scope", "turning+awkward"),
        most=60,
        needs="compiled copy",
    ),
    **{
        f"cost/{name}": Law(
            bystander_costs_nothing(bystander, "--method", "pairs"),
            COUNTED,
            share=0.5,
            cases=2 * len(COUNTED),
        )
        for name, bystander in (
            ("far body", one_far_body),
            ("far bodies", many_far_bodies),
            ("fast body", one_fast_body),
            ("large body", one_large_body),
            ("frame around", one_frame_around),
            ("body in pieces", one_body_in_pieces),
            ("later end", later_end),
        )
    },
    "cost/rebuilds": Law(
        general_position_needs_no_rebuild,
        (*GENERAL, "general", "many/scattered"),
        share=0.5,
        cases=96,
    ),
    "cost/filters": Law(most_decisions_are_of_filters, ("general",), share=0.5, cases=48),
    "cost/changes": Law(
        change_costs_nothing_elsewhere,
        ("whole/convex", "whole/stars", "whole/turning", "whole/letters", "whole/frames"),
        share=0.5,
        cases=20,
    ),
    "cost/later end, lazy": Law(
        bystander_costs_nothing(later_end, "--tiling", "lazy"),
        ("whole/convex", "whole/stars", "whole/turning"),
        share=0.5,
        cases=24,
    ),
}
"""The laws by name: the question, and what it is compared with."""
