"""LGP_Tool and default_LGP_TAMP_Abstraction: plans, the problems that they become, and their solutions."""

import itertools
import json
import logging
import signal
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
import robotic
from interrupts import interrupt_after

DATA = Path(__file__).parent.parent.parent / "data"
RECORDED = json.loads((DATA / "lgp.json").read_text())["problems"]
OVERLAPS = ("F_PairCollision", "F_AccumulatedCollisions")


def tool(scene, problem=None):
    C = ry.Config()
    C.addFile(str(DATA / "lgp" / f"{scene}.g"))
    tamp = ry.default_LGP_TAMP_Abstraction(C, str(DATA / "lgp" / f"{problem or scene}.lgp"))
    return C, tamp, ry.LGP_Tool(C, tamp)


def runs(values):
    return [[value, len(list(run))] for value, run in itertools.groupby(values)]


def objectives(komo):
    """Frames, order, type, times and slices of each, but for the number that a recording gives for all frames."""
    listed = [o for o in komo.report(False, True, False, False).values() if isinstance(o, dict) and "name" in o]
    return [
        [_named(o["frames"], komo), int(o["order"]), o["type"], list(o["times"]), list(map(int, o["slices"]))]
        for o in listed
    ]


def _named(frames, komo):
    joints = {"hand", "base"}  # the recording names the joint of a scene with one
    return [] if not frames or frames[0].startswith("#") or set(frames) == joints else frames


def expected_objectives(recorded):
    return [[_named(o[1], None), o[2], o[3], o[4], o[5]] for o in recorded["objectives"]]


def same(o, e):
    """If a hand closes, the reference lists accelerations one slice before the slice in which it measures them."""
    return o[:3] == e[:3] and (o[3:] == e[3:] or (o[1] == 2 and o[4] == [s + 1 for s in e[4]]))


@pytest.mark.parametrize("name", RECORDED)
def test_the_first_plan_that_is_feasible_is_as_long_as_that_of_the_reference(name):
    C, tamp, _ = tool(name)
    lgp = robotic.LGP_Tool(C, tamp)
    assert lgp.solve(verbose=0) and lgp.status == ry.LgpStatus.solved
    assert len(lgp.getSolvedPlan()) == len(RECORDED[name]["plan"])
    assert lgp.getSolvedKOMO().getT() == len(lgp.getSolvedPlan())


@pytest.mark.parametrize("name", RECORDED)
def test_waypoint_problems_are_those_of_the_reference(name):
    C, tamp, _ = tool(name)
    recorded, plan = RECORDED[name]["waypoints"], RECORDED[name]["plan"]
    komo = tamp.setup_sequence(C, len(plan))
    tamp.add_all(komo, plan, motion=False)
    nlp = komo.nlp()
    assert nlp.getDimension() == recorded["dim"] and len(nlp.getTypes()) == recorded["phi_dim"]
    assert runs(str(t).split(".")[-1] for t in nlp.getTypes()) == recorded["types"]
    ours, theirs = objectives(komo), expected_objectives(recorded)
    assert len(ours) == len(theirs) and all(same(o, e) for o, e in zip(ours, theirs, strict=True))
    phi, J = nlp.evaluate(np.array(recorded["x"]))
    Jv = np.zeros(len(phi))
    np.add.at(Jv, J[:, 0].astype(int), J[:, 2] * np.array(recorded["v"])[J[:, 1].astype(int)])
    tags = np.repeat([f[0] for f in recorded["features"]], [f[1] for f in recorded["features"]])
    compared = ~np.array([t.startswith((*OVERLAPS, "F_AlignWith")) for t in tags])
    # The sign of a quaternion, and so of the change of one, carries no meaning.
    expected, expected_v = np.array(recorded["phi"]), np.array(recorded["Jv"])
    flipped = (
        (abs(phi - expected) > 2e-6) & (abs(phi + expected) < 2e-6) & np.array([t.startswith("F_Pose") for t in tags])
    )
    sign = np.where(flipped, -1.0, 1.0)
    assert abs(phi - sign * expected)[compared].max() < 2e-6
    assert abs(Jv - sign * expected_v)[compared].max() < 1e-4


