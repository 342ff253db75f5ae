"""One query about many scenes: `answers` for texts in memory, `run` for files, on many workers.

Both take scenes as `exactpt.Scene.save` writes them, one JSON text each, and return results as JSON
(docs/format.md). A scene that fails has an error as its result, and the others go on.
"""

from exactpt.batch.answering import answers
from exactpt.batch.options import Options
from exactpt.batch.running import Summary, run

__all__ = ["Options", "Summary", "answers", "run"]
