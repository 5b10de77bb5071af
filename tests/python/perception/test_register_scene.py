"""Poses of known shapes from depth images: arguments, results, and robustness to the errors of a camera."""

import copy
import pickle
import warnings

import numpy as np
import pytest

import kinegraph as ry

SCENE = """
table: { shape: ssBox, size: [1.2, 1.2, .1, .005], pose: [0, 0, .6], contact: 1 }
box: { shape: ssBox, size: [.06, .1, .08, .002], pose: [.12, .05, .69], contact: 1 }
can: { shape: cylinder, size: [.12, .03], pose: [-.12, .05, .71], contact: 1 }
cam: { pose: [0, -.6, 1.2, .344, -.939, 0, 0], focalLength: 1.25, width: 640, height: 480 }
"""


@pytest.fixture
def scene():
    C = ry.Config()
    C.addText(SCENE)
    return C


def look(C):
    """The depth of the camera `cam` in m, and fx fy cx cy."""
    view = ry.CameraView(C)
    view.setCamera("cam")
    return view.computeImageAndDepth()[1], view.getFxycxy()


def moved(pose, step):
    return np.concatenate([pose[:3] + step, pose[3:]])


def test_a_moved_box_is_found_and_its_frame_moved(scene):
    depth, fxycxy = look(scene)
    truth = scene.getFrame("box").getPose()
    scene.getFrame("box").setPose(moved(truth, [0.03, -0.02, 0.01]))
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["box"], support="table")
    assert seen["box"].status == ry.SeenStatus.seen
    assert seen["box"].pose == pytest.approx(truth, abs=1e-3)
    assert scene.getFrame("box").getPose() == pytest.approx(seen["box"].pose, abs=1e-9)
    assert seen.poses()["box"] == pytest.approx(truth, abs=1e-3)
    assert seen["box"].covariance.shape == (6, 6)
    assert 0.95 < seen["box"].visible <= 1
    assert "box: seen at" in repr(seen)


@pytest.mark.parametrize("believed", ["tray", "table"])
@pytest.mark.parametrize("standing", ["tray", "table"])
def test_a_thing_rests_on_the_place_of_the_scene_or_on_the_support(scene, believed, standing):
    scene.delFrame("can")
    tray = scene.addFrame("tray", "table").setShape(ry.ST.ssBox, [0.3, 0.3, 0.03, 0.005])
    tray.setRelativePosition([-0.05, 0.05, 0.065]).setContact(1)
    box = scene.getFrame("box")
    at, height = ([-0.05, 0.05], 0.72) if standing == "tray" else ([0.2, 0.05], 0.69)
    box.setPosition([*at, height])
    truth = box.getPose()
    depth, fxycxy = look(scene)
    box.setParent(scene.getFrame(believed), True)
    box.setPose(moved(truth, [0.02, -0.02, 0.03 if believed == "tray" else -0.01]))
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["box"], support="table")
    assert seen["box"].status == ry.SeenStatus.seen
    assert seen["box"].pose == pytest.approx(truth, abs=1e-3)


def test_millimeters_in_integers_and_a_pose_give_the_same_result_as_meters_and_a_frame(scene):
    depth, fxycxy = look(scene)
    camera = scene.getFrame("cam").getPose()
    truth = scene.getFrame("can").getPose()
    coarse = np.clip(np.round(1000 * depth), 0, None).astype(np.uint16)
    for view in (ry.DepthView(coarse, fxycxy, camera), ry.DepthView(coarse.astype(float), fxycxy, "cam", unit=0.001)):
        scene.getFrame("can").setPose(moved(truth, [0.02, 0.02, 0]))
        seen = ry.registerScene(scene, [view], ["can"], support="table")
        assert seen["can"].pose[:3] == pytest.approx(truth[:3], abs=5e-4)
        assert len(seen["can"].free_directions) == 1


