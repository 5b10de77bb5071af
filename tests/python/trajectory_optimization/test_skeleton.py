"""Skeletons: schedules of modes and constraints, solved as motion problems."""

import pickle

import numpy as np
import pytest

import kinegraph as ry


def table_scene():
    """A point-like gripper that translates, a table and a box on it."""
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("table", "world").setPosition([0, 0, 0.5]).setShape(ry.ST.ssBox, [1.5, 1.5, 0.1, 0.01])
    g = C.addFrame("g", "world").setJoint(ry.JT.trans3).setPosition([0, 0, 1.0])
    g.setShape(ry.ST.sphere, [0.03])
    C.addFrame("b", "world").setPosition([0.2, 0.1, 0.65]).setShape(ry.ST.ssBox, [0.2, 0.24, 0.2, 0.01]).setMass(1.0)
    C.addFrame("cap", "world").setPosition([-0.2, 0.1, 0.65]).setShape(ry.ST.capsule, [0.2, 0.03])
    return C


def turning_scene():
    """The same with a gripper that also rotates."""
    C = table_scene()
    C.getFrame("g").setJoint(ry.JT.free)
    C.addFrame("r_palm", "g").setRelativePosition([0, 0, 0.15]).setShape(ry.ST.sphere, [0.03])
    return C


def solve(komo):
    result = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert result.feasible, result.message
    return result


def skeleton(*entries, collisions=False):
    S = ry.Skeleton()
    S.add(list(entries))
    S.useBroadCollisions(collisions)
    return S


PICK_AND_PLACE = (
    [1, 2], ry.SY.stable, ["g", "b"],
    [1], ry.SY.touch, ["g", "b"],
    [2, -1], ry.SY.stableOn, ["table", "b"],
    [2], ry.SY.relPosY, ["b", "cap"],
)  # fmt: skip


def test_pick_and_place_as_waypoints_path_and_final_slice():
    C = table_scene()
    S = skeleton(*PICK_AND_PLACE)
    assert S.getMaxPhase() == 2
    waypoints, path, final = S.getKomo_waypoints(C), S.getKomo_path(C, 10), S.getKomo_finalSlice(C)
    assert waypoints.getT() == 2 and path.getT() == 20 and final.getT() == 2
    assert waypoints.nlp().getDimension() == 2 * 3 + 7 + 3
    assert path.getPathTau()[0] == pytest.approx(0.5)  # 5 s per phase
    for komo in (waypoints, path, final):
        solve(komo)
        box = komo.getFrame("b", 2.0).getPosition()
        assert box[2] == pytest.approx(0.65, abs=1e-4)
        assert box[1] == pytest.approx(0.1, abs=1e-4)  # as the capsule
    config, start, end = S.getTwoWaypointProblem(1, waypoints)
    assert np.allclose(start, waypoints.getPath()[0]) and np.allclose(end, waypoints.getPath()[1])
    assert config.getJointDimension() == 3
    fine = S.getKomo_path(C, 10)
    fine.initWithWaypoints(waypoints.getPath_qAll(), interpolate=True)
    solve(fine)


def test_an_object_does_not_jump_where_another_mode_takes_over():
    """Also if the first one extends to the end."""
    S = skeleton(
        [1, -1], ry.SY.stable, ["g", "b"], [1], ry.SY.touch, ["g", "b"], [2, -1], ry.SY.stableOn, ["table", "b"]
    )
    S.addEntry([3.0], ry.SY.end, [])
    komo = S.getKomo_path(table_scene(), 8)
    solve(komo)
    names = komo.getConfig().getFrameNames()
    path = komo.getPathFrames()
    relative = path[:, names.index("b"), :3] - path[:, names.index("g"), :3]
    assert np.allclose(relative[7:16], relative[7], atol=1e-3)  # held from 1 to 2, then placed
    assert np.allclose(path[16:, names.index("b")], path[16, names.index("b")], atol=1e-9)


