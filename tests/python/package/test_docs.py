"""The pages of docs/ and README are correct: their code runs with the documented results, and their tables name
existing things."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

DOCS = Path(__file__).parent.parent.parent.parent / "docs"
WRITTEN = sorted([*DOCS.glob("*.md"), *DOCS.glob("theory/*.md")])
PAGES = [DOCS.parent / "README.md", *(page for page in WRITTEN if "```python" in page.read_text())]

# Output of the code of each page.
FOUND = {
    "README": [
        r"feasible: 1",
        r"<IkResult solved in 1 attempt",
        r"False no solution in 100 attempts; at the nearest, frame 'l_gripper' misses its position by 1\.06\d* m",
    ],
    "coming_from_curobo": [r"^[1-9]\d* of 100 solved", r"^PlanStatus.solved"],
    "coming_from_drake": [r"^True PlanStatus.solved", r"^SolverStatus.converged \(2, 7\)"],
    "coming_from_moveit": [r"^PlanStatus.solved", r"^\[0\.3 +0\.3 +1\. +\]"],
    "coming_from_mujoco": [r"^DiffIkStatus.solved \[-?0\. +-?0\. +-?0\.\]", r"^0\.5\d* True"],
    "coming_from_ompl": [r"^PlanStatus.solved", r"^True$"],
    "coming_from_pinocchio": [r"^DiffIkStatus.solved \[-?0\. +-?0\. +-?0\.\]"],
    "coming_from_robotic": [r"^True "],
    "contacts": [r"^slip: 0\.0[0-4]\d mm$"],
    "conventions": [
        r"from above: <IkResult solved in 1 attempt",
        r"the palm is above the target by 0\.103 m",
        r"from below: no solution .*'table' and 'l_panda_coll7' overlap",
        r"collisions with the box: [1-9]",
    ],
    "mcap": [
        r"^<Recording 'run.mcap', \d\.\d\d s, 9 joints, 8 topics> \d\d\d$",
        r"^BotOp\.follow: .*velocity",
    ],
    "ros2": [r"^\[0\.2 0\.1\] 1\.5$"],
    "lerobot_robots": [
        r"^True \['shoulder_pan', ",
        r"^\[0\.22 0\.05 0\.05\] \[ *-?0\. +-?0\. +1\.\]",
        r"^\[0\.27 *0\.05 *0\.05",
    ],
    "lerobot": [r"^2 episodes; faults: \[\]"],
    "determinism": [r"^\[True, True, True\]$"],
    "dynamics": [r"^True \d+\.\d+", r"^\[ *[-+\d.e ]* -9\.81"],
    "motion": [
        r"\[.* 1\.962\d*e\+01\]",
        r"^True False",
    ],
    "errors": [
        r"^FileError scene file 'scene.g' does not exist$",
        r"^PlanStatus.goal_unreachable the goal is out of reach: .* misses its position by 1\.06\d* m$",
    ],
    "faq": [
        r"^tcp: <IkResult solved",
        r"^both: <MotionPlan solved",
        r"^carried: <MotionPlan solved",
        r"^largest step: 0\.72 rad$",
        r"^six joints: 6 True$",
        r"^solutions: [1-9]\d* \(\d+, 7\)$",
        r"^\(3,\) \(3, 7\)\nequal: True\n<MotionContact: table and \w+ at time 0\.7",
        r"^arrived: True$",
        r"^line: <ToolPathPlan solved",
        r"^level: <MotionPlan solved",
        r"^0\.57 s, 3\.75 s$",
        r"^planned: [1-9]",
        r"^planMotion: option optimize is 'speed'; expected one of time, length, clearance$",
    ],
    "features": [
        r"<SelfCollisionMatrix: \d+ pairs of frames in 2000 configurations: \d+ adjacent, \d+ always in collision, \d+ never",
        r"^\[\('\w+', '\w+', 'sometimes', 0\.\d+\)",
    ],
    "infeasibility": [
        r"^PlanStatus.infeasible$",
        r"^there is no path: a ball of 150 mm inside of 'body' does not get past",
    ],
    "komo": [r"^\[1\. 1\.\]"],
    "verification": [r"^samples: True$", r"^edge: \('\w+', '\w+'\) 0\.4"],
    "ik": [r"^True $", r"\[ ?-?0\. +-?0\. +-0\.2\]"],
    "solvers": [
        r"^True SolverStatus\.converged",
        r"SolverStatus\.infeasible the constraints contradict each other",
        r"If positionDiff of l_gripper, target is relaxed by 3\.07 m, all others can hold",
    ],
    "planning": [
        r"^solved: \d+ configurations, length",
        r"verify: .* evaluations",
        r"clearance: [\d.]+ mm",
        r"waits for \d",
    ],
    "operation": [
        r"2\.\d\d s, open by 0\.030 m",
        r"BotOp\.move: joint '\w+' would .*; take at least \d",
        r"the same to the bit: True",
    ],
    "scenes": [r"scene file 'scene.g' does not exist", r"similar names: sphere", r"\['home'\] \{'arm': \['j'\]\}"],
    "control": [r"DiffIkStatus\.solved", r"'table' and", r"^True \d\.?\d*(e-\d+)? \d"],
    "fleets": [r"<MapResults 200 items in", r"\d+ of 200 reached", r"20000 rows \['item', 'q', 'free', 'error'\]"],
    "timing": [
        r"<TimedPath 4 points in \d\.\d+ s>",
        r"^\[ True  True\]",
        r"'arm' cannot rest at .* the limits are -3 to 3 N m",
    ],
    "perception": [r"^box: seen at 0\.1\d* 0\.\d+ 0\.69", r"^can: seen at .* 1 free directions"],
    "sensitivities": [r"^\(70, 7\) True", r"'position of box, x'", r"^True$", r"^4 .*shortest one"],
    "simulation": [r"\(64, 7\) \(64, 1, 7\)"],
    "tool_paths": [
        r"<ToolPathPlan solved: 1 path in \d\.\d+ s>",
        r"\['approach', 'path', 'retract'\]",
        r"m/s, \w+ of ",
        r"out_of_reach \(0, 0\.\d+\) path 0, 0\.\d+ m: no configuration reaches the path",
    ],
    "first_pick_and_place": [
        r"^failure: \(pick \w+ table l_gripper\)",
        r"^reached the goal after \d actions and \d repair",
    ],
    "own_robot": [
        r"joint 'roll': a joint of this type should have a <limit>",
        r"mesh 'package://arm/shoulder\.dae' does not exist",
        r"^distance: \[0\.035\d*\]\nfound: False$",
        r"^<SelfCollisionMatrix: 36 pairs .* 8 adjacent, 0 always",
        r"^found: True$",
        r"^\['turn', 'lift', 'elbow', 'roll', 'pitch', 'twist'\]\n\[\]$",
        r"^<IkResult solved",
        r"misses its position by 0\.33\d* m",
        r"^<MotionPlan solved: .*\nTrue$",
        r"^error at the goal: 0\.0",
        r"^opening: 0\.02 m$",
        r"^reached the goal after 2 actions$",
        r"^<IkResult solved .*<MotionPlan solved",
    ],
    "troubleshooting": [
        r"^before: 0\.0\nafter: 0\.3\nmoved: False\n1\.0 0\.8$",
        r"^holds: \[( +True){7}\]$",
        r"invalid_goal: the goal is outside the limits: l_panda_joint4 is at 2, 2\.07?\d* beyond its limits",
        r"invalid_goal: .*'table' and 'l_palm' overlap by 160 mm",
        r"goal_unreachable: .* misses its position by 1\.06\d* m",
        r"invalid_start: the start collides: 'l_palm' and 'box' overlap by 240 mm",
        r"^PlanStatus\.invalid_start \[\('stand', 'torso', -?0\.0\)\]\nPlanStatus\.solved$",
        r"'wall' is near moving links but cannot collide because `contact` is 0",
        r"^collisions: [1-9]",
        r"q is beyond the limits; did you mean radians\?",
        r"^\[1\. 0\. 0\. 0\.\]$",
    ],
    "logic": [
        r"^\[\['pick', 'cup', 'table', 'hand'\], \['place', 'cup', 'hand', 'tray'\]\]$",
        r"^None PlanSearchStatus\.exhausted\n\['\(on cup tray\)'\] \['",
        r"^\(pick-up b\) \(stack b c\) \(pick-up a\) \(stack a b\)$",
        r"^move\.fol:2:28: unknown predicate 'onn' in \(onn X Y\); declare it in a line of its own; similar names: on",
    ],
    "tasks": [
        r"^solved: 4 actions",
        r"^reached the goal after 4 actions$",
        r"^reached the goal after 2 actions and 1 repair$",
        r"^stopped after 0 actions: \(pick",
        r"\(place jug l_gripper tray\)",
        r"\(show cup l_gripper\)",
        "-- feasible",
    ],
}


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", page.read_text(), re.DOTALL)


def words(text):
    return set(re.findall(r"`(\w+)`", text))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_code_of_a_page_runs_from_top_to_bottom(page, tmp_path):
    program = "\n".join(blocks(page, "python"))
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        cwd=tmp_path,
        env=os.environ,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert run.returncode == 0, run.stderr
    for found in FOUND.get(page.stem, []):
        assert re.search(found, run.stdout, re.MULTILINE), f"{found} is not in\n{run.stdout}"


# Files that entries of tables read.
FILES = {
    "scene.xml": "<mujoco><worldbody><body name='ball'><freejoint/><geom size='.1'/></body></worldbody></mujoco>",
    "arm.urdf": """<robot name='arm'><link name='base'/><link name='hand'/><joint name='j' type='revolute'>
        <parent link='base'/><child link='hand'/><limit lower='-1' upper='1' velocity='1' effort='1'/></joint></robot>""",
    "arm.srdf": """<robot name='arm'><group name='all'><joint name='j'/></group>
        <group_state name='ready' group='all'><joint name='j' value='.5'/></group_state></robot>""",
    "poses.csv": "0 0.3 0.3 1.0\n1 0.4 0.3 1.0\n",
}


@pytest.mark.parametrize("page", sorted(DOCS.glob("coming_from_*.md")), ids=lambda page: page.stem)
def test_the_entries_of_a_page_for_newcomers_run_after_its_code(page, tmp_path):
    rows = [line.strip("| ").split(" | ") for line in page.read_text().split("\n") if line.startswith("|")][2:]
    assert len(rows) >= 20 and any(here.startswith("not here") for _, here in rows)
    entries = [entry for _, here in rows for entry in re.findall(r"`([^`]+)`", here)]
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    program = tmp_path / "program.py"  # a file: a traceback shows the entry
    program.write_text("\n".join([*blocks(page, "python"), *entries]))
    run = subprocess.run(
        [sys.executable, "-W", "error", program], cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    assert run.returncode == 0, run.stderr


def test_every_page_with_code_says_what_it_finds():
    assert {
        page.stem for page in PAGES if re.search(r"^print|^    print", "".join(blocks(page, "python")), re.M)
    } <= set(FOUND)


def test_the_axes_of_a_gripper_are_those_of_the_page_on_conventions():
    for robot in ("panda/panda.g", "robotiq/robotiq.g"):
        C = ry.Config()
        C.addFile(ry.raiPath(robot))
        gripper = C.getFrame("gripper")
        fingers = [C.getFrame(name).getPosition(gripper) for name in ("finger1", "finger2")]
        across = fingers[0] - fingers[1]
        back = C.getFrame("palm").getPosition(gripper)
        assert across @ [1, 0, 0] > 0.99 * np.linalg.norm(across)  # x from finger2 to finger1
        assert back @ [0, 0, 1] > 0.99 * np.linalg.norm(back) > 0.05  # z back into the hand


def test_the_scene_of_the_page_on_scenes_loads_without_a_warning(recwarn):
    (scene,) = blocks(DOCS / "scenes.md", "g")
    C = ry.Config()
    C.addText(scene)
    assert C.getJointNames() == ["lever"]
    assert not recwarn.list


def test_the_page_on_scenes_names_all_shapes_and_joints():
    named = words((DOCS / "scenes.md").read_text())
    assert {shape.name for shape in ry.ST} - {"none"} <= named
    assert {joint.name for joint in ry.JT} - {"none"} <= named


def test_the_page_on_features_names_all_features():
    assert {feature.name for feature in ry.FS} <= words((DOCS / "features.md").read_text())


def test_the_pages_on_conventions_and_the_viewer_name_all_parameters():
    from kinegraph.compatibility import parameters

    named = set(re.findall(r"`([\w/]+)`", (DOCS / "conventions.md").read_text() + (DOCS / "viewer.md").read_text()))
    assert set(parameters._KNOWN) <= named


def test_the_page_on_motions_names_all_types():
    text = (DOCS / "motion.md").read_text()
    assert {f"OT.{kind.name}" for kind in ry.OT} - {"OT.none"} <= set(re.findall(r"`(OT\.\w+)`", text))


def test_the_figures_of_the_theory_are_as_their_program_makes_them(tmp_path):
    program = DOCS / "theory" / "make_figures.py"
    subprocess.run([sys.executable, "-W", "error", program, tmp_path], check=True, timeout=120)
    made = sorted(file.name for file in tmp_path.iterdir())
    assert made == sorted(file.name for file in (DOCS / "theory").glob("*.svg"))
    for name in (
        "band.svg",
        "penalty.svg",
        "cells.svg",
    ):  # the others depend on distances and simulations to the last bit
        assert (tmp_path / name).read_text() == (DOCS / "theory" / name).read_text(), name
