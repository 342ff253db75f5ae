"""A batch: all scenes of a file, on several cores or a cluster, resumable."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from pathlib import Path
from typing import NamedTuple, final

from exactpt.batch.chunks import Answered, answered, one_by_one
from exactpt.batch.journal import Journal
from exactpt.batch.lines import Lines, Source, size_of
from exactpt.batch.options import Options
from exactpt.batch.parquet import Rows, table
from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.files import writing
from exactpt.kernel.numbers import shorten
from exactpt.workers.cluster import results_on
from exactpt.workers.processes import results_of
from exactpt.workers.work import MAX_JOBS, Work

PARQUET = ".parquet"
ON_A_CLUSTER = 16
"""Number of workers of a cluster for which an input is cut into enough chunks."""


@final
class Summary(NamedTuple):
    """The result of a batch.

    Attributes:
        scenes: the number of results.
        failures: the number of those that are an error.
        first: the line and the error of the first; empty if there is none.
    """

    scenes: int
    failures: int
    first: str

    def __repr__(self) -> str:
        return record_in_brief(self)


def run(
    scenes: str | Path,
    answers: str | Path,
    options: Options | None = None,
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    report: Callable[[int, int], None] | None = None,
) -> Summary:
    """Compute the result of a query for each scene of a file, as docs/scale.md explains.

    If it is interrupted or killed, the same call goes on where it stopped: until all results are
    there, they are in two files beside the output. Its bytes do not depend on the number of
    workers, nor on interruptions.

    Args:
        scenes: the file: a scene on each line, or Parquet (``.parquet``) with a column "scene".
        answers: the file to write, which must not exist; Parquet if it ends in ``.parquet``.
        options: the query; by default the first contact.
        jobs: number of processes; one is this process. (More are started anew: a script that
            uses more must be importable, see `multiprocessing`.)
        scheduler: the address of a Dask scheduler, instead.
        report: called with how much of the input is done, and with all of it.

    Raises:
        InputError: if a file cannot be read or written, the output exists, or the input or the
            query is not that of the batch that was interrupted.
    """
    options = options or Options()
    if not 1 <= jobs <= MAX_JOBS:
        raise InputError(f"jobs: expected a number from 1 to {MAX_JOBS}, got {shorten(jobs)}")
    given, target = Path(scenes), Path(answers)
    source = Rows(given) if given.suffix == PARQUET else Lines(given, options.max_bytes)
    if os.path.lexists(target):
        if target.is_symlink() or not target.is_file():
            raise InputError(f"{target}: a folder, link, pipe or device: choose another name")
        raise InputError(f"{target}: it exists: remove it, or choose another name")
    most = size_of(source.size, jobs if scheduler is None else ON_A_CLUSTER)
    journal = Journal(target, options, source.length)
    try:
        todo = source.chunks(dict(journal.records), most)
        done = sum(record.stop - record.start for record in journal.records.values())
        work = Work(partial(answered, options=options), partial(one_by_one, options=options))
        results: Iterator[Answered]
        if scheduler is not None:
            results = results_on(scheduler, work, todo)
        elif jobs == 1:
            results = (answered(chunk, lambda _: None, options) for chunk in todo)
        else:
            results = results_of(work, todo, jobs)
        for result in results:
            journal.add(result)
            done += result.stop - result.start
            if report is not None:
                report(done, source.length)
        _check_complete(journal, source)
        with writing(target, new=True) as write, _as_rows(target, write, source) as add:
            counts = journal.pass_on(add)
        journal.remove()
    finally:
        journal.close()
    return Summary(*counts)


def _as_rows(
    target: Path, write: Callable[[bytes], None], source: Source
) -> AbstractContextManager[Callable[[bytes], None]]:
    if target.suffix != PARQUET:
        return nullcontext(write)
    return table(write, source if isinstance(source, Rows) else None)


def _check_complete(journal: Journal, source: Source) -> None:
    """Check that the chunks that are finished are the whole input.

    Raises:
        InputError: if some are missing.
    """
    records = [journal.records[start] for start in sorted(journal.records)]
    ends = [0, *(record.stop for record in records)]
    if [record.start for record in records] != ends[:-1] or ends[-1] < source.length:
        raise InputError("the workers have ended before all scenes were processed")
