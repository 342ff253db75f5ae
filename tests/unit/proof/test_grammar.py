"""The keys of scenes that state groups, errors, units and an epoch, as the checkers take them.

`grammar-misuse.json` has scenes with these keys, and whether a reader accepts each. A scene that
is refused because a record is not verified (``verified``) is one to a checker of certificates.
"""

import hashlib
import json
import subprocess
from pathlib import Path

import pytest

import exactpt
from exactpt import Body, PosePath, Scene, check_apart, proof_check, proof_scene

TABLE = json.loads(
    (Path(__file__).parents[2] / "data" / "grammar-misuse.json").read_text(encoding="utf-8")
)
IGNORES = "rejected: a proof by a tiling counts all pairs, this scene ignores some"
SQUARE = [["0", "0"], ["1", "0"], ["1", "1"], ["0", "1"]]


def hash_of(scene):
    return hashlib.sha256(scene).hexdigest()


def is_read(scene, *, are_records_verified):
    try:
        proof_scene.Scene(json.dumps(scene), are_records_verified=are_records_verified)
    except proof_scene.NoProofError:
        return False
    return True


@pytest.mark.parametrize("row", TABLE, ids=[row["name"] for row in TABLE])
def test_scenes_of_the_table_are_read_in_python_as_stated(row):
    assert is_read(row["scene"], are_records_verified=True) == row["accepted"]
    of_certificate = row["accepted"] or row.get("verified", False)
    assert is_read(row["scene"], are_records_verified=False) == of_certificate


@pytest.mark.cgal
def test_scenes_of_the_table_are_read_in_cpp_as_stated(program, tmp_path):
    paths = tmp_path / "scene.json", tmp_path / "proof"
    for row in TABLE:
        scene = json.dumps(row["scene"]).encode()
        paths[0].write_bytes(scene)
        has_radius = any("radius" in body for body in row["scene"]["bodies"])
        for kind in ("exactpt-proof", "exactpt-apart"):
            # The span is none of the scene: exit code 1 if the scene is read, else 2.
            text = f"{kind} 1\nscene sha256 {hash_of(scene)}\nspan -7 -8\nnone\n"
            paths[1].write_text(text, encoding="utf-8")
            done = subprocess.run([program, "proof", *paths], capture_output=True, check=False)
            is_verified = kind == "exactpt-proof"
            expected = row["accepted"] or (row.get("verified", False) and not is_verified)
            if is_verified and has_radius:
                expected = False
            assert done.returncode == (1 if expected else 2), (row["name"], kind, done.stdout)


# ---- What is said of scenes with these keys, by both checkers.


def scene_of(bodies, **keys):
    """The bytes of a scene of points: names, abscissas at t = 0 and speeds; from t = 0 to 8."""
    rows = [
        {"name": name, "vertices": [[str(x), "0"]], "motion": {"x": ["0", str(speed)]}, **more}
        for name, x, speed, more in bodies
    ]
    return json.dumps({"exactpt": 1, "time": ["0", "8"], "bodies": rows, **keys}).encode()


def certificate(scene, *lines, until="8"):
    head = ["exactpt-apart 1", f"scene sha256 {hash_of(scene)}", f"span 0 {until}"]
    return "\n".join([*head, *lines, ""]).encode()


def in_cpp(scene, proof, folder):
    """The line of the checker in C++ with its exit code."""
    paths = folder / "s.json", folder / "p"
    paths[0].write_bytes(scene)
    paths[1].write_bytes(proof)
    program = exactpt.cgal.find_program()
    done = subprocess.run(
        [program, "proof", *paths], capture_output=True, check=False, text=True, timeout=60
    )
    return done.returncode, done.stdout.strip()


def in_python(scene, proof, folder, capsys):
    """The line of the checker in Python with its exit code."""
    paths = folder / "s.json", folder / "p"
    paths[0].write_bytes(scene)
    paths[1].write_bytes(proof)
    checker = check_apart if proof.startswith(b"exactpt-apart") else proof_check
    capsys.readouterr()
    code = checker.main([*map(str, paths)])
    said = capsys.readouterr()
    return code, (said.out or said.err).strip()