@pytest.mark.parametrize("name", RECORDED)
def test_motion_problems_are_those_of_the_reference(name):
    C, tamp, _ = tool(name)
    recorded, plan = RECORDED[name]["full"], RECORDED[name]["plan"]
    komo = tamp.setup_motion(C, len(plan))
    tamp.add_all(komo, plan, motion=True)
    assert komo.getT() == recorded["T"] and komo.nlp().getDimension() == recorded["dim"]
    ours, theirs = objectives(komo), expected_objectives(recorded)
    # The last acceleration is beyond the end: it is in the reference's list, and has no rows there.
    theirs = [e for e in theirs if not (e[1] == 2 and e[0] and e[4][0] == recorded["T"] - 1)]
    assert len(ours) == len(theirs) and all(same(o, e) for o, e in zip(ours, theirs, strict=True))


def test_a_simple_handover_is_found():
    """The problem whose plan the reference never finds."""
    _, _, lgp = tool("handover")
    assert lgp.solve(verbose=0)
    assert [a[0] for a in lgp.getSolvedPlan()] == ["pick_touch", "handover", "place_straightOn"]


def test_the_tutorial_with_one_arm_from_waypoints_to_motions():
    _C, _, lgp = tool("panda_unblock", "kitchen_single")
    assert lgp.solve(verbose=0)
    plan = lgp.getSolvedPlan()
    assert [a[0] for a in plan] == ["pick_touch", "place_straightOn"] * 2 and {a[1] for a in plan} == {"objG", "objB"}
    end = lgp.getSolvedKOMO().getConfiguration(3)
    for obj, tray in (("objG", "trayG"), ("objB", "trayB")):
        offset = end.getFrame(obj).getPosition() - end.getFrame(tray).getPosition()
        assert abs(offset[:2]).max() < 0.04 and offset[2] == pytest.approx(0.055, abs=2e-3)
    piece = lgp.get_piecewiseMotionProblem(1, True)
    assert piece.getT() == 30
    results = lgp.solvePiecewiseMotions(verbose=0)
    assert len(results) == 4
    # Waypoints of pick_touch may collide, as in the reference; a motion that must not ends beside them.
    np.testing.assert_allclose(lgp.paths[0][-1], lgp.getSolvedKOMO().getPath()[0], atol=5e-2)
    assert lgp.get_fullMotionProblem(True).getT() == 120


def test_the_tutorial_with_two_arms_hands_over():
    _, _, lgp = tool("bimanual", "kitchen_handover")
    assert lgp.solve(verbose=0)
    assert lgp.getSolvedPlan()[0][0] == "pick_touch" and lgp.getSolvedPlan()[-1][-1] == "trayG"
    assert lgp.solveFullMotion(verbose=0).feasible and lgp.path.shape == (90, 14)


@pytest.mark.parametrize(("scene", "problem"), [("panda_unblock", "kitchen_single"), ("bimanual", "kitchen_handover")])
def test_the_tutorials_problems_are_solved_whatever_is_drawn(scene, problem, request):
    request.addfinalizer(lambda: ry.rnd_seed(0))
    for seed in range(3, 6):
        ry.rnd_seed(seed)
        _, _, lgp = tool(scene, problem)
        assert lgp.solve(verbose=0), seed
        assert lgp.solveFullMotion(verbose=0).feasible, seed


def test_a_push_up_a_step_is_not_called_feasible_but_by_the_reference():
    """The pad is 4 mm higher than the table that the disc slides over."""
    _, _, lgp = tool("push")
    assert not lgp.solve(verbose=0) and lgp.status == ry.LgpStatus.no_plan_found
    assert "end_push g_gripper disc table pad" in lgp.message


def test_repeated_calls_give_further_plans_and_end():
    _, _, lgp = tool("gantry")
    plans = []
    while lgp.solve(verbose=0):
        assert lgp.getSolvedPlan() not in plans
        plans.append(lgp.getSolvedPlan())
        if len(plans) > 5:
            break
    assert plans and lgp.status != ry.LgpStatus.not_started


