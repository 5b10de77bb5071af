"""The command `kinegraph`."""

import os
import subprocess
import sys

import pytest

import kinegraph as ry


def kinegraph(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "kinegraph", *arguments], capture_output=True, text=True, env=os.environ, timeout=120
    )


def test_the_demo_follows_its_target_within_a_tenth_of_a_millimetre():
    program = kinegraph("demo", "--seconds", "2.5", "--no-view")
    assert program.returncode == 0, program.stderr
    *seconds, total = program.stdout.splitlines()
    assert len(seconds) >= 2
    assert total.startswith("total: ") and "infeasible" not in total
    assert float(total.split("worst position error ")[1].split(" mm")[0]) < 0.1


def test_info_lists_the_frames_of_a_file():
    program = kinegraph("info", ry.raiPath("scenarios/pandaSingle.g"))
    assert program.returncode == 0
    assert "l_gripper" in program.stdout


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


def test_check_shows_mistakes_and_oddities_with_their_lines(tmp_path):
    scene = tmp_path / "scene.g"
    scene.write_text("a: { colour: [1 0 0] }\nb (c): {}\nd: { shape: bax }\n")
    program = kinegraph("check", str(scene), ry.raiPath("panda/panda.g"))
    assert program.returncode == 1
    assert f"{scene}:2:1: error: parent of 'b': 'c' is not a frame of this scene" in program.stdout
    assert "    b (c): {}\n    ^" in program.stdout
    assert f"{scene}:1:6: warning: frame 'a': unknown attribute 'colour'; did you mean 'color'?" in program.stdout
    assert f"{scene}:3:13: error: frame 'd', shape: unknown shape type 'bax'" in program.stdout
    assert program.stdout.endswith("2 checked: 2 errors, 1 warnings\n")


def test_check_gives_status_0_for_oddities_unless_strict(tmp_path):
    scene = tmp_path / "scene.g"
    scene.write_text("a: { shpae: 3 }\n")
    assert kinegraph("check", str(scene)).returncode == 0
    assert kinegraph("check", "--strict", str(scene)).returncode == 1
    assert kinegraph("check", str(tmp_path / "missing.g")).returncode == 1