@pytest.fixture(params=["python", pytest.param("c++", marks=pytest.mark.cgal)])
def verdict(request, tmp_path, capsys):
    """The exit code and the line of a checker; each test runs with both."""
    if request.param == "c++":
        request.getfixturevalue("program")
        return lambda scene, proof: in_cpp(scene, proof, tmp_path)
    return lambda scene, proof: in_python(scene, proof, tmp_path, capsys)


APART = "no two bodies share a point in [0, 8], the whole span"
LINE = "c 1 0 1"  # between x = 0 and x = 2
STATED = [{"place_error": "1/100"}, {"shape_error": ["0", "1/9"]}]
STATED.append({"angle_error": "1/100", "pivot": ["0", "0"]})


@pytest.mark.parametrize("errors", STATED, ids=lambda errors: next(iter(errors)))
def test_a_stated_error_makes_a_certificate_one_of_modelled_bodies(verdict, errors):
    scene = scene_of([("a", 0, 0, {}), ("b", 2, 0, errors)])
    code, said = verdict(scene, certificate(scene, LINE, "none"))
    assert (code, said) == (0, f"accepted: {hash_of(scene)[:16]} modelled bodies: {APART}")


@pytest.mark.parametrize("errors", STATED, ids=lambda errors: next(iter(errors)))
def test_a_stated_error_makes_a_tiling_proof_one_of_modelled_bodies(verdict, errors):
    scene = scene_of([("a", 0, 0, errors)])
    proof = f"exactpt-proof 1\nscene sha256 {hash_of(scene)}\nspan 0 8\nouter 0\nnone\n".encode()
    code, said = verdict(scene, proof)
    words = "modelled bodies: no contact in [0, 8], the whole span"
    assert (code, said) == (0, f"accepted: {hash_of(scene)[:16]} {words}")


@pytest.mark.parametrize("errors", [{}, {"place_error": "0"}, {"shape_error": [0, 0]}])
def test_an_error_of_zero_says_nothing_of_modelled_bodies(verdict, errors):
    scene = scene_of([("a", 0, 0, {}), ("b", 2, 0, errors)])
    code, said = verdict(scene, certificate(scene, LINE, "none"))
    assert (code, said) == (0, f"accepted: {hash_of(scene)[:16]} {APART}")


def test_rows_of_which_one_has_an_error_are_of_modelled_bodies(verdict):
    plain = scene_of([("a", 0, 0, {}), ("b", 2, 0, {})])
    stated = scene_of([("a", 0, 0, {}), ("b", 2, 0, {"place_error": 1})])
    scenes = plain + b"\n" + stated + b"\n"
    row = f"span 0 8;{LINE};none\n"
    text = f"exactpt-apart-rows 1\nscenes sha256 {hash_of(scenes)}\n{row}{row}"
    code, said = verdict(scenes, text.encode())
    words = "2 rows, each of two or more bodies in the whole span: no contact in 2"
    assert (code, said) == (0, f"accepted: {hash_of(scenes)[:16]} modelled bodies: {words}")


def parts_of_a_run(folder, *errors):
    """Proofs of a point at rest, one after the other, of parts that take a unit of time."""
    for k, error in enumerate(errors, 1):
        body = {"name": "a", "vertices": [["0", "0"]], **error}
        data = {"exactpt": 1, "time": [str(k - 1), str(k)], "bodies": [body]}
        scene = json.dumps(data).encode()
        head = f"exactpt-proof 1\nscene sha256 {hash_of(scene)}\nspan {k - 1} {k}\n"
        (folder / f"{k}.scene.json").write_bytes(scene)
        (folder / f"{k}.proof").write_text(f"{head}outer 0\nnone\n", encoding="utf-8")


@pytest.mark.parametrize("place", [0, 1, None])
def test_parts_of_which_one_has_an_error_are_of_modelled_bodies(tmp_path, place):
    parts = [{"place_error": "1/9"} if k == place else {} for k in (0, 1)]
    parts_of_a_run(tmp_path, *parts)
    said = proof_check.check_chain(tmp_path).split(" ", 2)[2]
    modelled = "" if place is None else "modelled bodies: "
    words = f"{modelled}no contact in [0, 2], the whole span"
    assert said == f"along 2 parts from t = 0: {words}"


@pytest.mark.cgal
def test_parts_are_of_modelled_bodies_in_cpp_too(program, tmp_path):
    parts_of_a_run(tmp_path, {"shape_error": [1, 0]}, {})
    done = subprocess.run([program, "proof", tmp_path], capture_output=True, check=False, text=True)
    assert done.stdout.strip() == proof_check.check_chain(tmp_path)