def test_an_abstraction_of_ones_own(tmp_path):
    """An action that the default one does not know."""
    C = ry.Config()
    C.addFile(str(DATA / "lgp" / "unblock.g"))
    (tmp_path / "a.fol").write_text(
        "is_gripper is_object at\nDecisionRule visit { H O { (is_gripper H) (is_object O) } { (at H O) } }"
    )
    (tmp_path / "a.lgp").write_text('fol: <a.fol>\nterminal: "(at hand red)"\ngenericCollisions: false\n')

    class Visits(ry.default_LGP_TAMP_Abstraction):
        def add_action_constraints(self, komo, time, prev_action, action):
            komo.addObjective([time], ry.FS.positionDiff, action[1:3], ry.OT.eq, [1e1])

    with pytest.raises(ry.ArgumentError, match="unknown action 'visit'; known are pick_touch"):
        ry.LGP_Tool(C, ry.default_LGP_TAMP_Abstraction(C, str(tmp_path / "a.lgp"))).solve(0)
    lgp = ry.LGP_Tool(C, Visits(C, str(tmp_path / "a.lgp")))
    assert lgp.solve(0) and lgp.getSolvedPlan() == [["visit", "hand", "red"]]
    C.setJointState(lgp.getSolvedKOMO().getPath()[0])
    np.testing.assert_allclose(C.getFrame("hand").getPosition(), C.getFrame("red").getPosition(), atol=1e-3)


class Reaches(ry.LGP_TAMP_Abstraction):
    """Plans of one action each: the hand goes to a height."""

    def __init__(self, C, heights):
        super().__init__(C)
        self.plans = [[["reach", str(height)]] for height in heights]
        self.forbidden = []

    def getNewActionSequence(self):
        return self.plans.pop(0) if self.plans else None

    def forbidBeginning(self, plan):
        self.forbidden.append(plan)

    def add_action_constraints(self, komo, time, prev_action, action):
        assert prev_action == []
        komo.addObjective([time], ry.FS.position, ["hand"], ry.OT.eq, [[0, 0, 10]], [0, 0, float(action[1])])


def floating_hand():
    C = ry.Config()
    C.addFile(str(DATA / "lgp" / "unblock.g"))
    return C


def test_an_abstraction_without_files_in_which_all_methods_are_python():
    class Slow(Reaches):
        def setup_sequence(self, C, K):
            komo = super().setup_sequence(C, K)
            komo.addControlObjective([], 0, 1e-3)
            return komo

        def setup_motion(self, C, K):
            komo = ry.KOMO(C, K, 5, 2, False)
            komo.addControlObjective([], 2, 1e-1)
            return komo

        def add_action_constraints_motion(self, komo, time, prev_action, action):
            super().add_action_constraints_motion(komo, time, prev_action, action)
            komo.addObjective([time], ry.FS.qItself, [], ry.OT.eq, [1e0], [], 1)

    C = floating_hand()
    tamp = Slow(C, [0.9, 1.1])
    tamp.explicitCollisions = ["red", "blue"]
    lgp = ry.LGP_Tool(C, tamp)
    assert lgp.tamp is tamp and lgp.solve(0) and lgp.getSolvedPlan() == [["reach", "0.9"]]
    names = [o[0] for o in objectives(lgp.getSolvedKOMO())]
    assert ["red", "blue"] in names and ["hand"] in names and names.count([]) >= 3
    assert lgp.getSolvedKOMO().getConfiguration(0).getFrame("hand").getPosition()[2] == pytest.approx(0.9, abs=1e-3)
    result = lgp.solveFullMotion(0)
    assert result.feasible and lgp.path.shape[0] == lgp.motion.getT() == 5
    assert abs(lgp.path[-1] - lgp.path[-2]).max() < 1e-2
    assert lgp.solve(0) and lgp.getSolvedPlan() == [["reach", "1.1"]]
    assert not lgp.solve(0) and lgp.status == ry.LgpStatus.no_plan_found and lgp.message == "no further plan in logic"


