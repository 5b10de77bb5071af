"""Numbers in other units are asked about, and nothing else is: "did you mean radians?"."""

import math
import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

ASKS = "did you mean"


def questions(file: str | Path) -> list[str]:
    """The questions that a file raises."""
    C = ry.Config()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        C.addFile(file)
    return [line for line in C.fileWarnings() if ASKS in line]


def asked(text: str, tmp_path: Path, name: str) -> list[str]:
    file = tmp_path / name
    file.write_text(text)
    return questions(file)


def urdf(joint: str = "", shape: str = "", limits: str = "-1 1", second: str = "") -> str:
    lower, upper = limits.split()
    return f"""<robot name="r"><link name="a">{shape}</link><link name="b">{second}</link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/>{joint}<axis xyz="0 0 1"/>
<limit lower="{lower}" upper="{upper}" effort="9" velocity="2"/></joint></robot>"""


ARM_IN_MILLIMETERS = urdf('<origin xyz="0 0 333"/>').replace(
    "</robot>",
    """<link name="c"/><joint name="k" type="continuous"><origin xyz="316 0 0"/><parent link="b"/><child link="c"/></joint>
</robot>""",
)


@pytest.fixture
def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    return C


@pytest.mark.parametrize(
    ("text", "question"),
    [
        (
            urdf(limits="-170 170"),
            r":3:\d+: frame 'j': a limit is -170 rad; did you mean radians\? -170 degrees are -2.9",
        ),
        (urdf('<origin xyz="0 0 1" rpy="90 0 0"/>'), r":2:\d+: joint 'j': rpy has 90 rad; did you mean radians"),
        (
            ARM_IN_MILLIMETERS,
            r"'j': a coordinate of its position is 333 m; did you mean meters\? 333 mm are 0.333 m; so for 1 more",
        ),
        (
            urdf(
                '<origin xyz="0 0 .333"/>',
                second='<collision><geometry><box size="400 300 20"/></geometry></collision>',
            ),
            r"frame 'b_0': its box is 400 m large; did you mean meters",
        ),
    ],
)
def test_urdf_files_in_other_units_are_asked_about(text: str, question: str, tmp_path: Path) -> None:
    (line,) = asked(text, tmp_path, "robot.urdf")

    assert re.search(question, line), line


@pytest.mark.parametrize(
    ("text", "question"),
    [
        ("a: {}\nb (a): { joint: hingeZ, limits: [-170 170] }", "'b': a limit is -170 rad"),
        ("a: {}\nb (a): { joint: hingeZ, q: 90 }", "'b': q is 90 rad; did you mean radians"),
        ("a: {}\nb (a): { joint: hingeZ, shape: ssBox, size: [400 300 20 5] }", "'b': its ssBox is 400 m large"),
        ("a: {}\nb (a): { joint: rigid, shape: sphere, size: [40], mass: .2 }", "'b': its sphere is 40 m large"),
        (
            "a: {}\nb (a): { joint: hingeZ, pre: [0 0 500] }\nc (b): { Q: [300 0 0] }",
            "'b': a coordinate of its position is 500 m",
        ),
        ("a: { X: 't(0 0 1) r(90 1 0 0)' }", r"r\(...\) turns by 90 rad"),
        ("a: {}\nb (a): { Q: 'E(0 0 180)' }", r"E\(...\) turns by 180 rad"),
    ],
)
def test_scene_files_in_other_units_are_asked_about(text: str, question: str, tmp_path: Path) -> None:

    (line,) = asked(text, tmp_path, "scene.g")
    assert re.search(question, line), line


def mjcf(joint: str = "", body: str = "", compiler: str = "") -> str:
    return (
        f"""<mujoco>{compiler}<worldbody><body {body}><joint {joint}/><geom size=".1"/></body></worldbody></mujoco>"""
    )


@pytest.mark.parametrize(
    ("text", "question"),
    [
        (mjcf('range="-3.14 3.14"'), "the range -3.14 3.14 is in degrees; did you mean radians"),
        (mjcf(body='euler="1.57 0 0"'), "a rotation by 1.57 degrees; did you mean radians"),
        (mjcf('range="-170 170"', compiler='<compiler angle="radian"/>'), "a limit is -170 rad"),
        (mjcf(body='euler="90 0 0"', compiler='<compiler angle="radian"/>'), "a rotation by 90 rad; did you mean"),
    ],
)
def test_mjcf_files_with_the_other_angles_are_asked_about(text: str, question: str, tmp_path: Path) -> None:
    (line,) = asked(text, tmp_path, "scene.xml")
    assert question in line