@pytest.mark.parametrize("seed", range(6))
def test_the_error_is_within_the_covariance_with_noise_holes_and_outliers(scene, seed):
    rng = np.random.default_rng(seed)
    depth, fxycxy = look(scene)
    truth = scene.getFrame("box").getPose()
    noisy = depth + 0.0027 * depth**2 * rng.normal(size=depth.shape)
    noisy += rng.normal() * 0.0019 * depth**2  # an error that all pixels share
    noisy[rng.random(depth.shape) < 0.1] = 0
    noisy[rng.random(depth.shape) < 0.02] *= rng.uniform(0.8, 1.2)
    scene.getFrame("box").setPose(moved(truth, rng.uniform(-0.03, 0.03, 3)))
    seen = ry.registerScene(scene, ry.DepthView(noisy, fxycxy, "cam"), ["box"], support="table")
    error = (seen["box"].pose - truth)[:2]
    assert np.linalg.norm(error) < 0.006
    assert error @ np.linalg.solve(seen["box"].covariance[:2, :2], error) < 14  # exceeded by 1 of 1000


def test_what_is_gone_or_hidden_keeps_its_last_pose(scene):
    before = scene.getFrame("box").getPose()
    empty = scene.copy()
    empty.delFrame("box")
    view = ry.DepthView(*look(empty), "cam")
    seen = ry.registerScene(scene, view, ["box", "can"], support="table")
    assert seen["box"].status == ry.SeenStatus.not_there
    assert seen.poses()["box"] is None
    assert np.array_equal(scene.getFrame("box").getPose(), before)
    hidden = scene.copy()
    hidden.addFrame("stranger").setShape(ry.ST.box, [0.3, 0.02, 0.3]).setPosition([0.12, -0.1, 0.8])
    seen = ry.registerScene(scene, ry.DepthView(*look(hidden), "cam"), ["box"], support="table")
    assert seen["box"].status == ry.SeenStatus.occluded
    assert seen["box"].by == ""


def test_the_robot_does_not_hold_a_thing_that_its_hand_touches():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addText("cup: { shape: ssBox, size: [.05, .06, .12, .004], pose: [0, .3, .71], contact: 1 }")
    eye, target = np.array([0.6, 0.9, 1.3]), np.array([0, 0.3, 0.7])
    z = (target - eye) / np.linalg.norm(target - eye)
    x = np.cross(z, [0, 0, 1])
    x /= np.linalg.norm(x)
    cam = C.addFrame("cam").setPosition(eye).setRotationMatrix(np.stack([x, np.cross(z, x), z], 1))
    cam.setAttributes({"focalLength": 1.25, "width": 640, "height": 480})
    result = ry.solveIk(C, {"l_gripper": [0.0, 0.3, 0.79]})
    C.setJointState(result.q)
    depth, fxycxy = look(C)
    truth = C.getFrame("cup").getPose()
    C.getFrame("cup").setPose(moved(truth, [0.02, -0.02, 0]))
    seen = ry.registerScene(C, ry.DepthView(depth, fxycxy, "cam"), ["cup"], support="table")
    assert seen["cup"].pose == pytest.approx(truth, abs=2e-3)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda d, f: ry.DepthView(1000 * d, f, "cam"), "pass unit=0.001"),
        (lambda d, f: ry.DepthView(d[::2, ::2], f, "cam"), "does not fit an image of 320 x 240"),
        (lambda d, f: ry.DepthView(d.T, f, "cam"), "transpose it"),
        (lambda d, f: ry.DepthView(d[0], f, "cam"), "has 1 dimensions"),
        (lambda d, f: ry.DepthView(d, f[:3], "cam"), "has 3 entries"),
        (lambda d, f: ry.DepthView(d, f, [0, 0, 1]), "neither the name of a frame nor a pose"),
        (lambda d, f: ry.DepthView(d > 1, f, "cam"), "type bool"),
        (lambda d, f: ry.DepthView(d, f, "cam", noise=0), "noise is 0"),
    ],
)
def test_invalid_views_are_errors(scene, call, message):
    with pytest.raises(ry.ArgumentError, match=message):
        call(*look(scene))


def test_unknown_frames_and_an_empty_view_are_told(scene):
    depth, fxycxy = look(scene)
    with pytest.raises(ry.FrameNotFound, match="bax"):
        ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["bax"])
    with pytest.raises(ry.FrameNotFound, match="kam"):
        ry.registerScene(scene, ry.DepthView(depth, fxycxy, "kam"), ["box"])
    with pytest.raises(ry.ArgumentError, match="no views"):
        ry.registerScene(scene, [], ["box"])
    with pytest.warns(ry.KinegraphWarning, match="view 0 has no depth"):
        seen = ry.registerScene(scene, ry.DepthView(0 * depth, fxycxy, "cam"), ["box"])
    assert seen["box"].status == ry.SeenStatus.not_in_view
    with pytest.raises(ry.FrameNotFound, match="was not looked for"):
        seen["can"]


