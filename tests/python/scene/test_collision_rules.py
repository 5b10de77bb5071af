"""Which shapes of files collide, compared with MuJoCo's contacts; planes, loose points and mirrored meshes."""

import itertools
import warnings

import mujoco
import numpy as np
import pytest

import kinegraph as ry


def load(tmp_path, text):
    file = tmp_path / ("scene.urdf" if text.startswith("<robot") else "scene.xml")
    file.write_text(text)
    C = ry.Config()
    C.addFile(str(file))
    return C


def mujoco_pairs(text):
    """Names of the geoms that MuJoCo lets collide if all are in one place."""
    model = mujoco.MjModel.from_xml_string(text)
    model.geom_rbound[:] = np.where(model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE, 0, 1e3)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    data.geom_xpos[:] = [0, 0, 0.01]
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    names = [model.geom(i).name for i in range(model.ngeom)]
    return {tuple(sorted((names[c.geom1], names[c.geom2]))) for c in data.contact[: data.ncon]}


def own_pairs(C):
    names = C.getCollidablePairs()
    return {tuple(sorted(pair)) for pair in zip(names[::2], names[1::2], strict=True)}


HAND = """<mujoco><default><default class="visual"><geom contype="0" conaffinity="0" group="2"/></default></default>
<worldbody>
  <geom name="floor" size=".1" {floor}/>
  <body name="a"><joint/><geom name="a1" size=".1" {a}/><geom name="a2" size=".1" class="visual"/>
    <body name="b"><joint/><geom name="b1" size=".1" {b}/>
      <body name="c"><joint axis="1 0 0"/><joint/><geom name="c1" size=".1" {c}/>
        <body name="d"><geom name="d1" size=".1" {d}/></body></body></body></body>
  <body name="e"><freejoint/><geom name="e1" size=".1" {e}/><geom name="e2" size=".1" {e2}/></body>
  <body name="f"><geom name="f1" size=".1" {f}/></body>
</worldbody><contact>{contact}</contact></mujoco>"""


@pytest.mark.parametrize("seed", range(40))
def test_bits_pairs_and_exclusions_decide_as_in_mujoco(seed, tmp_path):
    rng = np.random.default_rng(seed)
    geoms = ["floor", "a", "b", "c", "d", "e", "e2", "f"]
    most = 4 if seed % 2 else 2
    bits = {g: f'contype="{rng.integers(0, most)}" conaffinity="{rng.integers(0, most)}"' for g in geoms}
    if seed == 0:
        bits = dict.fromkeys(geoms, "")
    contact = ""
    if seed % 3 == 0:
        one, other = rng.choice(list("abcdef"), 2, replace=False)
        contact += f'<exclude body1="{one}" body2="{other}"/>'
    if seed % 4 == 0:
        contact += '<pair geom1="e1" geom2="c1"/>'
    text = HAND.format(contact=contact, **bits)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        C = load(tmp_path, text)
    assert own_pairs(C) == mujoco_pairs(text)


def test_a_robot_whose_bits_exclude_each_other_still_collides_with_what_is_added(tmp_path):
    text = """<mujoco><default><geom contype="1" conaffinity="0" size=".1"/></default><worldbody>
        <body name="a"><joint/><geom name="a1"/><body name="b"><joint/><geom name="b1"/>
        <body name="c"><joint/><geom name="c1"/></body></body></body></worldbody></mujoco>"""
    C = load(tmp_path, text)
    assert own_pairs(C) == set()
    C.addFrame("box").setShape(ry.ST.box, [0.1, 0.1, 0.1]).setContact(1)
    assert own_pairs(C) == {("a1", "box"), ("b1", "box"), ("box", "c1")}


@pytest.mark.parametrize(
    ("position", "size"),
    [("0 0 .05", "1 1 .1"), ("1.5 0 .05", "1 1 .1"), ("0 0 -.5", "1 1 .1"), ("15 0 .05", "0 0 .1")],
)
def test_a_plane_is_endless_and_solid_below(position, size, tmp_path):
    text = (
        f'<mujoco><worldbody><geom name="floor" type="plane" size="{size}"/><body name="a" pos="{position}"><freejoint/>'
        '<geom name="ball" size=".1"/></body></worldbody></mujoco>'
    )
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    C = load(tmp_path, text)
    ((one, other, distance),) = C.getCollisions(0.0)
    assert {one, other} == {"floor", "ball"}
    assert distance == pytest.approx(data.contact[0].dist)
    assert not C.isValid(C.getJointState()[None])[0]


