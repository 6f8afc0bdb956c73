# SPDX-License-Identifier: MIT
"""Levels from files, against what the shell makes of the same file."""

import csv
import json
import os
import subprocess

import numpy as np
import pytest
from scenes import DT, walk

import tahr

trimesh = pytest.importorskip("trimesh")
SHELL = os.environ.get("TAHR", "")
needs_shell = pytest.mark.skipif(not os.path.exists(SHELL), reason="TAHR names no shell (built without assimp?)")

SQUARE = "v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nv 9 0 9\nf 1 2 3\nf 1 3 4\n"


@pytest.fixture
def square(tmp_path):
    (tmp_path / "square.obj").write_text(SQUARE)
    return tmp_path / "square.obj"


def test_y_up_becomes_z_up(square):
    vertices, triangles = tahr.load_level(square)
    assert vertices.shape == (4, 3) and (vertices[:, 2] == 0).all() and triangles.dtype == np.uint32
    edges = vertices[triangles[:, 1:]] - vertices[triangles[:, :1]]
    assert (np.cross(edges[:, 0], edges[:, 1])[:, 2] > 0).all()  # fronts are up
    state = walk(tahr.Mover(tahr.World.from_file(square)), tahr.State(None, (0, 0, 1)), 60)
    assert state.mode == tahr.MODE_WALKING
    assert (tahr.load_level(square, "z")[0][:, 1] == 0).all()


def test_a_scene_places_its_meshes(tmp_path):
    box = trimesh.creation.box((2, 2, 2))
    scene = trimesh.Scene()
    for x in (0.0, 5.0):
        scene.add_geometry(box, transform=trimesh.transformations.translation_matrix((x, 0, 0)))
    scene.export(tmp_path / "two.glb")
    vertices, triangles = tahr.load_level(tmp_path / "two.glb", "z")
    assert len(triangles) == 24 and vertices[:, 0].min() == -1 and vertices[:, 0].max() == 6


def test_wrong_files_are_named(tmp_path, square):
    for name, text in (("none.obj", None), ("empty.obj", ""), ("wild.glb", "no level"), ("points.obj", "v 1 2 3\n")):
        if text is not None:
            (tmp_path / name).write_text(text)
        with pytest.raises((tahr.NotFoundError, tahr.FileError), match=name):
            tahr.load_level(tmp_path / name)
    with pytest.raises(tahr.ArgumentError, match="up is 'x', expected 'y' or 'z'"):
        tahr.load_level(square, "x")


@needs_shell
def test_the_bundled_playground_is_walked_as_the_shell_does(tmp_path):
    level, route, rows = tmp_path / "playground.obj", tmp_path / "route.json", tmp_path / "rows.csv"
    level.write_bytes(subprocess.run([SHELL, "level", "playground.obj"], check=True, capture_output=True).stdout)
    inputs = [{"time": 0, "move": [1, 0.3, 0]}, {"time": 2, "move": [-0.5, 1, 0]}]
    route.write_text(json.dumps({"start": [0, 0, 1.2], "inputs": inputs}))
    command = [SHELL, "run", "--level", level, "--route", route, "--seconds", "5", "--csv", rows, "--json"]
    summary = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)

    vertices, triangles = tahr.load_level(level)
    assert len(triangles) == summary["triangles"]
    world = tahr.World.from_mesh(vertices.astype(np.float32), triangles)  # the shell reads floats
    mover = tahr.Mover(world, tahr.Config(max_speed=5))  # and its characters run at 5 m/s
    state = tahr.State(mover.config, (0, 0, 1.2))
    with open(rows, newline="") as file:
        for tick, row in enumerate(csv.DictReader(file)):
            mover.step(state, tahr.Input(move=inputs[int(tick * DT >= 2)]["move"]), DT)
            place = [float(row[axis]) for axis in "xyz"]
            assert np.allclose(state.position, place, rtol=0, atol=1e-10), tick  # the file has 12 digits
            assert row["mode"] == state.mode_name
    assert tick == 299
