"""The elements and attributes of URDF that the reader takes, with what becomes of them."""

from .entries import Entry as E

LINK = '<robot name="r"><link name="base"/><link name="a">{}</link><joint name="j" type="fixed"><parent link="base"/><child link="a"/></joint></robot>'
JOINT = '<robot name="r"><link name="base"/><link name="a"/>{}</robot>'
ENDS = '<parent link="base"/><child link="a"/>'

ROBOT = [
    E(
        "link name",
        "name",
        "required",
        "A link becomes a frame of its name, with one more frame `NAME_0`, `NAME_1`, ... per shape.",
        '<link name="b"/>' + '<joint name="k" type="fixed"><parent link="base"/><child link="b"/></joint>',
        "'b' in C.getFrameNames()",
    ),
    E(
        "joint name type",
        "name; `revolute`, `continuous`, `prismatic`, `fixed`, `planar`, `floating`, `spherical`",
        "required",
        "A joint becomes a frame of its name, below a frame `NAME_origin` if it has an origin.",
        f'<joint name="j" type="revolute">{ENDS}</joint>',
        "C.getFrame('j').getJointType() == ry.JT.hingeX",
    ),
    E(
        "parent child link",
        "name of a link",
        "required",
        "The links above and below the joint.",
        f'<joint name="j" type="continuous">{ENDS}</joint>',
        "a.getParent().name == 'j' and C.getFrame('j').getParent().name == 'base'",
    ),
    E(
        "origin xyz rpy",
        "3 numbers, m; 3 numbers, rad",
        "0 0 0",
        "Pose of the joint in its parent link. Roll, pitch and yaw are about fixed axes.",
        f'<joint name="j" type="fixed">{ENDS}<origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/></joint>',
        "equal(a.getPosition(), [1, 2, 3]) and equal(a.getRotationMatrix()[:, 0], [0, 1, 0])",
    ),
    E(
        "quat_xyzw",
        "4 numbers",
        "none",
        "Rotation as a quaternion, of URDF 1.1, instead of `rpy`.",
        f'<joint name="j" type="fixed">{ENDS}<origin quat_xyzw="0 0 1 1"/></joint>',
        "equal(a.getRotationMatrix()[:, 0], [0, 1, 0])",
    ),
    E(
        "axis xyz",
        "3 numbers",
        "1 0 0",
        "Axis of the joint in its own frame.",
        f'<joint name="j" type="prismatic">{ENDS}<axis xyz="0 0 1"/><limit lower="0" upper="1"/></joint>',
        "(C.setJointState([1]), equal(a.getPosition(), [0, 0, 1]))[1]",
    ),
    E(
        "limit lower upper",
        "rad or m",
        "0",
        "Limits of a revolute or prismatic joint; `inf` is none.",
        f'<joint name="j" type="revolute">{ENDS}<limit lower="-1" upper="2"/></joint>',
        "equal(C.getJointLimits(), [[-1], [2]])",
    ),
    E(
        "velocity effort",
        "rad/s or m/s; N m or N",
        "unknown",
        "Further attributes of `<limit>`: they become `ctrl_limits`.",
        f'<joint name="j" type="continuous">{ENDS}<limit velocity="3" effort="40"/></joint>',
        "equal(C.getVelocityLimits(), [3]) and equal(C.getEffortLimits(), [40])",
    ),
    E(
        "dynamics damping friction",
        "N m s/rad, N m, or N s/m, N",
        "0",
        "They become `angularDamping` and `jointFriction`.",
        f'<joint name="j" type="continuous">{ENDS}<dynamics damping=".2" friction=".1"/></joint>',
        "C.getFrame('j').getAttributes()['angularDamping'] == 0.2 and C.getFrame('j').getAttributes()['jointFriction'] == 0.1",
    ),
    E(
        "mimic joint multiplier offset",
        "name; number; rad or m",
        "required; 1; 0",
        "The joint follows another one: multiplier times its q, plus offset.",
        '<link name="b"/>'
        + f'<joint name="k" type="continuous"><parent link="base"/><child link="b"/></joint><joint name="j" type="prismatic">{ENDS}<limit lower="-9" upper="9"/><mimic joint="k" multiplier="2" offset=".5"/></joint>',
        "(C.setJointState([1]), C.getJointDimension() == 1 and equal(a.getPosition(), [2.5, 0, 0]))[1]",
    ),
    E(
        "mujoco compiler meshdir",
        "path",
        "none",
        "Extension of MuJoCo: the folder of meshes that are not where their names say.",
        '<mujoco><compiler meshdir="."/></mujoco><link name="b"><visual><geometry><mesh filename="other/tetra.obj"/></geometry></visual></link>',
        "C.getFrame('b_0').getShapeType() == ry.ST.mesh",
    ),
]

