"""Arguments that match no signature of a compiled function: the error names the argument and suggests a correction."""

from __future__ import annotations

import numpy as np
import pytest

import kinegraph as ry
from kinegraph import call_errors


@pytest.fixture(scope="module")
def C() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


@pytest.fixture(scope="module")
def komo(C) -> ry.KOMO:
    return ry.KOMO(C, 1, 1, 0, False)


def still(C) -> ry.MotionPlan:
    return ry.planMotion(C, C.getJointState())


MISTAKES = [
    (lambda C, k: C.addFrame(), r"Config.addFrame: missing: name \(str\)"),
    (lambda C, k: C.addFrame(3), r"Config.addFrame: name is 3 \(int\); expected str"),
    (
        lambda C, k: C["table"].setJoint("hingeX"),
        r"Frame.setJoint: jointType is 'hingeX' \(str\); expected JT; write JT.hingeX",
    ),
    (lambda C, k: C["table"].setJoint("hingex"), r"expected JT; similar names: hinge"),
    (
        lambda C, k: C["table"].setParent("world"),
        r"parent is 'world' \(str\); expected Frame; write C.getFrame\('world'\)",
    ),
    (lambda C, k: C["table"].setMass("1"), r"Frame.setMass: mass is '1' \(str\); expected float"),
    (lambda C, k: C["table"].setPosition(None), r"Frame.setPosition: position is None; expected numbers"),
    (
        lambda C, k: C["table"].setPosition(1, 2, 0.5),
        r"3 arguments are given; it takes at most 1: position; write one list: \[1, 2, 0.5\]",
    ),
    (lambda C, k: C["table"].setShape(ry.ST.box), r"Frame.setShape: missing: size \(numbers\)"),
    (
        lambda C, k: C.setJointState([0, 1, "a"]),
        r"q is \[0, 1, 'a'\] \(list\); expected numbers; entry 2 is 'a' \(str\)",
    ),
    (lambda C, k: C.setJointState([[1, 2], [3]]), r"expected numbers; its rows have different lengths"),
    (
        lambda C, k: C.selectJoints("l_panda_joint1"),
        r"jointNames is 'l_panda_joint1' \(str\); .* write \['l_panda_joint1'\]",
    ),
    (lambda C, k: C.selectJoints(C["table"]), r"expected Sequence\[str\]; write \['table'\]"),
    (lambda C, k: C.eval("positon", ["table"]), r"featureSymbol is 'positon' .* similar names: position"),
    (lambda C, k: C.view("hello"), r"Config.view: pause is 'hello' \(str\); expected bool"),
    (
        lambda C, k: k.addObjective([], ry.FS.position, ["table"], "eq"),
        r"KOMO.addObjective: type is 'eq' .* write OT.eq",
    ),
    (lambda C, k: k.addObjective([], ry.FS.position, ["table"]), r"KOMO.addObjective: missing: type \(OT\)"),
    (lambda C, k: k.addControlObjective([], order=0, scal=1.0), r"it has no argument 'scal'; similar names: scale"),
    (lambda C, k: ry.BotOp(C, False).setLimits(vel=1.0), r"it has no argument 'vel'; similar names: velocity\n"),
    (lambda C, k: ry.KOMO(C), r"KOMO: missing: phases \(float\), slicesPerPhase \(int\), kOrder \(int\)"),
    (lambda C, k: ry.KOMO("scene.g", 1, 1, 0, False), r"KOMO: config is 'scene.g' \(str\); expected Config"),
    (lambda C, k: ry.NLP_Solver(k), r"NLP_Solver: problem is <KOMO.* expected NLP; write komo.nlp\(\)"),
    (lambda C, k: ry.Simulation(C, "physx"), r"engine is 'physx' .* write SimulationEngine.physx"),
    (
        lambda C, k: ry.RRT_PathFinder().setProblem(3),
        r"RRT_PathFinder.setProblem: Configuration is 3 \(int\); expected Config",
    ),
    (lambda C, k: ry.CameraView(3), r"CameraView: config is 3 \(int\); expected Config"),
    (lambda C, k: ry.SimulationBatch("C", 2), r"SimulationBatch: \w+ is 'C' \(str\); expected Config"),
    (lambda C, k: ry.planTask(C, 3), r"planTask: goal is 3 \(int\); expected str"),
    (lambda C, k: C.setJointState(C.getJointState), r"q is the method getJointState; .* call it: getJointState\(\)"),
    (lambda C, k: ry.NLP_Solver(k.nlp), r"problem is the method nlp; expected NLP; call it: nlp\(\)"),
    (lambda C, k: C["table"].setQuaternion(1, 0, 0, 0), r"at most 1: quaternion; write one list: \[1, 0, 0, 0\]"),
    (
        lambda C, k: C["table"].setShape(ry.ST.box, 0.1, 0.2, 0.3),
        r"takes at most 2: type, size; write one list: \[0.1, 0.2, 0.3\]",
    ),
    (lambda C, k: C["table"].setJoint("revolute"), r"expected JT; here it is hingeX, hingeY or hingeZ"),
    (lambda C, k: C.setJointState(still(C)), r"expected numbers; plan.eval\(t\)\[0\] is its configuration"),
    (lambda C, k: C.view_path(still(C)), r"expected numbers; write plan.path"),
    (lambda C, k: C.setJointState(ry.solveIk(C, {"l_gripper": "table"})), r"expected numbers; write result.q"),
    (lambda C, k: ry.BotOp(C).follow(still(C).path), r"expected Trajectory; ry.retime\(path, .* times a path"),
    (lambda C, k: ry.Config("arm.urdf"), r"read a file by C = Config\(\); C.addFile\('arm.urdf'\)"),
    (lambda C, k: ry.Domain("own.fol"), r"read a file by Domain.fromFol\('own.fol'\)"),
    (
        lambda C, k: ry.LogicProblem.fromPddl("domain.pddl", "problem.pddl"),
        r"domain is 'domain.pddl' \(str\); expected Domain; read a file by Domain.fromPddl\('domain.pddl'\)",
    ),
]


