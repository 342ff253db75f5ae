"""Scenes and answers in Parquet files."""

import json

import pytest
from scenes_of_two import generic_lines

from exactpt.batch import Options, answers, run
from exactpt.batch.parquet import Rows
from exactpt.errors import InputError

arrow = pytest.importorskip("pyarrow")
parquet = pytest.importorskip("pyarrow.parquet")

LINES = [*generic_lines(60, seed=2), "{", json.dumps(json.loads(generic_lines(1)[0]), indent=1)]


@pytest.fixture
def scenes(tmp_path):
    path = tmp_path / "scenes.parquet"
    table = arrow.table({"id": range(len(LINES)), "scene": LINES})
    parquet.write_table(table, path, row_group_size=10)
    return path


def expected(lines):
    return [json.dumps({"line": k, **data}) for k, data in enumerate(answers(lines), 1)]


@pytest.mark.long("2")
@pytest.mark.parametrize("jobs", [1, 2])
def test_from_parquet_to_parquet(scenes, tmp_path, jobs):
    out = tmp_path / "answers.parquet"

    summary = run(scenes, out, jobs=jobs)

    rows = parquet.read_table(out).to_pylist()
    assert (summary.scenes, summary.failures) == (len(LINES), 1)
    assert [row["answer"] for row in rows] == expected(LINES)
    assert [row["line"] for row in rows] == list(range(1, len(LINES) + 1))
    for row in rows:
        data = json.loads(row["answer"])
        assert row["error"] == data.get("error")
        found = data.get("contact")
        assert row["time"] == (found["time"]["approx"] if found else None)
    assert sum(row["time"] is not None for row in rows) > 20


def test_columns_of_the_input_pass_through(tmp_path):
    path, out = tmp_path / "scenes.parquet", tmp_path / "answers.parquet"
    names = [f"scene {k}" for k in range(2500)]  # more than are read at a time
    weights = arrow.array([[k] for k in range(2500)], arrow.list_(arrow.int16()))
    columns = {"name": names, "scene": ["null"] * 2500, "time": weights, "input_time": names}
    parquet.write_table(arrow.table(columns), path)

    run(path, out)

    found = parquet.read_table(out)
    assert found["name"].to_pylist() == found["input_time"].to_pylist() == names
    assert found["input_input_time"].combine_chunks() == weights
    assert found["time"].null_count == 2500
    assert "scene" not in found.column_names


TWO = json.loads(generic_lines(1)[0]) | {
    "time": [0, 9],
    "bodies": [
        {"name": "ball", "vertices": [[0, 0]], "motion": {"x": [0, 1]}},
        {"name": "wall", "vertices": [[4, -1], [4, 2]]},
    ],
}


@pytest.mark.parametrize(
    "options, expected",
    [
        (Options(), {"time": 4.0, "kind": "vertex-edge", "vertex_a": 0, "edge_b": 0, "x": 4.0}),
        (Options(distance=1), {"time": 3.0, "kind": None, "vertex_a": None}),
        (
            Options(every=True),
            {
                "time": None,
                "intervals": [{"body_a": "ball", "body_b": "wall", "start": 4.0, "end": 4.0}],
            },
        ),
    ],
)
def test_bodies_features_and_points_have_columns(tmp_path, options, expected):
    path, out = tmp_path / "scenes.jsonl", tmp_path / "answers.parquet"
    path.write_text(json.dumps(TWO))

    run(path, out, options)

    (row,) = parquet.read_table(out).to_pylist()
    assert {name: row[name] for name in expected} == expected
    if not options.every:
        assert (row["body_a"], row["body_b"]) == ("ball", "wall")


@pytest.mark.long
def test_the_same_rows_make_the_same_bytes(scenes, tmp_path):
    outs = [tmp_path / "one.parquet", tmp_path / "two.parquet", tmp_path / "lines.jsonl"]
    run(scenes, outs[0])

    def interrupt(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(scenes, outs[1], report=interrupt)
    run(scenes, outs[1], jobs=2)
    run(scenes, outs[2])

    assert outs[0].read_bytes() == outs[1].read_bytes()
    assert outs[2].read_text().splitlines() == expected(LINES)


def test_rows_without_a_scene_are_errors_of_their_own(tmp_path):
    path, out = tmp_path / "scenes.parquet", tmp_path / "answers.jsonl"
    parquet.write_table(arrow.table({"scene": [None, LINES[0], "", " \n "]}), path)

    assert run(path, out).failures == 3
    assert json.loads(out.read_text().splitlines()[1])["line"] == 2


def test_chunks_of_rows_go_around_those_that_are_known(scenes):
    source = Rows(scenes)
    chunks = list(source.chunks({}, 2000))

    assert source.length == chunks[-1].stop == len(LINES)
    assert [c.start for c in chunks[1:]] == [c.stop for c in chunks[:-1]]
    known = {c.start: c for c in chunks[2::4]}
    rest = list(source.chunks(known, 10**6))
    places = sorted((c.start, c.stop) for c in [*rest, *known.values()])
    assert [a for a, _ in places] == [0, *(b for _, b in places[:-1])]
    assert len(rest) == len(known) + 1
    with pytest.raises(InputError, match="has changed"):
        list(source.chunks({2: chunks[2]._replace(start=2)}, 2000))


@pytest.mark.parametrize("kind", ["text", "other", "number"])
def test_what_is_no_table_of_scenes_is_refused(tmp_path, kind):
    path = tmp_path / "scenes.parquet"
    if kind == "text":
        path.write_text("{}\n")
    else:
        parquet.write_table(arrow.table({"other" if kind == "other" else "scene": [1]}), path)

    with pytest.raises(InputError, match=r"scenes.parquet: "):
        run(path, tmp_path / "answers.jsonl")
    assert [p.name for p in tmp_path.iterdir()] == ["scenes.parquet"]


def test_two_columns_of_one_name_pass_through(tmp_path):
    path, out = tmp_path / "scenes.parquet", tmp_path / "answers.parquet"
    columns = [arrow.array(["null"]), arrow.array([1]), arrow.array([2])]
    parquet.write_table(arrow.Table.from_arrays(columns, ["scene", "a", "a"]), path)

    run(path, out)

    found = parquet.ParquetFile(out).read()
    assert [field.name for field in found.schema][-3:] == ["answer", "a", "a"]
    assert [column.to_pylist() for column in found.columns[-2:]] == [[1], [2]]