def test_what_an_abstraction_cannot_do_is_forbidden_and_told():
    C = floating_hand()
    tamp = Reaches(C, [50.0, 1.0])
    lgp = ry.LGP_Tool(C, tamp)
    assert lgp.solve(0) and lgp.getSolvedPlan() == [["reach", "1.0"]]
    assert tamp.forbidden == [[["reach", "50.0"]]]
    assert not lgp.solve(0) and "(reach 50.0): position of hand is missed by 4" in lgp.message
    nothing = ry.LGP_Tool(C, Reaches(C, []))
    assert not nothing.solve(0) and (nothing.status, nothing.message) == (ry.LgpStatus.infeasible, "no plan in logic")


def test_plans_that_failed_are_tried_again_when_there_is_no_further_one():
    class Moody(Reaches):
        calls = 0

        def add_action_constraints(self, komo, time, prev_action, action):
            self.calls += 1
            super().add_action_constraints(komo, time, prev_action, [action[0], "50" if self.calls < 3 else action[1]])

    C = floating_hand()
    lgp = ry.LGP_Tool(C, Moody(C, [0.9, 1.1]))
    assert lgp.solve(0) and lgp.getSolvedPlan() == [["reach", "0.9"]]
    assert lgp.solve(0) and lgp.getSolvedPlan() == [["reach", "1.1"]]


def test_mistakes_in_an_abstraction_are_told():
    C = floating_hand()

    class Wrong(Reaches):
        def setup_sequence(self, C, K):
            return 3

    class Broken(Reaches):
        def add_action_constraints(self, komo, time, prev_action, action):
            raise ZeroDivisionError("broken")

    class NoPlan(Reaches):
        def getNewActionSequence(self):
            return "reach"

    with pytest.raises(ry.ArgumentError, match="setup_sequence returned a int; expected a KOMO"):
        ry.LGP_Tool(C, Wrong(C, [1.0])).solve(0)
    with pytest.raises(ZeroDivisionError, match="broken"):
        ry.LGP_Tool(C, Broken(C, [1.0])).solve(0)
    with pytest.raises(ry.ArgumentError, match="getNewActionSequence returned a str; expected a list of actions"):
        ry.LGP_Tool(C, NoPlan(C, [1.0])).solve(0)
    with pytest.raises(ry.ArgumentError, match=r"action \(reach up\) has no constraints"):
        ry.LGP_TAMP_Abstraction(C).add_action_constraints(ry.KOMO(C, 1, 1, 1, False), 1.0, [], ["reach", "up"])
    odd = Reaches(C, [1.0])
    odd.explicitCollisions = ["red"]
    assert odd.explicitCollisions == ("red",)
    with pytest.raises(ry.ArgumentError, match="explicitCollisions has 1 names; expected pairs"):
        ry.LGP_Tool(C, odd).solve(0)


def test_an_action_with_too_few_words_is_told():
    C, tamp, _ = tool("unblock")
    komo = tamp.setup_sequence(C, 1)
    with pytest.raises(ry.ArgumentError, match=r"action \(pick_touch red\) has 2 words; expected 4"):
        tamp.add_action_constraints(komo, 1.0, [], ["pick_touch", "red"])


def test_an_action_of_ones_own_that_takes_something_along():
    """Uses the parts of the default actions."""
    C, _, _ = tool("unblock")

    class Lifts(ry.default_LGP_TAMP_Abstraction):
        def add_action_constraints(self, komo, time, prev_action, action):
            if action[0] != "pick_touch":
                return super().add_action_constraints(komo, time, prev_action, action)
            m = ry.KOMO_ManipulationHelper()
            m.komo = komo
            m.add_stable_frame(ry.JT.free, action[3], f"mine_{round(time)}")
            self.switch(m, time, f"mine_{round(time)}", action[1])
            komo.addObjective([time], ry.FS.distance, [action[1], action[3]], ry.OT.eq, [1e2])
            self.seen = (self.steps(komo), self.is_last(time))
            return None

    tamp = Lifts(C, str(DATA / "lgp" / "unblock.lgp"))
    lgp = ry.LGP_Tool(C, tamp)
    assert lgp.solve(0) and tamp.seen == (1, False)
    assert lgp.getSolvedKOMO().getConfiguration(0).getFrame("blue").getParent().name == "mine_1"
    assert lgp.solveFullMotion(0).feasible
    assert lgp.get_fullMotionProblem().getT() == 120 and tamp.seen == (30, False)
    assert tamp.domain.actions[0] == "pick_touch" and tamp.search.status == ry.PlanSearchStatus.found