def test_without_a_prior_things_are_found_anywhere_on_the_support(scene):
    view = ry.DepthView(*look(scene), "cam")
    truth = {name: scene.getFrame(name).getPose() for name in ("box", "can")}
    for name in truth:
        scene.getFrame(name).setPosition([3, 3, 3])
    scene.addFrame("ball").setShape(ry.ST.sphere, [0.04]).setPosition([3, 4, 3])
    seen = ry.registerScene(scene, view, ["box", "can", "ball"], support="table", prior="anywhere")
    for name, pose in truth.items():
        assert seen[name].pose[:3] == pytest.approx(pose[:3], abs=1e-3)
    assert seen["ball"].status == ry.SeenStatus.not_found
    assert seen.poses()["ball"] is None
    with pytest.raises(ry.ArgumentError, match="'anywhere' without a support"):
        ry.registerScene(scene, view, ["box"], prior="anywhere")
    with pytest.raises(ry.ArgumentError, match="expected 'last' or 'anywhere'"):
        ry.registerScene(scene, view, ["box"], support="table", prior="near")


def test_equal_things_that_may_be_exchanged_are_named(scene):
    scene.getFrame("can").setShape(ry.ST.ssBox, [0.06, 0.1, 0.08, 0.002]).setPosition([0.0, 0.05, 0.69])
    view = ry.DepthView(*look(scene), "cam")
    scene.getFrame("box").setPosition([0.07, 0.1, 0.69])
    scene.getFrame("can").setPosition([0.05, -0.01, 0.69])
    with pytest.warns(ry.KinegraphWarning, match="look alike and may be exchanged"):
        seen = ry.registerScene(scene, view, ["box", "can"], support="table", search_radius=0.1)
    assert seen["box"].may_be == ["can"] and seen["can"].may_be == ["box"]
    assert seen["box"].pose[0] == pytest.approx(0.12, abs=1e-3)
    assert "may be exchanged with 'can'" in repr(seen["box"])


def test_a_camera_upside_down_and_a_wrong_unit_are_told(scene):
    depth, fxycxy = look(scene)
    with pytest.warns(ry.KinegraphWarning, match="looks through .* of the surface of 'table'"):
        ry.registerScene(scene, ry.DepthView(depth[::-1, ::-1], fxycxy, "cam"), ["box"], support="table")
    with pytest.raises(ry.ArgumentError, match="pass unit=1"):
        ry.DepthView(depth, fxycxy, "cam", unit=0.001)


@pytest.mark.parametrize("names", [["box", "top"], ["top", "box"], ["top"]])
def test_a_thing_on_another_one_is_found_in_the_same_call(scene, names):
    top = scene.addFrame("top").setShape(ry.ST.box, [0.04, 0.05, 0.05]).setPosition([0.12, 0.06, 0.755]).setContact(1)
    truth = [scene.getFrame(name).getPose() for name in names]
    depth, fxycxy = look(scene)
    top.setPosition([0.13, 0.05, 0.75])
    if "box" in names:
        scene.getFrame("box").setPosition([0.13, 0.04, 0.69])
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), names, support="table")
    assert [seen[name].pose[:3] for name in names] == [pytest.approx(pose[:3], abs=1e-3) for pose in truth]


@pytest.mark.parametrize("names", [["low", "top"], ["top", "low"]])
def test_a_thing_taken_from_another_one_leaves_the_pose_of_this_one_alone(scene, names):
    scene.delFrame("can")
    scene.delFrame("box")
    scene.addFrame("low").setShape(ry.ST.box, [0.08, 0.08, 0.05]).setPosition([0.1, 0.05, 0.675]).setContact(1)
    top = scene.addFrame("top").setShape(ry.ST.box, [0.05, 0.05, 0.05]).setPosition([0, 0.05, 0.675]).setContact(1)
    depth, fxycxy = look(scene)
    top.setPosition([0.1, 0.05, 0.725])
    view = ry.DepthView(depth, fxycxy, "cam")
    seen = ry.registerScene(scene, view, names, support="table", search_radius=0.12)
    assert seen["low"].pose[:3] == pytest.approx([0.1, 0.05, 0.675], abs=1e-3)
    assert seen["top"].pose[:3] == pytest.approx([0, 0.05, 0.675], abs=1e-3)


