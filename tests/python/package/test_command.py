"""The command `kinegraph`."""

import os
import subprocess
import sys

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.demo import followTarget


def kinegraph(*arguments, cwd=None):
    command = [sys.executable, "-m", "kinegraph", *arguments]
    return subprocess.run(command, capture_output=True, text=True, env=os.environ, cwd=cwd, timeout=120)


def test_the_demo_follows_its_target_within_a_tenth_of_a_millimeter():
    program = kinegraph("demo", "--seconds", "2.5", "--no-view")
    assert program.returncode == 0, program.stderr
    *seconds, total = program.stdout.splitlines()
    assert len(seconds) >= 2
    assert total.startswith("total: ") and "infeasible" not in total
    assert float(total.split("worst position error ")[1].split(" mm")[0]) < 0.1


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_demos_target_never_leaves_the_arms_reach(seed):
    summary = followTarget(1.0, rate=0, seed=seed, view=False)  # as many as possible: thousands of targets
    assert summary.solves > 100
    assert summary.infeasible == 0 and summary.worst_error < 1e-4


def test_info_lists_the_frames_of_a_file():
    program = kinegraph("info", "--frames", ry.raiPath("scenarios/pandaSingle.g"))
    assert program.returncode == 0
    assert "l_gripper" in program.stdout


def test_info_shows_what_moves_as_a_tree_with_limits(tmp_path):
    scene = tmp_path / "scene.g"
    scene.write_text("""
        world: {}  table (world): { shape: box, size: [1 1 .1], contact: 1 }
        drive (world): { joint: transXY, limits: [-1 -2 1 2] }
        turn (drive): { joint: hingeZ, limits: [-1 2], q: .5, ctrl_limits: [3 7 -1], shape: sphere, size: [.1] }
        copy (drive): { joint: hingeZ, mimic: turn }
        lid (turn): { joint: hingeX, joint_active: false }
        plate (lid): { shape: box, size: [1 1 .1], contact: -2 }
    """)
    program = kinegraph("info", str(scene))
    assert program.returncode == 0, program.stderr
    assert program.stdout.splitlines()[1:7] == [
        "collide: table plate",
        "world  (*table*)",
        "└── drive  transXY  q[0:2] = 0 in [-1, 1], 0 in [-2, 2]",
        "    ├── turn  hingeZ  q[2] = 0.5 in [-1, 2] at 3/s with 7  (turn)",
        "    │   └── lid  hingeX, not in q  (*plate*)",
        "    └── copy  hingeZ, follows turn",
    ]
    assert "contact -k" in program.stdout


def test_info_of_a_large_robot_fits_on_a_page():
    program = kinegraph("info", ry.raiPath("pr2/pr2.g"))
    assert program.returncode == 0, program.stderr
    assert 25 <= len(program.stdout.splitlines()) <= 60


@pytest.mark.parametrize("text, words", [("a: { shape: shpere }", "1:13"), (None, "missing.g")])
def test_a_file_that_is_wrong_gives_status_1_and_says_why(tmp_path, text, words):
    scene = tmp_path / "missing.g"
    if text:
        scene.write_text(text)
    program = kinegraph("info", str(scene))
    assert program.returncode == 1
    assert words in program.stderr and "Traceback" not in program.stderr


def test_an_unknown_command_gives_status_2():
    assert kinegraph("dmeo").returncode == 2


def test_check_shows_errors_and_warnings_with_their_lines(tmp_path):
    scene = tmp_path / "scene.g"
    scene.write_text("a: { colour: [1 0 0] }\nb (c): {}\nd: { shape: bax }\n")
    program = kinegraph("check", str(scene), ry.raiPath("panda/panda.g"))
    assert program.returncode == 1
    assert f"{scene}:2:1: error: parent of 'b': 'c' is not a frame of this scene" in program.stdout
    assert "    b (c): {}\n    ^" in program.stdout
    assert f"{scene}:1:6: warning: frame 'a': unknown attribute 'colour'; did you mean 'color'?" in program.stdout
    assert f"{scene}:3:13: error: frame 'd', shape: unknown shape type 'bax'" in program.stdout
    assert program.stdout.endswith("2 checked: 2 errors, 1 warnings\n")