GROUPS = {"ignoring": [["a", "b"]]}


def test_a_proof_by_a_tiling_of_a_scene_with_groups_is_rejected(verdict):
    for groups, expected in ((GROUPS, 1), ({"ignoring": []}, 0)):
        bodies = [("a", 0, 0, {}), ("b", 2, 0, {})]
        plain = Scene.from_json(json.loads(scene_of(bodies)))
        scene = scene_of(bodies, **groups)
        lines = exactpt.prove(plain).text.decode().splitlines()
        lines[1] = f"scene sha256 {hash_of(scene)}"
        code, said = verdict(scene, "".join(f"{line}\n" for line in lines).encode())
        assert code == expected
        assert expected == 0 or said == IGNORES


# Three points: a and b may meet (or not), c is apart from both.
THREE = [("a", 0, 0, {}), ("b", 2, "-1/4", {}), ("c", 9, 0, {})]  # a and b meet at t = 8
BESIDE = "c 1 0 5"  # between c and the others


def test_pairs_that_the_scene_ignores_may_be_left_out_of_a_certificate(verdict):
    scene = scene_of(THREE, **GROUPS)
    code, said = verdict(scene, certificate(scene, "ignoring 0 1", BESIDE, "none"))
    assert code == 0
    assert f" {APART}; ignoring b0 b1 (b0 is 'a'" in said
    code, said = verdict(scene, certificate(scene, "between 0 2", "between 1 2", BESIDE, "none"))
    assert code == 0
    assert f" {APART}; between b0 b2; between b1 b2 (b0 is 'a'" in said


@pytest.mark.parametrize(
    "lines", [["ignoring 0 2"], ["between 0 2"], ["between 1 2"], ["ignoring 0 1 2"]]
)
def test_a_certificate_that_leaves_out_a_pair_that_counts_is_a_part(verdict, lines):
    scene = scene_of([("a", 0, 0, {}), ("b", 3, 0, {}), ("c", 9, 0, {})], **GROUPS)
    nodes = {"ignoring 0 2": ["c 1 0 1", "c 1 0 5"], "ignoring 0 1 2": []}
    code, said = verdict(scene, certificate(scene, *lines, *nodes.get(lines[0], [BESIDE]), "none"))
    assert (code, "proved is only a part" in said) == (1, True), said


def test_the_same_lines_are_a_part_if_the_scene_ignores_nothing(verdict):
    scene = scene_of(THREE)
    code, said = verdict(scene, certificate(scene, "ignoring 0 1", BESIDE, "none"))
    assert (code, "proved is only a part" in said) == (1, True)


def test_a_certificate_of_all_pairs_is_one_of_those_that_count(verdict):
    bodies = [("a", 0, 0, {}), ("b", 3, 0, {}), ("c", 9, 0, {})]
    scene = scene_of(bodies, **GROUPS)
    code, said = verdict(scene, certificate(scene, "c 1 0 1", "c 1 0 5", "none"))
    assert (code, said) == (0, f"accepted: {hash_of(scene)[:16]} {APART}")


def test_a_contact_of_bodies_that_the_scene_ignores_is_rejected(verdict):
    lines = ["c 1 0 1/10", "c 1 0 5", "meet 8 0 1"]  # a and b, at t = 8
    plain, ignored = scene_of(THREE), scene_of(THREE, **GROUPS)
    assert verdict(plain, certificate(plain, *lines, until="7"))[0] == 0
    code, said = verdict(ignored, certificate(ignored, *lines, until="7"))
    assert (code, "of two bodies that ignore each other" in said) == (1, True)


def test_ignoring_is_not_transitive_in_certificates(verdict):
    bodies = [("link 1", 0, 0, {}), ("link 2", 1, 0, {}), ("link 3", 2, 0, {})]
    scene = scene_of(bodies, ignoring=[["link 1", "link 2"], ["link 2", "link 3"]])
    code, _ = verdict(scene, certificate(scene, "between 0 2", "c 1 0 3/2", "none"))
    assert code == 0
    code, said = verdict(scene, certificate(scene, "ignoring 0 1 2", "none"))
    assert (code, "proved is only a part" in said) == (1, True)


