"""Hostile files: every one is run, or refused with exit code 2 and one clear line.

The command line itself is called, in this process: whatever the file, no traceback, no
hang, nothing on standard output, nothing written.
"""

import copy
import json
import random
import signal
import sys

import pytest
from commands import code_of
from folding import every

VALID = {
    "exactpt": 1,
    "time": ["0", "2"],
    "bodies": [
        {"name": "box", "vertices": [["0", "0"], [2, 0], [2, 1.5], ["0", "3/2"]],
         "motion": {"x": ["0", "1/2"], "y": [0]}},
        {"name": "blob", "vertices": [{"x": ["9", "-1"]}, {"x": [10], "y": [0, "1/3"]}, ["9", 1]]},
        {"name": "arm", "vertices": [["0", "5"], ["4", "5"], ["4", "6"]],
         "motion": {"rigid": {"pivot": ["0", "5"], "half_turn": ["0", "1/4"], "x": ["0"]}}},
        {"name": "skew", "vertices": [["20", "5"]],
         "motion": {"affine": {"matrix": [[[1], [0]], [[0], [1, "1/5"]]], "y": ["1"]}}},
        {"name": "jelly", "keyframes": [{"t": "0", "vertices": [["8", "8"], ["9", "8"]]},
                                        {"t": "2", "vertices": [["7", "8"], ["9", "7"]]}]},
        {"name": "probe", "vertices": [["1", "-9"]], "motion": {"pieces": [
            {"until": "1", "motion": {"x": ["0", "1"]}}, {"motion": {"x": ["2", "-1"]}}]}},
    ],
}  # fmt: skip
BODY_KEYS = ("name", "vertices", "motion", "closed", "keyframes")
JUNK = [
    None, True, False, 0, -1, 7, 1.5, 10**30, [], {}, "", "x", "1/0", "1/-2", "--1", "1e5",
    "1e999999999", "-1e-999999999", "NaN", "Infinity", "0x10", "1_000", "\uff11", "1 ", "\u0000",
    "\ud800", "½", [[]], [["0"]], ["0", "1", "2"], {"x": 1}, {"x": ["0"], "z": ["1"]},
    {"rigid": {}}, {"pieces": []}, {"affine": {"matrix": []}}, {"until": "1"}, "1" * 500,
    [["0", "0"]] * 3, [["0", "0"], ["1", "1"], ["2", "2"]], [["0", "0"], ["1", "0"], ["0", "0"]],
]  # fmt: skip
RAW = [
    "NaN", "Infinity", "-Infinity", "1e999999999", "-1E+999999999", "1e-999999999", "01", "1.",
    ".5", "+1", "0x1", "1/2", "'a'", "undefined", "1" * 100_000, "0." + "3" * 100_000,
    "[" * 1000 + "]" * 1000, "[" * 100_000, '{"x":' * 900 + "1" + "}" * 900, "[1,]", "{,}", '"',
    '"\\u12"', '"\\ud800"', "\ufeff1", "/* */ 1", "1 1", "", "\x00",
]  # fmt: skip


BUDGET = ("--max-seconds", "10")
"""Most answer at once; but numbers of hundreds of digits make a scene that takes its time."""


class TooSlowError(AssertionError):
    pass


@pytest.fixture
def run(tmp_path, capsys):
    """Write bytes to a file, run a command on it: exit code, standard output and error."""

    def hang(signum, frame):
        raise TooSlowError

    def run(content, *arguments):
        path = tmp_path / "scene.json"
        path.write_bytes(content)
        old = signal.signal(signal.SIGALRM, hang)
        signal.alarm(20)
        try:
            code = code_of(*(arguments or ("collide",)), path, "--max-events", "50", *BUDGET)
        finally:
            signal.alarm(0)
            signal.signal(signal.SIGALRM, old)
        assert [p.name for p in tmp_path.iterdir()] == ["scene.json"], "something was written"
        return code, *capsys.readouterr(), path

    return run


def assert_refused(answer):
    """Exit code 2, nothing but one line on standard error that begins with the file."""
    code, out, err, path = answer
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert err.startswith(f"exactpt: {path}: ")
    assert len(err) < 500 + len(str(path))
    return err


def assert_run_or_refused(answer):
    code, _, err, _ = answer
    if code in (0, 4):
        assert "Traceback" not in err
    else:
        assert_refused(answer)


def text(data):
    return json.dumps(data).encode()