SHAPES = {
    "sphere": [0.2],
    "box": [0.2, 0.3, 0.4],
    "capsule": [0.4, 0.1],
    "cylinder": [0.4, 0.1],
    "ssBox": [0.2, 0.3, 0.4, 0.05],
    "ssCylinder": [0.4, 0.2, 0.05],
    "ssBoxElip": [0.0, 0.0, 0.0, 0.1, 0.2, 0.3, 0.0],
}


@pytest.mark.filterwarnings("ignore:setShape. frame .solid. is")  # it stands for a half space
@pytest.mark.parametrize("shape", SHAPES)
def test_the_distance_from_a_plane_is_the_height_of_the_lowest_point(shape):
    rng = np.random.default_rng(0)
    C = ry.Config()
    plane = C.addFrame("plane").setShape(ry.ST.plane, [1, 1]).setContact(1)
    body = C.addFrame("body").setShape(getattr(ry.ST, shape), SHAPES[shape]).setContact(1)
    reference = C.addFrame("solid").setShape(ry.ST.box, [80, 80, 80]).setContact(1)
    for _ in range(50):
        orientation = rng.normal(size=4)
        plane.setPosition(rng.normal(size=3)).setQuaternion(orientation / np.linalg.norm(orientation))
        reference.setPosition(plane.getPosition() - 40 * plane.getRotationMatrix()[:, 2]).setQuaternion(
            plane.getQuaternion()
        )
        orientation = rng.normal(size=4)
        body.setPosition(plane.getPosition() + rng.normal(size=3)).setQuaternion(
            orientation / np.linalg.norm(orientation)
        )
        distance, expected = (C.eval(ry.FS.negDistance, [name, "body"])[0][0] for name in ("plane", "solid"))
        assert distance == pytest.approx(expected, abs=1e-6)
        assert C.eval(ry.FS.negDistance, ["body", "plane"])[0][0] == pytest.approx(distance)


def test_motions_are_planned_above_a_plane():
    C = ry.Config()
    C.addText(
        "floor: { shape: plane, size: [1 1], contact: 1 } world: {} "
        "j (world): { pre: [0 0 .2], joint: hingeY, limits: [-3.1 3.1] } stick (j): { Q: [.3 0 0], shape: box, size: [.6 .05 .05], contact: 1 }"
    )
    assert not C.isValid([[1.5]])[0]
    plan = ry.planMotion(C, [-2.9], [-0.1])
    assert plan.feasible
    assert C.isValid(plan.path).all()
    assert not ry.planMotion(C, [1.5], [0.0]).feasible


def arm(jointed_base):
    limit = '<limit lower="-3" upper="3" effort="1" velocity="1"/>'
    text = '<robot name="arm">'
    if jointed_base:
        text += '<link name="w"/><joint name="j0" type="continuous"><parent link="w"/><child link="base"/></joint>'
    text += '<link name="base"><collision><origin xyz="0 0 .1"/><geometry><box size=".2 .2 .2"/></geometry></collision></link>'
    parent = "base"
    for i, name in enumerate(("shoulder", "upper", "forearm", "hand")):
        z, length = (0.22, 0.44) if name == "forearm" else (0.15, 0.3)
        shape = f'<collision><origin xyz="0 0 {z}"/><geometry><box size=".08 .08 {length}"/></geometry></collision>'
        height = (0.2, 0, 0.3, 0.3)[i]
        text += (
            f'<link name="{name}">{shape if name in ("upper", "forearm") else ""}</link>'
            f'<joint name="j{i + 1}" type="revolute"><origin xyz="0 0 {height}"/><parent link="{parent}"/>'
            f'<child link="{name}"/><axis xyz="0 {int(i > 0)} {int(i == 0)}"/>{limit}</joint>'
        )
        parent = name
    return text + "</robot>"


def test_contact_minus_k_leaves_out_k_joints_also_at_a_base_without_a_joint(tmp_path):
    for jointed in (False, True):
        C = load(tmp_path, arm(jointed))
        assert own_pairs(C) == {("base_0", "forearm_0")}
    C = load(tmp_path, arm(False))
    folded = np.array([0, 0, 2.9, 0])
    C.setJointState(folded)
    assert [set(c[:2]) for c in C.getCollisions(0.0)] == [{"base_0", "forearm_0"}]
    assert not ry.planMotion(C, folded, np.zeros(4)).feasible


