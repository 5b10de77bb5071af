"""docs/errors.md has the messages of the library: each of its rows is produced here, with its class."""

import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

PAGE = (Path(__file__).parent.parent.parent.parent / "docs" / "errors.md").read_text()

NO_LIMIT = (
    "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'>"
    "<parent link='a'/><child link='b'/></joint></robot>"
)


def rows(section):
    """Returns the messages of a section as regular expressions."""
    text = PAGE.split(f"\n## {section}\n")[1].split("\n## ")[0]
    messages = [line.split(" | ")[0][2:] for line in text.splitlines() if line.startswith("| ")][1:]
    plain = [message.replace("&lt;", "<").replace("&gt;", ">").replace("\\`", "`") for message in messages]
    return [re.escape(message).replace(re.escape("..."), ".*") for message in plain]


def panda():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def text(scene):
    return lambda C: ry.Config().addText(scene)


def file(name, content, **options):
    def load(C):
        Path(name).write_text(content)
        C = ry.Config()
        C.addFile(name, **options)
        return C

    return load


def komo(*objective):
    return lambda C: ry.KOMO(C, 1, 1, 0, False).addObjective(*objective)


def step(C):
    ry.Simulation(C).step([1.0, 2.0], 0.01, ry.ControlMode.position)


def diverge(C):
    C.addFrame("box").setShape(ry.ST.box, [0.1, 0.1, 0.1]).setPosition([0, 0, 3]).setMass(0.001)
    S = ry.Simulation(C)
    S.applyForce("box", [1e12, 0, 0])
    S.step()


def deleted(C):
    frame = C.addFrame("a")
    C.delFrame("a")
    frame.getPosition()


def near(C):
    C.addFrame("a").setShape(ry.ST.ssBox, [0.3, 0.3, 0.3, 0.02]).setPosition(C.getFrame("l_palm").getPosition())
    C.getCollisions()


def srdf(C):
    Path("robot.srdf").write_text("<robot name='r'><disable_collisions link1='foo' link2='l_palm'/></robot>")
    C.addFile("robot.srdf")


def attached(C):
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("b", "world").setShape(ry.ST.box, [0.1, 0.1, 0.1]).setRelativePosition([0, 0, 1]).setMass(1.0)
    ry.Simulation(C)


def in_the_air(C):
    inertia = "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
    shape = "<collision><geometry><sphere radius='.1'/></geometry></collision>"
    links = "".join(f"<link name='{name}'><inertial>{inertia}</inertial>{shape}</link>" for name in "ab")
    joint = "<joint name='j' type='continuous'><parent link='a'/><child link='b'/><origin xyz='1 0 0'/></joint>"
    C = file("air.urdf", f"<robot name='r'>{links}{joint}</robot>")(C)
    C.getFrame("a").setPosition([0, 0, 1.1])
    ry.Simulation(C)


class Broken(ry.RobotDriver):
    def __init__(self, config):
        super().__init__()
        self.config, self.reads = config, 0

    def info(self):
        return ry.RobotInfo.of(self.config, "broken")

    def read(self):
        self.reads += 1
        if self.reads > 20:
            raise RuntimeError("cable unplugged")
        q = self.config.getJointState()
        return ry.RobotState(0.01 * self.reads, q, np.zeros(len(q)))

    def write(self, command):
        pass

    def stop(self, reason):
        pass


def fault(C):
    bot = ry.BotOp(C, driver=Broken(C.copy()))
    while True:
        bot.sync(C, 0.1)


