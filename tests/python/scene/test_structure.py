"""Methods that change or describe a scene as a whole: tree, inertias, copies, pickles, exports."""

import copy
import pickle

import numpy as np
import pytest

import kinegraph as ry

CHAIN = """
a: { X: "t(0 0 1)" }
b (a): { joint: hingeX, q: .3, limits: [-1 2] }
c (b): { Q: "t(0 1 0)" }
d (c): { joint: rigid, Q: "t(1 0 0)" }
e (d): { joint: transY, q: .2 }
g (e): { Q: "t(0 0 1)" }
"""

TETRAHEDRON = (
    [[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]],
    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
)


def scene(text: str = CHAIN) -> ry.Config:
    C = ry.Config()
    C.addText(text)
    return C


def poses(C: ry.Config) -> dict[str, np.ndarray]:
    return {frame.name: frame.getTransform() for frame in C}


def assert_same_poses(before: dict[str, np.ndarray], C: ry.Config) -> None:
    for frame in C:
        assert np.allclose(frame.getTransform(), before[frame.name], atol=1e-12), frame.name


def test_a_new_root_reverses_the_path_and_moves_nothing():
    C = scene()
    before = poses(C)
    root = C.getFrame("g").makeRoot(untilPartBreak=False)
    assert root.getParent() is None and C.getFrame("a").getParent() == C.getFrame("b")
    assert_same_poses(before, C)
    assert C.getJointNames() == ["a", "d"]
    assert np.allclose(C.getJointState(), [-0.3, -0.2])
    assert np.allclose(C.getJointLimits(), [[-2, -np.inf], [1, np.inf]])
    assert C.checkConsistency()


def test_a_new_root_sees_the_same_relative_motion():
    C, D = scene(), scene()
    D.getFrame("g").makeRoot()
    for q in ([0.1, -0.4], [-0.7, 0.9]):
        C.setJointState(q)
        D.setJointState([-q[0], -q[1]])
        for name in "abcde":
            here, there = C.getFrame(name), D.getFrame(name)
            assert np.allclose(
                here.getTransform(relativeTo=C.getFrame("g")), there.getTransform(relativeTo=D.getFrame("g"))
            )


def test_a_part_is_cut_at_its_rigid_joint():
    C = scene()
    before = poses(C)
    C.getFrame("g").makeRoot(untilPartBreak=True)
    assert [frame.name for frame in C.getRoots()] == ["a", "g"]
    assert C.getFrame("d").getParent() == C.getFrame("e")
    assert_same_poses(before, C)


def test_followers_keep_following_when_their_source_is_inverted():
    C = scene("a: {}  b (a): { joint: hingeX, q: .3 }  c (a): { joint: hingeX, joint_scale: 2, mimic: b }")
    before = poses(C)
    C.getFrame("b").makeRoot()
    assert_same_poses(before, C)
    angle = C.getFrame("c").getRelativeQuaternion()[1]
    C.setJointState([-0.5])
    assert C.getFrame("c").getRelativeQuaternion()[1] > angle


def test_a_joint_without_inverse_is_refused_and_nothing_changes():
    C = scene("a: {}  b (a): { joint: universal, q: [.1 .2] }")
    before = poses(C)
    with pytest.raises(ry.ArgumentError, match="universal joint of frame 'b'"):
        C.getFrame("b").makeRoot()
    assert_same_poses(before, C)
    assert C.getFrame("b").getParent() == C.getFrame("a")


def test_the_structure_is_simplified_without_moving_anything():
    C = scene()
    before = poses(C)
    C.processStructure(pruneRigidJoints=True)
    assert C.getFrameNames() == ["a", "b", "d", "e"]
    assert C.getFrame("d").getParent() == C.getFrame("b")
    assert_same_poses(before, C)
    assert np.allclose(C.getJointState(), [0.3, 0.2])


def test_shapes_that_never_collide_and_transparent_ones_are_pruned_on_request():
    text = """r: {} solid (r): { pose: [0 0 1], shape: sphere, size: [.1], contact: 1 }
    ghost (r): { pose: [0 0 2], shape: sphere, size: [.1], contact: 1, color: [1 0 0 .5] }
    picture (r): { pose: [0 0 3], shape: box, size: [1 1 1] }  mark (r): { pose: [0 0 4], shape: marker, size: [.1] }"""
    C = scene(text)
    C.processStructure(pruneNonContactShapes=True)
    assert C.getFrameNames() == ["r", "solid", "ghost", "mark"]
    C = scene(text)
    C.processStructure(pruneTransparent=True)
    assert C.getFrameNames() == ["r", "solid", "picture", "mark"]