def places(data, path=()):
    """Every place in the data, as a path."""
    if path:
        yield path
    if isinstance(data, dict):
        for key in data:
            yield from places(data[key], (*path, key))
    elif isinstance(data, list):
        for i, value in enumerate(data):
            yield from places(value, (*path, i))


def at(data, path):
    for key in path:
        data = data[key]
    return data


def mutated(rng):
    """The valid scene with one to three wounds."""
    data = copy.deepcopy(VALID)
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        path = rng.choice(list(places(data)) or [("exactpt",)])
        parent, key = at(data, path[:-1]), path[-1]
        match rng.randrange(6):
            case 0:
                del parent[key]
            case 1:
                parent[key] = copy.deepcopy(at(data, rng.choice(list(places(data)))))
            case 2 if isinstance(parent, dict):
                parent[rng.choice([*BODY_KEYS, "colour", "x", "until", ""])] = parent[key]
            case 3 if isinstance(parent, list):
                parent.insert(key, copy.deepcopy(rng.choice([parent[key], rng.choice(JUNK)])))
            case _:
                parent[key] = copy.deepcopy(rng.choice(JUNK))
        if not isinstance(data, dict):
            break
    return data


def test_the_valid_scene_is_valid(run):
    code, out, err, _ = run(text(VALID))

    assert (code, err) == (0, "")
    assert out.startswith("no contact")


