"""Inverse kinematics, motion optimization, planning, timing and tool paths."""

import numpy as np

import kinegraph as ry

from .scenes import PANDA, TWO_ARMS, Loop

VIEW = dict.fromkeys(
    [
        "gripper_at_a_position",
        "gripper_from_above",
        "all_solutions",
        "what_can_be_reached",
        "gaze",
        "around_a_column",
        "over_a_wall",
        "level_glass",
        "the_clearest_path",
        "tool_line",
        "tool_over_a_wavy_surface",
        "komo_to_a_target",
        "komo_with_a_via_point",
        "spline_motion",
        "follow_a_circle",
        "among_what_moves",
        "point_to_point",
    ],
    PANDA,
)
VIEW["both_arms"] = TWO_ARMS
VIEW |= dict.fromkeys(["raster_between_clamps", "write_a_word", "part_in_the_hand"], ([0.8, 1.3, 1.4], [0, 0.25, 0.85]))
VIEW["seam_on_a_part"] = ([1.9, 1.3, 1.1], [0.45, 0, 0.3])
VIEW["all_solutions"] = ([1.5, 1.2, 0.9], [0.2, 0, 0.4])


def panda() -> ry.Config:
    """A Panda at a table."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def gripper_at_a_position() -> ry.Config:
    """Inverse kinematics: the gripper at a position."""
    C = panda()
    ball = C.addFrame("ball").setShape(ry.ST.sphere, [0.04]).setPosition([0.3, 0.4, 1.1]).setColor([1, 0.5, 0])
    ry.solveIk(C, {"l_gripper": ball.getPosition()}, apply=True)
    return C


def gripper_from_above() -> ry.Config:
    """Inverse kinematics: position and direction. The z axis of a gripper points back into the hand."""
    C = panda()
    box = C.addFrame("box").setShape(ry.ST.ssBox, [0.05, 0.05, 0.1, 0.01]).setPosition([-0.2, 0.3, 0.7])
    box.setColor([1, 0.5, 0])
    ry.solveIk(C, {"l_gripper": {"position": "box", "z": [0, 0, 1]}}, apply=True, collisions=False)
    return C


def all_solutions() -> ry.Config:
    """All configurations of an arm with six joints that reach one pose."""
    C = ry.Config()
    C.addFile(ry.raiPath("ur5e/ur5e.g"))
    found = ry.solveIk(C, {"tool0": [0.35, 0.2, 0.5, 0, 1, 0, 0]}, all=True, collisions=False)
    scene = ry.Config()
    for i, result in enumerate(found):
        C.setJointState(result.q)
        scene.addConfigurationCopy(C, f"{i}_")
    for frame in scene.getFrames():
        if frame.getShapeType() != ry.ST.none:
            frame.setColor([0.3 + 0.08 * int(frame.name[0]), 0.5, 0.9 - 0.09 * int(frame.name[0]), 0.5])
    return scene


def what_can_be_reached() -> ry.Config:
    """A grid of points: green ones are reached by the gripper, red ones are not."""
    C = panda()
    axes = [np.linspace(-0.8, 0.8, 9), np.linspace(-0.2, 1.0, 7), [0.8]]
    points = np.stack(np.meshgrid(*axes), -1).reshape(-1, 3)
    good = ry.solveIk(C, {"l_gripper": points}, attempts=5).feasible
    for i, point in enumerate(points):
        color = [0.1, 0.7, 0.2] if good[i] else [0.9, 0.2, 0.1]
        C.addFrame(f"p{i}").setShape(ry.ST.sphere, [0.02]).setPosition(point).setColor(color)
    return C


def both_arms() -> ry.Config:
    """Two grippers reach two balls in one problem, 2 cm from everything else."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    targets = {"l_gripper": [-0.2, 0.2, 1.0], "r_gripper": [0.25, 0.25, 1.1]}
    for name, at in targets.items():
        C.addFrame(f"{name}_at").setShape(ry.ST.sphere, [0.03]).setPosition(at).setColor([1, 0.5, 0])
    ry.solveIk(C, targets, margin=0.02, apply=True)
    return C