def test_the_present_state_becomes_the_zero_of_all_joints():
    C = scene("a: {} m (a): { Q: [0 0 .5] } b (m): { joint: hingeX, q: .3, limits: [-1 2] } c (b): { Q: [0 1 0] }")
    before = poses(C)
    C.recalibrateJointsToZero()
    assert np.allclose(C.getJointState(), [0.0]) and np.allclose(C.getJointLimits(), [[-1.3], [1.7]])
    assert np.allclose(C.getFrame("c").getTransform(), before["c"])
    with pytest.raises(ry.ArgumentError, match="'b' hangs below 'a', a root"):
        scene("a: {} b (a): { joint: hingeX }").recalibrateJointsToZero()


def test_joints_are_selected_by_the_subtree_that_they_are_in():
    C = scene()
    C.selectJointsBySubtree(C.getFrame("d"))
    assert C.getJointNames() == ["e"]
    assert C.getFrame("e").getJointQIndex() == 0 and C.getFrame("b").getJointQIndex() == 0
    C.selectJointsBySubtree(root="a")
    assert [C.getFrame(name).getJointQIndex() for name in "be"] == [0, 1]


def test_inertias_are_gathered_with_steiner():
    C = ry.Config()
    f = C.addFrame("f").setMass(1.0, [1, 1, 1])
    g = C.addFrame("g", "f").setRelativePosition([1, 0, 0]).setMass(2.0, [1, 2, 3])
    assert f.computeCompoundInertia() == f
    mass, com, matrix = f.getInertia()
    assert mass == 3.0 and np.allclose(com, [2 / 3, 0, 0])
    assert np.allclose(matrix, np.diag([2, 3 + 2 / 3, 4 + 2 / 3]))  # reduced mass 2/3 at distance 1
    assert g.getMass() == 0.0


def test_a_frame_moves_to_its_principal_axes_and_leaves_everything_else_in_place():
    C = ry.Config()
    f = C.addFrame("f").setPosition([1, 2, 3]).setMesh(*TETRAHEDRON).setMass(1.5)
    child = C.addFrame("child", "f").setRelativePosition([0, 0, 0.5])
    points = f.getTransform() @ np.vstack([f.getMeshPoints().T, np.ones(4)])
    moments = np.linalg.eigvalsh(f.getInertia()[2])
    before, old = child.getPose(), f.getTransform()
    motion = f.transformToDiagInertia(True)
    _, com, matrix = f.getInertia()
    assert np.allclose(com, 0, atol=1e-12) and np.allclose(matrix, np.diag(np.diag(matrix)))
    assert np.allclose(sorted(np.diag(matrix)), moments)
    assert np.allclose(f.getTransform() @ np.vstack([f.getMeshPoints().T, np.ones(4)]), points)
    assert np.allclose(child.getPose(), before)
    X = ry.Config().addFrame("x").setPose(motion).getTransform()
    assert np.allclose(old @ X, f.getTransform())


def test_a_frame_whose_shape_would_move_is_not_rotated():
    C = ry.Config()
    box = C.addFrame("box").setShape("box", [1, 2, 3]).setMass(1.0)
    with pytest.raises(ry.ArgumentError, match="box.*would move with the frame"):
        box.transformToDiagInertia(True)
    with pytest.raises(ry.ArgumentError, match="has no mass"):
        C.addFrame("empty").transformToDiagInertia()


def test_the_equation_of_motion_does_not_depend_on_where_inertias_are_kept():
    C = scene("""base: {} j (base): { joint: hingeX } k (j): { pre: [0 0 .5], joint: hingeY }
    m (j): { Q: "t(.1 .2 .3) d(30 1 1 0)", shape: box, size: [.1 .2 .3], mass: 2 }
    n (k): { Q: "t(0 .1 .2) d(50 0 1 1)", shape: box, size: [.3 .2 .1], mass: 1 }""")
    C.setJointState([0.3, -0.4])
    M, F = C.dyn_MF([0.5, -0.2])
    for diagonal in (False, True):
        C.processInertias(recomputeInertias=False, transformToDiagInertia=diagonal)
        again = C.dyn_MF([0.5, -0.2])
        assert np.allclose(again[0], M) and np.allclose(again[1], F)
    assert C.getFrame("m").getMass() == 0.0 and "j_inertia" in C


def test_recomputed_inertias_are_those_of_opaque_surfaces():
    C = scene("""a: { shape: box, size: [1 1 1] }
    b (a): { shape: sphere, size: [1], color: [1 0 0 .5], mass: 3 }""")
    C.processInertias()
    assert C.getFrame("a").getMass() == pytest.approx(5 * 6) and C.getFrame("b").getMass() == 0.0