def test_a_small_support_causes_no_warning(scene, recwarn):
    top = scene.addFrame("top").setShape(ry.ST.box, [0.04, 0.05, 0.05]).setPosition([0.12, 0.06, 0.755]).setContact(1)
    depth, fxycxy = look(scene)
    top.setPosition([0.13, 0.05, 0.755])
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["top"], support="box")
    assert seen["top"].pose[:3] == pytest.approx([0.12, 0.06, 0.755], abs=1e-3)
    assert not recwarn.list and not seen.warnings


def test_an_interlaced_image_is_enough(scene):
    depth, fxycxy = look(scene)
    depth = depth.copy()
    depth[::2] = 0
    scene.getFrame("box").setPosition([0.13, 0.04, 0.7])
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["box"], support="table")
    assert seen["box"].pose[:3] == pytest.approx([0.12, 0.05, 0.69], abs=1e-3)


def test_things_beside_the_support_keep_their_prior(scene):
    scene.getFrame("table").setShape(ry.ST.ssBox, [0.5, 0.5, 0.1, 0.005])
    scene.addFrame("cabinet").setPosition([0.32, 0.05, 0.7])
    drawer = scene.addFrame("drawer", "cabinet").setJoint(ry.JT.transX, [0.0, 0.1])
    drawer.setShape(ry.ST.ssBox, [0.08, 0.2, 0.1, 0.004]).setJointState([0.06])
    view = ry.DepthView(*look(scene), "cam")
    truth = drawer.getPose()
    drawer.setJointState([0.02])
    seen = ry.registerScene(scene, view, ["drawer", "box"], support="table", prior="anywhere")
    assert seen["drawer"].status == ry.SeenStatus.seen
    assert seen["drawer"].pose == pytest.approx(truth, abs=2e-3)


@pytest.mark.parametrize("names", [["box", "twin"], ["twin", "box"]])
def test_of_equal_things_without_a_prior_one_is_not_found(scene, names):
    view = ry.DepthView(*look(scene), "cam")
    twin = scene.addFrame("twin").setShape(ry.ST.ssBox, [0.06, 0.1, 0.08, 0.002])
    twin.setPosition([0.2, 0.1, 0.69])
    scene.getFrame("box").setPosition([-0.3, -0.2, 0.69])
    with pytest.warns(ry.KinegraphWarning, match="look alike"):
        seen = ry.registerScene(scene, view, names, support="table", prior="anywhere")
    assert {seen[name].status for name in names} == {ry.SeenStatus.seen, ry.SeenStatus.not_found}
    assert seen["twin"].status == ry.SeenStatus.seen  # it moved less


def test_many_equal_things_are_told_apart():
    C = ry.Config()
    C.addText("\n".join(line for line in SCENE.splitlines() if not line.startswith(("box", "can"))))
    rng = np.random.default_rng(3)
    places = [(0.11 * i - 0.33, 0.12 * j - 0.12) for i in range(7) for j in range(2)]
    names = [f"cube{k}" for k in range(len(places))]
    for name, (x, y) in zip(names, places, strict=True):
        C.addFrame(name).setShape(ry.ST.ssBox, [0.05, 0.05, 0.05, 0.002]).setPosition([x, y, 0.675]).setContact(1)
    view = ry.DepthView(*look(C), "cam")
    truth = {name: C.getFrame(name).getPosition() for name in names}
    for name in names:
        C.getFrame(name).setPosition(truth[name] + [*rng.uniform(-0.02, 0.02, 2), 0])
    with pytest.warns(ry.KinegraphWarning, match="look alike"):
        seen = ry.registerScene(C, view, names, support="table", prior="anywhere")
    for name in names:
        assert seen[name].pose[:3] == pytest.approx(truth[name], abs=3e-3)


def panda_scene():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addText("box: { shape: ssBox, size: [.06, .1, .08, .002], pose: [.2, .3, .69], contact: 1 }")
    eye, target = np.array([0.7, 1.0, 1.3]), np.array([0, 0.2, 0.8])
    z = (target - eye) / np.linalg.norm(target - eye)
    x = np.cross(z, [0, 0, 1]) / np.linalg.norm(np.cross(z, [0, 0, 1]))
    cam = C.addFrame("cam").setPosition(eye).setRotationMatrix(np.stack([x, np.cross(z, x), z], 1))
    cam.setAttributes({"focalLength": 1.1, "width": 640, "height": 480})
    return C


