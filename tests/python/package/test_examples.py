"""Every example runs, and prints the expected results."""

import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

EXAMPLES = sorted((Path(__file__).parent.parent.parent.parent / "examples").glob("*.py"))

# Expected output.
FOUND = {
    "00_first_motion": [
        r"<MotionPlan solved: ",
        r"least distance: 0\.01 m",
        r"the gripper is at \[0\.35 +0\.3 +0\.9 *\]",
    ],
    "01_frames": [r"door opened by 1 rad", r"joints: \['hinge'\]"],
    "02_box": [r"made in Python: .*'size': \[0.5, 0.5, 0.5, 0.05\]", r"from box.g: .*'size': \[0.5, 0.5, 0.5, 0.05\]"],
    "03_relative_positions": [
        r"box2: position \[0\. +0\. +1\.25\]",
        r"seen from box1, box2 has not moved: \[0\. 0\. 1\.\]",
    ],
    "04_two_link_arm": [r"by hand the same to \d\.\de-(0[9]|[1-9]\d) m|by hand the same to 0"],
    "05_features": [r"height of the gripper over the table: 0\.66\d+ m", r"distance of palm and table: 0\.6\d+ m"],
    "06_inverse_kinematics": [r"after: +0\.0\d+ mm", r"feasible True, 0\.0\d+ mm off"],
    "07_theory_of_ik": [r"done: .* 0\.000\d+ m off"],
    "08_solve_ik": [
        r"<IkResult solved in 1 attempt",
        r"moved by 0\.1 m",
        r"False IkStatus\.goal_unreachable",
        r"7\d\d of 1000 reached",
    ],
    "09_custom_features": [r"gripper at height 1\.1000 m, 0\.1500 m from the post", r"the straight way there is free"],
    "12_control": [
        r"a step takes \d+ of 1000 us",
        r"within 0\.\d+ mm on average",
        r"restricted by:(\n +.*)*table",
        r"overlap: 0\.0000 m",
    ],
    "13_timing": [
        r"stop: 1\.\d+ s",
        r"blend: \d\.\d+ s, with jerk limits \d\.\d+ s",
        r"passes the middle point",
    ],
    "15_grasp_and_lift": [
        r"apart by 0\.0(60|59\d) m|apart by 0\.06 m",
        r"slipped by 0\.0[0-4]\d+ mm",
        r"put down at \[.* 0\.68",
    ],
    "16_conveyor": [r"the boxes move at \[0\.3 0\.3 0\.3\]", r"heights of the boxes"],
    "11_plan_motions": [
        r"^solved: \d+ configurations, length 1\.[23]\d+",
        r"clearance: 10(?:\.\d)? mm",
        r"infeasible: there is no path: a ball of 150 mm inside of 'body' does not get past 'left', 'right'",
    ],
    "17_pick_and_place": [r"-- feasible: pick and place", r"-- feasible: sub_motion 1"],
    "18_plan_a_task": [
        r"^solved: 4 actions, \d+\.\d+ s",
        r"infeasible: 'far' is at least 3\.85 m beyond the reach",
    ],
    "19_own_action": [r"^solved: 2 actions, \d+\.\d+ s", r"\(show cup l_gripper\)"],
    "10_many_problems": [r"taken by r_gripper", r"6 of 6 feasible", r"\b10 configurations"],
    "32_a_data_set_overnight": [r"(1 episodes of \d+ attempts, \d+ frames, in .* faults: \[\]\s+){3}"],
    "34_a_seam": [
        r"^<ToolPathPlan solved",
        r"approach: 0\.00 to",
        r"path 0, 0\.\d+ m: .*'clamp'",
        r"\d+ configurations lead to 0\.\d+ m",
    ],
    "35_raster_between_clamps": [
        r"^<ToolPathPlan solved",
        r"leans by up to \d+\.\d degrees",
        r"slower than asked on \d+ %",
    ],
    "36_write_a_word": [r"^<ToolPathPlan solved: 4 paths", r"'transfer', 'path'", r"the cut at up to 0\.(1|2|300)"],
    "37_part_in_the_hand": [r"the jet moves by 0\.000 m", r"the table turns by -?\d+ degrees"],
    "38_look_before_moving": [r"cube: seen at -0\.2[67]", r"\(pick cube", r"reached the goal after 1 action"],
    "33_look_plan_pick": [r"blue was seen within \d\.\d mm", r"reached the goal after \d actions"],
    "27_calibrate": [r"step 4: configurations off by 0\.\d+ mrad", r"found within 0\.\d+ mm", r"elbow bent by"],
    "22_a_data_set": [r"in \d+ s|in \d\.\d+ s", r"2000 targets, \d\d\.\d % of them", r"of 20 motions found"],
    "21_execute_a_task": [
        r"^solved: 4 actions",
        r"failure: .*'blue' is 0\.080 m away",
        r"reached the goal after 4 actions and 1 repair",
    ],
    "25_upside_down": [r"^solved: 4 actions", r"\(lay box g_gripper table", r"z axis is now \[.* -1\. *\]"],
    "30_open_a_drawer": [
        r"^solved: 6 actions",
        r"while \(closed drawer\)",
        r"reached the goal after 6",
        r"drawer is closed",
    ],
    "31_lgp": [
        r"^-- infeasible: \(grasp objG",
        r"(?m)^-- feasible: \(grasp objB .*\(place_straightOn objG l_gripper trayG\)$",
        r"full motion: (step|the relative)",
        r"objG stands 0\.055 m above trayG",
    ],
    "23_better_plans": [r"(s after \d+ evaluations\n.*){2}", r"pick cup table l_gripper.*(wall|lid)"],
    "24_two_arms": [r"^solved: 3 actions", r"\(handover rod l_gripper r_gripper\)"],
    "20_two_robots": [r"the blocks are 0\.1[34]\d m and 0\.1[34]\d m higher", r"the replay is equal to the bit: True"],
    "26_train_a_policy": [r"from 100 new starts: before \d %, after ([5-9]\d|100) %"],
    "14_mpc": [r"nearest to the ball and the table: \d+\.\d mm", r"at the end \d\.\d mm"],
    "29_motion_as_a_spline": [
        r"feasible: True, 70 variables for 420",
        r"limits hold at all times: True",
        r"times: True",
    ],
    "28_among_what_moves": [
        r"^<MotionPlan solved",
        r"waits for \d",
        r"at the goal, 'l_\w+' meets 'load', which stays there",
        r"never slower than 0\.[1-9]",
        r"(length \d\.\d+\n){2}",
    ],
}