def gaze() -> Loop:
    """The hand keeps looking at a ball: a direction constraint in every step of a loop."""
    C = panda()
    ball = C.addFrame("ball").setShape(ry.ST.sphere, [0.04]).setColor([1, 0.5, 0])
    frames = []
    for t in np.linspace(0, 2 * np.pi, 36):
        ball.setPosition([0.5 * np.cos(t), 0.8, 1.2 + 0.25 * np.sin(t)])
        ry.solveIk(C, {"l_palm": {"position": [0, 0.3, 1.2], "gaze": "ball"}}, apply=True, collisions=False)
        frames.append(C.getFrameState())
    return C, np.array(frames), 3.0


def around_a_column() -> Loop:
    """planMotion: from one side of a column to the other."""
    C = panda()
    column = C.addFrame("column", "table").setShape(ry.ST.ssBox, [0.1, 0.1, 0.8, 0.02])
    column.setRelativePosition([0, 0.35, 0.4]).setContact(1).setColor([0.8, 0.5, 0.2])
    swing = np.array([0.6, 0, 0, 0, 0, 0, 0])
    plan = ry.planMotion(C, C.getJointState() + swing, C.getJointState() - swing, margin=0.01)
    return C, plan.sample(15)[1], plan.duration


def over_a_wall() -> Loop:
    """planMotion: over a wall, to a position of the gripper."""
    C = panda()
    wall = C.addFrame("wall", "table").setShape(ry.ST.ssBox, [0.04, 0.6, 0.35, 0.01])
    wall.setRelativePosition([0, 0.4, 0.18]).setContact(1).setColor([0.7, 0.4, 0.3])
    ry.solveIk(C, {"l_gripper": {"position": [-0.3, 0.3, 0.8], "z": [0, 0, 1]}}, apply=True)
    plan = ry.planMotion(C, {"l_gripper": {"position": [0.3, 0.3, 0.8], "z": [0, 0, 1]}}, margin=0.02)
    return C, plan.sample(15)[1], plan.duration


def level_glass() -> Loop:
    """planMotion with a constraint: the z axis of the gripper stays vertical on the whole path."""
    C = panda()
    ry.solveIk(C, {"l_gripper": {"position": [-0.3, 0.35, 0.9], "x": [0, 0, 1]}}, apply=True)
    level = ry.MotionConstraint(ry.FS.scalarProductXZ, ["l_gripper", "world"], target=[1.0])
    glass = C.addFrame("glass", "l_gripper").setShape(ry.ST.cylinder, [0.14, 0.03]).setColor([0.3, 0.7, 0.9, 0.6])
    glass.setRelativePose("d(90 0 1 0)")
    plan = ry.planMotion(C, {"l_gripper": {"position": [0.35, 0.35, 0.9], "x": [0, 0, 1]}}, constraints=[level])
    return C, plan.sample(15)[1], plan.duration


def the_clearest_path() -> Loop:
    """planMotion with optimize="clearance": as far from obstacles as possible."""
    C = panda()
    for i, x in enumerate((-0.35, 0.35)):
        post = C.addFrame(f"post{i}", "table").setShape(ry.ST.ssBox, [0.08, 0.08, 0.7, 0.02]).setContact(1)
        post.setRelativePosition([x, 0.4, 0.35]).setColor([0.6, 0.4, 0.6])
    swing = np.array([0.3, 0.2, 0, 0.3, 0, 0, 0])
    plan = ry.planMotion(C, C.getJointState() + swing, C.getJointState() - swing, optimize="clearance")
    return C, plan.sample(15)[1], plan.duration