def test_a_ball_bounces_with_nine_tenths_of_its_speed():
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("floor", "world").setShape(ry.ST.ssBox, [4, 4, 0.1, 0.01]).setPosition([0, 0, -0.05])
    fall = 9.81 * 0.04**2 * 9 * 10 / 2  # from slice 0 to slice 9, from rest
    C.addFrame("ball", "world").setPosition([-0.5, 0, 0.1 + fall]).setShape(ry.ST.sphere, [0.1]).setMass(0.5)
    komo = ry.KOMO()
    komo.setConfig(C, False)
    komo.setTiming(2, 10, 0.4, 2)
    komo.setSkeleton([[0.1, -1], ry.SY.dynamic, ["world", "ball"], [1], ry.SY.bounce, ["floor", "ball"]])
    komo.addQuaternionNorms()
    solve(komo)
    z = komo.getPathFrames()[:, komo.getConfig().getFrameNames().index("ball"), 2]
    tau = komo.getPathTau()[0]
    assert z[9] == pytest.approx(0.1, abs=1e-3)
    assert (z[10] - z[9]) == pytest.approx(0.9 * (z[8] - z[9]), abs=1e-4)
    falling = np.diff(z[:9], 2) / tau**2
    assert np.allclose(falling, -9.81, atol=1e-2) and np.allclose(np.diff(z[9:], 2) / tau**2, -9.81, atol=1e-2)
    forces = komo.getForceInteractions()
    assert len(forces) == 1 and forces[0]["slice"] == 9 and forces[0]["force"][2] > 0
    change = (z[10] - 2 * z[9] + z[8]) / tau + 9.81 * tau  # of the velocity, by the force
    assert forces[0]["force"][2] * tau / 0.5 == pytest.approx(change, rel=1e-3)


def test_a_finger_pushes_a_box_to_where_it_shall_be():
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("table", "world").setPosition([0, 0, 0.5]).setShape(ry.ST.ssBox, [2, 2, 0.1, 0.01])
    finger = C.addFrame("finger", "world").setJoint(ry.JT.trans3).setPosition([-0.4, 0.0, 0.65])
    finger.setShape(ry.ST.sphere, [0.04])
    C.addFrame("box", "world").setPosition([0.0, 0.0, 0.65]).setShape(ry.ST.ssBox, [0.2, 0.2, 0.2, 0.01]).setMass(1.0)
    C.addFrame("goal", "world").setPosition([0.3, 0.05, 0.65])
    S = skeleton(
        [1, -1], ry.SY.quasiStaticOn, ["table", "box"],
        [1, 2], ry.SY.push, ["finger", "box"],
        [2], ry.SY.positionEq, ["box", "goal"],
    )  # fmt: skip
    komo = S.getKomo_path(C, 10, 1.0, 0.0, 1e-2)
    solve(komo)
    assert np.allclose(komo.getFrame("box", 2.0).getPosition(), [0.3, 0.05, 0.65], atol=1e-3)
    forces = komo.getForceInteractions()
    assert len(forces) == 11 and all(f["onto"] == "box" and f["from"] == "finger" for f in forces)
    pushed = sum(f["force"] for f in forces)
    assert pushed[0] > 0 and abs(pushed[1]) < pushed[0]


CONDITIONS = {
    "touch": (["g", "b"], lambda C: C.eval(ry.FS.distance, ["g", "b"])[0]),
    "above": (["g", "b"], lambda C: np.maximum(C.eval(ry.FS.aboveBox, ["g", "b"])[0], 0)),
    "inside": (["g", "b"], lambda C: np.maximum(C.eval(ry.FS.insideBox, ["g", "b"])[0], 0)),
    "oppose": (["g", "cap", "b"], None),
    "poseEq": (["g", "b"], lambda C: C.eval(ry.FS.poseDiff, ["g", "b"])[0]),
    "positionEq": (["g", "b"], lambda C: C.eval(ry.FS.positionDiff, ["g", "b"])[0]),
    "relPosY": (["g", "b"], lambda C: C.eval(ry.FS.positionRel, ["g", "b"])[0][1]),
    "touchBoxNormalX": (
        ["g", "b"],
        lambda C: [
            C.eval(ry.FS.positionRel, ["g", "b"])[0][0] - 0.1,
            C.eval(ry.FS.scalarProductXZ, ["b", "g"])[0][0] - 1,
        ],
    ),
    "touchBoxNormalY": (
        ["g", "b"],
        lambda C: [
            C.eval(ry.FS.positionRel, ["g", "b"])[0][1] - 0.12,
            C.eval(ry.FS.scalarProductYZ, ["b", "g"])[0][0] - 1,
        ],
    ),
    "touchBoxNormalZ": (
        ["g", "b"],
        lambda C: [
            C.eval(ry.FS.positionRel, ["g", "b"])[0][2] - 0.1,
            C.eval(ry.FS.scalarProductZZ, ["b", "g"])[0][0] - 1,
        ],
    ),
    "topBoxGrasp": (
        ["g", "b"],
        lambda C: [*C.eval(ry.FS.positionDiff, ["g", "b"])[0], C.eval(ry.FS.scalarProductXY, ["g", "b"])[0][0]],
    ),
    "boxGraspX": (
        ["g", "b"],
        lambda C: [C.eval(ry.FS.positionRel, ["g", "b"])[0][0], C.eval(ry.FS.scalarProductXY, ["g", "b"])[0][0]],
    ),
    "boxGraspY": (
        ["g", "b"],
        lambda C: [C.eval(ry.FS.positionRel, ["g", "b"])[0][1], C.eval(ry.FS.scalarProductXZ, ["g", "b"])[0][0]],
    ),
    "boxGraspZ": (
        ["g", "b"],
        lambda C: [C.eval(ry.FS.positionRel, ["g", "b"])[0][2], C.eval(ry.FS.scalarProductXX, ["g", "b"])[0][0]],
    ),
}