LINKS = [
    E(
        "inertial mass value",
        "kg",
        "required",
        "Mass of the link.",
        '<inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1"/></inertial>',
        "a.getMass() == 2",
    ),
    E(
        "inertia ixx iyy izz ixy ixz iyz",
        "kg m^2",
        "required for the diagonal; 0",
        "Inertia about the center of mass, in the axes of the `<origin>` of `<inertial>`.",
        '<inertial><mass value="2"/><inertia ixx="1" iyy="2" izz="2.5"/></inertial>',
        "equal(a.getInertia()[2], np.diag([1, 2, 2.5]))",
    ),
    E(
        "visual",
        "geometry",
        "none",
        "A shape for pictures: `visual: true`.",
        '<visual><geometry><sphere radius=".1"/></geometry></visual>',
        "C.getFrame('a_0').getAttributes()['visual']",
    ),
    E(
        "collision",
        "geometry",
        "none",
        "A shape that collides: `contact: -2` unless an SRDF file says more. It is shown red and transparent.",
        '<collision><geometry><sphere radius=".1"/></geometry></collision>',
        "C.getFrame('a_0').getAttributes()['contact'] == -2",
    ),
    E(
        "geometry box size",
        "widths x y z, m",
        "required",
        "A box.",
        '<visual><geometry><box size="1 2 3"/></geometry></visual>',
        "equal(C.getFrame('a_0').getSize(), [1, 2, 3])",
    ),
    E(
        "sphere radius",
        "m",
        "required",
        "A ball.",
        '<visual><geometry><sphere radius=".1"/></geometry></visual>',
        "C.getFrame('a_0').getShapeType() == ry.ST.sphere",
    ),
    E(
        "cylinder capsule length",
        "m",
        "required",
        "A cylinder, or a capsule with the length of its core, along z, with a `radius`.",
        '<visual><geometry><cylinder length="2" radius=".1"/></geometry></visual><visual><geometry><capsule length="2" radius=".1"/></geometry></visual>',
        "C.getFrame('a_0').getShapeType() == ry.ST.cylinder and C.getFrame('a_1').getShapeType() == ry.ST.capsule",
    ),
    E(
        "mesh filename scale",
        "path, `package://` or `file://`; 3 numbers, or one for all",
        "required; 1",
        "A mesh.",
        '<visual><geometry><mesh filename="tetra.obj" scale="2 2 2"/></geometry></visual>',
        "equal(C.getFrame('a_0').getMeshPoints().max(), 2)",
    ),
    E(
        "material color rgba",
        "4 numbers, 0 to 1",
        "gray",
        "Color of a visual shape; a material with a name may be defined anywhere in the file.",
        '<visual><geometry><sphere radius=".1"/></geometry><material name="red"><color rgba="1 0 0 1"/></material></visual>',
        "equal(C.getFrame('a_0').asDict()['color'][:3], [1, 0, 0])",
    ),
    E(
        "texture",
        "`filename`: path",
        "none",
        "Picture on a visual shape.",
        '<visual><geometry><box size="1 1 1"/></geometry><material name="m"><texture filename="dot.png"/></material></visual>',
        "not C.fileWarnings()",
    ),
]

SECTIONS = {
    "`<robot>`: links and joints": (
        "The file has one `<robot>` with a `name`. Links without a joint above them are roots.",
        JOINT,
        ROBOT,
    ),
    "`<link>`: masses and shapes": (
        "`<inertial>`, `<visual>` and `<collision>` have an `<origin>` as joints do.",
        LINK,
        LINKS,
    ),
}
NOT_READ = "Not read: `<safety_controller>`, `<calibration>`, `<transmission>`, `<gazebo>`, `<sensor>`, and the joint efforts of `<dynamics>` beyond damping and friction. [Robots of other packages](../robots.md#flaws) lists how flaws are mended."
