"""The robots and scenes that come with the package: names and poses that scripts rely on."""

import collections
import importlib.util
import os
import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from base_pairs import pairsAtBases
from conftest import DATA, recorded

SHARE = [
    Path(folder)
    for folder in os.environ.get("KINEGRAPH_PACKAGE_PATH", "").split(os.pathsep)
    if folder and (Path(folder) / "example-robot-data").is_dir()
]
# included by others, and nothing on their own
# Recorded with the masses of hollow shells, or rounded ones; ours have those of the manufacturers' descriptions. The
# recorded Panda weighs nothing.
OWN_MASSES = re.compile(r"^ur_|^ranger_|ranger_clean|g1_clean|ur10_conv")
NOT_OURS = {"visual"}  # is said of shapes that do not collide
PARTS = {"pr2_modifications.g", "panda_hand.g", "panda_hand_masses.g", "panda_collision.g", "panda_tight_collision.g"}
needs_robots = pytest.mark.skipif(not SHARE, reason="needs robots: pip install example-robot-data==6.0.0")


def model(name: str, prefix: str | None = None) -> ry.Config:
    C = ry.Config()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)  # meshes that the robot package itself lacks
        C.addFile(ry.raiPath(name), prefix)
    return C


def test_two_robots_of_one_file_stand_side_by_side():
    C = model("panda/panda.g", "l_")
    C.addFile(ry.raiPath("panda/panda.g"), "r_")
    C.getFrame("r_panda_base").setPosition([0, 1, 0])
    offset = C.getFrame("r_gripper").getPosition() - C.getFrame("l_gripper").getPosition()
    assert C.getJointDimension() == 14 and np.allclose(offset, [0, 1, 0])


@pytest.mark.parametrize(
    "name, mass, heaviest",
    [
        ("panda/panda.g", 17.4519, "panda_joint1"),
        ("ur10/ur10.g", 4 + 7.778 + 12.93 + 3.87 + 2 * 1.96 + 0.202, "ur_shoulder_lift_joint"),
        ("ur10/ur10_clean.g", 4 + 7.778 + 12.93 + 3.87 + 2 * 1.96 + 0.202, "upper_arm_link"),
        ("g1/g1_clean.g", 35.115, "waist_pitch_joint"),
        ("ranger/ranger.g", 25.7056 + 2 * (1.34089 + 1.33115), "ranger_base_link"),
        ("ranger/ranger_clean.g", 25.7056 + 2 * (1.34089 + 1.33115), "base_link"),
    ],
)
def test_robots_weigh_what_their_makers_say(name: str, mass: float, heaviest: str) -> None:
    C = model(name)
    masses = {frame.name: frame.getMass() for frame in C.getFrames()}
    assert sum(masses.values()) == pytest.approx(mass, rel=1e-4)
    assert max(masses, key=masses.__getitem__) == heaviest


def test_both_files_of_the_g1_and_of_the_ur10_are_the_same_body():
    """Mass and center of mass of the whole, at q = 0, by any names of the frames."""
    for one, other in (("g1/g1_clean.g", "g1/g1_29dof_conv.g"), ("ur10/ur10_conv.g", "ur10/ur10_clean.g")):
        bodies = []
        for name in (one, other):
            C = model(name)
            C.setJointState(0 * C.getJointState())
            mass, center = C.getCenterOfMass()
            bodies.append([mass, *center])
        assert bodies[0] == pytest.approx(bodies[1], abs=2e-5), one


# Recorded from the package robotic 0.4.2 at the pose that the file gives.
UR10 = {
    "ur_shoulder_lift_joint": [0.0, 0.2209, 0.1273, 0.9771, 0.0, -0.2130, 0.0],
    "ur_elbow_joint": [-0.2547, 0.0490, 0.6838, 0.9595, 0.0, 0.2815, 0.0],
    "ur_wrist_2_joint": [0.0545, 0.1639, 1.1654, 0.7385, 0.2590, 0.4742, 0.4034],
    "ur_ee_fixed_joint": [0.1275, 0.2138, 1.2841, 0.2369, 0.5184, 0.1521, 0.8074],
}


