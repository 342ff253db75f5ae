"""Documents with their class, on both checkers: the specification for a third one.

Each file of ``conformance`` is a list of documents: a scene and a proof, the exit code that is
expected without options, and, where it is short, the statement that is proved.
"""

import hashlib
import json
import subprocess
from pathlib import Path

import pytest

from exactpt import InputError, Scene, check_apart, proof_check

DOCUMENTS = {
    f"{path.stem}: {document['name']}": document
    for path in sorted((Path(__file__).parent / "conformance").glob("*.json"))
    for document in json.loads(path.read_text(encoding="utf-8"))
}


def written(document, folder):
    scene, proof = folder / "s.json", folder / "p"
    scene.write_bytes(document["scene"].encode("utf-8", "surrogatepass"))
    proof.write_text(document["proof"], encoding="utf-8", newline="")
    return [str(scene), str(proof)]


def line_of(document):
    digest = hashlib.sha256(document["scene"].encode("utf-8", "surrogatepass")).hexdigest()
    return f"accepted: {digest[:16]} {document['says']}\n"


def test_there_are_documents_of_each_class():
    classes = [document["expected"] for document in DOCUMENTS.values()]
    assert len(classes) >= 350
    assert min(classes.count(code) for code in (0, 1, 2)) > 60
    assert set(classes) == {0, 1, 2}


@pytest.mark.parametrize("document", DOCUMENTS.values(), ids=DOCUMENTS)
def test_the_checker_in_python(document, tmp_path, capsys):
    checker = check_apart if document["proof"].startswith("exactpt-apart") else proof_check
    assert checker.main(written(document, tmp_path)) == document["expected"]
    said = capsys.readouterr()
    if "says" in document:
        assert said.out == line_of(document)


@pytest.mark.cgal
def test_the_checker_in_cpp(program, tmp_path):
    for name, document in DOCUMENTS.items():
        command = [program, "proof", *written(document, tmp_path)]
        done = subprocess.run(command, capture_output=True, check=False, text=True, timeout=60)
        assert done.returncode == document["expected"], (name, done.stdout)
        if "says" in document:
            assert done.stdout == line_of(document), name


@pytest.mark.long
def test_what_is_no_scene_to_exactpt_is_none_to_a_checker(tmp_path):
    refused = 0
    for name, document in DOCUMENTS.items():
        if document["group"] == "rows":  # a scene a line
            continue
        scene, _ = written(document, tmp_path)
        try:
            Scene.load(scene)
        except InputError:
            refused += 1
            assert document["expected"] == 2 or document["group"] == "records", name
        else:
            assert document["expected"] < 2 or document["group"] != "properties", name
    assert refused > 150
