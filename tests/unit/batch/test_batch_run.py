"""Batches of files: the same bytes for any workers, interruptions and kills."""

import json
import multiprocessing
import os
import signal
import socket
import subprocess
import sys
import time

import pytest
from commands import code_of
from scenes_of_two import generic_lines, nearly_degenerate

from exactpt.batch import Options, answers, run
from exactpt.batch.chunks import Chunk, Record, answered, digest_of, one_by_one, tally
from exactpt.batch.lines import Lines
from exactpt.errors import InputError
from exactpt.testing.scenes import generate
from exactpt.workers import processes

TURNING = [json.dumps(generate("turning", seed).to_json()) for seed in range(3)]
MALFORMED = ["{", "[]", '{"exactpt": 2, "time": [0, 1], "bodies": []}', "\x00", '"', "nan"]
SCENES = generic_lines(70, seed=5) + TURNING + nearly_degenerate(1, seed=4) + MALFORMED


@pytest.fixture
def scenes(tmp_path):
    path = tmp_path / "scenes.jsonl"
    path.write_text("\n".join(SCENES) + "\n")
    return path


def expected(lines, options=None):
    found = enumerate(answers(lines, options), 1)
    return "".join(f"{json.dumps({'line': number, **data})}\n" for number, data in found)


EXPECTED = expected(SCENES)


