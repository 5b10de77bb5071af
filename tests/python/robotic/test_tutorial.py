"""The lines of the tutorial, part by part, as a student types them (their line breaks mended)."""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from numpy.linalg import inv

import kinegraph

EXAMPLES = Path(__file__).parent.parent.parent.parent / "examples"
IMPORTS = ["from robotic import ry", "import robotic as ry", "import kinegraph as ry"]

BOX_FILE = """box1: { X: "t(0 0 0.25) d(0 0 0 1)", shape: ssBox, size: [.5 .5 .5 .05], color: [1 .5 0], mass: .1, contact: true }
"""

ARM_FILE = """zero { X:"T t(0 0 0) d(180 0 0 1)" shape:sphere mass=1 size=[0.
0. .2 .05]}

link1 { shape:capsule mass=1 size=[0. 0. .3 .05] color: [0 0
1]}

(zero link1) { joint:hingeX, pre:"T t(0 0 .00)" B:"T t(0 0 .2)" }

link2      { shape:capsule mass=1 size=[0. 0. .3 .05] color: [1 0
0]}

(link1 link2) { joint:hingeX, pre:"T t(0 0.0 .15)" B:"T t(0 0.0
.15)" }

endeffector  { shape:sphere mass=1 size=[0. 0. .2 .05] color:
[0 1 0]}

(link2 endeffector) { joint:hingeX, pre:"T t(0 0.0 .18)" B:"T t(0
0.0 .0)" }
"""


@pytest.fixture(params=IMPORTS)
def tutorial(request, tmp_path, monkeypatch):
    """Runs lines in a folder with the tutorial's files, after one of the imports. Names stay from block to block."""
    (tmp_path / "mini.g").write_text((EXAMPLES / "mini.g").read_text())
    (tmp_path / "box.g").write_text(BOX_FILE)
    (tmp_path / "arm.g").write_text(ARM_FILE)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("builtins.input", lambda prompt="": print(prompt))
    monkeypatch.setattr(time, "sleep", lambda seconds: None)
    names = {}

    def run(lines):
        exec(compile(lines, "<tutorial>", "exec"), names)
        return names

    run(request.param)
    return run


@pytest.mark.parametrize("line", IMPORTS)
def test_the_installation_test_shows_a_random_scene_of_many_shapes(line):
    program = subprocess.run(
        [sys.executable, "-c", f"{line}; ry.test.RndScene()"], capture_output=True, text=True, timeout=120
    )
    assert program.returncode == 0, program.stderr
    assert "frames" in program.stdout
    shapes = [frame for frame in kinegraph.test.randomScene().getFrames() if frame.getShapeType() != kinegraph.ST.none]
    assert len(shapes) > 40


def test_part_1_loads_shows_and_watches_a_file(tutorial):
    names = tutorial("""
C = ry.Config()
C.addFile('mini.g')
C.view()

C.watchFile('mini.g')
""")
    assert "handle" in names["C"].getFrameNames()


def test_part_2_adds_a_box(tutorial):
    names = tutorial("""
import time


C = ry.Config()
C.addFrame('box') \\
.setPosition([0, 0, .25]) \\
.setShape(ry.ST.ssBox, size=[.5, .5, .5, .05]) \\
.setColor([1, .5, 0]) \\
.setMass(.1) \\
.setContact(True)
C.view()
time.sleep(5)
""")
    box = names["C"].getFrame("box")
    assert np.allclose(box.getPosition(), [0, 0, 0.25])
    assert np.allclose(box.getSize(), [0.5, 0.5, 0.5, 0.05])
    assert box.getShapeType() == kinegraph.ST.ssBox


def test_part_2_reads_the_same_box_from_a_file(tutorial):
    names = tutorial("C = ry.Config()\nC.addFile('box.g')\nC.view()")
    box = names["C"].getFrame("box1")
    assert np.allclose(box.getPosition(), [0, 0, 0.25])
    assert box.getAttributes()["color"] == [1, 0.5, 0]


def test_part_3_places_a_second_box_relative_to_the_first(tutorial, capsys):
    tutorial("""
C = ry.Config()
C.addFile('box.g')
C.addFrame(name="box2", parent="box1") \\
  .setShape(ry.ST.ssBox, size=[.5, .5, .5, .05]) \\
  .setRelativePosition([0,0,1]) \\
  .setColor([0,0,1])
f = C.frame("box2")
print("position:", f.getPosition())
print("orientation:", f.getQuaternion())
""")
    assert capsys.readouterr().out.splitlines() == ["position: [0.   0.   1.25]", "orientation: [1. 0. 0. 0.]"]