def among_what_moves() -> Loop:
    """planMotion with an obstacle that moves: the arm waits until it has passed."""
    C = panda()
    C.addFrame("load").setShape(ry.ST.ssBox, [0.3, 0.3, 0.5, 0.02]).setContact(1).setColor([0.8, 0.5, 0.2])
    poses = np.array([[-0.6, 0.35, 1.1, 1, 0, 0, 0], [0.6, 0.35, 1.1, 1, 0, 0, 0], [0.6, 1.5, 1.1, 1, 0, 0, 0]])
    C.getFrame("load").setPose(poses[0])
    turn = np.array([0.6, 0, 0, 0, 0, 0, 0])
    moving = {"load": (np.array([0.0, 2.0, 4.0]), poses)}
    start, goal = C.getJointState() - turn, C.getJointState() + turn
    plan = ry.planMotion(C, goal, start, margin=0.01, obstacle_trajectories=moving)
    frames = []
    for t in np.arange(0, plan.duration, 1 / 12):
        C.setJointState(plan.eval(t)[0])
        C.getFrame("load").setPose(plan.obstaclesAt(t)["load"])
        frames.append(C.getFrameState())
    return C, np.array(frames), plan.duration


def point_to_point() -> Loop:
    """retime: the fastest motion through four configurations within limits of speed, acceleration and jerk."""
    C = panda()
    q = C.getJointState()
    path = q + np.array([[0] * 7, [0.6, 0.2, 0, 0, 0, 0, 0], [0, -0.3, 0.3, 0.4, 0, 0, 0], [-0.6, 0, 0, 0, 0, 0.5, 0]])
    timed = ry.retime(path, 2.0, 6.0, 60.0)
    return C, timed.sample(15)[1], timed.duration


def tool_line() -> Loop:
    """planToolPath: a pen along lines with rounded corners, at a constant speed."""
    C = panda()
    C.addFrame("pen", "l_gripper").setShape(ry.ST.capsule, [0.06, 0.008]).setRelativePosition([0, 0, -0.03])
    C.addFrame("tip", "l_gripper").setRelativePosition([0, 0, -0.08])
    at = C.getFrame("tip").getPosition()
    corners = [at + [0.15, 0, 0], at + [0.15, 0.2, 0], at + [-0.1, 0.2, 0], at]
    path = ry.ToolPath("tip")
    for corner in corners:
        path = path.line(corner, blend=0.02) if corner is not corners[-1] else path.line(corner)
    C.addFrame("drawn").setLines(np.array([at, *np.repeat(corners, 2, axis=0)][:-1])).setColor([0.9, 0.2, 0.1])
    plan = ry.planToolPath(C, path, speed=0.2)
    return C, plan.sample(12)[1], plan.duration


def tool_over_a_wavy_surface() -> Loop:
    """planToolPath: a seam over a wavy surface, the tool free to rotate about its axis and to tilt by 15 degrees."""
    C = panda()
    C.addFrame("tip", "l_gripper").setShape(ry.ST.marker, [0.1]).setRelativePosition([0, 0, -0.08])
    s = np.linspace(-0.15, 0.15, 301)
    points = np.stack([s, 0.3 + 0 * s, 0.85 + 0.02 * np.cos(20 * s)], 1)
    normals = np.stack([0.4 * np.sin(20 * s), 0 * s, 1 + 0 * s], 1)
    C.addFrame("seam").setLines(np.repeat(points, 2, axis=0)[1:-1]).setColor([0.9, 0.2, 0.1])
    path = ry.ToolPath.along(points, normals, frame="tip").tilt(np.radians(15))
    plan = ry.planToolPath(C, path, speed=0.1, approach=0.03, retract=0.03)
    return C, plan.sample(12)[1], plan.duration


def seam_on_a_part() -> Loop:
    """planToolPath: a torch along a wave on a part, with approach and retract, leaning by at most 15 degrees."""
    C = ry.Config()
    C.addFile(ry.raiPath("ur10e/ur10e.g"))
    C.addFrame("torch", "tool0").setShape(ry.ST.capsule, [0.14, 0.012]).setRelativePosition([0, 0, 0.09])
    C.addFrame("tip", "tool0").setRelativePosition([0, 0, 0.18])
    C.addFrame("part").setShape(ry.ST.ssBox, [0.5, 0.3, 0.1, 0.005]).setPosition([0.75, 0, 0.2]).setContact(1)
    x = np.linspace(-0.2, 0.2, 401)
    points = np.stack([x, 0.06 * np.sin(12 * x), 0 * x + 0.052], axis=1)
    C.addFrame("seam", "part").setLines(np.repeat(points, 2, axis=0)[1:-1]).setColor([0.9, 0.2, 0.1])
    into = np.tile([0.0, 0.0, -1.0], (401, 1))
    seam = ry.ToolPath.along(points, into, frame="tip", relativeTo="part").tilt(np.radians(15))
    plan = ry.planToolPath(C, seam, touching=["part"], speed=0.1, approach=0.05, retract=0.05)
    return C, plan.sample(12)[1], plan.duration