@pytest.mark.parametrize(("call", "message"), MISTAKES)
def test_the_message_names_the_argument_and_how_to_mend_it(C, komo, call, message) -> None:
    with pytest.raises(ry.ArgumentTypeError, match=message) as raised:
        call(C, komo)
    assert isinstance(raised.value, TypeError) and isinstance(raised.value, ry.Error)
    assert "kinegraph._core" not in str(raised.value) and "incompatible" not in str(raised.value)


def test_each_form_is_written_below_with_its_defaults(C) -> None:
    with pytest.raises(ry.ArgumentTypeError) as raised:
        C["table"].setMass()
    assert str(raised.value).splitlines()[1:] == ["  setMass(mass: float, inertiaMatrix: ArrayLike | None = None)"]


@pytest.mark.parametrize(
    "call",
    [
        lambda C, k: C.eval(ry.OT.eq, ["table"]),
        lambda C, k: C.addFrame("ball").setShape(ry.JT.hingeX, [0.1]),
        lambda C, k: C.addFrame("arm", "table").setJoint(ry.ST.box),
        lambda C, k: k.addObjective([], ry.OT.eq, ["table"], ry.FS.position),
        lambda C, k: k.addModeSwitch([1, 2], ry.OT.eq, ["table", "world"]),
        lambda C, k: ry.Simulation(C).step([], 0.01, ry.OT.eq),
    ],
)
def test_a_member_of_another_enum_is_refused(C, komo, call) -> None:
    with pytest.raises(ry.ArgumentTypeError, match=r"is (OT|JT|ST|FS)\.\w+; expected"):
        call(C, komo)


def test_the_number_of_a_member_is_taken(C) -> None:
    ball = C.addFrame("numbered")
    for number in (int(ry.ST.sphere), np.int64(ry.ST.sphere)):
        assert ball.setShape(number, [0.1]).getShapeType() == ry.ST.sphere


def test_what_a_callback_raises_is_not_changed(C) -> None:
    def feature(*frames: ry.FrameView) -> list[float]:
        raise TypeError("mine: incompatible")

    with pytest.raises(TypeError, match="^mine: incompatible$"):
        C.eval(feature, ["table"])


def test_operators_still_leave_it_to_the_other_side(C) -> None:
    assert (C["table"] == 3) is False and (ry.OT.eq == ry.FS.position) is False and ry.OT.eq == ry.OT.eq


def test_signatures_and_types_are_read() -> None:
    form = call_errors.parameters(
        "def f(self, a: dict[str, int] | None = \\0, *args, b: float = 1.0) -> tuple[int]", [{}]
    )
    assert [str(each) for each in form] == ["self: Any", "a: dict[str, int] | None = {}", "*args", "b: float = 1.0"]
    assert call_errors.fits([1, 2], "collections.abc.Sequence[int]") and not call_errors.fits("a", "list[str]")
    assert call_errors.fits(3, "some.unknown.Type") and not call_errors.fits(None, "numpy.typing.ArrayLike")