@pytest.mark.parametrize("name", CONDITIONS)
def test_conditions_hold_where_they_shall(name):
    frames, error = CONDITIONS[name]
    C = turning_scene()
    komo = skeleton([1], getattr(ry.SY, name), frames).getKomo_waypoints(C)
    assert len(komo.report()) > 3
    if error is None:
        return
    solve(komo)
    C.setJointState(komo.getPath()[-1])
    assert np.allclose(error(C), 0, atol=2e-3)


def test_what_rests_lies_on_the_box():
    C = table_scene()
    for name, height in (("cap", 0.55 + 0.03), ("b", 0.55 + 0.1)):
        komo = skeleton([1], ry.SY.makeFree, [name], [1], ry.SY.restingOn, ["table", name]).getKomo_waypoints(C)
        solve(komo)
        frame = komo.getFrame(name, 1.0)
        assert frame.getPosition()[2] == pytest.approx(height, abs=1e-3)
        upright = frame.getRotationMatrix()[2, 2]
        assert upright == pytest.approx(0.0 if name == "cap" else 1.0, abs=2e-3)


def test_top_box_place_stands_on_the_target():
    C = turning_scene()
    S = skeleton(
        [1, 2],
        ry.SY.stable,
        ["g", "b"],
        [1],
        ry.SY.topBoxGrasp,
        ["g", "b"],
        [2],
        ry.SY.topBoxPlace,
        ["g", "b", "table"],
    )
    komo = S.getKomo_path(C, 10)
    solve(komo)
    assert np.allclose(komo.getFrame("b", 2.0).getPosition(), [0, 0, 0.65], atol=1e-3)


def test_free_motion_and_conditions_of_velocity():
    C = table_scene()
    for symbol, dofs in ((ry.SY.magic, 7), (ry.SY.magicTrans, 2)):
        komo = skeleton([1, 2], symbol, ["table", "b"], [2], ry.SY.positionEq, ["b", "g"]).getKomo_path(C, 4)
        assert komo.nlp().getDimension() == 8 * 3 + 5 * dofs
        solve(komo)
    C.getFrame("g").setPosition([0, 0, 0.2])
    komo = skeleton([1, 2], ry.SY.dampMotion, ["g"], [0.5], ry.SY.downUp, ["g"], [0], ry.SY.lift, ["g"], [1], ry.SY.stablePose, ["g"],
                    [1], ry.SY.stableRelPose, ["g", "b"], [1], ry.SY.alignByInt, ["g", "b"], [2], ry.SY.end, []).getKomo_path(C, 10)  # fmt: skip
    assert komo.nlp().checkJacobian(komo.nlp().getInitializationSample(), 1e-4)
    solve(komo)
    path = komo.getPath()
    assert np.allclose(path[8], path[9], atol=1e-5)  # from the slice before phase 1 on it rests
    assert path[4:6, 2].min() > 0.39  # lifted
    tau = komo.getPathTau()[0]
    assert (path[5, 2] - 2 * path[4, 2] + path[3, 2]) / tau**2 == pytest.approx(0.1, abs=1e-3)


@pytest.mark.parametrize("symbol", ["contact", "contactStick", "contactComplementary", "bounce", "push"])
def test_jacobians_of_contacts(symbol):
    C = table_scene()
    komo = skeleton([1, 2], getattr(ry.SY, symbol), ["g", "b"], [2], ry.SY.end, []).getKomo_path(C, 4)
    per_slice = 1 if symbol == "bounce" else 5
    assert komo.nlp().getDimension() == 8 * 3 + 6 * per_slice
    nlp = komo.nlp()
    assert nlp.checkJacobian(nlp.getInitializationSample() + 0.01, 1e-4)


@pytest.mark.parametrize("order", [1, 2])
def test_a_ball_is_pushed_from_behind(order):
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("finger", "world").setJoint(ry.JT.trans3).setPosition([-0.2, 0, 1]).setShape(ry.ST.sphere, [0.02])
    C.addFrame("ball", "world").setJoint(ry.JT.trans3).setPosition([0, 0, 1]).setShape(ry.ST.sphere, [0.1]).setMass(0.1)
    S = skeleton([1, 2], ry.SY.push, ["finger", "ball"])
    komo = S.getKomo_path(C, 8) if order == 2 else S.getKomo_waypoints(C)
    behind = [o for o in komo.report().values() if o.get("name") == "pushRadius"]
    assert [o["slices"] for o in behind] == [[10, 13] if order == 2 else [1, 1]]
    nlp = komo.nlp()
    assert nlp.checkJacobian(nlp.getInitializationSample() + 0.03 * np.cos(np.arange(nlp.dimension)), 1e-4)
    if order == 2:
        komo.addObjective([2], ry.FS.position, ["ball"], ry.OT.eq, [10], [0.5, 0.2, 1])
        assert ry.NLP_Solver(komo.nlp(), verbose=0).solve().feasible
        before, after = (np.array(komo.getConfiguration(t).getFrame("ball").getPosition()) for t in (10, 11))
        way = (after - before) / np.linalg.norm(after - before)
        finger = np.array(komo.getConfiguration(11).getFrame("finger").getPosition())
        assert way @ (after - finger) / np.linalg.norm(after - finger) > 0.7