def raster_between_clamps() -> Loop:
    """planToolPath: lines along a cylinder between two clamps; the pen leans within a cone of 20 degrees."""
    C = panda()
    C.addFrame("pen", "l_gripper").setShape(ry.ST.capsule, [0.06, 0.008]).setRelativePosition([0, 0, -0.032])
    C.addFrame("tip", "l_gripper").setRelativePosition([0, 0, -0.08])
    drum = C.addFrame("drum", "table").setShape(ry.ST.cylinder, [0.3, 0.11]).setContact(1)
    drum.setRelativePose("t(0 .45 .22) d(90 0 1 0)").setColor([0.8, 0.8, 0.75])
    for k, x in enumerate((-0.05, 0.07)):
        clamp = C.addFrame(f"clamp {k}", "table").setShape(ry.ST.ssBox, [0.015, 0.06, 0.05, 0.002]).setContact(1)
        clamp.setRelativePosition([x, 0.345, 0.33]).setColor([0.2, 0.4, 0.7])
    lines, turn = [], np.linspace(0, np.pi, 30)[1:-1]
    for k, angle in enumerate(np.linspace(-0.5, 0.3, 7)):
        x = np.linspace(-0.1, 0.1, 101) * (-1) ** k
        lines.append(np.stack([x, np.full(101, angle)], axis=1))
        bend = [x[-1] + np.sign(x[-1]) * 0.008 * np.sin(turn), angle + (1 - np.cos(turn)) / 15]
        lines += [np.stack(bend, axis=1)] if k < 6 else []
    x, angle = np.vstack(lines).T
    normals = np.stack([0 * x, np.sin(angle), np.cos(angle)], axis=1)
    points = drum.getPosition() + 0.12 * normals + x[:, None] * [1, 0, 0]
    C.addFrame("raster").setLines(np.repeat(points, 2, axis=0)[1:-1]).setColor([0.9, 0.2, 0.1])
    path = ry.ToolPath.along(points, normals, frame="tip").tilt(np.radians(20))
    plan = ry.planToolPath(C, path, speed=0.2, margin=0.002, approach=0.03, retract=0.03)
    return C, plan.sample(12)[1], plan.duration


def write_a_word() -> Loop:
    """planToolPath: strokes on paper, each with approach and retract, connected by transfers."""
    C = panda()
    C.addFrame("pen", "l_gripper").setShape(ry.ST.capsule, [0.06, 0.008]).setRelativePosition([0, 0, -0.032])
    C.addFrame("tip", "l_gripper").setRelativePosition([0, 0, -0.08])
    C.addFrame("paper", "table").setShape(ry.ST.box, [0.4, 0.2, 0.001]).setRelativePosition([0, 0.35, 0.051])
    strokes = [
        [(-0.12, 0.08), (-0.12, 0.0)],
        [(-0.12, 0.05), (-0.09, 0.08), (-0.06, 0.08)],
        [(0.0, 0.08), (0.04, 0.0)],
        [(0.08, 0.08), (0.04, 0.0), (0.02, -0.04)],
    ]
    word = []
    for k, stroke in enumerate(strokes):
        on_paper = [[*point, 0.002] for point in stroke]
        C.addFrame(f"stroke {k}", "paper").setLines(np.repeat(on_paper, 2, axis=0)[1:-1]).setColor([0.9, 0.2, 0.1])
        path = ry.ToolPath("tip", relativeTo="paper").free().start([*stroke[0], 0.03]).line(on_paper[0])
        for point in on_paper[1:]:
            path.line(point, blend=0.01 if point is not on_paper[1] else 0)
        word.append(path.line([*stroke[-1], 0.03]))
    plan = ry.planToolPath(C, word, speed=0.2, transfer_from=C.getJointState())
    return C, plan.sample(12)[1], plan.duration


