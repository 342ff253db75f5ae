"""One query about many scenes: `answers` for texts in memory, `run` for files, on many workers.

Both take scenes as `exactpt.Scene.save` writes them, one JSON text each, and return results as JSON
(docs/format.md). A scene that fails has an error as its result, and the others go on.
"""

from exactpt.batch.answering import answers
from exactpt.batch.options import Options
from exactpt.batch.running import Summary, run
from exactpt.renamed import warn_renamed

__all__ = ["Options", "Summary", "answers", "run"]


def __getattr__(name: str) -> type[Options]:
    if name == "Question":
        warn_renamed("exactpt.batch.Question", "Options")
        return Options
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