def test_each_example_has_something_to_find():
    assert set(FOUND) == {example.stem for example in EXAMPLES}


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_the_example_runs_and_prints_what_it_finds(example, tmp_path):
    program = subprocess.run(
        [sys.executable, "-W", "error", str(example)],
        cwd=tmp_path,
        env={**os.environ, "TARGETS": "2000", "GENERATIONS": "16"},  # fewer than examples 22 and 26 make by themselves
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert program.returncode == 0, program.stderr
    for found in FOUND[example.stem]:
        assert re.search(found, program.stdout), f"{found} is not in\n{program.stdout}"
    assert list(tmp_path.iterdir()) == []  # nothing is left behind


def test_a_training_draws_its_curve_and_a_seed_gives_the_same_again(tmp_path):
    example = next(file for file in EXAMPLES if file.stem == "26_train_a_policy")
    runs = [
        subprocess.run(
            [sys.executable, str(example), str(tmp_path / f"{i}.svg")],
            env={**os.environ, "GENERATIONS": "3"},
            capture_output=True,
            text=True,
            check=True,
            timeout=120,
        ).stdout
        for i in range(2)
    ]
    assert runs[0] == runs[1] and runs[0].count("mean reward") == 3
    drawn = [ElementTree.parse(tmp_path / f"{i}.svg").getroot() for i in range(2)]
    points = [picture.find("{http://www.w3.org/2000/svg}polyline").get("points") for picture in drawn]
    assert points[0] == points[1] and len(points[0].split()) == 3
    rewards = [float(reward) for reward in re.findall(r"mean reward (-[\d.]+)", runs[0])]
    heights = [float(point.split(",")[1]) for point in points[0].split()]
    assert sorted(range(3), key=rewards.__getitem__) == sorted(range(3), key=lambda i: -heights[i])