def part_in_the_hand() -> Loop:
    """planToolPath: a plate in the gripper along a fixed nozzle, whose path is relative to the plate."""
    C = panda()
    plate = C.addFrame("plate", "l_gripper").setShape(ry.ST.ssBox, [0.16, 0.1, 0.01, 0.002])
    plate.setRelativePosition([0, 0, -0.05]).setContact(-2).setColor([0.8, 0.8, 0.75])
    C.addFrame("nozzle", "table").setShape(ry.ST.capsule, [0.1, 0.01]).setRelativePosition([0.1, 0.35, 0.1])
    C.addFrame("jet", "nozzle").setRelativePosition([0, 0, 0.08])
    corners = np.array([[-0.06, -0.03, -0.01], [0.06, -0.03, -0.01], [0.06, 0.03, -0.01], [-0.06, 0.03, -0.01]])
    around = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1).reshape(-1, 3)
    C.addFrame("bead", "plate").setLines(around).setColor([0.9, 0.2, 0.1])
    bead = ry.ToolPath("jet", relativeTo="plate").start(np.r_[corners[0], 1, 0, 0, 0]).free()
    for corner in np.roll(corners, -1, axis=0):
        bead.line(corner, blend=0.01)
    plan = ry.planToolPath(C, bead, speed=0.1)
    return C, plan.sample(12)[1], plan.duration


def komo_to_a_target() -> Loop:
    """KOMO: sixteen slices with small accelerations, to a target, at rest at the end."""
    C = panda()
    C.addFrame("target").setShape(ry.ST.marker, [0.15]).setPosition([0.3, 0.4, 1.0])
    komo = ry.KOMO(C, 1, 16, 2, False)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, 1.0)
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0])
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [1.0], [], order=1)
    ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    return C, komo.getPath(), 2.0


def komo_with_a_via_point() -> Loop:
    """KOMO in two phases: through one target, to another, without collisions."""
    C = panda()
    for name, at in (("first", [-0.35, 0.35, 1.1]), ("second", [0.35, 0.35, 0.9])):
        C.addFrame(name).setShape(ry.ST.marker, [0.15]).setPosition(at)
    komo = ry.KOMO(C, 2, 16, 2, True)
    komo.addControlObjective([], 2, 1.0)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [10.0])
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "first"], ry.OT.eq, [10.0])
    komo.addObjective([2.0], ry.FS.positionDiff, ["l_gripper", "second"], ry.OT.eq, [10.0])
    komo.addObjective([2.0], ry.FS.jointState, [], ry.OT.eq, [1.0], [], order=1)
    ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    return C, komo.getPath(), 3.0


def spline_motion() -> Loop:
    """SplineMotion: the variables are ten control points of a B-spline."""
    C = panda()
    C.addFrame("target").setShape(ry.ST.marker, [0.15]).setPosition([-0.3, 0.35, 0.95])
    komo = ry.KOMO(C, 2, 30, 2, True)
    komo.addControlObjective([], 2, 0.1)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [10.0])
    komo.addObjective([2.0], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0])
    motion = ry.SplineMotion(komo, points=10)
    ry.NLP_Solver(motion.nlp(), verbose=0).solve()
    return C, motion.spline().eval(np.linspace(0, 2, 40), 0), 2.5


def follow_a_circle() -> Loop:
    """DiffIk: the gripper follows a target on a circle, in steps of 5 ms."""
    C = panda()
    target = C.addFrame("target").setShape(ry.ST.marker, [0.2]).setPose(C.getFrame("l_gripper").getPose())
    start = target.getPosition()
    ik = ry.DiffIk(C, velocity=2.0, acceleration=20.0)
    ik.addTask(ry.FS.poseDiff, ["l_gripper", "target"])
    frames = []
    for i, t in enumerate(np.arange(0, 2 * np.pi, 0.005)):
        target.setPosition(start + 0.15 * np.array([np.sin(t), 1 - np.cos(t), 0]))
        ik.step(0.005)
        if i % 30 == 0:
            frames.append(C.getFrameState())
    return C, np.array(frames), 3.0
