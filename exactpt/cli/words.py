"""Answers in words, as the commands print them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from exactpt.kernel.numbers import shorten

if TYPE_CHECKING:
    from exactpt.collision.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.simulation.event import Event

__all__ = ["answer_in_words", "event_in_words", "stats_in_words"]


def answer_in_words(scene: Scene, contact: Contact | None) -> list[str]:
    """The first contact in words: time, kind, and all incidences with their points."""
    from exactpt.render.words import polynomial_in_words

    if contact is None:
        return [f"no contact from t = {scene._start} to t = {scene._end}"]
    time = contact.time
    root = f"root of {polynomial_in_words(time._polynomial)}"
    exactly = str(time._low) if time.is_rational else root
    lines = [f"first contact at t = {float(time)!r} ({exactly}), kind {contact.kind}"]
    for pair in contact.pairs:
        feature = f"vertex {pair.other_vertex}" if pair.edge is None else f"edge {pair.edge}"
        x, y = pair.point
        lines.append(
            f"  vertex {pair.vertex} of {_shown(pair.body)} on {feature} "
            f"of {_shown(pair.other)} at ({x}, {y})"
        )
    lines += [f"  {_shown(a)} and {_shown(b)} share a point" for a, b in contact.overlaps]
    return lines


def _shown(name: str) -> str:
    """A name; quoted and escaped if it contains unprintable characters."""
    return name if name.isprintable() else shorten(name)


def event_in_words(event: Event) -> str:
    """An event in words: time, kind, and the edges of the tiling that were removed and added."""
    changes = [f"-{u}~{v}" for u, v in event.removed] + [f"+{u}~{v}" for u, v in event.added]
    words = [f"t = {float(event.time)!r}", event.kind, *map(_shown, changes)]
    return " ".join(words)


def stats_in_words(stats: dict[str, object]) -> list[str]:
    """One line per count."""
    return [
        f"  {key}: {', '.join(f'{k} {v}' for k, v in value.items()) or 'none'}"
        if isinstance(value, dict)
        else f"  {key}: {value}"
        for key, value in stats.items()
    ]