def test_the_ur10_stands_as_in_older_scripts():
    C = model("ur10/ur10.g")
    assert C.getJointNames() == [
        f"ur_{name}_joint" for name in ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
    ]
    assert np.allclose(C.getJointState(), [0, -2, 1, -1, 1, 0])
    assert np.allclose(np.abs(C.getJointLimits()), 2 * np.pi)
    for name, pose in UR10.items():
        assert np.allclose(C.getFrame(name).getPose(), pose, atol=1e-4), name


def test_the_gripper_closes_symmetrically_and_its_pads_stay_parallel():
    C = model("robotiq/robotiq.g")
    assert C.getJointNames()[:1] == ["finger_joint"] and np.allclose(C.getJointState(), [0.2])
    assert np.allclose(C.getFrame("gripper").getPosition(), [0, 0, 1.14])
    gaps = []
    for q in (0.0, 0.4, 0.8):
        C.setJointState([q])
        left, right = (C.getFrame(f"{side}_inner_finger_pad_0") for side in ("left", "right"))
        assert np.allclose(left.getPosition() * [1, -1, 1], right.getPosition())
        assert np.allclose(np.abs(left.getRotationMatrix()), np.eye(3), atol=1e-9)
        gaps.append(right.getPosition()[1] - left.getPosition()[1] - 0.00635)
    assert gaps[0] == pytest.approx(0.085, abs=0.002) and gaps[0] > gaps[1] > gaps[2] > -0.01  # it is called 2F-85


RECORDED = sorted(path.stem for path in (DATA / "models").glob("*.json"))

# If frames share a name, our files rename the later ones, and references stay unique.
OWN_NAMES = {
    ("pr2/pr2.g", "base_footprint"): ["base_footprint", "base_footprint_marker"],
    ("tests/pr2Shelf.g", "base_footprint"): ["base_footprint", "base_footprint_marker"],
    ("scenarios/workshopTable.g", "bucketA"): ["bucketA", "bucketA1", "bucketA2"],
}


def own_names(file: str, names: list[str]) -> list[str]:
    """Recorded names of frames, as our file has them."""
    return [OWN_NAMES.get((file, name), [name] * (count + 1))[count] for name, count in places(names)]


def places(names):
    """Numbers equal names, which distinguishes frames without a name."""
    seen = collections.Counter()
    result = []
    for name in names:
        result.append((name, seen[name]))
        seen[name] += 1
    return result


@pytest.mark.parametrize("name", RECORDED)
def test_a_model_is_as_recorded(name):
    numbers = recorded(f"models/{name}")
    C = model(numbers["file"])
    own = C.getJointNames()[: C.getJointDimension()]  # joints that mimic others follow; they were not recorded
    assert own == numbers["joint_names"]
    assert np.allclose(C.getJointState(), numbers["q"], atol=1e-6)
    limits, theirs = np.array(C.getJointLimits()).reshape(2, -1), np.array(numbers["limits"]).reshape(2, -1)
    bounded = theirs[0] <= theirs[1]
    assert np.allclose(limits[:, bounded], theirs[:, bounded], atol=1e-5)  # 2 pi is given as 6.28319
    assert np.isinf(limits[:, ~bounded]).all()  # recorded as 0 and -1
    C.setJointState(numbers["random_q"])
    assert C.getFrameNames() == own_names(numbers["file"], [frame["name"] for frame in numbers["frames"]])
    for ours, theirs in zip(C.getFrames(), numbers["frames"]):
        parent, place = ours.getParent(), (ours.ID, ours.name)
        assert (parent.name if parent else None) == theirs["parent"], place
        assert ours.getJointType() == getattr(ry.JT, theirs.get("joint", "none")), place
        attributes = ours.asDict()
        assert attributes.get("contact", 0) == theirs.get("contact", 0), place
        for key, value in theirs.get("attributes", {}).items():  # other attributes of a frame: logical, gains, ...
            expected = pytest.approx(value, abs=1e-6) if isinstance(value, list) else value
            assert key in NOT_OURS or attributes[key] == expected, (place, key)
        sign = np.sign(ours.getPose()[3:] @ theirs["pose"][3:])
        assert np.allclose(ours.getPose() * np.r_[1, 1, 1, [sign] * 4], theirs["pose"], atol=1e-6), place
        if "shape" in theirs:
            assert ours.getShapeType() == getattr(ry.ST, theirs["shape"]), place
            size = ours.getSize()
            assert np.allclose(size, theirs["size"][: len(size)]), place  # markers are given more numbers than count
        if ("mass" in theirs or "panda" not in ours.name) and not OWN_MASSES.search(ours.name + numbers["file"]):
            assert ours.getMass() == pytest.approx(theirs.get("mass", 0), abs=1e-6), place


