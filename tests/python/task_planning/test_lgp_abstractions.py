"""Abstractions of one's own for LGP_Tool, and mistakes in files."""

import logging
import signal

import numpy as np
import pytest

import kinegraph as ry
from interrupts import interrupt_after
from lgp_tools import DATA, objectives, tool


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