@pytest.mark.filterwarnings("ignore::kinegraph.errors.KinegraphWarning")  # rotations of slender links are hardly seen
@pytest.mark.parametrize("estimate", [["joints"], ["joints", "camera"]])
@pytest.mark.parametrize("seed", [1, 4])
def test_offsets_of_the_joints_and_the_camera_are_estimated_along(seed, estimate):
    rng = np.random.default_rng(seed)
    C = panda_scene()
    truth = C.copy()
    offsets = rng.uniform(-0.01, 0.01, 7)
    truth.setJointState(C.getJointState() + offsets)
    depth, fxycxy = look(truth)
    depth = depth + 0.0008 * depth**2 * rng.normal(size=depth.shape)
    if "camera" in estimate:
        C.getFrame("cam").setPosition(C.getFrame("cam").getPosition() + rng.uniform(-0.01, 0.01, 3))
    C.getFrame("box").setPosition([0.22, 0.28, 0.69])
    view = ry.DepthView(depth, fxycxy, "cam", noise=0.0008, bias=0.0004)
    seen = ry.registerScene(C, view, ["box"], support="table", estimate=estimate)
    assert seen.joints == C.getJointNames() and len(seen.cameras) == len(estimate) - 1
    error = seen.joint_offsets - offsets
    assert error @ np.linalg.solve(seen.joint_covariance, error) < 24  # exceeded by 1 of 1000
    hand = C.getFrame("l_gripper").getPosition() - truth.getFrame("l_gripper").getPosition()
    assert np.linalg.norm(hand) < (0.003 if seen.cameras else 0.001)
    assert "l_panda_joint1: offset" in repr(seen)
    for camera in seen.cameras:
        off = camera.pose[:3] - truth.getFrame("cam").getPosition()
        assert off @ np.linalg.solve(camera.covariance[:3, :3], off) < 17
        assert C.getFrame("cam").getPosition() == pytest.approx(camera.pose[:3], abs=1e-9)
    assert C.getFrame("box").getPosition() == pytest.approx([0.2, 0.3, 0.69], abs=3e-3)


def test_an_unknown_name_of_what_to_estimate_is_an_error(scene):
    view = ry.DepthView(*look(scene), "cam")
    with pytest.raises(ry.ArgumentError, match="estimate has 'arm'; expected 'camera' or 'joints'"):
        ry.registerScene(scene, view, ["box"], estimate=["arm"])
    with pytest.raises(ry.ArgumentError, match="no active hinge or slide"):
        ry.registerScene(scene, view, ["box"], estimate=["joints"])


def test_images_of_another_size_than_the_intrinsics_are_errors(scene):
    depth, fxycxy = look(scene)
    for image in (depth[::2, ::2], np.repeat(np.repeat(depth, 2, 0), 2, 1)):
        with pytest.raises(ry.ArgumentError, match="does not fit an image"):
            ry.DepthView(image, fxycxy, "cam")


def test_the_housing_of_a_camera_is_nothing_that_it_looks_through(scene):
    depth, fxycxy = look(scene)
    scene.addFrame("housing", "cam").setShape(ry.ST.ssBox, [0.08, 0.08, 0.08, 0.004]).setContact(1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["box"], support="table")


def test_one_large_number_marks_what_was_not_measured(scene):
    depth, fxycxy = look(scene)
    depth[:250] = 65.535
    assert ry.DepthView(depth, fxycxy, "cam")
    with pytest.raises(ry.ArgumentError, match=r"pass unit=0.001"):
        ry.DepthView(1000 * look(scene)[0], fxycxy, "cam")


def test_a_thing_of_several_parts_on_another_one_is_found(scene):
    lamp = scene.addFrame("lamp").setPosition([0.12, 0.06, 0.78])
    foot = scene.addFrame("foot", "lamp").setShape(ry.ST.box, [0.05, 0.05, 0.02]).setContact(1)
    foot.setRelativePosition([0, 0, -0.04])
    pole = scene.addFrame("pole", "lamp").setShape(ry.ST.cylinder, [0.06, 0.012]).setContact(1)
    pole.setRelativePosition([0, 0, 0])
    truth = lamp.getPose()
    depth, fxycxy = look(scene)
    scene.getFrame("box").setPosition([0.13, 0.04, 0.69])
    lamp.setPosition([0.135, 0.05, 0.78])
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["box", "lamp"], support="table")
    assert seen["lamp"].status == ry.SeenStatus.seen
    assert seen["lamp"].pose[:3] == pytest.approx(truth[:3], abs=1e-3)