@pytest.mark.parametrize("name", RECORDED)
def test_the_same_frames_of_a_model_may_collide(name):
    numbers = recorded(f"models/{name}")
    C = model(numbers["file"])
    names, more = C.getCollidablePairs(), pairsAtBases(C)
    assert len(names) == 2 * (numbers["collidable"] + len(more))
    if "pairs" in numbers:
        expected = sorted([*numbers["pairs"], *(sorted(pair) for pair in more)])
        assert sorted(sorted(pair) for pair in zip(names[::2], names[1::2])) == expected


# other models of the reference's collection; it cannot load some of them itself
@pytest.mark.parametrize(
    "name, dofs",
    [
        ("g1/g1_29dof_raw_conv.yml", 29),
        ("panda/panda_deformable.g", 8),
        ("pr2/pr2_modify_fixRight.g", 0),
        ("pr2/pr2_modify_fixLeft.g", 0),
        ("pr2/pr2_modify_fixHead.g", 0),
        ("pr2/pr2_modify_fixGrippers.g", 0),
        ("robotiq/robotiq_clean.g", 1),
        ("robotiq/robotiq_arg2f_85_model_conv.yml", 1),
        ("scenarios/climber.g", 5),
        ("scenarios/climber2.g", 6),
        ("scenarios/k-bars.g", 0),
        ("scenarios/k00.g", 14),
        ("scenarios/panda_fixRobotiq.g", 7),
        ("scenarios/panda_moveGripper.g", 8),
        ("scenarios/walker1.g", 4),
        ("scenarios/walker3.g", 9),
        ("trossen/trossen_raw_conv.yml", 8),
        ("ur10/ur10_clean.g", 6),
    ],
)
def test_a_model_that_the_reference_only_names_has_its_dofs(name, dofs):
    assert model(name).getJointDimension() == dofs


def test_every_model_loads_without_a_warning_and_none_holds_a_mesh():
    folder = Path(ry.raiPath())
    for path in [path for ending in ("*.g", "*.yml") for path in folder.rglob(ending)]:
        if path.name in PARTS:
            continue
        C = ry.Config()
        with warnings.catch_warnings():
            warnings.simplefilter("error", ry.KinegraphWarning)
            if path.stem.startswith("pr2_modify"):
                C.addFile(ry.raiPath("pr2/pr2.g"))
                continue
            C.addFile(path)
        assert len(C) > 0, path
        assert all(frame.getShapeType() != ry.ST.mesh for frame in C.getFrames() if frame.asDict().get("shape")), path
    assert not [path for path in folder.rglob("*") if path.suffix in (".h5", ".ply", ".stl", ".dae", ".obj")]


@pytest.mark.filterwarnings("ignore:no moving shape of the robot")
def test_robots_stand_free_of_each_other_and_of_themselves():
    """At a file's own pose only those frames collide that collide in the reference, too."""
    for name in (
        "g1/g1.g",
        "allegro/allegro.g",
        "ranger/ranger.g",
        "allegro/allegro_collision.g",
        "g1/g1_collision.g",
        "pr2/pr2_collision.g",
        "trossen/trossen_collision.g",
        "ur10/ur10_collision.g",
        "ur10/ur10.g",
        "trossen/trossen.g",
        "panda/panda.g",
    ):
        assert model(name).getCollisions(0.0) == [], name