@pytest.mark.parametrize("joints", range(1, 5))
def test_contact_minus_k_counts_joints(joints):
    """A chain of 5 links, the first fixed to a base without a joint; the last excludes `joints` joints."""
    C = ry.Config()
    C.addText("l0: { shape: sphere, size: [.1], contact: 1 }")
    for i in range(1, 5):
        flag = -joints if i == 4 else 1
        C.addFrame(f"l{i}", f"l{i - 1}", "joint: hingeX").setShape(ry.ST.sphere, [0.1]).setContact(flag)
    with_last = {pair for pair in own_pairs(C) if "l4" in pair}
    assert with_last == {(f"l{i}", "l4") for i in range(4) if 4 - i > joints}


TETRAHEDRON = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


@pytest.mark.parametrize("extra", ["", "v 1 0 0\nl 1 5\n", "v 1 0 0\np 5\n", "v 1 0 0\nv 1 1 0\nl 5 6\n"])
def test_lines_and_points_of_mesh_files_are_no_solids(extra, tmp_path):
    (tmp_path / "m.obj").write_text(TETRAHEDRON + extra)
    C = load(
        tmp_path,
        '<robot name="r"><link name="a"><collision><geometry><mesh filename="m.obj"/></geometry></collision></link></robot>',
    )
    C.addFrame("ball").setShape(ry.ST.sphere, [0.05]).setPosition([0.8, 0, 0])
    assert C.eval(ry.FS.negDistance, ["a_0", "ball"])[0][0] == pytest.approx(-0.65, abs=1e-6)
    assert len(C.getFrame("a_0").getMeshPoints()) == 4


TETRAHEDRON_NUMBERS = 'vertex="0 0 0 .1 0 0 0 .1 0 0 0 .1" face="0 2 1 0 1 3 0 3 2 1 2 3"'


def volume(frame):
    points, triangles = np.array(frame.getMeshPoints()), np.array(frame.getMeshTriangles())
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


@pytest.mark.parametrize("signs", list(itertools.product((1, -1), repeat=3)))
def test_mirrored_meshes_stay_outside_out(signs, tmp_path):
    (tmp_path / "m.obj").write_text(TETRAHEDRON)
    scale = " ".join(map(str, signs))
    urdf = load(
        tmp_path,
        f'<robot name="r"><link name="a"><visual><geometry><mesh filename="m.obj" scale="{scale}"/></geometry></visual></link></robot>',
    )
    mjcf = load(
        tmp_path,
        f'<mujoco><asset><mesh name="m" file="m.obj" scale="{scale}"/><mesh name="n" vertex="0 0 0 .1 0 0 0 .1 0 0 0 .1" '
        f'face="0 2 1 0 1 3 0 3 2 1 2 3" scale="{scale}"/></asset><worldbody><body name="a"><inertial pos="0 0 0" mass="1" '
        'diaginertia="1 1 1"/><geom type="mesh" mesh="m"/><geom type="mesh" mesh="n"/></body></worldbody></mujoco>',
    )
    for frame in (urdf.getFrame("a_0"), mjcf.getFrame("a_0"), mjcf.getFrame("a_1")):
        assert volume(frame) == pytest.approx(1e-3 / 6)


@pytest.mark.parametrize("scale", [(1, 1, 1), (2, 2, 2), (1, 2, 0.5), (-1, 1, 1), (1, -3, -1), (-1, -1, -2)])
@pytest.mark.parametrize("source", ["file", "inline"])
def test_reference_poses_of_meshes_with_a_scale_are_those_of_mujoco(scale, source, tmp_path):
    (tmp_path / "m.obj").write_text(TETRAHEDRON)
    mesh = 'file="m.obj"' if source == "file" else TETRAHEDRON_NUMBERS
    file = tmp_path / "scene.xml"
    file.write_text(
        f'<mujoco><asset><mesh name="m" {mesh} scale="{" ".join(map(str, scale))}" refpos=".1 .2 -.3" '
        'refquat=".5 .1 -.7 .4"/></asset><worldbody><body name="a" pos="1 2 3" euler="10 20 30">'
        '<geom type="mesh" mesh="m" pos=".1 .2 .3" euler="40 50 60"/></body></worldbody></mujoco>'
    )
    C = ry.Config()
    C.addFile(file)
    assert C.fileWarnings() == []
    frame = C.getFrame("a_0")
    points = frame.getMeshPoints() @ frame.getRotationMatrix().T + frame.getPosition()
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    expected = model.mesh_vert @ data.geom_xmat[0].reshape(3, 3).T + data.geom_xpos[0]
    distances = np.linalg.norm(points[:, None] - expected[None], axis=2)
    assert distances.min(axis=0).max() < 1e-6 and distances.min(axis=1).max() < 1e-6
    assert volume(frame) == pytest.approx(abs(np.prod(scale)) * 1e-3 / 6, rel=1e-6)
    assert sum(f.getMass() for f in C) == pytest.approx(model.body_mass[1], rel=1e-6)


