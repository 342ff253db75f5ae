"""`exactpt bench`: forwards in a checkout, and says where the benchmarks are from a wheel."""

import pytest

import exactpt
from exactpt.cli import main


def test_from_a_wheel_bench_says_where_the_benchmarks_are(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(exactpt, "__file__", str(tmp_path / "exactpt" / "__init__.py"))

    with pytest.raises(SystemExit) as ended:
        main(["bench", "--quick"])

    assert ended.value.code == 2
    said = capsys.readouterr()
    assert said.err == "exactpt bench: moved to the repository (python -m benchmarks)\n"
    assert said.out == ""


def test_in_a_checkout_bench_forwards(tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        main(["bench", "statics", "--quick", "-o", str(tmp_path)])

    assert ended.value.code == 0
    assert "statics" in capsys.readouterr().out
    assert (tmp_path / "machine.txt").is_file()


def test_bench_reports_a_name_that_is_none(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["bench", "speed"])

    assert ended.value.code == 2
    assert "speed" in capsys.readouterr().err