@pytest.mark.parametrize("roll", [0.0, 1.0, 2.5, -2.0])
def test_a_lying_can_may_have_any_side_down(scene, roll):
    can = scene.getFrame("can").setShape(ry.ST.cylinder, [0.08, 0.045])
    can.setPosition([-0.12, 0.05, 0.695]).setQuaternion(
        [
            np.cos(np.pi / 4) * np.cos(roll / 2),
            np.sin(np.pi / 4) * np.cos(roll / 2),
            -np.sin(np.pi / 4) * np.sin(roll / 2),
            np.cos(np.pi / 4) * np.sin(roll / 2),
        ]
    )
    truth = can.getPose()
    depth, fxycxy = look(scene)
    can.setPose(moved(truth, [0.02, -0.02, 0.01]))
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["can"], support="table")
    assert seen["can"].pose[:3] == pytest.approx(truth[:3], abs=1e-3)


def test_what_explains_the_pixels_badly_is_not_seen(scene):
    unknown = scene.copy()
    unknown.delFrame("box")
    unknown.addFrame("stranger").setShape(ry.ST.sphere, [0.05]).setPosition([0.12, 0.05, 0.7])
    seen = ry.registerScene(scene, ry.DepthView(*look(unknown), "cam"), ["box"], support="table")
    assert seen["box"].status != ry.SeenStatus.seen


@pytest.mark.parametrize("names", [["box", "lid"], ["lid", "box"]])
def test_a_child_of_another_thing_is_where_it_was_seen(scene, names):
    lid = scene.addFrame("lid", "box").setShape(ry.ST.box, [0.04, 0.04, 0.02]).setRelativePosition([0, 0, 0.05])
    lid.setContact(1)
    depth, fxycxy = look(scene)
    truth = lid.getPose()
    scene.getFrame("box").setPosition([0.14, 0.04, 0.69])
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), names, support="table")
    assert seen["lid"].pose == pytest.approx(truth, abs=1e-3)
    assert lid.getPose() == pytest.approx(seen["lid"].pose, abs=1e-9)


def test_a_child_that_was_not_seen_moves_with_its_parent(scene):
    depth, fxycxy = look(scene)
    lid = scene.addFrame("lid", "box").setShape(ry.ST.box, [0.04, 0.04, 0.02]).setRelativePosition([0, 0, 0.05])
    scene.getFrame("box").setPosition([0.14, 0.04, 0.69])
    seen = ry.registerScene(scene, ry.DepthView(depth, fxycxy, "cam"), ["lid", "box"], support="table")
    assert seen["lid"].status == ry.SeenStatus.not_there
    assert lid.getPosition() == pytest.approx([0.12, 0.05, 0.74], abs=1e-3)
    assert np.array_equal(seen["lid"].pose[:3], lid.getPosition())


@pytest.mark.filterwarnings("ignore::kinegraph.errors.KinegraphWarning")  # a plane does not determine the camera
def test_views_and_results_are_pickled_and_copied(scene):
    view = ry.DepthView(*look(scene), "cam", noise=0.002)
    scene.getFrame("box").setPosition([0.13, 0.04, 0.69])
    again = pickle.loads(pickle.dumps(view))
    assert repr(again) == repr(view) == "<DepthView 640 x 480, 100 % measured, camera 'cam'>"
    seen = ry.registerScene(scene.copy(), view, ["box", "can"], support="table", estimate=["camera"])
    assert repr(ry.registerScene(scene.copy(), again, ["box", "can"], support="table", estimate=["camera"])) == repr(
        seen
    )
    for other in (pickle.loads(pickle.dumps(seen)), copy.deepcopy(seen)):
        assert repr(other) == repr(seen)
        assert np.array_equal(other["box"].covariance, seen["box"].covariance)
        assert np.array_equal(other["can"].free_directions, seen["can"].free_directions)
        assert other.poses()["can"] == pytest.approx(seen.poses()["can"])
        assert np.array_equal(other.cameras[0].covariance, seen.cameras[0].covariance)