@pytest.mark.parametrize("signs", [(-1, 1, 1), (1, -1, 0.5), (-1, -1, -1)])
def test_mirrored_meshes_are_seen_and_written_outside_out(signs, tmp_path):
    (tmp_path / "m.obj").write_text(TETRAHEDRON)
    C = ry.Config()
    (tmp_path / "m.g").write_text(f"m: {{ mesh: <m.obj>, meshscale: [{' '.join(map(str, signs))}] }}")
    C.addFile(tmp_path / "m.g")
    frame = C.getFrame("m")
    frame.setPosition([0, 0, 0.5])  # above the floor of pictures
    points, inside = np.add(frame.getMeshPoints(), [0, 0, 0.5]), volume(frame)
    assert inside > 0
    # from outside, a depth camera sees the near faces, not the far ones through them
    middle = points.mean(axis=0)
    for direction in ([1, 0.3, 0.2], [-1, 0.3, 0.2], [0.2, -1, 0.4], [0.2, 1, -0.4]):
        away = np.array(direction) / np.linalg.norm(direction)
        camera = C.addFrame("camera")
        camera.setPosition(middle + 0.4 * away)
        x = np.cross([0, 0, 1], -away)
        x /= np.linalg.norm(x)
        camera.setRotationMatrix(np.stack([x, np.cross(-away, x), -away], axis=1))
        camera.setAttributes({"focalLength": 1.0, "width": 41, "height": 41})
        view = ry.CameraView(C)
        view.setCamera(camera)
        _, depth = view.computeImageAndDepth(C)
        a, b, c = points[np.array(frame.getMeshTriangles())].transpose(1, 0, 2)
        normals = np.cross(b - a, c - a)
        entered = normals @ -away < 0  # a ray enters a convex body at the last of the planes that it enters
        times = np.einsum("ij,ij->i", normals, a - middle - 0.4 * away)[entered] / (normals @ -away)[entered]
        assert depth[20, 20] == pytest.approx(times.max(), abs=1e-4)
        C.delFrame("camera")
    for suffix, write in (("urdf", C.writeURDF), ("xml", C.writeMJCF), ("dae", C.writeCollada), ("ply", C.writeMesh)):
        file = tmp_path / f"out.{suffix}"
        write(str(file))
        D = ry.Config()
        if suffix in ("urdf", "xml"):
            D.addFile(file)
        else:
            D.addFrame("m").setMeshFile(str(file))
        written = [f for f in D.getFrames() if len(f.getMeshTriangles())]
        assert [volume(f) for f in written] == [pytest.approx(inside, rel=1e-5)]
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "out.xml"))
    corners = model.mesh_vert[model.mesh_face]
    assert np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6 == pytest.approx(inside)


def test_a_robot_without_a_colliding_shape_says_so():
    C = ry.Config()
    C.addFile(ry.raiPath("g1/g1.g"))
    with pytest.warns(ry.KinegraphWarning, match="no moving shape of the robot 'g1_base' can collide"):
        C.isValid(C.getJointState()[None])


def near_wall():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("wall").setShape(ry.ST.ssBox, [0.05, 0.6, 0.8, 0.01]).setPosition([0, 0.35, 1.0])
    return C


CALLS = {
    "planMotion": lambda C: ry.planMotion(C, C.getJointState() + 0.01),
    "planMotions": lambda C: ry.planMotions(C, C.getJointState() + 0.01),
    "planTask": lambda C: ry.planTask(C, "(on table wall)"),
    "DiffIk": lambda C: ry.DiffIk(C),
    "getCollisions": lambda C: C.getCollisions(),
    "isValid": lambda C: C.isValid(C.getJointState()),
    "checkMotion": lambda C: C.checkMotion(C.getJointState(), C.getJointState() + 0.1),
    "solveIk": lambda C: ry.solveIk(C, {"l_gripper": [0.1, 0.4, 1.0]}),
}


@pytest.mark.parametrize("call", CALLS)
def test_the_first_question_about_collisions_warns_of_shapes_without_contact(call):
    C = near_wall()
    with pytest.warns(ry.KinegraphWarning, match="'wall'.* cannot collide because `contact` is 0"):
        CALLS[call](C)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ry.KinegraphWarning)
        C.isValid(C.getJointState())  # once per scene


