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