def test_functions_of_ones_own_in_problems_are_called_from_threads_too():
    def height(frame):
        return frame.getPosition()[2:], frame.getPositionJacobian()[2:]

    class Feature(Reaches):
        def add_action_constraints(self, komo, time, prev_action, action):
            komo.addObjective([time], height, ["hand"], ry.OT.eq, [1e1], [float(action[1])])

    C = floating_hand()
    paths = []
    for threads in (1, 2):
        lgp = ry.LGP_Tool(C, Feature(C, [0.9]), threads=threads)
        assert lgp.solve(0)
        paths.append(lgp.getSolvedKOMO().getPath().tobytes())
    assert paths[0] == paths[1]


class Endless(Reaches):
    def getNewActionSequence(self):
        self.number = getattr(self, "number", 50) + 1
        return [["reach", str(self.number)]]


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_ends_a_search(threads):
    C = floating_hand()
    lgp = ry.LGP_Tool(C, Endless(C, []), threads=threads)
    with interrupt_after(0.2), pytest.raises(KeyboardInterrupt):
        lgp.solve(0, maxSolves=10**8)
    assert lgp.solves > 0


def test_ctrl_c_while_a_message_is_handled_ends_a_search(caplog):
    class PressesOnce(logging.Handler):
        messages = 0

        def emit(self, record):
            self.messages += 1
            if self.messages == 1:
                signal.raise_signal(signal.SIGINT)

    handler = PressesOnce()
    caplog.set_level("INFO", "kinegraph")
    C = floating_hand()
    lgp = ry.LGP_Tool(C, Endless(C, []))
    logging.getLogger("kinegraph").addHandler(handler)
    try:
        with interrupt_after(60) as late, pytest.raises(KeyboardInterrupt):
            lgp.solve(1, maxSolves=10**8)
    finally:
        logging.getLogger("kinegraph").removeHandler(handler)
    assert handler.messages >= 1 and late.time is None


def test_results_of_robotic_are_by_its_rule():
    C, tamp, _ = tool("push")
    lgp = robotic.LGP_Tool(C, tamp)
    assert lgp.solve(0)  # eq and ineq are below .1
    result = lgp.solveFullMotion(0)
    assert isinstance(result, robotic.SolverReturn) and result.feasible
    assert "feasible by the rule of robotic" in result.message
    assert all(isinstance(piece, robotic.SolverReturn) for piece in lgp.solvePiecewiseMotions(0))


def test_lines_are_logged(caplog):
    caplog.set_level("INFO", "kinegraph")
    _, _, lgp = tool("tower")
    assert lgp.solve()
    lgp.solvePiecewiseMotions()
    lgp.solveFullMotion()
    said = caplog.messages
    assert said[0] == "-- feasible: " + " ".join(f"({' '.join(action)})" for action in lgp.getSolvedPlan())
    assert said[1].startswith(f"-- ({' '.join(lgp.getSolvedPlan()[0])}): ") and said[-1].startswith("-- full motion: ")


TABLE = """world {}
base (world) { Q: [0 0 .6], shape: marker, size: [.05] }
table (base) { Q: [0 0 -.05], shape: ssBox, size: [2. 2. .1 .02], contact: 1, logical: { is_box, is_place } }
hand (base) { joint: trans3, limits: [-.9 -.9 0 .9 .9 1], Q: [0 0 .5], shape: marker, size: [.03], logical: { is_gripper } }
"""
RULES = """is_gripper is_object is_place is_box on busy
START_STATE {}
DecisionRule pick_touch {
  Obj, From, Hand
  { (is_gripper Hand) (is_object Obj) (on From Obj) (is_place From) (busy Hand)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) }
}
DecisionRule place_straightOn {
  Obj, Hand, To
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) }
  { (busy Hand)! (on Hand Obj)! (on To Obj) }
}
"""