LINK = '<link name="{0}"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>'
JOINT = """<joint name="j{1}" type="continuous"><parent link="{0}"/><child link="{1}"/><axis xyz="0 1 0"/>
  <origin xyz="0 0 0.3"/></joint>"""
ARM = f"""<robot name="arm">{"".join(LINK.format(x) for x in "abcd")}
  {"".join(JOINT.format(*pair) for pair in ("ab", "bc", "cd"))}</robot>"""


@pytest.mark.parametrize("ground", ["world", "table"])
def test_a_wall_beside_a_robot_on_the_ground_is_no_part_of_its_base(ground, tmp_path):
    (tmp_path / "arm.urdf").write_text(ARM)
    C = ry.Config()
    C.addFrame(ground)
    C.addFrame("wall", ground).setShape(ry.ST.box, [0.1, 2, 2]).setPosition([0.1, 0, 1]).setContact(1)
    C.addFrame("floor", ground).setShape(ry.ST.box, [2, 2, 0.1]).setPosition([0, 0, -0.5]).setContact(1)
    C.addFile(str(tmp_path / "arm.urdf")).setParent(C.getFrame(ground))
    with_wall = {name for pair in own_pairs(C) if "wall" in pair for name in pair} - {"wall"}
    assert with_wall == ({"b_0", "c_0", "d_0"} if ground == "world" else {"d_0"})
    assert {pair for pair in own_pairs(C) if not {"wall", "floor"} & set(pair)} == {("a_0", "d_0")}
    saved = str(tmp_path / "saved.g")
    C.write(saved)
    again = ry.Config()
    again.addFile(saved)
    assert own_pairs(again) == own_pairs(C)


@pytest.mark.parametrize("ground", ["", "table: { shape: ssBox, size: [2 2 .1 .01], contact: 1 }"])
def test_what_stands_beside_a_robot_on_the_same_table_collides_with_all_of_its_links(ground):
    C = ry.Config()
    root = "(table)" if ground else ""
    C.addText(f"""{ground}
      base {root}: {{ multibody: true, shape: sphere, size: [.1], contact: 1 }}
      box (base): {{ shape: sphere, size: [.1], contact: 1 }}
      a (base): {{ joint: hingeZ, shape: sphere, size: [.1], contact: -2 }}
      b (a): {{ joint: hingeX, shape: sphere, size: [.1], contact: -2 }}
      wall {root}: {{ shape: sphere, size: [.1], contact: 1 }}
      shelf {"(wall)" if ground else ""}: {{ shape: sphere, size: [.1], contact: 1 }}""")
    between = {("a", "shelf"), ("a", "wall"), ("b", "shelf"), ("b", "wall")}
    fixed = (
        set() if ground else {("base", "wall"), ("base", "shelf"), ("box", "wall"), ("box", "shelf"), ("shelf", "wall")}
    )
    assert own_pairs(C) == between | {tuple(sorted(pair)) for pair in fixed}


def test_a_wall_on_the_table_of_a_panda_collides_with_its_first_link_and_the_table_does_not():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("wall", "table").setShape(ry.ST.sphere, [0.1]).setContact(1)
    pairs = own_pairs(C)
    assert {("l_panda_coll1", "wall"), ("l_panda_coll2", "wall")} <= pairs
    assert ("l_panda_coll1", "table") not in pairs


def test_links_that_never_move_do_not_collide_with_the_table_that_they_stand_in():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    assert not {("l_panda_coll0", "table"), ("r_panda_coll0", "table")} & own_pairs(C)
    assert ("l_panda_coll1", "table") not in own_pairs(C) and C.getTotalPenetration() == 0.0


@pytest.mark.parametrize("mark", ["true", "1", "0", "later"])
def test_the_base_of_a_robot_is_marked_by_true_or_a_number_in_the_file_or_later(mark):
    C = ry.Config()
    C.addText(f"""table: {{ shape: ssBox, size: [2 2 .1 .01], contact: 1 }}
      base (table): {{ {"" if mark == "later" else f"multibody: {mark}, "}shape: sphere, size: [.1], contact: 1 }}
      a (base): {{ joint: hingeZ, shape: sphere, size: [.1], contact: -2 }}
      wall (table): {{ shape: sphere, size: [.1], contact: 1 }}""")
    if mark == "later":
        assert ("a", "wall") not in own_pairs(C)
        C.getFrame("base").setAttributes({"multibody": True})
    assert (("a", "wall") in own_pairs(C)) == (mark != "0")