def test_jacobians_of_a_frame_are_those_of_the_features(panda):
    panda.setJointState([0.1, -0.5, 0.2, -1.9, 0.1, 1.8, -0.4])
    gripper = panda.getFrame("l_gripper")
    assert np.allclose(gripper.get_Jacobian_pos(), panda.eval(ry.FS.position, ["l_gripper"])[1])
    point = gripper.trans_rel2world([0.1, 0, 0.2])
    q, step, J = panda.getJointState(), 1e-6, gripper.get_Jacobian_pos(point)
    for i in range(7):
        panda.setJointState(q + step * np.eye(7)[i])
        ahead = gripper.trans_rel2world([0.1, 0, 0.2])
        panda.setJointState(q - step * np.eye(7)[i])
        assert np.allclose((ahead - gripper.trans_rel2world([0.1, 0, 0.2])) / (2 * step), J[:, i], atol=1e-8)
    panda.setJointState(q)
    velocity = gripper.get_Jacobian_angular()
    assert velocity.shape == (3, 7) and np.allclose(velocity[:, 0], [0, 0, 1])


def busy_scene() -> ry.Config:
    """Everything that a scene can hold."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addText("""odd: { note: "x y", list: [a b], flag: false, deep: { one: 1, two: [[1 2] [3]] }, shape: box, size: [1 1 1] }
    odd: { mimic_shape: odd }
    ball (odd): { joint: quatBall, q: [.1 .2 .3 .4], shape: sphere, size: [.1] }
    twin (odd): { joint: _xyc, q: [.1 .2 .3], limits: [-1 -1 -1 1 1 1] }""")
    C.addFrame("mesh", "odd").setMesh(*TETRAHEDRON, colors=[[255, 0, 0]] * 4, cvxParts=[0]).setMass(1.2)
    C.addFrame("grid").setTensorShape(np.arange(24.0).reshape(2, 3, 4), [1, 1, 1])
    C.addFrame("lines").setLines([[0, 0, 0], [1, 1, 1]])
    C.setJointState(np.nextafter(C.getJointState(), 7.0))
    return C


@pytest.mark.filterwarnings("ignore::kinegraph.KinegraphWarning")
@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_pickle_keeps_every_bit(protocol):
    C = busy_scene()
    D = pickle.loads(pickle.dumps(C, protocol))
    assert pickle.dumps(D) == pickle.dumps(C)
    assert np.array_equal(D.getJointState(), C.getJointState())
    assert np.array_equal(D.getFrameState(), C.getFrameState())
    assert D.getFrameNames() == C.getFrameNames() and D.getJointNames() == C.getJointNames()
    for ours, theirs in zip(C, D):
        assert ours.asDict() == theirs.asDict() and ours.getAttributes() == theirs.getAttributes()
        assert all(np.array_equal(a, b) for a, b in zip(ours.getMesh(), theirs.getMesh()))
    assert D.checkConsistency()


@pytest.mark.filterwarnings("ignore::kinegraph.KinegraphWarning")
def test_shapes_that_are_shared_stay_shared_in_copies_and_pickles():
    for D in (copy.deepcopy(busy_scene()), pickle.loads(pickle.dumps(busy_scene()))):
        first, second = (frame for frame in D if frame.name == "odd")
        first.setColor([1, 0, 0])
        assert second.getMeshColors().tolist() == [[255, 0, 0]]
        assert len(D.getShapes()) == len(D.getShapes(shared_only_once=False)) - 1


def test_damaged_bytes_are_refused():
    state = scene().__getstate__()
    for damaged in (b"", b"nonsense", state[:-1], state + b"\0", state[:60] + b"\xff" * 8 + state[68:]):
        with pytest.raises(ry.Error):
            ry.Config.__new__(ry.Config).__setstate__(damaged)


def test_a_config_shows_a_table_of_its_frames_in_a_notebook():
    C = ry.Config()
    assert C._repr_html_() == "<p>Config: 0 frames, 0 dofs</p>"
    C.addFrame("<b>").setShape("box", [1, 1, 1])
    for i in range(30):
        C.addFrame(f"f{i}", "<b>")
    html = C._repr_html_()
    assert "31 frames" in html and "&lt;b&gt;" in html and "<td>box</td>" in html and "and 11 more" in html


def test_a_frame_shows_what_it_is_and_that_it_is_gone():
    C = ry.Config()
    C.addText("base: { X: [1 2 3] }  '<b>'(base): { joint: hingeX, q: .5, note: 'a&b' }".replace("'<b>'", '"<b>"'))
    html = C.getFrame("<b>")._repr_html_()
    for part in ("Frame '&lt;b&gt;'", "<td>base</td>", "1 2 3 0.9689", "<th>joint</th><td>hingeX</td>", "a&amp;b"):
        assert part in html
    frame = C.getFrame("base").setMesh(np.zeros((100, 3)), [])
    assert "(300 in all)" in frame._repr_html_()
    C.delFrame(frame)
    assert repr(frame) == "<Frame, deleted>"


def test_meshes_are_written_and_read_back(tmp_path):
    C = ry.Config()
    C.addFrame("part/1").setMesh(*TETRAHEDRON, colors=[255, 0, 0]).setPosition([0, 0, 1])
    C.addFrame("box").setShape("box", [1, 1, 1]).setPosition([5, 0, 0])
    (ply,) = C.writeMeshes(str(tmp_path / "out" / "m_"))
    assert ply.endswith("m_part_1.ply")
    back = ry.Config().addFrame("x").setMeshFile(ply)
    assert np.allclose(sorted(back.getMeshPoints().tolist()), sorted(TETRAHEDRON[0]))
    assert back.getMeshColors()[0].tolist() == [255, 0, 0]
    (stl,) = C.writeConvexStls(str(tmp_path / "hull_"))
    hull = ry.Config().addFrame("x").setMeshFile(stl, scale=2.0).getMeshPoints()
    assert np.allclose(hull.max(axis=0), [2, 4, 6])
    C.writeMesh(tmp_path / "all.ply")
    for suffix in ("obj", "STL"):
        C.writeMesh(tmp_path / f"all.{suffix}")
        D = ry.Config()
        points = {}
        for name in ("all.ply", f"all.{suffix}"):
            points[name] = np.asarray(D.addFrame(name).setMeshFile(str(tmp_path / name)).getMeshPoints())
        ply, other = points.values()
        assert other.min(axis=0) == pytest.approx(ply.min(axis=0), abs=1e-6)
        assert other.max(axis=0) == pytest.approx(ply.max(axis=0), abs=1e-6)
        assert len(D.getFrame("all.ply").getMeshTriangles()) == len(D.getFrame(f"all.{suffix}").getMeshTriangles())
    for name, hint in (("all.dae", "writeCollada"), ("all", "suffix of .* is missing; expected .ply, .obj or .stl")):
        with pytest.raises(ry.ArgumentError, match=hint):
            C.writeMesh(tmp_path / name)
    C.writeCollada(tmp_path / "all.dae")
    for name in ("all.ply", "all.dae"):
        points = ry.Config().addFrame("x").setMeshFile(tmp_path / name).getMeshPoints()
        assert np.allclose(points.min(axis=0), [0, -0.5, -0.5]) and np.allclose(points.max(axis=0), [5.5, 2, 4]), name
    with pytest.raises(ry.FileError, match="cannot be written"):
        C.writeMesh(tmp_path / "no" / "such" / "folder.ply")
    with pytest.raises(ry.ArgumentError, match="collada"):
        C.writeCollada(tmp_path / "x.obj", format="obj")


def test_what_a_config_has_not_is_said(panda):
    pairs, forces = panda.getForceArrays()
    assert pairs.shape == (0, 2) and forces.shape == (0, 3, 3)
    with pytest.raises(ry.ArgumentError, match="no time slices.*KOMO"):
        panda.setJointStateSlice(q=[0] * 7, t=1)


def test_a_quaternion_that_may_be_an_angle_warns_with_the_order_of_its_numbers():
    f = ry.Config().addFrame("f")
    for call in (lambda: f.setQuaternion([20, 0, 0, 0]), lambda: f.setPose([0, 0, 0, 0, 0, 0, 50])):
        with pytest.warns(ry.KinegraphWarning, match="w x y z"):
            call()
        assert np.linalg.norm(f.getQuaternion()) == pytest.approx(1.0)
    with pytest.raises(ry.ArgumentError, match="'f'"):
        f.setPose([1, 2, 3, 0, 0, 0, 0])


def test_names_are_not_taken_over_and_frames_know_their_config():
    C = scene()
    with pytest.raises(ry.ArgumentError, match="'b'.*'a'"):
        C.getFrame("b").name = "a"
    C.getFrame("b").name = "bb"
    assert "bb" in C and C["bb"] in C and scene()["a"] not in C
    with pytest.raises(ry.ArgumentError, match="no limits"):
        C["bb"].setJoint(ry.JT.none, limits=[0, 1])


@pytest.mark.parametrize("death", ["delFrame", "clear"])
def test_every_call_on_a_deleted_frame_says_so(death):
    C = scene("a: { shape: sphere, size: [.1] }  b (a): { joint: hingeX }")
    frame = C.getFrame("b")
    C.delFrame("b") if death == "delFrame" else C.clear()
    calls = ["getPose", "getParent", "getJointState", "getShapeType", "getAttributes", "asDict", "makeRoot"]
    for call in [*calls, "getMesh", "get_Jacobian_pos", "getJointQIndex", "computeCompoundInertia"]:
        with pytest.raises(ry.FrameDeleted, match="'b'"):
            getattr(frame, call)()