def test_part_4_builds_the_two_link_arm_from_the_old_dialect(tutorial):
    names = tutorial("C = ry.Config()\nC.addFile('arm.g')\nC.view()")
    arm = names["C"]
    assert arm.getJointDimension() == 3
    a, b = 0.3, 0.4
    arm.setJointState([a, b, 0.5])
    expected = [0, 0.35 * np.sin(a) + 0.33 * np.sin(a + b), 0.35 * np.cos(a) + 0.33 * np.cos(a + b)]
    position = arm.getFrame("endeffector").getPosition()
    assert np.allclose(np.abs(position), np.abs(expected), atol=1e-9)  # zero is turned by 180 degrees about z


def test_part_5_evaluates_features_of_two_arms(tutorial):
    names = tutorial("""
C = ry.Config()
C.addFile(ry.raiPath('panda/panda.g'))
C.addFile(ry.raiPath('panda/panda.g'), 'r_')
C.getFrame('r_panda_base').setPosition([0, -.8, 0])
f = C.getFrame('r_gripper')
print('gripper pos:', f.getPosition())
print('gripper quat:', f.getQuaternion())
print('gripper rot:', f.getRotationMatrix())
[y,J] = C.eval(ry.FS.position, ['gripper'])
print('position of gripper:', y, '\\nJacobian:', J)
# negative(!) distance between two convex shapes (or origin of marker)
d = C.eval(ry.FS.negDistance, ['panda_coll7', 'r_panda_coll7'])
# the x-axis of the given frame in world coordinates
x = C.eval(ry.FS.vectorX, ['gripper'])
""")
    C = names["C"]
    assert np.allclose(names["y"], C.getFrame("gripper").getPosition())
    assert names["J"].shape == (3, 14) and not names["J"][:, 7:].any()
    assert -0.8 < names["d"][0][0] < -0.5
    assert np.allclose(names["x"][0], C.getFrame("gripper").getRotationMatrix()[:, 0])


TABLE = [
    "position",
    "quaternion",
    "pose",
    "vectorX",
    "vectorY",
    "vectorZ",
    "positionDiff",
    "positionRel",
    "quaternionDiff",
    "quaternionRel",
    "poseDiff",
    "poseRel",
    "vectorXDiff",
    "vectorXRel",
    "vectorYDiff",
    "vectorYRel",
    "vectorZDiff",
    "vectorZRel",
    "scalarProductXX",
    "scalarProductXY",
    "scalarProductXZ",
    "scalarProductYX",
    "scalarProductYY",
    "scalarProductYZ",
    "scalarProductZZ",
    "gazeAt",
    "angularVel",
    "accumulatedCollisions",
    "jointLimits",
    "distance",
    "negDistance",
    "qItself",
    "jointState",
    "aboveBox",
    "insideBox",
    "standingAbove",
]
ROWS = {
    "position": 3,
    "quaternion": 4,
    "pose": 7,
    "vector": 3,
    "scalar": 1,
    "gazeAt": 2,
    "angularVel": 3,
    "accumulated": 1,
    "jointLimits": 14,
    "distance": 1,
    "negDistance": 1,
    "qItself": 7,
    "jointState": 7,
    "aboveBox": 4,
    "insideBox": 6,
}


@pytest.mark.parametrize("name", TABLE)
def test_part_5_every_feature_of_the_table_has_the_rows_that_it_says(name, panda):
    panda.addFrame("box").setPosition([0.3, 0.3, 0.8]).setShape(kinegraph.ST.ssBox, [0.3, 0.3, 0.3, 0.02])
    one = name in ("position", "quaternion", "pose", "vectorX", "vectorY", "vectorZ", "angularVel")
    none = name in ("accumulatedCollisions", "jointLimits", "qItself", "jointState")
    frames = [] if none else ["l_gripper"] if one else ["l_palm", "box"]
    symbol = getattr(kinegraph.FS, name)
    if name == "angularVel":  # a velocity compares two configurations
        komo = kinegraph.KOMO(panda, 1, 1, 1, False)
        komo.addObjective([], symbol, frames, kinegraph.OT.eq, [1.0], [], 1)
        assert len(komo.nlp().evaluate(panda.getJointState())[0]) == 3
        return
    y, J = panda.eval(symbol, frames)
    rows = next((rows for start, rows in ROWS.items() if name.startswith(start)), None)
    assert rows is None or y.shape == (rows,)
    assert J.shape == (y.size, 7)


