"""Laws about files and copies: what is written and read again, or pickled, is the same."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import exactpt
from exactpt import Contact, ContactInterval, Scene
from exactpt.kernel.numbers import fraction
from fuzz.laws.law import check_equal
from fuzz.laws.questions import a_time

__all__ = ["results_survive_a_pickle", "scene_is_read_as_written"]


def scene_is_read_as_written(scene: Scene, random: Random) -> str:
    """A scene that is saved, written as text or copied is the same scene, at every time."""
    text = json.dumps(scene.to_json())
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scene.json"
        scene.save(path)
        again = {
            "saved": Scene.load(path),
            "text": Scene.from_json(json.loads(text)),
            "pickle": pickle.loads(pickle.dumps(scene)),
            "copy": copy.deepcopy(scene),
        }
    time = fraction(a_time(scene, random))
    for way, other in again.items():
        check_equal(way, other, scene)
        check_equal(f"{way}: hash", hash(other), hash(scene))
        check_equal(f"{way}: text", json.dumps(other.to_json()), text)
        check_equal(f"{way}: positions", other.at(time), scene.at(time))
    return f"{min(len(scene.bodies), 3)} bodies"


def results_survive_a_pickle(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """Contacts and intervals are equal after a pickle and a copy, and print the same."""
    contact = exactpt.first_contact(scene)
    results: list[Contact | ContactInterval] = list(exactpt.contacts(scene)[:2])
    if contact is not None:
        results.append(contact)
    for result in results:
        for way, other in (
            ("pickle", pickle.loads(pickle.dumps(result))),
            ("copy", copy.deepcopy(result)),
        ):
            check_equal(way, other, result)
            check_equal(f"{way}: text", repr(other), repr(result))
            check_equal(f"{way}: JSON", other.to_json(), result.to_json())
    return "no contact" if contact is None else contact.kind
