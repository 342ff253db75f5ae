"""Cases: a scene, its images, and the answers to all questions about both."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from random import Random
from typing import Final, NamedTuple

from exactpt import Body, Scene, Translation
from exactpt.kernel.numbers import QQ
from fuzz.changes.images import TRANSFORMATIONS, Image, move_alike
from fuzz.questions.rounded import rounded_pair
from fuzz.questions.scenes import crowded_scene, distant_scene
from fuzz.questions.spinning import spinning_scene
from fuzz.questions.tiny import pair_scene, touching_scene
from fuzz.transformations.answers import QUESTIONS, Case, NotAskedError, Refusal, answer

__all__ = ["SCENES", "Fault", "check", "scene_of"]

TILINGS: Final = ("lazy", "greedy", "mixed")
FAMILIES: Final = (pair_scene, pair_scene, distant_scene, touching_scene, crowded_scene,
                   rounded_pair)  # fmt: skip
TWINS: Final = (
    [(0, 0), (1, 0), (0, 1)],
    [(0, 0), (2, 0), (2, 1), (0, 1)],
    [(0, 0), (2, 1), (0, 2), (1, 1)],
)


class Fault(NamedTuple):
    """A disagreement.

    Attributes:
        question, transformation: their names.
        number: the number of the case.
        why: the two answers, or the exception.
        old, new: the scenes.
    """

    question: str
    transformation: str
    number: int
    why: str
    old: Scene
    new: Scene


def scene_of(random: Random) -> Scene:
    """Return a tiny scene, sometimes with a body that moves like another one, beside it."""
    if random.random() < 0.1:
        return straight(random)
    scene = random.choice(FAMILIES)(random)
    kind = random.random()
    if kind < 0.3:
        return scene
    scene = _with_twin(random, scene)
    if kind < 0.6:
        return scene
    image = TRANSFORMATIONS["joined"](scene, random)
    return scene if image is None else image.new.scene


def alike(random: Random) -> Scene:
    """Return a scene with two bodies that move alike and lie apart, or with both as one body."""
    while True:
        scene = _with_twin(random, random.choice(FAMILIES)(random))
        image = TRANSFORMATIONS["joined"](scene, random)
        if image is not None:
            return scene if random.random() < 0.5 else image.new.scene


def straight(random: Random) -> Scene:
    """Return two bodies that move straight."""
    bodies = []
    for name, x in (("a", 0), ("b", random.randint(-4, 4))):
        shape = random.choice([[(0, 0)], [(0, 0), (2, 1)], *TWINS])
        u, v = random.randint(-2, 2), random.randint(-2, 2)
        y = random.randint(-4, 4)
        vertices = [(x + p, y + q) for p, q in shape]
        closed = random.random() < 0.7
        bodies.append(Body(name, vertices, Translation([0, u], [0, v]), closed=closed))
    return Scene(bodies, (0, 4))


def spinning(random: Random) -> Scene:
    """Return a scene of gears, mills or orbits, with a body that turns like another one."""
    return _with_twin(random, spinning_scene(random))


def standing(random: Random) -> Scene:
    """Return a wall without interior and a thin body that stands on it, and moves."""
    wall = random.choice([[(-2, 0), (2, 0)], [(-2, 0), (0, 0), (2, 0)], [(-2, 0), (0, 0), (2, 1)]])
    shape = random.choice([[(0, 0)], [(0, 0), (0, 2)], [(0, 0), (1, 2)], [(-1, 1), (0, 0), (1, 1)]])
    x, u, v = random.choice([-1, 0, 0, 1]), random.randint(-1, 1), random.randint(-1, 1)
    vertices = [(x + p, q) for p, q in shape]
    thin = Body("thin", vertices, Translation([0, u], [0, v]), closed=False)
    return Scene([Body("wall", wall, closed=False), thin], (0, 4))


def _with_twin(random: Random, scene: Scene) -> Scene:
    solid = [body for body in scene.bodies if body.has_interior and not body.keyframes]
    if not solid:
        return scene
    like = random.choice(solid)
    for _ in range(8):
        x, y = random.randint(-6, 6), random.randint(-6, 6)
        vertices = [(x + u, y + v) for u, v in random.choice(TWINS)]
        twin = Body("twin", vertices, like.motion, radius=like.radius)
        if move_alike(like, twin, scene.exact_start):
            return Scene([*scene.bodies, twin], (scene.start, scene.end))
    return scene


def _case(random: Random, image: Image) -> Case:
    scene = image.old.scene
    groups = sorted({image.old.groups[body.name] for body in scene.bodies})
    two = random.sample(groups, 2) if len(groups) > 1 else [groups[0], groups[0]]
    span = scene.exact_end - scene.exact_start
    p, q, r = ((QQ(random.randint(-6, 9), 2), QQ(random.randint(-6, 9), 2)) for _ in range(3))
    return Case(
        groups=(two[0], two[1]),
        t=scene.exact_start + span * random.randint(0, 8) / 8,
        d=QQ(random.choice([0, 1, 1, 2]), random.choice([1, 2, 3])),
        points=(p, q, r),
        tiling=random.choice(TILINGS),
    )


SCENES: Final[dict[str, Callable[[Random], Scene]]] = {
    "mixed": scene_of,
    "alike": alike,
    "straight": straight,
    "spinning": spinning,
    "standing": standing,
}
"""What scenes are drawn from."""


def check(
    number: int,
    seed: int = 0,
    wanted: Callable[[str, str], bool] = lambda _, __: True,
    within: Callable[[], AbstractContextManager[object]] = nullcontext,
    draw: Callable[[Random], Scene] | None = None,
) -> Iterator[tuple[str, str, Fault | None]]:
    """Ask questions about a scene and its images.

    Args:
        number: the number of the case.
        seed: the seed of the run.
        wanted: returns whether to ask a question about the image by a transformation.
        within: the context in which the questions are asked.
        draw: makes the scene; `scene_of` if not given.

    Returns:
        The question, the transformation, and the disagreement if there is one.
    """
    random = Random(f"transformations {seed} {number}")
    scene = (draw or scene_of)(random)
    known: dict[tuple[str, Case], object] = {}
    for name, transform in TRANSFORMATIONS.items():
        questions = [question for question in QUESTIONS if wanted(question, name)]
        image = None
        if questions:
            image = transform(scene, Random(f"{name} {seed} {number}"))
        if image is None:
            continue
        case = _case(Random(f"case {seed} {number}"), image)
        if case.groups[0] == case.groups[1]:
            continue
        with within():
            found = list(_checked(number, name, image, case, questions, known))
        yield from found


def _checked(
    number: int, name: str, image: Image, case: Case, questions: Sequence[str],
    known: dict[tuple[str, Case], object],
) -> Iterator[tuple[str, str, Fault | None]]:  # fmt: skip
    """Compare answers; those about an old scene without groups are kept in ``known``."""
    is_one = all(group == name for name, group in image.old.groups.items())
    for asked in questions:
        question, why = QUESTIONS[asked], None
        try:
            if not is_one or (asked, case) not in known:
                before = answer(question, image.old, case)
            else:
                before = known[asked, case]
            if is_one:
                known[asked, case] = before
            after = answer(question, image.new, case)
            if isinstance(before, Refusal) and before == after:
                continue
            if before != after:
                why = f"{before} became {after}"
        except NotAskedError:
            continue
        except Exception as error:  # any exception is a finding
            why = f"{type(error).__name__}: {error}"
        fault = None
        if why is not None:
            fault = Fault(asked, name, number, why, image.old.scene, image.new.scene)
        yield asked, name, fault