PART_6 = [
    """
import numpy as np
import time
C = ry.Config()
C.addFile(ry.raiPath('../rai-robotModels/scenarios/pandaSingle.g'))
C.view()
""",
    """
#this reference frame only appears in your workspace C - not the simulation!
target = C.addFrame('target', 'table')
target.setShape(ry.ST.marker, [.1])
target.setRelativePosition([0., .3, .3])
pos = target.getPosition()
cen = pos.copy()
C.view()
""",
    """
qHome=[ 0., -0.5, 0., -2., 0., 2., -0.5]
q0 = qHome.copy()
q1 = q0.copy()
q1[1] = q1[1] + .2
print(q0, q1)

# you'll learn about KOMO later - this defines a basic Inverse Kinematics method
def IK(C, pos):
    q0 = C.getJointState()
    komo = ry.KOMO(C, 1, 1, 0, False) #one phase one time slice problem, with 'delta_t=1', order=0

    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], q0) #cost: close to 'current state'
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], qHome) #cost: close to qHome
    komo.addObjective([], ry.FS.positionDiff, ['l_gripper', 'target'], ry.OT.eq, [1e1]) #constraint: gripper position

    ret = ry.NLP_Solver(komo.nlp(), verbose=0) .solve()

    return [komo.getPath()[0], ret]
""",
    """
#pos= [0., .0, .0]
#target.setPosition(pos)
q_target, ret = IK(C, pos)
print(ret)
C.setJointState(q_target)
C.view()
""",
]

PART_6_LOOP = """
np.random.seed(0)
seen = []
for t in range(20):
    time.sleep(.1)
    pos = cen + .98 * (pos-cen) + 0.02 * np.random.randn(3)
    target.setPosition(pos)

    q_target, ret = IK(C, pos)
    print(ret)
    C.setJointState(q_target)
    C.view()
    seen.append((ret.feasible, np.linalg.norm(C.getFrame('l_gripper').getPosition() - pos)))
"""


def test_part_6_follows_the_target_with_twenty_of_twenty_solves(tutorial, capsys):
    for block in PART_6:
        tutorial(block)
    names = tutorial(PART_6_LOOP)
    feasible, distances = zip(*names["seen"])
    assert all(feasible) and len(feasible) == 20
    assert max(distances) < 1e-4
    assert capsys.readouterr().out.count("feasible: 1") == 21


def test_part_7_reaches_for_the_target_in_ten_newton_steps(tutorial):
    tutorial(
        "import numpy as np\nfrom numpy.linalg import inv\nK = ry.Config()\nK.addFile('arm.g')\nK.setJointState([.3, .4, 0.])"
    )
    names = tutorial("""
n = K.getJointDimension()
q = K.getJointState()
w = 1e-4
W = w * np.identity(n) # W is equal the ID_n matrix times scalar w

input("initial posture, press Enter to continue...")


y_target = [0.0, 0.7, 0]

for i in range(10):
    # 1st task
    F = K.feature(ry.FS.position, ["endeffector"])
    y, J = F.eval(K)

    # compute joint updates
    q += inv(J.T @ J + W) @ J.T @ (y_target - y)
    # NOTATION: J.T is the transpose of J; @ is matrix multiplication (dot product)
# sets joint angles AND computes all frames AND updates display
K.setJointState(q)

# optional: pause and watch OpenGL
K.view()
input("Press Enter to continue...")
""")
    assert np.isfinite(names["q"]).all()
    K = names["K"]

    def step(q, target):
        K.setJointState(q)
        y, J = names["F"].eval(K)
        return q + inv(J.T @ J + names["W"]) @ J.T @ (target - y)

    # With the joint state set in every step, as the text means it, a target within reach is reached.
    q, target = np.array([0.3, 0.4, 0.0]), np.array([0.0, -0.5, 0.2])
    for _ in range(10):
        q = step(q, target)
    K.setJointState(q)
    assert np.linalg.norm(K.getFrame("endeffector").getPosition() - target) < 1e-3