def box(name, parent, position, size, logical="is_object, is_box, is_place"):
    return (
        f"{name} ({parent}) {{ Q: [{position}], joint: rigid, shape: ssBox, size: [{size} .004], contact: 1, "
        f"logical: {{ {logical} }} }}\n"
    )


def pad(name, position, size):
    return (
        f"{name} (base) {{ Q: [{position}], shape: ssBox, size: [{size} .01 .004], contact: 0, "
        "logical: { is_box, is_place } }\n"
    )


def boxes(folder, scene, goal, coll=""):
    (folder / "p.g").write_text(TABLE + scene)
    (folder / "p.fol").write_text(RULES)
    (folder / "p.lgp").write_text(f'fol: <p.fol>\nterminal: "{goal}"\n' + (f"coll: [{coll}]\n" if coll else ""))
    C = ry.Config()
    C.addFile(folder / "p.g")
    return C, ry.LGP_Tool(C, ry.default_LGP_TAMP_Abstraction(C, str(folder / "p.lgp")))


@pytest.mark.parametrize(
    ("goal", "actions"),
    [
        ("(on w1 w0)", 6),  # w2 on w1 on w0; the logic alone would put w0 on w1 at once, on top of itself
        ("(on w2 w1) (on w1 w0)", 8),
        ("(on w1 w0) (on w0 w2)", 6),
    ],
)
def test_towers_are_stacked_anew(tmp_path, goal, actions):
    tower = box("w0", "table", "0 0 .1", ".1 .1 .1") + box("w1", "w0", "0 0 .1", ".1 .1 .1")
    tower += box("w2", "w1", "0 0 .1", ".1 .1 .1")
    C, lgp = boxes(tmp_path, tower, goal, "w0 w1 w1 w2 w0 w2")
    assert lgp.solve(verbose=0)
    plan, komo = lgp.getSolvedPlan(), lgp.getSolvedKOMO()
    assert len(plan) <= actions
    C.setFrameState(komo.getFrameState(len(plan) - 1)[: C.getFrameDimension()])
    for literal in goal.replace(") (", ")|(").split("|"):
        below, above = (C.getFrame(name).getPosition() for name in literal.strip("()").split()[1:])
        assert above[2] - below[2] == pytest.approx(0.1, abs=5e-3)
        assert abs(above - below)[:2].max() < 0.06
    assert not [c for c in C.getCollisions() if c[2] < -2e-3]


def test_waypoints_in_which_a_third_object_overlaps_are_not_solved(tmp_path):
    can = box("can", "goal", "0 0 .055", ".06 .06 .1", "is_object")
    obj = box("obj", "table", "-.3 -.3 .1", ".08 .08 .1", "is_object")
    small, large = pad("goal", ".4 .3 .005", ".1 .1"), pad("goal", ".4 .3 .005", ".3 .1")
    C, lgp = boxes(tmp_path, small + can + obj, "(on goal obj)")  # without room for both
    assert lgp.solve(verbose=0)
    assert [action[1] for action in lgp.getSolvedPlan()] == ["can", "can", "obj", "obj"]
    C, lgp = boxes(tmp_path, large + can + obj, "(on goal obj)")
    assert lgp.solve(verbose=0)
    plan, komo = lgp.getSolvedPlan(), lgp.getSolvedKOMO()
    assert [action[1] for action in plan] == ["obj", "obj"]
    C.setFrameState(komo.getFrameState(1)[: C.getFrameDimension()])
    assert C.eval(ry.FS.negDistance, ["obj", "can"])[0][0] < 0  # beside each other


def test_a_wall_in_the_way_of_an_object_is_told(tmp_path):
    wall = "wall (base) { Q: [.4 .3 .2], shape: ssBox, size: [.3 .3 .4 .01], contact: 1 }\n"
    obj = box("obj", "table", "-.3 -.3 .1", ".08 .08 .1", "is_object")
    _, lgp = boxes(tmp_path, pad("goal", ".4 .3 .005", ".1 .1") + wall + obj, "(on goal obj)")
    assert not lgp.solve(verbose=0, maxSolves=60)
    assert "overlap by" in lgp.message and "wall" in lgp.message and "obj" in lgp.message