@pytest.mark.parametrize(
    "text",
    [
        urdf(limits="-6.28 6.28"),
        urdf('<origin xyz="0 0 1" rpy="3.14159 -1.5708 6"/>'),
        mjcf('range="-180 180"'),
        mjcf('range="-2 2"'),
        mjcf(body='euler="90 0 45"'),
        mjcf('range="-3.14 3.14"', 'euler="1.57 0 0"', '<compiler angle="radian"/>'),
        urdf('<origin xyz="0 0 333"/>'),
        urdf(shape='<collision><geometry><box size="400 300 20"/></geometry></collision>'),
        "hall: { shape: box, size: [30 20 8] }\nsky: { X: [0 0 500] }\nfloor: { shape: quad, size: [100 100] }",
        "town: { shape: ssBox, size: [900 700 90 5], X: [4000 5000 0], mass: 1 }\ndome: { shape: sphere, size: [40] }",
        "tower: { shape: cylinder, size: [120 4] }\nyaw (tower): { joint: hingeZ, pre: [0 0 120] }\n"
        "hub (yaw): { joint: hingeX, pre: [4 0 2] }\nblade (hub): { shape: box, Q: [0 0 35], size: [2 3 70] }",
        "base: {}\nmast (base): { joint: hingeZ }\nboom (mast): { joint: hingeY, pre: [120 0 0] }",
        "base: {}\ncrane (base): { joint: hingeZ, shape: box, size: [60 3 2.5] }",
        "sea: {}\nship (sea): { joint: transXYPhi, shape: box, size: [120 20 15], mass: 2e7 }",
        "ground: {}\nstone (ground): { joint: rigid, shape: sphere, size: [16], mass: 4e7 }",
        "base: { X: [500 500 0] }\nb (base): { joint: hingeZ, X: [500 500 .3] }\nc (b): { joint: hingeY, X: [500.4 500 .3] }",
        "a: {}\nb (a): { joint: hingeZ, limits: [-1.5 1.5] }\nwheel (a): { joint: hingeX, limits: [-20 20] }",
        "a: { X: 't(0 0 1) d(90 1 0 0) r(1.5 1 0 0)' }\nb (a): { joint: transX, limits: [0 20], q: 15 }",
    ],
)
def test_numbers_in_the_right_units_are_not_asked_about(text: str, tmp_path: Path) -> None:
    name = "robot.urdf" if "<robot" in text else "scene.xml" if "<mujoco" in text else "scene.g"
    assert asked(text, tmp_path, name) == []


def test_no_model_of_the_package_is_asked_about() -> None:
    files = sorted(Path(ry.raiPath()).rglob("*.g"))
    assert len(files) > 50
    found = {}
    for file in files:
        try:
            found[file.name] = questions(file)
        except ry.Error:  # parts of other files
            continue
    assert {name: lines for name, lines in found.items() if lines} == {}


def test_links_of_programs_in_millimeters_are_asked_about(panda: ry.Config) -> None:
    hand = panda.addFrame("tool", "gripper")
    with pytest.warns(ry.KinegraphWarning, match="'tool': its box is 120 m large; did you mean meters.* are 0.12 m"):
        hand.setShape(ry.ST.box, [120, 30, 20])


def test_scenery_of_any_size_is_not_asked_about(panda: ry.Config) -> None:
    hall = panda.addFrame("hall").setMass(1.0)
    for size in ([16, 16, 8], [30, 20, 10], [400, 300, 60], [50, 30, 0.2]):
        hall.setShape(ry.ST.box, size)
    panda.addFrame("floor").setShape(ry.ST.quad, [500, 300])
    heights = 30 * np.random.default_rng(0).random((20, 20))
    x, y = np.meshgrid(np.linspace(0, 900, 20), np.linspace(0, 900, 20))
    points = np.stack([x, y, heights], axis=-1).reshape(-1, 3)
    corners = np.arange(380).reshape(19, 20)[:, :-1].reshape(-1, 1)
    panda.addFrame("terrain").setMesh(points, np.vstack([np.add(corners, [0, 1, 20]), np.add(corners, [1, 21, 20])]))


