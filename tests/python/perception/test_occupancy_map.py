"""Free, occupied and unseen space from depth images, and motions around unseen space."""

import copy
import pickle

import numpy as np
import pytest

import kinegraph as ry

REGION = [[-0.5, -0.1, 0.66], [0.5, 0.8, 1.16]]
UNSEEN, HIDDEN, FREE, OCCUPIED = (
    int(s) for s in (ry.CellState.unseen, ry.CellState.hidden, ry.CellState.free, ry.CellState.occupied)
)


def camera_pose(eye, at):
    """The pose of a camera that looks from one point at another, with the image's x axis horizontal."""
    z = np.subtract(at, eye) / np.linalg.norm(np.subtract(at, eye))
    x = np.cross(z, [0, 0, 1])
    x /= np.linalg.norm(x)
    R = np.stack([x, np.cross(z, x), z], axis=1)
    frame = ry.Config().addFrame("camera")
    frame.setRotationMatrix(R)
    return np.concatenate([eye, frame.getQuaternion()])


def scene(boxes=(), cameras=([0.0, 1.3, 1.4],)):
    """A Panda at a table, with boxes that only the true scene has."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    truth = copy.copy(C)
    for i, (size, position) in enumerate(boxes):
        truth.addFrame(f"box{i}").setShape(ry.ST.box, size).setPosition(position).setContact(1)
    for config in (C, truth):
        for i, eye in enumerate(cameras):
            frame = config.addFrame(f"cam{i}")
            frame.setPose(camera_pose(eye, [0, 0.3, 0.75]))
            frame.setAttributes({"focalLength": 0.9, "width": 640, "height": 480})
    return C, truth


def depth_image(truth, camera="cam0", noise=0.0, seed=0):
    """The depth of a camera in m, and fx fy cx cy."""
    view = ry.CameraView(truth)
    view.setCamera(camera)
    depth = view.computeImageAndDepth()[1].astype(float)
    if noise:
        rng = np.random.default_rng(seed)
        depth = np.where(depth > 0, depth + rng.normal(size=depth.shape) * noise * depth**2, 0)
        depth[rng.random(depth.shape) < 0.02] = 0
    return depth, view.getFxycxy()


def look(truth, camera="cam0", noise=0.0, seed=0):
    return ry.DepthView(*depth_image(truth, camera, noise, seed), camera)


def middles(m):
    return m.lower + m.cell * (np.stack(np.indices(m.states.shape), -1) + 0.5)


def test_cells_are_occupied_at_things_free_before_and_hidden_behind_them():
    C, truth = scene([([0.2, 0.1, 0.3], [0.0, 0.4, 0.81])])
    m = ry.OccupancyMap(C, REGION, 0.02)
    m.update(C, look(truth, noise=0.0027))
    x, y, z = np.moveaxis(middles(m), -1, 0)
    face = (abs(x) < 0.08) & (abs(y - 0.45) < 0.03) & (abs(z - 0.8) < 0.12)
    assert (m.states[face] == OCCUPIED).sum() > 60  # of about 100 in the face
    assert m.state([0.0, 0.6, 0.85]) == ry.CellState.free
    assert m.state([0.0, 0.3, 0.8]) == ry.CellState.hidden
    assert m.state([0.0, 0.3, 0.68]) == ry.CellState.hidden
    assert m.state([3.0, 0.0, 0.0]) == ry.CellState.free
    states, points = m.states, middles(m)
    inside = (np.abs(points - [0, 0.4, 0.81]) < np.array([0.1, 0.05, 0.15]) - 1e-6).all(-1)
    assert not (states[inside] == FREE).any()
    far = (np.abs(points - [0, 0.4, 0.81]) > np.array([0.1, 0.05, 0.15]) + 0.04).any(-1)
    assert not (states[far] == OCCUPIED).any()
    assert pickle.loads(pickle.dumps(m)).states.tolist() == states.tolist()


@pytest.mark.parametrize("seed", range(3))
def test_no_cell_with_a_part_of_a_thing_is_free(seed):
    rng = np.random.default_rng(100 + seed)
    boxes = [(rng.uniform(0.04, 0.25, 3), [*rng.uniform([-0.35, 0.2], [0.35, 0.6]), 0.0]) for _ in range(5)]
    boxes = [(s, [p[0], p[1], 0.65 + s[2] / 2 + 0.001]) for s, p in boxes]
    C, truth = scene(boxes, ([0.0, 1.3, 1.4], [0.9, 0.7, 1.3]))
    m = ry.OccupancyMap(C, REGION, 0.02)
    for camera in ("cam0", "cam1"):
        m.update(C, look(truth, camera, noise=0.0027, seed=seed))
    points, free = middles(m), m.states == FREE
    for size, position in boxes:
        # Cells that touch the known table are left to it.
        inside = (np.abs(points - position) < np.array(size) / 2).all(-1) & (points[..., 2] > 0.65 + 0.866 * m.cell)
        assert not (inside & free).any()
    assert free.mean() > 0.4


@pytest.mark.parametrize("eye", [[0.05, 0.35, 1.4], [0.2, 0.9, 1.3]])
def test_cells_seen_close_beside_a_thing_are_free(eye):
    C, truth = scene([([0.1, 0.1, 0.2], [0.0, 0.4, 0.76])], [eye])
    depth, (fx, fy, cx, cy) = depth_image(truth)
    m = ry.OccupancyMap(C, REGION, 0.02)
    m.update(C, ry.DepthView(depth, [fx, fy, cx, cy], "cam0", noise=1e-6))
    points = middles(m)
    near = (np.abs(points[..., :2] - [0, 0.4]).max(-1) < 0.1) & (abs(points[..., 2] - 0.78) < 0.08)
    # all of the cell and of 7 mm, a few pixels, around it
    around = points[near][:, None] + 0.017 * np.stack(np.meshgrid(*3 * [[-1, -0.5, 0, 0.5, 1]]), -1).reshape(-1, 3)
    camera = C.getFrame("cam0")
    x, y, z = np.moveaxis((around - camera.getPosition()) @ camera.getRotationMatrix(), -1, 0)
    seen = (depth[(fy * y / z + cy).astype(int), (fx * x / z + cx).astype(int)] > z).all(-1)
    assert seen.sum() > 100 and (m.states[near][seen] == FREE).all()


def test_cells_partly_beside_an_image_are_not_free_by_it():
    C, truth = scene()
    view = look(truth)
    m = ry.OccupancyMap(C, REGION, 0.05)
    m.update(C, view)
    eye, R = C.getFrame("cam0").getPosition(), C.getFrame("cam0").getRotationMatrix()
    fx, fy, cx, cy = view.fxycxy
    corners = middles(m)[..., None, :] + 0.025 * (np.stack(np.indices((2, 2, 2)), -1).reshape(-1, 3) * 2 - 1)
    x, y, z = np.moveaxis((corners - eye) @ R, -1, 0)
    outside = (z < 0) | (abs(fx * x / z) > cx) | (abs(fy * y / z) > cy)
    known = ry.OccupancyMap(C, REGION, 0.05).states == FREE  # the robot's own space
    assert (outside.any(-1) & ~outside.all(-1)).sum() > 20
    assert not ((m.states == FREE) & outside.any(-1) & ~known).any()


@pytest.mark.parametrize("none", [np.uint16(65535), 65.535, np.inf])
def test_the_largest_number_of_a_format_is_no_measurement(none):
    C, truth = scene([([0.2, 0.1, 0.3], [0.0, 0.4, 0.81])])
    depth, fxycxy = depth_image(truth)
    if isinstance(none, np.uint16):
        depth = np.round(1000 * depth).astype(np.uint16)
    depth[200:400, 200:440] = none
    m = ry.OccupancyMap(C, REGION, 0.02)
    m.update(C, ry.DepthView(depth, fxycxy, "cam0"))
    assert m.state([0, 0.35, 0.8]) != ry.CellState.free
    assert m.state([0.4, 0.4, 0.9]) == ry.CellState.free


def test_an_image_upside_down_is_told():
    C, truth = scene()
    depth, fxycxy = depth_image(truth)
    m = ry.OccupancyMap(C, REGION, 0.02)
    with pytest.warns(ry.KinegraphWarning, match="looks through known shapes"):
        m.update(C, ry.DepthView(depth[::-1, ::-1], fxycxy, "cam0"))


def test_what_moved_away_is_cleared():
    boxes = [([0.1, 0.1, 0.2], [0.2, 0.4, 0.76])]
    C, truth = scene(boxes)
    m = ry.OccupancyMap(C, REGION, 0.01)
    m.update(C, look(truth))
    assert (m.states == OCCUPIED).sum() > 100
    truth.getFrame("box0").setPosition([-0.3, 0.4, 0.76])
    m.update(C, look(truth))
    occupied = middles(m)[m.states == OCCUPIED]
    assert len(occupied) > 100 and (occupied[:, 0] < -0.2).all()
    truth.delFrame("box0")
    m.update(C, look(truth))
    assert not (m.states == OCCUPIED).any()


def test_the_robot_and_known_things_are_not_in_the_map():
    C, truth = scene([([0.1, 0.1, 0.2], [0.2, 0.4, 0.76])])
    C.addFrame("known").setShape(ry.ST.box, [0.1, 0.1, 0.2]).setPosition([0.2, 0.4, 0.76]).setContact(1)
    m = ry.OccupancyMap(C, REGION, 0.01)
    m.update(C, look(truth, noise=0.0027))
    assert (m.states == OCCUPIED).sum() <= 2  # single outliers of the noise
    m.attach(C)
    assert C.isValid(C.getJointState(), 0.005)  # the robot stands in space that it has to itself


def test_attached_cells_are_solid_by_the_rule_for_unseen_ones():
    C, truth = scene([([0.2, 0.1, 0.3], [0.0, 0.4, 0.81])])
    m = ry.OccupancyMap(C, REGION, 0.02)
    m.update(C, look(truth))
    ball = C.addFrame("ball").setShape(ry.ST.sphere, [0.005]).setContact(1)
    never, surface = (middles(m)[m.states == kind][0] for kind in (UNSEEN, OCCUPIED))
    hidden = [0.0, 0.3, 0.8]
    assert m.state(never) == ry.CellState.unseen and m.state(hidden) == ry.CellState.hidden
    touched = {}
    for unseen in ("blocked", "shadows", "free"):
        m.attach(C, unseen=unseen)
        assert C.getFrame("map").getShapeType() == ry.ST.cells
        touched[unseen] = []
        for place in (never, hidden, surface, [0.0, 0.6, 0.85]):
            ball.setPosition(place)
            touched[unseen].append(bool(C.eval(ry.FS.negDistance, ["ball", "map"])[0][0] > 0))
    assert touched == {
        "blocked": [True, True, True, False],
        "shadows": [False, True, True, False],
        "free": [False, False, True, False],
    }
    with pytest.raises(ry.ArgumentError, match="expected 'blocked', 'shadows' or 'free'"):
        m.attach(C, unseen="maybe")
    with pytest.raises(ry.ArgumentError, match="exists and has another shape"):
        m.attach(C, name="table")


def test_wrong_regions_and_images_are_refused_and_leave_the_map():
    C, truth = scene([([0.1, 0.1, 0.2], [0.2, 0.4, 0.76])])
    for region in ([[0, 0, 0], [1, 1, 0]], [[0, 0, np.nan], [1, 1, 1]], [0, 0, 1]):
        with pytest.raises(ry.ArgumentError):
            ry.OccupancyMap(C, region, 0.01)
    with pytest.raises(ry.ArgumentError, match="at most 50 million"):
        ry.OccupancyMap(C, REGION, 0.0005)
    with pytest.raises(ry.ArgumentError, match="cell is 0"):
        ry.OccupancyMap(C, REGION, 0.0)
    with pytest.raises(ry.FrameNotFound):
        ry.OccupancyMap(C, REGION, 0.02, free=["nowhere"])
    m = ry.OccupancyMap(C, REGION, 0.02)
    m.update(C, look(truth))
    before = m.states
    empty = ry.DepthView(np.full((480, 640), np.nan), [576, 576, 320, 240], "cam0")
    with pytest.warns(UserWarning, match="has no depth"):
        m.update(C, empty)
    away = ry.DepthView(np.ones((480, 640)), [576, 576, 320, 240], [0, 3, 1, 0, 1, 0, 0])
    with pytest.warns(UserWarning, match="shows nothing of the region"):
        m.update(C, away)
    assert (m.states == before).all()
    view = look(truth)
    C.getFrame("cam0").setPosition([0.0, 1.3, 1.35])  # 5 cm too low: the table is measured inside of itself
    with pytest.warns(UserWarning, match="looks through known shapes"):
        m.update(C, view)


def test_a_declared_free_frame_is_free_at_first():
    C, _ = scene()
    C.addFrame("work").setShape(ry.ST.box, [0.4, 0.4, 0.4]).setPosition([0, 0.4, 0.9]).setColor([1, 1, 1, 0.1])
    m = ry.OccupancyMap(C, REGION, 0.02, free=["work"])
    assert m.state([0, 0.4, 0.9]) == ry.CellState.free
    assert m.state([0.3, 0.4, 0.9]) == ry.CellState.unseen


@pytest.mark.parametrize("seed", range(4))
def test_no_hidden_part_of_a_thing_becomes_free_because_nothing_floats(seed):
    rng = np.random.default_rng(300 + seed)
    boxes = []
    for _ in range(4):
        size = rng.uniform([0.05, 0.05, 0.05], [0.12, 0.12, 0.3])
        boxes.append((size, [*rng.uniform([-0.3, 0.2], [0.3, 0.6]), 0.65 + size[2] / 2]))
    C, truth = scene(boxes, ([-0.7, 1.1, 1.45], [0.75, 1.0, 1.4]))
    m = ry.OccupancyMap(C, REGION, 0.02)
    m.update(C, [look(truth, f"cam{i}", 0.0027, seed) for i in range(2)])
    m.attach(C, unseen="shadows")
    ball = C.addFrame("ball").setShape(ry.ST.sphere, [0.001]).setContact(1)
    points, hidden = middles(m), m.states == HIDDEN
    blocked = np.zeros(hidden.shape, bool)
    for at in np.argwhere(hidden):
        ball.setPosition(points[tuple(at)])
        blocked[tuple(at)] = C.eval(ry.FS.negDistance, ["ball", "map"])[0][0] > 0
    for size, position in boxes:
        inside = (np.abs(points - position) < size / 2).all(-1) & hidden
        assert inside.any() and blocked[inside].all()
    assert (hidden & ~blocked).any()  # the intersection of shadows in the air


def wall_and_goal():
    """A wall in front of the robot that one camera sees, the swing of the arm around it, and the boxes."""
    return [([0.12, 0.12, 0.5], [0.0, 0.35, 0.9]), ([0.15, 0.15, 0.2], [0.35, 0.3, 0.75])]


def swing(C):
    q = C.getJointState() + np.array([0, 0.45, 0, -0.3, 0, 0.6, 0])
    turn = np.array([0.7, 0, 0, 0, 0, 0, 0])
    return q + turn, q - turn


def test_plans_around_what_was_measured_are_free_in_the_true_scene():
    C, truth = scene(wall_and_goal(), ([0.0, 1.3, 1.4], [0.9, 0.7, 1.3], [-0.9, 0.7, 1.3]))
    start, goal = swing(C)
    C.setJointState(start)
    truth.setJointState(start)
    m = ry.OccupancyMap(C, [[-0.6, -0.1, 0.66], [0.6, 0.9, 1.4]], 0.02)
    for camera in ("cam0", "cam1", "cam2"):
        m.update(C, look(truth, camera, noise=0.0027))
    m.attach(C, unseen="shadows")
    plan = ry.planMotion(C, goal, start)
    assert plan.feasible, plan.message
    path = np.array([plan.eval(t)[0] for t in np.linspace(0, plan.duration, 500)])
    assert truth.isValid(path).all()
    assert C.isValid(path).all()


@pytest.mark.parametrize("seed", range(4))
def test_edges_among_cells_agree_with_edges_among_boxes(seed):
    rng = np.random.default_rng(50 + seed)
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    B = copy.copy(C)
    solid = rng.random((12, 10, 8)) < 0.02
    size, lower = 0.08, np.array([-0.48, 0.1, 0.66])
    for i, at in enumerate(np.argwhere(solid)):
        B.addFrame(f"c{i}").setShape(ry.ST.box, [size] * 3).setPosition(lower + size * (at + 0.5)).setContact(1)
    extent = size * np.array(solid.shape)
    C.addFrame("cells").setCells(solid.astype(float), extent).setPosition(lower + extent / 2).setContact(1)
    Q = C.getJointState() + 0.6 * rng.normal(size=(300, 7))
    for margin in (0.0, 0.03):
        assert (C.isValid(Q, margin) == B.isValid(Q, margin)).all()
    checks = [[c.isMotionFree(a, b) for a, b in zip(Q[:100], Q[100:200])] for c in (C, B)]
    assert (checks[0] == checks[1] and 5 < sum(checks[0]) < 100) or sum(checks[0]) == sum(checks[1])


def test_komo_ik_and_differential_ik_avoid_cells():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    solid = np.zeros((10, 10, 20))
    solid[3:7, 3:7, :15] = 1
    C.addFrame("cells").setCells(solid, [0.3, 0.3, 0.6]).setPosition([0.0, 0.35, 0.95]).setContact(1)
    start, goal = swing(C)
    assert C.isValid(np.stack([start, goal])).all()
    C.setJointState(start)
    komo = ry.KOMO(C, 1, 40, 2, True)
    komo.addControlObjective([], 2)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.ineq, [1e1])
    komo.addObjective([1], ry.FS.qItself, [], ry.OT.eq, [1e1], goal)
    komo.addObjective([1], ry.FS.qItself, [], ry.OT.eq, [1e1], order=1)
    straight = C.isMotionFree(start, goal)
    ret = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    path = komo.getPath()
    assert not straight and ret.feasible
    assert C.isValid(path, -2e-3).all()
    r = ry.solveIk(C, {"l_gripper": [0.02, 0.2, 0.9]})
    assert not r.feasible or C.isValid(r.q)