def left(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.long
@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_the_bytes_do_not_depend_on_the_workers(scenes, tmp_path, jobs):
    out = tmp_path / "answers.jsonl"

    summary = run(scenes, out, jobs=jobs)

    assert out.read_text() == EXPECTED
    assert (summary.scenes, summary.failures) == (len(SCENES), len(MALFORMED))
    assert summary.first.startswith(f"line {len(SCENES) - len(MALFORMED) + 1}: not JSON")
    assert left(tmp_path) == ["answers.jsonl", "scenes.jsonl"]


def interrupted_after(chunks):
    """What is called after each chunk, and interrupts after a number of them."""
    seen = []

    def report(done, length):
        seen.append(done)
        assert 0 < done <= length
        if len(seen) == chunks:
            raise KeyboardInterrupt

    return report


@pytest.mark.long("2")
@pytest.mark.parametrize("jobs", [1, 2])
def test_an_interrupted_batch_goes_on(scenes, tmp_path, jobs, monkeypatch):
    out = tmp_path / "answers.jsonl"
    for chunks in (1, 3):
        with pytest.raises(KeyboardInterrupt):
            run(scenes, out, jobs=jobs, report=interrupted_after(chunks))
        assert not out.exists()
    assert left(tmp_path) == ["answers.jsonl.journal", "answers.jsonl.part", "scenes.jsonl"]
    _own, *known = (tmp_path / "answers.jsonl.part").read_text().splitlines()
    again = []

    def count(chunk, tell, options):
        again.append(chunk)
        return answered(chunk, tell, options)

    monkeypatch.setattr("exactpt.batch.running.answered", count)
    summary = run(scenes, out)

    assert out.read_text() == EXPECTED
    assert summary.scenes == len(SCENES)
    assert sum(len(chunk.text.splitlines()) for chunk in again) == len(SCENES) - len(known)
    assert 0 < len(known) < len(SCENES)


def stopped(scenes, out):
    """A batch of which some chunks are answered."""
    with pytest.raises(KeyboardInterrupt):
        run(scenes, out, report=interrupted_after(2))
    return out.with_name(f"{out.name}.part"), out.with_name(f"{out.name}.journal")


@pytest.mark.parametrize("cut", [1, 10, 100])
def test_what_was_half_written_is_written_again(scenes, tmp_path, cut):
    out = tmp_path / "answers.jsonl"
    part, journal = stopped(scenes, out)
    part.write_bytes(part.read_bytes() + b'{"line": 99, "con')
    journal.write_bytes(journal.read_bytes()[:-cut])

    run(scenes, out)

    assert out.read_text() == EXPECTED


def test_journal_without_its_first_line_is_refused(scenes, tmp_path):
    """The first line appears whole or not at all: such a file is not of the batch."""
    out = tmp_path / "answers.jsonl"
    part, journal = stopped(scenes, out)
    journal.write_bytes(journal.read_bytes()[:7])
    before = part.read_bytes()

    assert "not the journal of a batch" in refusal(scenes, out)
    assert (journal.read_bytes(), part.read_bytes()) == (b'{"exact', before)


def refusal(scenes, out, options=None):
    with pytest.raises(InputError) as error:
        run(scenes, out, options)
    return str(error.value)


def test_another_input_or_question_is_refused(scenes, tmp_path):
    out = tmp_path / "answers.jsonl"
    part, journal = stopped(scenes, out)
    before = part.read_bytes(), journal.read_bytes()

    other = "of another query or input"
    assert other in refusal(scenes, out, Options(until=3))
    text = scenes.read_text()
    scenes.write_text(text.replace("0", "1", 1))
    assert "has changed since the batch began" in refusal(scenes, out)
    for shorter_or_longer in (text[:3000], text + "\n"):
        scenes.write_text(shorter_or_longer)
        assert other in refusal(scenes, out)
    scenes.write_text(text)
    assert (part.read_bytes(), journal.read_bytes()) == before
    run(scenes, out, Options(method="auto"))
    assert out.read_text() == EXPECTED


def test_files_that_are_no_batch_are_refused(scenes, tmp_path):
    out = tmp_path / "answers.jsonl"
    _part, journal = stopped(scenes, out)
    head = journal.read_bytes().split(b"\n")[0]
    for wrong in (b"[1, 2]", b"{}", b"3", b'[0, 1, "x", 1, 1, 0, "", 0, "y"]'):
        journal.write_bytes(head + b"\n" + wrong + b"\n")
        assert f"{journal}: line 2: " in refusal(scenes, out)


def foreign(kind, folder):
    """Something beside the output that a batch has not written."""
    path = folder / kind
    target = folder / "target"
    target.write_text("precious\n")
    match kind:
        case "file":
            path.write_text("precious\n")
        case "empty file":
            path.touch()
        case "link":
            path.symlink_to(target)
        case "dangling link":
            path.symlink_to(folder / "nothing")
        case "folder":
            path.mkdir()
        case "pipe":
            os.mkfifo(path)
    return path, target


@pytest.mark.skipif(sys.platform == "win32", reason="links and pipes of a Unix")
@pytest.mark.parametrize("ending", ["part", "journal"])
@pytest.mark.parametrize("kind", ["file", "empty file", "link", "dangling link", "folder", "pipe"])
def test_neighbour_of_the_output_is_left_alone(scenes, tmp_path, kind, ending):
    out = tmp_path / "answers.jsonl"
    path, target = foreign(kind, tmp_path)
    neighbour = out.with_name(f"answers.jsonl.{ending}")
    os.rename(path, neighbour)
    before, files = os.lstat(neighbour), left(tmp_path)

    message = refusal(scenes, out)

    assert message.startswith(f"{neighbour}: ")
    assert "\n" not in message
    assert left(tmp_path) == files
    assert os.lstat(neighbour) == before
    assert target.read_text() == "precious\n"
    assert not (tmp_path / "nothing").exists()


@pytest.mark.parametrize("ending", ["part", "journal"])
def test_neighbour_in_a_batch_that_goes_on_is_left_alone(scenes, tmp_path, ending):
    """The other file is that of the batch."""
    out = tmp_path / "answers.jsonl"
    files = dict(zip(("part", "journal"), stopped(scenes, out), strict=True))
    files[ending].unlink()
    files[ending].write_text("precious\n")
    before = {path: path.read_bytes() for path in files.values()}

    assert refusal(scenes, out).startswith(f"{files[ending]}: not ")
    assert {path: path.read_bytes() for path in files.values()} == before


def test_results_of_another_batch_are_refused(scenes, tmp_path):
    """The same query about the same scenes: the names of the two batches differ."""
    out, other = tmp_path / "answers.jsonl", tmp_path / "others.jsonl"
    part, _ = stopped(scenes, out)
    theirs, _ = stopped(scenes, other)
    part.write_bytes(theirs.read_bytes())

    assert refusal(scenes, out).startswith(f"{part}: not of this batch")


@pytest.mark.parametrize("place", [0, 30, -30, None])
def test_results_changed_meanwhile_are_refused(scenes, tmp_path, place):
    out = tmp_path / "answers.jsonl"
    part, journal = stopped(scenes, out)
    content = bytearray(part.read_bytes())
    if place is None:
        content += b"precious\n"
    else:
        first = content.index(b"\n") + 1
        content[first + place if place >= 0 else place] ^= 1
    part.write_bytes(content)
    before = part.read_bytes(), journal.read_bytes()

    message = refusal(scenes, out)

    assert message.startswith(f"{part}: byte ")
    assert (part.read_bytes(), journal.read_bytes()) == before


@pytest.mark.parametrize("rest", [b"", b'{"li', b'{"line": 3, "con', b'{"line": 3}\n{', b"\0" * 99])
def test_what_a_killed_process_was_writing_is_cut_off(scenes, tmp_path, rest):
    out = tmp_path / "answers.jsonl"
    part, _ = stopped(scenes, out)
    part.write_bytes(part.read_bytes() + rest)

    run(scenes, out)

    assert out.read_text() == EXPECTED


DEEP = "[" * 900 + "]" * 900


@pytest.mark.parametrize("key", Record._fields)
@pytest.mark.parametrize("value", ["-1", "1" + "0" * 400, "1.5", "true", "null", '"x"', "{}", DEEP])
def test_value_of_a_journal_is_refused_with_its_key(scenes, tmp_path, key, value):
    """The digest of the line is right."""
    out = tmp_path / "answers.jsonl"
    part, journal = stopped(scenes, out)
    head, line, *rest = journal.read_bytes().splitlines(keepends=True)
    data = {**json.loads(line), key: json.loads(value)}
    del data["seal"]
    data["seal"] = digest_of(json.dumps(data).encode() + b"\n")
    if data == json.loads(line) or (isinstance(data[key], str) and key == "digest"):
        return  # it is what was written, or a text
    journal.write_bytes(head + json.dumps(data).encode() + b"\n" + b"".join(rest))
    before = part.read_bytes(), journal.read_bytes()

    message = refusal(scenes, out)

    assert "\n" not in message
    assert len(message) < 400
    place = (f"{part}: byte ",) if key == "results" else ()
    assert message.startswith((f'{journal}: line 2: "{key}": expected ', *place))
    assert (part.read_bytes(), journal.read_bytes()) == before


@pytest.mark.parametrize(
    "line",
    [b"[1, 2]", b"{}", b"3", b"null", b"", b"{", b"\xff", b"[" * 100_000, b'{"a":' * 100_000,
     b"7" * 10_000, b'[0, 1, "x", 1, 1, 0, "", 0, "y"]'],
    ids=lambda line: line[:20].decode(errors="replace"),
)  # fmt: skip
@pytest.mark.parametrize("at", [1, 2])
def test_line_of_a_journal_that_is_none_is_refused(scenes, tmp_path, line, at):
    out = tmp_path / "answers.jsonl"
    _, journal = stopped(scenes, out)
    lines = journal.read_bytes().splitlines()
    lines[at - 1] = line
    journal.write_bytes(b"\n".join(lines) + b"\n")
    before = journal.read_bytes()

    message = refusal(scenes, out)

    assert message.startswith(f"{journal}: " + ("line 2: " if at == 2 else "not "))
    assert len(message) < 400
    assert journal.read_bytes() == before


def test_journal_with_a_changed_digit_is_refused(scenes, tmp_path):
    """Without a digest of the line, the results that follow would have other numbers."""
    out = tmp_path / "answers.jsonl"
    _, journal = stopped(scenes, out)
    text = journal.read_text()
    count = json.loads(text.splitlines()[1])["lines"]
    journal.write_text(text.replace(f'"lines": {count}', f'"lines": {count + 1}', 1))

    assert "were changed" in refusal(scenes, out)


def test_journal_of_0_2_is_refused(scenes, tmp_path):
    out = tmp_path / "answers.jsonl"
    journal = tmp_path / "answers.jsonl.journal"
    journal.write_text('{"exactpt batch": 1, "question": {}, "length": 7}\n')

    assert "of a batch of another version, 1" in refusal(scenes, out)


def test_output_that_appears_meanwhile_is_not_replaced(scenes, tmp_path):
    """The results are kept, and the same call goes on once it is moved away."""
    out = tmp_path / "answers.jsonl"

    def report(done, length):
        if done == length:
            out.write_text("mine")

    with pytest.raises(InputError, match="it exists"):
        run(scenes, out, report=report)
    assert out.read_text() == "mine"
    out.unlink()
    run(scenes, out)
    assert out.read_text() == EXPECTED
    assert left(tmp_path) == ["answers.jsonl", "scenes.jsonl"]


def test_files_that_replace_those_of_a_batch_are_not_removed(scenes, tmp_path):
    out = tmp_path / "answers.jsonl"
    journal = out.with_name("answers.jsonl.journal")

    def report(done, length):
        if done == length:
            journal.unlink()
            journal.write_text("precious")

    run(scenes, out, report=report)

    assert journal.read_text() == "precious"
    assert out.read_text() == EXPECTED


@pytest.mark.skipif(sys.platform == "win32", reason="links and pipes of a Unix")
@pytest.mark.parametrize("kind", ["link", "dangling link", "folder", "pipe"])
def test_output_that_is_no_file_is_refused(scenes, tmp_path, kind):
    out, target = foreign(kind, tmp_path)
    before, files = os.lstat(out), left(tmp_path)

    assert refusal(scenes, out).endswith("a folder, link, pipe or device: choose another name")
    assert (os.lstat(out), left(tmp_path)) == (before, files)
    assert target.read_text() == "precious\n"


def test_an_output_that_exists_is_left_alone(scenes, tmp_path):
    out = tmp_path / "answers.jsonl"
    out.write_text("mine")

    assert refusal(scenes, out) == f"{out}: it exists: remove it, or choose another name"
    assert out.read_text() == "mine"
    assert left(tmp_path) == ["answers.jsonl", "scenes.jsonl"]


def test_two_batches_do_not_write_the_same_answers(scenes, tmp_path):
    out = tmp_path / "answers.jsonl"
    seen = []

    def report(*_):
        seen.append(refusal(scenes, out))

    run(scenes, out, report=report)

    assert set(seen) == {f"{out}.journal: locked by another batch"}
    assert out.read_text() == EXPECTED


@pytest.mark.long
def test_a_worker_that_is_killed_loses_no_scene(scenes, tmp_path):
    out = tmp_path / "answers.jsonl"
    killed = []

    def report(*_):
        if len(killed) < 2:
            child = multiprocessing.active_children()[0]
            killed.append(child.pid)
            os.kill(child.pid, signal.SIGKILL)

    run(scenes, out, jobs=2, report=report)

    assert out.read_text() == EXPECTED
    assert len(killed) == 2


@pytest.mark.long
def test_scenes_of_a_chunk_that_ends_workers_are_answered_one_by_one():
    text = "\n".join([*SCENES[:4], "", *SCENES[-2:]]).encode()
    chunk = Chunk(7, 100, 100 + len(text), "digest", text)

    alone = one_by_one(chunk, None, "ends", Options())

    assert alone == answered(chunk, lambda _: None, Options())
    assert alone.lines == 7
    assert tally(alone.text)[:2] == (6, 2)
    assert [json.loads(line)["line"] for line in alone.text.splitlines()] == [7, 8, 9, 10, 12, 13]


def command(*arguments):
    # What a shell runs in the background ignores Ctrl-C, and so do its children.
    here = signal.signal(signal.SIGINT, signal.default_int_handler)
    process = subprocess.Popen(
        [sys.executable, "-m", "exactpt", "batch", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    signal.signal(signal.SIGINT, here)
    return process


def chunks_in(journal):
    return journal.read_bytes().count(b"\n") - 1 if journal.exists() else 0


@pytest.mark.long
@pytest.mark.parametrize(
    ("how", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -9)]
)
def test_a_batch_that_is_interrupted_or_killed_goes_on(tmp_path, how, code):
    """It is hit when two of many chunks are answered, wherever it is then."""
    scenes, out = tmp_path / "scenes.jsonl", tmp_path / "answers.jsonl"
    lines = generic_lines(60, seed=8) + nearly_degenerate(20, seed=8)
    scenes.write_text("\n".join(lines) + "\n")
    process = command(scenes, "-o", out, "--jobs", 2)
    journal = tmp_path / "answers.jsonl.journal"
    while chunks_in(journal) < 2 and process.poll() is None:
        time.sleep(0.002)
    process.send_signal(how)
    _, reported = process.communicate(timeout=60)

    assert process.returncode == code
    assert "Traceback" not in reported
    if how == signal.SIGINT:
        assert "is done, in answers.jsonl.part and answers.jsonl.journal; the same" in reported
    assert not out.exists()
    assert chunks_in(journal) >= 2
    summary = run(scenes, out)
    assert summary == (len(lines), 0, "")
    assert out.read_text() == expected(lines)


WRITTEN = {
    "nothing": (b"", 0),
    "a line break": (b"\n", 0),
    "blank lines": (b"\n \n\n" + SCENES[0].encode() + b"\n\n\r\n", 1),
    "no line break at the end": ("\n".join(SCENES[:2]).encode(), 2),
    "line breaks of Windows": ("\r\n".join(SCENES[:2]).encode(), 2),
    "a byte order mark": (b"\xef\xbb\xbf" + SCENES[0].encode(), 1),
}


@pytest.mark.parametrize("kind", WRITTEN)
def test_lines_however_written(tmp_path, kind):
    content, count = WRITTEN[kind]
    scenes, out = tmp_path / "scenes.jsonl", tmp_path / "answers.jsonl"
    scenes.write_bytes(content)

    summary = run(scenes, out)

    assert (summary.scenes, summary.failures) == (count, 0)
    reported = [json.loads(line) for line in out.read_text().splitlines()]
    assert [data.pop("line") for data in reported] == (
        [4] if kind == "blank lines" else [1, 2][:count]
    )
    assert reported == list(answers(SCENES[:count]))


def test_what_is_not_utf8_is_an_error_of_its_line(tmp_path):
    scenes, out = tmp_path / "scenes.jsonl", tmp_path / "answers.jsonl"
    scenes.write_bytes(b"\xff\xfe{}\n" + SCENES[0].encode())

    assert run(scenes, out).first == "line 1: not UTF-8"
    assert out.read_text().splitlines()[1] == EXPECTED.splitlines()[0].replace(
        '{"line": 1', '{"line": 2'
    )


@pytest.mark.parametrize("most", [100, 700, 20_000])
def test_a_line_that_is_too_long_is_an_error_of_its_own(tmp_path, most):
    scenes, out = tmp_path / "scenes.jsonl", tmp_path / "answers.jsonl"
    long = SCENES[0].replace(": [", ": [" + " " * 600_000, 1)
    scenes.write_text("\n".join([SCENES[0], long, SCENES[1], long]))

    summary = run(scenes, out, Options(max_bytes=most))

    assert summary.scenes == 4
    assert summary.failures == (4 if most == 100 else 2)
    reported = [json.loads(line) for line in out.read_text().splitlines()]
    assert reported[1] == {"line": 2, "error": f"more than {most} bytes"}
    longest = max(len(chunk.text) for chunk in Lines(scenes, most).chunks({}, 4096))
    assert longest < 300_000


def test_a_chunk_begins_where_a_known_one_ends(scenes):
    source = Lines(scenes, 10**8)
    chunks = list(source.chunks({}, 4096))
    whole = b"".join(chunk.text for chunk in chunks)

    assert whole == scenes.read_bytes()
    assert [c.start for c in chunks[1:]] == [c.stop for c in chunks[:-1]]
    known = {c.start: record(c) for c in chunks[1::3]}
    rest = list(source.chunks(known, 10**6))
    assert {c.start for c in rest}.isdisjoint(known)
    places = sorted([(c.start, c.stop) for c in rest] + [(r.start, r.stop) for r in known.values()])
    assert [a for a, _ in places] == [0, *(b for _, b in places[:-1])]
    numbers = {c.start: c.line for c in chunks}
    assert all(numbers[c.start] == c.line for c in rest)


def record(chunk):
    from exactpt.batch.chunks import record_of

    return record_of(answered(chunk, lambda _: None, Options(every=True)), 0)


QUESTIONS = {
    "--all": (Options(every=True), "intervals"),
    "--within 1/2": (Options(distance="1/2"), "approach"),
    "--until 3 --since 1": (Options(until=3, since=1), "contact"),
    "--method kinetic --tiling lazy": (Options(method="kinetic", tiling="lazy"), "contact"),
    "--ignore a,b": (Options(ignoring=(("a", "b"),)), "contact"),
    "--after-start": (Options(after_start=True), "contact"),
    "--between a,b": (Options(between=(("a", "b"),)), "contact"),
    "--exact-only": (Options(exact_only=True), "contact"),
}


@pytest.mark.parametrize("given", QUESTIONS)
def test_any_options_of_one_scene(tmp_path, given, monkeypatch, capsys):
    options, key = QUESTIONS[given]
    monkeypatch.chdir(tmp_path)
    lines = generic_lines(6, seed=1)
    (tmp_path / "scenes.jsonl").write_text("\n".join(lines))

    assert code_of("batch", "scenes.jsonl", "-o", "answers.jsonl", *given.split()) == 0
    assert (tmp_path / "answers.jsonl").read_text() == expected(lines, options)
    reported = [
        json.loads(line)[key] for line in (tmp_path / "answers.jsonl").read_text().splitlines()
    ]
    (tmp_path / "one.json").write_text(lines[0])
    if key != "approach":
        asked = given.replace("--until 3 --since 1", "--since 1 --until 3").split()
        code_of("collide", "one.json", "--json", *asked)
        assert json.loads(capsys.readouterr().out)[key] == reported[0]


def test_the_command_counts_failures(scenes, tmp_path, capsys):
    out = tmp_path / "answers.jsonl"

    assert code_of("batch", scenes, "-o", out, "--quiet") == 2
    assert out.read_text() == EXPECTED
    (reported,) = capsys.readouterr().err.splitlines()
    assert reported.startswith(
        f"exactpt: {scenes}: {len(MALFORMED)} of {len(SCENES)} scenes without a result; line"
    )


def test_a_budget_is_one_of_each_scene(tmp_path):
    scenes, out = tmp_path / "scenes.jsonl", tmp_path / "answers.jsonl"
    far = [
        {"name": str(k), "vertices": [[7 * k, 0], [7 * k + 1, 0], [7 * k, 1]]} for k in range(20)
    ]
    one = json.dumps({"exactpt": 1, "time": [0, 1], "bodies": far})
    scenes.write_text(f"{one}\n{SCENES[0]}\n")

    summary = run(scenes, out, Options(max_memory=1))

    assert summary.failures == 2
    assert summary.first == "line 1: memory limit exceeded"


@pytest.mark.parametrize("line", [SCENES[0], TURNING[0]])
def test_no_time_at_all(line):
    (reported,) = answers([line], Options(max_seconds=0))

    assert reported == {"error": "time limit exceeded"}


def test_workers_are_deaf_to_ctrl_c_from_their_first_moment_on():
    command = "import signal; print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))"

    with processes._deaf():
        inside = subprocess.check_output([sys.executable, "-c", command])

    assert inside == b"True\n"
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


@pytest.mark.parametrize("what", ["missing", "folder", "null"])
def test_an_input_that_is_no_file_is_refused(tmp_path, what):
    path = {"missing": tmp_path / "no.jsonl", "folder": tmp_path, "null": "/dev/null"}[what]

    assert str(path) in refusal(path, tmp_path / "answers.jsonl")
    assert left(tmp_path) == []


@pytest.mark.parametrize("jobs", [0, -1, 1025, 10**9])
def test_jobs_out_of_range_are_refused(scenes, tmp_path, jobs):
    """A million processes were started, before any scene was read."""
    with pytest.raises(InputError, match="jobs: expected a number from 1 to 1024"):
        run(scenes, tmp_path / "answers.jsonl", jobs=jobs)
    assert code_of("batch", scenes, "-o", tmp_path / "x", "--jobs", jobs) == 2


@pytest.mark.long
def test_no_more_processes_than_chunks_are_started(tmp_path, monkeypatch):
    started = []
    make = processes._Worker.__init__

    def counted(self, work):
        started.append(self)
        make(self, work)

    monkeypatch.setattr(processes._Worker, "__init__", counted)
    (tmp_path / "one.jsonl").write_text(SCENES[0] + "\n")

    run(tmp_path / "one.jsonl", tmp_path / "answers.jsonl", jobs=50)

    assert len(started) == 1


def test_an_output_in_no_folder_is_refused(scenes, tmp_path):
    assert "cannot be written" in refusal(scenes, tmp_path / "no" / "answers.jsonl")


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_a_cluster_gives_the_same_bytes_and_loses_a_worker(scenes, tmp_path):
    distributed = pytest.importorskip("distributed")
    out = tmp_path / "answers.jsonl"
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        pids = list(client.run(os.getpid).values())

        def report(*_):
            if pids:
                os.kill(pids.pop(), signal.SIGKILL)
                pids.clear()

        run(scenes, out, scheduler=cluster.scheduler_address, report=report)

    assert out.read_text() == EXPECTED


@pytest.mark.long
@pytest.mark.filterwarnings("default")
def test_a_scheduler_that_does_not_answer_is_refused(scenes, tmp_path):
    pytest.importorskip("distributed")
    with pytest.raises(InputError, match="no scheduler at"):
        run(scenes, tmp_path / "answers.jsonl", scheduler="nonsense://nowhere")
    assert not list(tmp_path.glob("answers.jsonl*"))


@pytest.mark.long
@pytest.mark.filterwarnings("default")
def test_bug_a_silent_scheduler_is_named_within_five_seconds(scenes, tmp_path):
    """It accepts the connection and does not answer: the client waited for 30 s and more."""
    pytest.importorskip("distributed")
    with socket.create_server(("127.0.0.1", 0)) as silent:
        address = f"tcp://127.0.0.1:{silent.getsockname()[1]}"
        began = time.monotonic()
        with pytest.raises(InputError, match=f"^no scheduler at {address}: no answer within 5 s"):
            run(scenes, tmp_path / "answers.jsonl", scheduler=address)
        assert time.monotonic() - began < 10
    assert not list(tmp_path.glob("answers.jsonl*"))


@pytest.mark.parametrize(
    "wrong",
    [{"ignoring": "ab"}, {"ignoring": ["ab"]}, {"between": "ab"}, {"between": [("a", "a")]}],
)
def test_options_that_are_no_names_are_refused_before_any_scene(wrong):
    with pytest.raises(InputError, match=next(iter(wrong))):
        Options(**wrong)


def test_options_of_iterators_hold_for_every_scene():
    options = Options(ignoring=(pair for pair in [["a", "b"]]), between=iter([["b", "c"]]))

    assert (options.ignoring, options.between) == ((("a", "b"),), (("b", "c"),))
    assert options.to_json()["between"] == (("b", "c"),)