def test_a_box_held_by_sticking_contacts_balances_its_weight():
    C = ry.Config()
    C.addFrame("world")
    for name, x in (("left", -0.14), ("right", 0.14)):
        C.addFrame(name, "world").setJoint(ry.JT.trans3).setPosition([x, 0, 1]).setShape(ry.ST.sphere, [0.04])
    C.addFrame("box", "world").setPosition([0, 0, 1]).setShape(ry.ST.ssBox, [0.2, 0.2, 0.2, 0.01]).setMass(1.0)
    S = skeleton([1], ry.SY.makeFree, ["box"], [1], ry.SY.contactStick, ["left", "box"], [1], ry.SY.contactStick, ["right", "box"],
                 [1], ry.SY.forceBalance, ["box"])  # fmt: skip
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointState())
    with pytest.raises(ry.Error, match="makeFree"):
        komo.setSkeleton(S)
    waypoints = S.getKomo_waypoints(C)
    solve(waypoints)
    forces = waypoints.getForceInteractions()
    assert np.allclose(sum(f["force"] for f in forces), [0, 0, 9.81], atol=1e-3)


def test_explicit_collisions_and_lift_priors():
    C = table_scene()
    S = skeleton([1], ry.SY.positionEq, ["g", "b"])
    S.addExplicitCollisions(["g", "b"])
    assert not ry.NLP_Solver(S.getKomo_waypoints(C).nlp(), verbose=0).solve().feasible
    T = skeleton([2], ry.SY.positionEq, ["g", "b"])
    low = T.getKomo_path(C, 10)
    T.addLiftPriors(["g"])
    lifted = T.getKomo_path(C, 10)
    assert len(lifted.report()) == len(low.report()) + 2
    collisions = skeleton([1], ry.SY.positionEq, ["g", "b"], collisions=True).getKomo_path(C, 4)
    assert any("ollision" in str(o) for o in collisions.report().values())


def test_mistakes_are_explained():
    S = ry.Skeleton()
    with pytest.raises(ry.Error, match="touch takes 2 frames; got 1"):
        S.addEntry([1], ry.SY.touch, ["a"])
    with pytest.raises(ry.Error, match=r"times of touch"):
        S.addEntry([], ry.SY.touch, ["a", "b"])
    with pytest.raises(ry.Error, match="pushAndPlace is not supported"):
        S.addEntry([1], ry.SY.pushAndPlace, ["a", "b"])
    with pytest.raises(ry.Error, match="three by three"):
        S.add([[1], ry.SY.touch])
    with pytest.raises(ry.Error, match="before it begins"):
        S.addEntry([2, 1], ry.SY.touch, ["a", "b"])
    with pytest.raises(ry.Error, match="no entry with a phase above 0"):
        S.getKomo_waypoints(table_scene())
    S.addEntry([1], ry.SY.touch, ["g", "bx"])
    with pytest.raises(ry.FrameNotFound, match="'bx'"):
        S.getKomo_waypoints(table_scene())
    with pytest.raises(ry.Error, match="kOrder 2"):
        skeleton([1], ry.SY.bounce, ["g", "b"]).getKomo_waypoints(table_scene())


def test_skeletons_pickle():
    S = skeleton(*PICK_AND_PLACE)
    again = pickle.loads(pickle.dumps(S))
    assert again.entries() == S.entries()
    assert again.getKomo_waypoints(table_scene()).nlp().getDimension() == 16


def test_what_physics_leaves_out_is_pickled_with_the_problem():
    C = table_scene()
    komo = ry.KOMO(C, 2, 4, 2, False)
    komo.addModeSwitch([1, -1], ry.SY.dynamicOn, ["table", "b"])  # without gravity
    komo.addModeSwitch([1, -1], ry.SY.magic, ["cap"])  # alone: below the first frame
    again = pickle.loads(pickle.dumps(komo))
    x = komo.nlp().getInitializationSample()
    assert np.allclose(komo.nlp().evaluate(x)[0], again.nlp().evaluate(x)[0], atol=1e-12)