CASES = {
    "ArgumentError": [
        (ry.ArgumentError, lambda C: C.setJointState([0, 0])),
        (ry.ArgumentError, lambda C: C.setJointState([np.nan] * 7)),
        (ry.ArgumentError, lambda C: ry.planMotion(C, [0] * 7, margn=0.1)),
        (ry.ArgumentError, lambda C: ry.planMotion(C, [0, 0])),
        (ry.ArgumentError, lambda C: ry.solveIk(C, {"l_gripper": {"pos": [0, 0, 1]}})),
        (ry.ArgumentError, lambda C: ry.solveIk(C, {"l_gripper": "l_palm"})),
        (ry.ArgumentError, lambda C: C.eval(ry.FS.positionDiff, ["l_gripper"])),
        (ry.ArgumentError, komo([1.0], ry.FS.positionDiff, ["l_gripper", "table"], ry.OT.eq, [1], [], 1)),
        (ry.ArgumentError, lambda C: C.addFrame("a").setQuaternion([0, 0, 0, 0])),
        (ry.ArgumentError, lambda C: C.addFrame("a").setShape(ry.ST.ssBox, [1, 1, 1])),
        (ry.ArgumentError, lambda C: C.getFrame("l_panda_joint1").setAttributes({"limits": [2, -2]})),
        (ry.ArgumentError, lambda C: C.getFrame("table").setAttributes({"shape": "box"})),
        (ry.ArgumentError, lambda C: C.write("a.foo")),
        (ry.ArgumentError, step),
        (ry.ArgumentError, lambda C: ry.BotOp(C).move([C.getJointState() + 1], [0.1])),
        (ry.ArgumentError, lambda C: ry.BotOp(C).move([np.add(C.getJointState(), [0, 0, 0, 5, 0, 0, 0])], [5.0])),
        (
            ry.ArgumentError,
            lambda C: ry.BotOp(C).follow(ry.planMotion(C, C.getJointState(), C.getJointState() + 0.1)),
        ),
        (ry.ArgumentError, lambda C: ry.BotOp(C).gripperMove(5, 0.1)),
        (ry.ArgumentError, lambda C: ry.retime(C, [[0] * 7, [1] * 7], velocity=1.0)),
    ],
    "ArgumentTypeError": [
        (ry.ArgumentTypeError, lambda C: C.setJointState("a")),
        (ry.ArgumentTypeError, lambda C: ry.planMotion(C)),
        (ry.ArgumentTypeError, lambda C: ry.BotOp(C, realRobot=True)),
    ],
    "NotFound and FrameNotFound": [
        (ry.FrameNotFound, lambda C: C.getFrame("l_griper")),
        (ry.FrameNotFound, komo([], ry.FS.positionDiff, ["l_gripper", "tble"], ry.OT.eq)),
        (ry.NotFound, lambda C: ry.planMotion(C, "reddy")),
        (ry.NotFound, lambda C: ry.solveIk(C, {"l_gripper": [0.3, 0.4, 1.0]}).sensitivity("box")),
    ],
    "DivergenceError": [(ry.DivergenceError, diverge)],
    "FrameDeleted": [(ry.FrameDeleted, deleted)],
    "FileError": [
        (ry.FileError, lambda C: C.addFile("nope.g")),
        (ry.FileError, file("cup.obj", "v 0 0 0\n")),
        (ry.FileError, lambda C: ry.robotPath("pandda")),
        (ry.FileError, lambda C: ry.CommandLog.load("nothing.log")),
    ],
    "ParseError": [
        (ry.ParseError, text("a: { shape: box, size: [1 2 3")),
        (ry.ParseError, text("a: { shape: bxo, size: [1 2 3] }")),
        (ry.ParseError, text("a:  { shape: box, siez: [1 2 3] }")),
        (ry.ParseError, text("a (nobody): {}")),
        (ry.ParseError, text("a:  { joint: hingeX }")),
        (ry.ParseError, text("a: { Q: [0 0] }")),
        (ry.ParseError, file("bad.urdf", "<robot><link name='a'></robot>")),
        (
            ry.ParseError,
            file(
                "bad.urdf",
                "<robot name='r'><link name='a'/><joint name='j' type='fixed'>"
                "<parent link='a'/><child link='b'/></joint></robot>",
            ),
        ),
        (
            ry.ParseError,
            file(
                "model.xml",
                "<mujoco><worldbody><body><geom class='foo' type='sphere' size='.1'/></body></worldbody></mujoco>",
            ),
        ),
        (ry.ParseError, lambda C: ry.planTask(C, "(on tray box)")),
        (ry.ParseError, file("robot.urdf", NO_LIMIT, strict=True)),
    ],
    "RobotFault": [(ry.RobotFault, fault)],
    "Warnings": [
        (ry.KinegraphWarning, lambda C: C.setJointState([0, -30, 0, -120, 0, 90, 0])),
        (ry.KinegraphWarning, lambda C: C.addFrame("a").setQuaternion([0, 0, 0, 1])),
        (ry.KinegraphWarning, lambda C: C.addFrame("a").setPose([1, 0, 0, 0, 0.4, 0.2, 0.5])),
        (ry.KinegraphWarning, lambda C: C.addFrame("a").setQuaternion([90, 0, 0, 1])),
        (ry.KinegraphWarning, lambda C: C.addFrame("hand", "l_gripper").setShape(ry.ST.box, [120, 30, 20])),
        (
            ry.KinegraphWarning,
            lambda C: C.addFrame("b", "table").setRelativePosition([0, 0, 0.5]).setJoint(ry.JT.hingeX),
        ),
        (ry.KinegraphWarning, near),
        (ry.KinegraphWarning, lambda C: file("ur.g", f"Include: <{ry.raiPath('ur10/ur10.g')}>")(C).getCollisions()),
        (ry.KinegraphWarning, lambda C: C.addFrame("table")),
        (ry.KinegraphWarning, text("a: { shape: marker,   colour: [1 0 0], size: [.1] }")),
        (ry.KinegraphWarning, komo([5.0], ry.FS.positionDiff, ["l_gripper", "table"], ry.OT.eq)),
        (ry.KinegraphWarning, file("robot.urdf", NO_LIMIT)),
        (
            ry.KinegraphWarning,
            file(
                "robot.urdf",
                NO_LIMIT.replace("</joint>", "<limit lower='1' upper='-1' effort='1' velocity='1'/></joint>"),
            ),
        ),
        (
            ry.KinegraphWarning,
            file(
                "robot.urdf",
                "<robot name='r'><link name='a'><visual><geometry>"
                "<mesh filename='package://arm/a.stl'/></geometry></visual></link></robot>",
            ),
        ),
        (ry.KinegraphWarning, srdf),
        (
            ry.KinegraphWarning,
            file(
                "model.xml",
                "<mujoco><worldbody><geom type='sphere' size='.1'/></worldbody><tendon><fixed name='t'/></tendon>"
                "</mujoco>",
            ),
        ),
        (ry.KinegraphWarning, attached),
        (ry.KinegraphWarning, in_the_air),
    ],
}


def message_of(kind, call):
    """Returns the first line of the error or of the first warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", ry.KinegraphWarning)
        with pytest.raises(kind) as caught:
            call(panda())
    assert caught.type is kind
    return str(caught.value).splitlines()[0]


@pytest.mark.parametrize("section", CASES)
def test_the_messages_of_the_catalogue_are_those_of_the_library(section, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    messages = [message_of(kind, call) for kind, call in CASES[section]]
    expected = rows(section)
    assert len(messages) == len(expected)
    for message, row in zip(messages, expected, strict=True):
        assert re.fullmatch(row, message), f"{row}\nis not\n{message}"


def test_the_catalogue_names_all_classes():
    classes = {
        name
        for name, value in vars(ry).items()
        if isinstance(value, type) and issubclass(value, (ry.Error, ry.KinegraphWarning))
    }
    table = PAGE.split("| class in Python")[1].split("\n\n")[0]
    assert classes == set(re.findall(r"^\| `(\w+)`", table, re.MULTILINE))
