"""An action of your own.

A custom action with two variants: an object in the hand is shown, high or low.
"""

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
cup = C.addFrame("cup", "table").setRelativePosition([-0.3, 0.25, 0.1]).setJoint(ry.JT.rigid)
cup.setShape(ry.ST.ssBox, [0.05, 0.05, 0.1, 0.005]).setColor([1, 0.5, 0]).setContact(1)

domain = ry.defaultDomain()
domain.addAction("show", ["Obj", "Hand"], "(is_gripper Hand) (is_object Obj) (on Hand Obj)", "(shown Obj)")


def show(w: ry.TaskWaypoints, time: float, action: list[str], variant: str) -> None:
    height = {"high": 1.2, "low": 0.9}[variant]
    w.komo.addObjective([time], ry.FS.position, [action[1]], ry.OT.eq, [[0, 0, 10.0]], [0, 0, height])


rules = {"show": ry.TaskRule(show, lambda C, action: ["high", "low"])}
print(ry.planTask(C, "(shown cup)", domain=domain, rules=rules))