def test_only_poses_in_another_order_and_angles_are_asked_about_for_their_norm() -> None:
    frame = ry.Config().addFrame("a")
    for norm in (0.2, 1.0, 2.0, 5.0):
        frame.setQuaternion(np.multiply(norm, [0.5, 0.5, 0.5, 0.5]))
        frame.setPose([1.0, 2.0, 3.0, *np.multiply(norm, [0.8, 0.6, 0.0, 0.0])])
    with pytest.warns(ry.KinegraphWarning, match="did you mean x y z qw qx qy qz"):
        frame.setPose([0.8, 0.6, 0.0, 0.0, 1.0, 2.0, 3.0])
    with pytest.warns(ry.KinegraphWarning, match="did you mean an angle"):
        frame.setQuaternion([90, 0, 0, 1])


def test_targets_in_millimeters_are_asked_about(panda: ry.Config) -> None:
    for position in ([400, 200, 500], [400, 200, 500, 0, 1, 0, 0]):
        message = ry.solveIk(panda, {"gripper": position}).message
        assert "did you mean meters? 500 mm are 0.5 m" in message
    assert "did you mean meters" in ry.planMotion(panda, {"gripper": [400, 200, 500]}).message
    assert ASKS not in ry.solveIk(panda, {"gripper": [4.0, 2.0, 0.5]}).message


def xyzw(pose: np.ndarray) -> list[float]:
    return [*pose[:3], *pose[4:], pose[3]]


def test_a_quaternion_in_the_order_of_ros_near_the_present_rotation_is_asked_about(panda: ry.Config) -> None:
    pose = np.add(panda.getFrame("gripper").getPose(), [0, 0.1, 0.05, 0, 0, 0, 0])
    with pytest.warns(ry.KinegraphWarning, match="'gripper' is read as w x y z; did you mean x y z w"):
        ry.solveIk(panda, {"gripper": xyzw(pose)})
    assert any("did you mean x y z w" in line for line in ry.planMotion(panda, {"gripper": xyzw(pose)}).warnings)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert ry.solveIk(panda, {"gripper": pose}).feasible
    with pytest.warns(ry.KinegraphWarning, match="the quaternion 0 0 0 1 is half a turn about z; did you mean"):
        ry.solveIk(panda, {"gripper": [0.4, 0.2, 0.5, 0, 0, 0, 1]})


def test_a_quaternion_in_the_order_of_ros_is_asked_about_if_only_it_is_reached() -> None:
    C = ry.Config()
    C.addText("""base: {}
a (base): { joint: hingeZ, pre: [0 0 .3], limits: [-3 3] }
b (a): { joint: hingeZ, pre: [.4 0 0], limits: [-3 3] }
tip (b): { Q: [.4 0 0] }""")
    turn = math.radians(40)
    quaternion = [0, 0, math.sin(turn / 2), math.cos(turn / 2)]  # x y z w, about z
    result = ry.solveIk(C, {"tip": {"quaternion": quaternion}})
    assert not result.feasible and "Read as x y z w, the quaternion is reached" in result.message
    assert ASKS not in ry.solveIk(C, {"tip": {"quaternion": [0.5, 0.5, 0.5, 0.5]}}).message


def test_motions_of_a_robot_in_degrees_are_asked_about(panda: ry.Config) -> None:
    bot = ry.BotOp(panda, False)
    q = [0, -30, 0, -120, 0, 90, 45]
    for call in (lambda: bot.moveTo(q), lambda: bot.move([q], [2.0])):
        with pytest.raises(ry.ArgumentError, match="would go to -30; .*did you mean radians. -30 degrees are -0.52"):
            call()
    with pytest.raises(ry.ArgumentError) as beyond:
        bot.moveTo([0, -1.9, 0, -2, 0, 2, 0])
    assert ASKS not in str(beyond.value)


def test_joints_that_slide_are_not_asked_for_radians() -> None:
    C = ry.Config()
    C.addText("base: {}\nslide (base): { joint: transX, limits: [0 .5] }")
    with pytest.raises(ry.ArgumentError, match="would go to 20; its limits are 0 to 0.5") as beyond:
        ry.BotOp(C, False).moveTo([20.0])
    assert ASKS not in str(beyond.value)