def test_mistakes_in_files_are_told_with_their_place(tmp_path):
    C = ry.Config()
    C.addFile(str(DATA / "lgp" / "unblock.g"))
    fol = (DATA / "lgp" / "kitchen.fol").read_text()
    (tmp_path / "a.fol").write_text(fol)

    def problem(text):
        (tmp_path / "a.lgp").write_text(text)
        return ry.default_LGP_TAMP_Abstraction(C, str(tmp_path / "a.lgp"))

    with pytest.raises(ry.FileError, match="nowhere.lgp"):
        ry.default_LGP_TAMP_Abstraction(C, "nowhere.lgp")
    with pytest.raises(ry.ParseError, match="missing `terminal:`"):
        problem("fol: <a.fol>")
    with pytest.raises(ry.FrameNotFound, match="redd.*red"):
        problem('fol: <a.fol>\nterminal: "(on padA red)"\ncoll: [redd blue]')
    with pytest.raises(ry.ParseError, match="unknown symbol 'padC' in the goal.*similar names: padA"):
        problem('fol: <a.fol>\nterminal: "(on padC red)"')
    with pytest.raises(ry.ParseError, match=r"nothing can make \(on hand padA\)"):
        problem('fol: <a.fol>\nterminal: "(on hand padA)"')
    with pytest.raises(ry.ArgumentError, match="no plan was found yet"):
        ry.LGP_Tool(C, problem('fol: <a.fol>\nterminal: "(on padA red)"')).getSolvedPlan()


FOL_OF_EARLIER_YEARS = """QUIT
WAIT
ANY
Terminate
FOL_World{
  hasWait=false
  gamma = 1.
  stepCost = 1.
}
## predicates, some of which no rule needs
is_gripper
is_object
is_place
is_box
on
busy
movable
INFEASIBLE_pick
stableOn
START_STATE {}
REWARD {
}
DecisionRule pick {
  Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (on From Obj) (busy Hand)! (INFEASIBLE_pick Hand Obj)! }
  { (on From Obj)! (stableOn From Obj)!  #deletes
    (on Hand Obj) (busy Hand) (movable Obj)  #logic
    }
}
DecisionRule place {
  Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) (busy Obj)! }
  { (busy Hand)! (on Hand Obj)! (movable Obj)!  (on To Obj) (stableOn To Obj) }
}
Rule chain {
  Obj1, Obj2,
  { (is_object Obj1) (is_object Obj2) (on Obj1 Obj2) (movable Obj1) }
  { (movable Obj2) }
}
"""


def test_the_first_notebook_on_lgp_runs_as_a_student_runs_it(tmp_path):
    """With a translator and a provider, and actions that are called pick and place; cell by cell."""
    (tmp_path / "a.fol").write_text(FOL_OF_EARLIER_YEARS)
    (tmp_path / "a.lgp").write_text('fol: <a.fol>\nterminal: "(on padA red)"\ngenericCollisions: true\n')
    C = robotic.Config()
    C.addFile(str(DATA / "lgp" / "unblock.g"))
    trans = robotic.default_Logic2KOMO_Translator()
    tamp = robotic.default_TAMP_Provider(C, str(tmp_path / "a.lgp"))
    lgp = robotic.LGP_Tool(C, tamp, trans)
    plans = []
    for _ in range(2):
        assert lgp.solve(0)
        plan = lgp.getSolvedPlan()
        plans.append(plan)
        lgp.view_solved(pause=False)
        assert {action[0] for action in plan} == {"pick", "place"}
        for k in range(len(plan)):
            piece = lgp.get_piecewiseMotionProblem(k)
            robotic.NLP_Solver(piece.nlp(), verbose=0).solve()
            piece.set_viewer(C.get_viewer())
            piece.view_play(False, f"piece {plan[k]}")
        path = lgp.get_fullMotionProblem()
        robotic.NLP_Solver(path.nlp(), verbose=0).solve()
        path.set_viewer(C.get_viewer())
        path.view_play(False, f"all of {plan}")
    assert plans[0] != plans[1]
    lgp.view_close()
