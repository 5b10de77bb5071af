"""Plans that only unseen space prevents, and the views that answer their question."""

import copy
import pickle

import numpy as np
import pytest

import kinegraph as ry

REGION = [[-0.5, 0.15, 0.66], [0.5, 0.8, 1.1]]
NOT_SEEN = (ry.CellState.unseen, ry.CellState.hidden)


def scene_with_carton(x, y):
    """A Panda with a camera at its wrist, a free space above the table, and a carton that only the true scene has."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.getFrame("cameraWrist").setAttributes({"width": 320, "height": 240})
    work = C.addFrame("work").setShape(ry.ST.box, [1, 0.75, 0.25]).setPosition([0, 0.45, 1.1])
    work.setColor([1, 1, 1, 0.1]).setAttributes({"simulate": False})
    truth = copy.copy(C)
    truth.addFrame("carton").setShape(ry.ST.box, [0.16, 0.06, 0.25]).setPosition([x, y, 0.775]).setContact(1)
    return C, truth


def see(C, truth, m, unseen):
    truth.setJointState(C.getJointState())
    camera = ry.CameraView(truth)
    camera.setCamera("cameraWrist")
    m.update(C, ry.DepthView(camera.computeImageAndDepth()[1], camera.getFxycxy(), "cameraWrist"))
    m.attach(C, unseen=unseen)


def first_look(x, y, unseen):
    C, truth = scene_with_carton(x, y)
    m = ry.OccupancyMap(C, REGION, 0.02, free=["work"])
    C.setJointState(ry.solveIk(C, {"cameraWrist": {"position": [0, 0.1, 1.15], "gaze": [0, 0.45, 0.75]}}).q)
    see(C, truth, m, unseen)
    return C, truth, m


def goal_behind_the_carton(truth, x, y):
    """The hand behind the carton and 2 cm away from it: cells reach beyond its faces."""
    wide = copy.copy(truth)
    wide.getFrame("carton").setShape(ry.ST.box, [0.2, 0.1, 0.27]).setPosition([x, y, 0.786])
    goal = ry.solveIk(wide, {"l_gripper": {"position": [x, y + 0.16, 0.78], "z": [0, 0, 1]}})
    assert goal.feasible, goal.message
    return goal.q


@pytest.mark.parametrize("x, y, unseen", [(0.0, 0.34, "shadows"), (-0.08, 0.34, "shadows"), (0.06, 0.34, "shadows")])
def test_looks_and_plans_lead_behind_a_carton(x, y, unseen):
    C, truth, m = first_look(x, y, unseen)
    goal = goal_behind_the_carton(truth, x, y)
    plan = ry.planMotion(C, goal)
    assert not plan.feasible and plan.blockedByUnseen
    looks = 0
    while not plan.feasible and looks < 6:
        cells = plan.blockedByUnseen.cells
        view = ry.nextView(C, m, "cameraWrist", plan)
        assert view.feasible, view.message
        assert 0 < view.visible <= view.cells == len(cells)
        path = np.array([view.plan.eval(t)[0] for t in np.linspace(0, view.plan.duration, 300)])
        assert truth.isValid(path).all() and np.allclose(path[-1], view.q)
        C.setJointState(view.q)
        assert np.allclose(C.getFrame("cameraWrist").getPose()[:3], view.pose[:3], atol=1e-9)
        see(C, truth, m, unseen)
        decided = sum(state not in NOT_SEEN for state in m.state(cells))
        if looks == 0:  # later ones are about cells at surfaces, which may stay open
            assert decided >= 0.5 * view.visible
        looks += 1
        plan = ry.planMotion(C, goal)
    assert plan.feasible, plan.message
    path = np.array([plan.eval(t)[0] for t in np.linspace(0, plan.duration, 500)])
    assert truth.isValid(path).all()
    assert plan.blockedByUnseen is None


def test_the_place_is_the_first_that_the_motion_enters():
    C, truth, m = first_look(0.0, 0.34, "shadows")
    plan = ry.planMotion(C, goal_behind_the_carton(truth, 0.0, 0.34))
    place = plan.blockedByUnseen
    assert "without unseen space there is a motion" in plan.message and place.frame in plan.message
    assert m.state(place.position) in NOT_SEEN and np.allclose(place.position, place.cells[0])
    assert all(state in NOT_SEEN for state in m.state(place.cells))
    assert 0 < place.depth < 0.5 and not C.isValid(place.q)
    again = pickle.loads(pickle.dumps(plan)).blockedByUnseen
    assert np.allclose(again.cells, place.cells) and again.frame == place.frame and again.depth == place.depth
    free = copy.copy(C)
    m.attach(free, unseen="free")
    assert free.isValid(place.q)


def test_what_occupied_cells_or_shapes_prevent_is_not_blocked_by_unseen_ones():
    C, truth, _ = first_look(0.0, 0.34, "shadows")
    goal = ry.solveIk(C, {"l_gripper": {"position": [0, 0.34, 0.8], "z": [0, 0, 1]}}, collisions=False).q
    assert ry.planMotion(C, goal).blockedByUnseen is None  # in the carton
    C.addFrame("lid").setShape(ry.ST.box, [1.2, 0.6, 0.02]).setPosition([0, 0.6, 1.0]).setContact(1)
    assert ry.planMotion(C, goal_behind_the_carton(truth, 0.0, 0.34), max_evaluations=3000).blockedByUnseen is None


def test_next_view_says_what_is_missing():
    C, truth, m = first_look(0.0, 0.34, "shadows")
    plan = ry.planMotion(C, goal_behind_the_carton(truth, 0.0, 0.34))
    with pytest.raises(ry.ArgumentError, match="no joint moves camera 'cameraTop'"):
        ry.nextView(C, m, "cameraTop", plan)
    with pytest.raises(ry.FrameNotFound, match="cameraWrist"):
        ry.nextView(C, m, "cameraWrst", plan)
    with pytest.raises(ry.ArgumentError, match="nearest"):
        ry.nextView(C, m, "cameraWrist", plan, nearest=0.5, farthest=0.2)
    with pytest.raises(ry.ArgumentError, match="not blocked by unseen"):
        ry.nextView(C, m, "cameraWrist", ry.planMotion(C, C.getJointState()))
    far = ry.nextView(C, m, "cameraWrist", plan, nearest=3.0, farthest=4.0)
    assert not far.feasible and far.message and len(far.q) == 0
