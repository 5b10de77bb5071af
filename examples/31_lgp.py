"""Logic-geometric programs.

A search in logic proposes plans, and waypoints decide whether an arm can execute them.
"""

from pathlib import Path

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
for tray, at, color in (
    ("trayG", [0.4, 0.3, 0.055], [0, 0.6, 0]),
    ("trayB", [-0.3, 0.5, 0.055], [0, 0, 0.6]),
    ("stand", [-0.2, 0.25, 0.055], [0.6, 0.6, 0.6]),
):
    frame = C.addFrame(tray, "table", "logical: { is_place }").setRelativePosition(at).setColor(color)
    frame.setShape(ry.ST.ssBox, [0.07, 0.07, 0.01, 0.004])
for obj, place, color in (("objG", "stand", [0, 0.7, 0]), ("objB", "trayG", [0, 0, 0.7])):  # target place of objG
    frame = C.addFrame(obj, place, "logical: { is_object }").setRelativePosition([0, 0, 0.055]).setColor(color)
    frame.setJoint(ry.JT.rigid).setShape(ry.ST.ssBox, [0.06, 0.06, 0.1, 0.005]).setContact(1)


class Grasps(ry.default_LGP_TAMP_Abstraction):
    """A custom action, and waypoints without collisions."""

    def setup_sequence(self, C: ry.Config, K: int) -> ry.KOMO:
        komo = super().setup_sequence(C, K)
        komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1e0])
        komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq, [1e0])
        return komo

    def add_action_constraints(self, komo: ry.KOMO, time: float, prev_action: list[str], action: list[str]) -> None:
        if action[0] == "grasp":
            self.grasp(komo, time, obj=action[1], hand=action[3])
        else:
            super().add_action_constraints(komo, time, prev_action, action)

    def grasp(self, komo: ry.KOMO, time: float, obj: str, hand: str) -> None:
        m = ry.KOMO_ManipulationHelper()
        m.komo = komo
        held = f"held_{obj}_{round(time)}"
        m.add_stable_frame(ry.JT.free, hand, held)
        self.switch(m, time, held, obj)  # the object moves with the hand from then on

        m.grasp_box(time, hand, obj, "l_palm", "y")


lgp = ry.LGP_Tool(C, Grasps(C, str(Path(__file__).parent / "31_lgp.lgp")))
if not lgp.solve():
    raise SystemExit(lgp.message)
lgp.view_solved(pause=False)
lgp.solvePiecewiseMotions()
result = lgp.solveFullMotion()
end = lgp.getSolvedKOMO().getConfiguration(len(lgp.getSolvedPlan()) - 1)
for obj, tray in (("objG", "trayG"), ("objB", "trayB")):
    off = end.getFrame(obj).getPosition() - end.getFrame(tray).getPosition()
    print(f"{obj} stands {off[2]:.3f} m above {tray}")