@pytest.mark.long
@pytest.mark.parametrize(
    "count", [400, pytest.param(10_000, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_mutated_scenes_are_run_or_refused(run, count):
    rng = random.Random(f"hostile {count}")
    refused = 0
    for _ in range(count):
        answer = run(text(mutated(rng)))
        assert_run_or_refused(answer)
        refused += answer[0] == 2

    assert refused > count / 2


@pytest.mark.long
@pytest.mark.parametrize(
    "count", [300, pytest.param(10_000, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_damaged_bytes_are_run_or_refused(run, count):
    """Cut off, with bytes flipped, inserted or doubled: nearly always no JSON."""
    rng = random.Random(f"bytes {count}")
    whole = text(VALID)
    for _ in range(count):
        content = bytearray(whole)
        for _ in range(rng.choice([1, 1, 2, 5])):
            i = rng.randrange(len(content) + 1)
            match rng.randrange(5):
                case 0:
                    del content[i:]
                    content += b" "
                case 1:
                    content[i : i + 1] = [rng.randrange(256)]
                case 2:
                    content[i:i] = rng.randbytes(rng.choice([1, 4, 50]))
                case 3:
                    content[i:i] = content[i : i + rng.randrange(60)]
                case _:
                    del content[i : i + rng.randrange(9)]
        assert_run_or_refused(run(bytes(content)))


@pytest.mark.long("bodies-4-keyframes-1-t")
@pytest.mark.parametrize(
    "path",
    [("exactpt",), ("time", 1), ("bodies",), ("bodies", 0), ("bodies", 0, "name"),
     ("bodies", 0, "vertices", 1, 0), ("bodies", 0, "motion", "x", 1),
     ("bodies", 4, "keyframes", 1, "t")],
    ids=lambda path: "-".join(map(str, path)),
)  # fmt: skip
@every("raw", RAW)
def test_raw_text_in_place_of_a_value(run, raw, path):
    data = copy.deepcopy(VALID)
    at(data, path[:-1])[path[-1]] = "MARK"

    answer = run(json.dumps(data).replace('"MARK"', raw).encode("utf-8", "surrogatepass"))

    if set(raw) <= set("0123456789."):
        assert_run_or_refused(answer)
    else:
        assert_refused(answer)


@pytest.mark.long
@pytest.mark.parametrize(
    "content",
    [
        b"", b" ", b"\x00", b"null", b"[]", b"{}", b"3", b'"scene"', b"\xff\xfe{\x00}\x00",
        json.dumps(VALID).encode("utf-16"), json.dumps(VALID).encode("utf-32"),
        b"\x89PNG\r\n\x1a\n" + bytes(range(256)),
        random.Random(1).randbytes(100_000), b"[" * 1_000_000, b'{"a":' * 1_000_000,
        json.dumps(VALID).encode() * 2, b"{" + b'"a": 1, ' * 10_000 + b'"b": 2}',
    ],
    ids=str,
)  # fmt: skip
def test_what_is_no_scene_at_all_is_refused(run, content):
    assert_refused(run(content))


@pytest.mark.parametrize("key", ["exactpt", "time", "bodies"])
def test_a_key_that_is_there_twice_is_refused(run, key):
    content = json.dumps(VALID)[:-1] + f', "{key}": {json.dumps(VALID[key])}}}'

    assert f"'{key}' is there twice" in assert_refused(run(content.encode()))


@pytest.mark.parametrize("digits", [10_000, pytest.param(10_000_000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("form", ["{0}", '"{0}"', '"{0}/3{0}"', "0.{0}", '"-{0}.{0}"', "1e{0}"])
def test_numbers_of_any_length_are_run_or_refused_at_once(run, digits, form):
    data = copy.deepcopy(VALID)
    data["bodies"][0]["motion"]["y"] = "MARK"
    data["bodies"] = data["bodies"][:2]
    number = form.format("7" * digits)

    answer = run(json.dumps(data).replace('"MARK"', f"[{number}]").encode())

    assert_run_or_refused(answer)


def test_a_huge_number_in_a_wrong_place_is_shown_short(run):
    data = copy.deepcopy(VALID)
    data["bodies"][0]["name"] = "MARK"

    answer = run(json.dumps(data).replace('"MARK"', "7" * 1_000_000).encode())

    assert len(assert_refused(answer)) < 500


@pytest.mark.long
def test_many_bodies_and_vertices_are_refused_by_the_last(run):
    """All of a large file is read before anything runs."""
    data = {"exactpt": 1, "time": [0, 1], "bodies": [
        {"name": f"b{i}", "vertices": [[3 * i, 0], [3 * i + 1, 0], [3 * i, 1]]} for i in range(5000)
    ]}  # fmt: skip
    data["bodies"][-1]["vertices"][2][1] = "one"

    assert "'b4999': vertex 2: y: not a number: 'one'" in assert_refused(run(text(data)))


@pytest.mark.parametrize("command", ["collide", "simulate", "tile", "check"])
def test_every_command_refuses_alike(run, command):
    data = copy.deepcopy(VALID)
    data["bodies"][0]["closed"] = "yes"

    err = assert_refused(run(text(data), command))

    assert err.endswith("body 'box': \"closed\": not true or false: 'yes'\n")


@pytest.mark.parametrize("content", [text({**VALID, "time": [1, 1]}), b"{", b"\xff"])
def test_nothing_is_written_if_the_scene_is_refused(tmp_path, capsys, content):
    scene, output = tmp_path / "scene.json", tmp_path / "tiling.json"
    scene.write_bytes(content)
    output.write_text("old")

    for arguments in (["tile", str(scene), "-o"], ["simulate", str(scene), "--events"]):
        assert code_of(*arguments, output) == 2

    assert output.read_text() == "old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["scene.json", "tiling.json"]
    assert len(capsys.readouterr().err.splitlines()) == 2


@pytest.mark.parametrize("name", ["missing.json", ".", "a\nb.json", "x" * 300])
def test_paths_that_cannot_be_read(tmp_path, capsys, name):
    assert code_of("collide", tmp_path / name) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_recursion_is_left_as_it_was(run):
    limit = sys.getrecursionlimit()

    assert_refused(run(b"[" * 10_000))

    assert sys.getrecursionlimit() == limit


LONG = "7" * 3000


@pytest.mark.parametrize(
    "path, value",
    [
        (("time",), [LONG, f"-{LONG}"]),
        (("bodies", 4, "keyframes", 0, "t"), LONG),
        (("bodies", 5, "motion", "pieces", 0, "until"), f"1/{LONG}"),
        (("bodies", 5, "motion", "pieces", 1, "motion", "x", 0), LONG),
        (("bodies", 0, "vertices", 2), [f"1/{LONG}", f"-{LONG}"]),
        (("bodies", 0, "vertices"), [[LONG, LONG], [LONG, LONG], ["0", "1"]]),
        (("bodies", 0, "vertices"), [["0", "0"], [LONG, LONG], [f"2{LONG}", f"2{LONG}"]]),
        (("bodies", 0), {"name": "x" * 5000, "vertices": [["0", "0"], ["0", "0"]]}),
        (("bodies", 0), {"name": "x" * 5000, "vertices": []}),
    ],
    ids=str,
)
def test_bug_long_numbers_and_names_are_cut_in_every_refusal(run, path, value):
    data = copy.deepcopy(VALID)
    at(data, path[:-1])[path[-1]] = value

    assert_refused(run(text(data)))