TIGHT = {
    "panda_coll0": "link0",
    "panda_coll1": "link1",
    "panda_coll2": "link2",
    "panda_coll3": "link3",
    "panda_coll4": "link4",
    "panda_coll5": "link5",
    "panda_coll6": "link6",
    "panda_coll7": "link7",
    "palm": "hand",
    "finger1": "finger",
}


@needs_robots
def test_the_tight_panda_holds_each_link_within_a_centimeter():
    C = model("panda/panda_tight.g")
    directions = np.random.default_rng(0).normal(size=(2000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for name, link in TIGHT.items():
        frame = ry.Config().addFrame("mesh")
        frame.setMeshFile(str(SHARE[0] / f"example-robot-data/robots/panda_description/meshes/collision/{link}.stl"))
        attributes = C.getFrame(name).asDict()
        reach = (directions @ np.reshape(attributes["core"], (-1, 3)).T).max(axis=1) + attributes["size"][0]
        excess = reach - (directions @ frame.getMeshPoints().T).max(axis=1)
        assert excess.min() > 0 and excess.max() < 0.01, name


def test_the_tight_panda_is_free_where_capsules_are_not():
    """The same joints and frames; beside a plate it is free more often, and its gripper keeps its pose."""
    wide, tight = model("panda/panda.g"), model("panda/panda_tight.g")
    assert set(tight.getFrameNames()) == set(wide.getFrameNames())
    assert list(tight.getJointNames()) == list(wide.getJointNames()) and tight.getCollisions(0.0) == []
    for C in (wide, tight):
        C.addFrame("plate").setShape(ry.ST.box, [1, 0.02, 1.5]).setPosition([0.2, 0.16, 0.75]).setContact(1)
    assert tight.getCollisions(0.0) == []  # the elbows reach to 13 cm
    assert {"panda_coll2", "plate"} in [{a, b} for a, b, _ in wide.getCollisions(0.0)]  # their capsules to 18
    rng = np.random.default_rng(0)
    lower, upper = wide.getJointLimits()
    q = lower + rng.random((400, 7)) * (upper - lower)
    assert np.sum(tight.isValid(q)) > np.sum(wide.isValid(q))
    wide.setJointState(q[0]), tight.setJointState(q[0])
    assert np.array_equal(wide.getFrame("gripper").getPose(), tight.getFrame("gripper").getPose())


@needs_robots
@pytest.mark.parametrize("name", ["g1/g1.g", "allegro/allegro.g", "pr2/pr2.g", "ur10/ur10.g"])
def test_hulls_are_where_the_meshes_of_the_robot_package_are(name):
    """The corners of our shapes are within 2 cm of the box around the mesh that viewers show instead."""
    C = model(name)
    pictured = [frame for frame in C.getFrames() if "visual_mesh" in frame.asDict()]
    assert len(pictured) > 5
    for frame in pictured:
        mesh = ry.Config().addFrame("mesh")
        path = str(frame.asDict()["visual_mesh"]).strip("<>").removeprefix("package:").lstrip("/")
        mesh.setMeshFile(str(SHARE[0] / path))
        ours, theirs = frame.getMeshPoints(), mesh.getMeshPoints()
        assert np.allclose(ours.min(axis=0), theirs.min(axis=0), atol=0.02), frame.name
        assert np.allclose(ours.max(axis=0), theirs.max(axis=0), atol=0.02), frame.name


def test_a_marker_image_has_its_borders_or_says_what_to_install():
    with pytest.raises(ry.ArgumentError, match="50"):
        ry.getArucoImage(50)
    if importlib.util.find_spec("cv2") is None:
        with pytest.raises(ry.Error, match="pip install opencv"):
            ry.getArucoImage(0)
        return
    image = ry.getArucoImage(id=0)
    assert image.shape == (9, 9) and image.dtype == np.uint8
    assert (image[0] == 255).all() and (image[1, 1:-1] == 0).all()
    assert (image[3, 1:-1] == [0, 0, 255, 0, 255, 255, 0]).all()  # recorded from the package robotic 0.4.2
