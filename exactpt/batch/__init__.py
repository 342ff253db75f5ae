"""Many scenes, one question: `answers` for texts in memory, `run` for files, on many workers.

Both take scenes as `exactpt.Scene.save` writes them, one JSON text each, and give answers as JSON
(docs/format.md). A scene that has no answer has an error instead, and the others go on.
"""

from exactpt.batch.answering import answers
from exactpt.batch.question import Question
from exactpt.batch.running import Summary, run

__all__ = ["Question", "Summary", "answers", "run"]