@pytest.mark.long
def test_patterns_of_many_bodies_are_counted(verdict):
    """A megabyte of patterns would fill the memory: each stands for thousands of bodies."""
    bodies = [(f"b{k}", k, 0, {}) for k in range(5000)]
    scene = scene_of(bodies, ignoring=[["*"]] * 40_000)
    code, said = verdict(scene, certificate(scene, "none"))
    assert (code, "budget of work" in said) == (4, True)


def test_every_body_in_one_group_leaves_nothing_to_prove(verdict):
    scene = scene_of(THREE, ignoring=[["*"]])
    code, said = verdict(scene, certificate(scene, "ignoring 0 1 2", "none"))
    assert (code, APART in said) == (0, True)


def test_a_named_pair_of_two_bodies_is_all_that_there_is(verdict):
    scene = scene_of([("a", 0, 0, {}), ("b", 2, 0, {})])
    code, said = verdict(scene, certificate(scene, "between 0 1", LINE, "none"))
    assert (code, said.split(" (")[0]) == (
        0,
        f"accepted: {hash_of(scene)[:16]} {APART}; between b0 b1",
    )


# ---- The pivot of a path: the pieces turn about it, and are compared with the poses there.


def along_a_path(pivot, shift=0):
    """A scene with a body along a path about a pivot, from one about the origin.

    Of a path about the origin, the pieces turn about the origin. About another pivot q the pose at
    t puts p at R (p - q) + q + (x, y): the pieces have the same half turns, x and y, and pivot q.
    """
    path = PosePath([0, 1, 2], [(0, [1, 1], [0, 1]), ([0, 1], 2, 1)], error="1e-2")
    data = Scene([Body("b", [(0, 0), (2, 0)], path)], time=(0, 2)).to_json()
    motion = data["bodies"][0]["motion"]
    for piece in motion["pieces"]:
        piece["motion"]["rigid"]["pivot"] = [str(c + shift) for c in pivot]
    motion["path"]["pivot"] = [str(c) for c in pivot]
    return data


@pytest.mark.parametrize("pivot", [(0, 0), (3, -1), (-7, 100)])
def test_pieces_about_the_pivot_of_a_path_follow_it(verdict, pivot):
    scene = json.dumps(along_a_path(pivot)).encode()
    proof = certificate(scene, "none", until="2")
    assert verdict(scene, proof)[0] == 0
    text = f"exactpt-proof 1\nscene sha256 {hash_of(scene)}\nspan 0 2\nouter 0 1\nnone\n"
    assert verdict(scene, text.encode())[0] == 0


def test_pieces_about_another_pivot_than_that_of_a_path_are_refused(verdict):
    scene = json.dumps(along_a_path((3, -1), shift=1)).encode()
    text = f"exactpt-proof 1\nscene sha256 {hash_of(scene)}\nspan 0 2\nouter 0 1\nnone\n"
    assert verdict(scene, text.encode())[0] == 2
    data = along_a_path((3, -1))
    del data["bodies"][0]["motion"]["path"]["pivot"]  # the origin, then
    assert not is_read(data, are_records_verified=True)


def test_a_misfit_about_a_pivot_is_found(verdict):
    data = along_a_path((3, -1))
    data["bodies"][0]["motion"]["path"]["error"] = "1/100000"  # of a path made within 1/100
    scene = json.dumps(data).encode()
    text = f"exactpt-proof 1\nscene sha256 {hash_of(scene)}\nspan 0 2\nouter 0 1\nnone\n"
    assert verdict(scene, text.encode())[0] == 2


def test_the_checker_that_is_handed_out_has_the_grammar(tmp_path):
    from exactpt.proof.handout import checker_file

    path = tmp_path / "check.py"
    path.write_bytes(checker_file("check_apart"))
    scene = scene_of(THREE, units={"time": "s"}, epoch="2026-01-01T00:00:00Z", **GROUPS)
    (tmp_path / "s.json").write_bytes(scene)
    (tmp_path / "p").write_bytes(certificate(scene, "ignoring 0 1", BESIDE, "none"))
    command = ["python3", "-I", path, tmp_path / "s.json", tmp_path / "p"]
    done = subprocess.run(command, capture_output=True, check=False, text=True)
    assert (done.returncode, done.stderr) == (0, "")
