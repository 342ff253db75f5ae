"""The interface of what records a run as it goes, as the proofs of `exactpt.proof` do."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.incidence import Touch
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

__all__ = ["Recorder"]


class Recorder(Protocol):
    """Told of a run what happens: `begin` and `advanced` in turn, then `change` or an end."""

    def touching(self, scene: Scene) -> None:
        """Bodies touch at the start; nothing else follows."""

    def begin(self, scene: Scene, kinetic: Tiling) -> None:
        """Time is about to pass; the scene is that since the last change of plans."""

    def advanced(self) -> None:
        """Time has passed up to the next event, and it has been processed."""

    def change(self, t: QQ) -> None:
        """Plans have changed at a rational time, or the run ends there without contact."""

    def met(self, touches: Sequence[Touch]) -> None:
        """The run has ended with a contact now."""

    def finish(self) -> None:
        """Nothing else is to be recorded."""
