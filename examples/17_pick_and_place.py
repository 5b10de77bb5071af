"""Pick and place by waypoints.

Waypoints for picking and placing a box, then the motions between them.
"""

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
box = C.addFrame("box", "table").setRelativePosition([-0.25, 0.3, 0.11]).setJoint(ry.JT.rigid)
box.setShape(ry.ST.ssBox, [0.06, 0.05, 0.12, 0.005]).setColor([1, 0.5, 0]).setContact(1)
goal = C.addFrame("goal", "table").setRelativePosition([0.3, 0.3, 0.055])
goal.setShape(ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004]).setColor([0.3, 0.6, 0.3])

m = ry.KOMO_ManipulationHelper("pick and place")
m.setup_pick_and_place_waypoints(C, "l_gripper", "box")
m.grasp_box(1.0, "l_gripper", "box", "l_palm", "x")
m.place_box(2.0, "box", "goal", "l_palm", "z")
m.solve()

for phase in (0, 1):
    motion = m.sub_motion(phase)
    motion.solve()
    if motion.feasible:
        motion.play(C)
    if phase == 0:
        C.attach("l_gripper", "box")