def test_check_gives_status_0_for_warnings_unless_strict(tmp_path):
    scene = tmp_path / "scene.g"
    scene.write_text("a: { shpae: 3 }\n")
    assert kinegraph("check", str(scene)).returncode == 0
    assert kinegraph("check", "--strict", str(scene)).returncode == 1
    assert kinegraph("check", str(tmp_path / "missing.g")).returncode == 1


def test_warnings_of_commands_are_lines_without_the_code_that_calls(tmp_path):
    scene = tmp_path / "scene.g"
    scene.write_text("a: { shpae: 3 }\n")
    program = kinegraph("info", str(scene))
    assert (
        program.stderr
        == f"kinegraph: warning: {scene}:1:6: frame 'a': unknown attribute 'shpae'; did you mean 'shape'?\n"
    )


def test_view_shows_scenes_and_meshes_and_ends_without_a_display(tmp_path):
    mesh = tmp_path / "triangle.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    for arguments in (
        [mesh],
        [ry.raiPath("scenarios/pandaSingle.g")],
        ["--watch", ry.raiPath("scenarios/pandaSingle.g")],
    ):
        program = kinegraph("view", *map(str, arguments))
        assert program.returncode == 0, program.stderr
    assert "triangle" in kinegraph("info", str(mesh)).stdout
    missing = kinegraph("view", "--watch", str(tmp_path / "missing.g"))
    assert missing.returncode == 1
    assert "missing.g' does not exist" in missing.stderr


def test_models_of_the_package_are_found_by_their_names(tmp_path):
    shipped = kinegraph("info", "scenarios/pandaSingle.g", cwd=tmp_path)
    assert shipped.returncode == 0, shipped.stderr
    assert shipped.stdout == kinegraph("info", ry.raiPath("scenarios/pandaSingle.g")).stdout
    (tmp_path / "panda").mkdir()
    (tmp_path / "panda" / "panda.g").write_text("mine: {}")
    assert "#frames=1 " in kinegraph("info", "panda/panda.g", cwd=tmp_path).stdout  # one's own file comes first
    typo = kinegraph("info", "scenarios/pandaSingel.g", cwd=tmp_path)
    assert typo.returncode == 1
    assert "similar names: scenarios/pandaSingle.g" in typo.stderr


@pytest.mark.parametrize("command, words", [("ry_info", "raiPath"), ("ry_view", "a scene")])
def test_the_commands_of_robotic_are_there(command, words):
    code = f"import sys; from kinegraph.cli import {command}; sys.exit({command}())"
    arguments = [ry.raiPath("panda/panda.g")] if command == "ry_view" else []
    program = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, timeout=120)
    assert program.returncode == 0, program.stderr
    assert words in program.stdout


def test_plan_writes_the_motion_and_says_where_it_cannot(tmp_path):
    scene = ry.raiPath("scenarios/pandaSingle.g")
    goal = ["--goal", "l_gripper=0.3,0.3,1.1", "--no-view"]
    done = kinegraph("plan", scene, *goal, "-o", str(tmp_path / "motion.csv"))
    assert done.returncode == 0, done.stderr
    rows = np.loadtxt(tmp_path / "motion.csv", delimiter=",", skiprows=1)
    assert rows.shape[1] == 22 and rows[0, 0] == 0 and (np.diff(rows[:, 0]) > 0).all()
    nowhere = kinegraph("plan", scene, *goal, "-o", str(tmp_path / "none" / "motion.csv"))
    assert nowhere.returncode == 1 and "Traceback" not in nowhere.stderr
    assert nowhere.stderr.endswith("motion.csv: cannot write the file: No such file or directory\n")
