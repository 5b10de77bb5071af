"""Task plans and differential inverse kinematics keep away from the cells of maps, held objects included."""

import copy

import numpy as np
import pytest

import kinegraph as ry

CELL = 0.01
WALL_SIZE, WALL_AT = [0.1, 0.3, 0.4], [0.0, 0.4, 0.85]


def table_with_cube():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    tray = C.addFrame("tray", "table").setShape(ry.ST.ssBox, [0.2, 0.2, 0.02, 0.005])
    tray.setRelativePosition([0.3, 0.3, 0.06]).setContact(1)
    cube = C.addFrame("cube", "table").setRelativePosition([-0.3, 0.3, 0.075]).setJoint(ry.JT.rigid)
    cube.setShape(ry.ST.ssBox, [0.05, 0.05, 0.05, 0.004]).setContact(1).setMass(0.1)
    return C


def add_wall_of_cells(C, unseen_share):
    """A wall between cube and tray, and free cells around it."""
    rng = np.random.default_rng(3)
    inner = np.round(np.array(WALL_SIZE) / CELL).astype(int)
    cells = np.zeros(inner + 20)
    cells[10:-10, 10:-10, 10:-10] = np.where(rng.random(inner) < unseen_share, 2, 1)
    C.addFrame("map").setCells(cells, CELL * np.array(cells.shape)).setPosition(WALL_AT).setContact(1)


def add_true_wall(C):
    C.addFrame("wall").setShape(ry.ST.box, WALL_SIZE).setPosition(WALL_AT).setContact(1)


def clearance_from_wall(C):
    return min([d for a, b, d in C.getCollisions(0.1) if "wall" in (a, b) and "map" not in (a, b)], default=0.1)


@pytest.mark.parametrize("unseen_share", [0.0, 0.5])
def test_a_task_is_planned_around_occupied_and_unseen_cells(unseen_share):
    C = table_with_cube()
    straight = ry.planTask(C, "(on tray cube)")
    add_wall_of_cells(C, unseen_share)
    plan = ry.planTask(C, "(on tray cube)")
    assert straight.feasible and plan.feasible, plan.message
    least = []
    for p in (straight, plan):
        least.append(0.1)
        for scene, rows in zip(p.scenes, p.segments):
            S = copy.copy(scene)
            add_true_wall(S)
            for t in np.linspace(p.times[rows.start], p.times[rows.stop - 1], 200):
                S.setJointState(p.eval(t)[0])
                least[-1] = min(least[-1], clearance_from_wall(S))
    assert least[0] < -0.02  # the wall is in the way
    assert least[1] > -1e-4


def test_differential_ik_stops_before_cells():
    C = table_with_cube()
    C.setJointState(ry.solveIk(C, {"l_gripper": [-0.25, 0.4, 0.85]}).q)
    C.addFrame("goal").setPosition([0.25, 0.4, 0.85])
    start = C.getJointState()
    reached = []
    for walled in (False, True):
        C.setJointState(start)
        if walled:
            add_wall_of_cells(C, 0.3)
        ik = ry.DiffIk(C, velocity=1.0)
        ik.addTask(ry.FS.positionDiff, ["l_gripper", "goal"])
        T = copy.copy(C)
        add_true_wall(T)
        least = 0.1
        for _ in range(400):
            ik.step(0.01)
            T.setJointState(C.getJointState())
            least = min(least, clearance_from_wall(T))
        reached.append(np.linalg.norm(C.getFrame("l_gripper").getPosition() - [0.25, 0.4, 0.85]))
        assert least > -1e-4 if walled else least < -0.02
    assert reached[0] < 0.01 and reached[1] > 0.2
