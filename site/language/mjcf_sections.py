"""What is beside <worldbody> in MJCF: actuators, assets, settings, and what makes or repeats elements."""

from .entries import Entry as E

DOCUMENT = "<mujoco>{}</mujoco>"
GEOM = '<geom size=".1"/>'


def two(text: str) -> str:
    """A joint j of body a, and a joint k of a body below."""
    body = f'<body name="a"><joint name="j" axis="0 0 1"/>{GEOM}<body name="b"><joint name="k" axis="0 0 1"/>{GEOM}</body></body>'
    return f'<compiler angle="radian"/><worldbody>{body}</worldbody>{text}'


ACTUATORS = [
    E(
        "joint",
        "name",
        "none",
        "Joint of an actuator. Others, of tendons and sites, are listed by `kinegraph info` only.",
        two('<actuator><motor joint="j" name="m"/></actuator>'),
        "len(C.getFrame('j').getAttributes()) > 1",
    ),
    E(
        "gear",
        "number",
        "1",
        "Ratio of the actuator; it scales limits and, squared, gains.",
        two('<actuator><motor joint="j" gear="5" ctrlrange="-2 2"/></actuator>'),
        "equal(C.getEffortLimits()[0], 10)",
    ),
    E(
        "ctrlrange ctrllimited",
        "2 numbers; `auto`, `true`, `false`",
        "none; auto",
        "Range of the control; of a `motor` it limits the effort.",
        two('<actuator><motor joint="j" ctrlrange="-7 7"/></actuator>'),
        "equal(C.getEffortLimits()[0], 7)",
    ),
    E(
        "forcerange forcelimited",
        "2 numbers; `auto`, `true`, `false`",
        "none; auto",
        "Limit of the effort.",
        two('<actuator><position joint="j" kp="9" forcerange="-5 5"/></actuator>'),
        "equal(C.getEffortLimits()[0], 5)",
    ),
    E(
        "kp kv",
        "gains",
        "1; 0",
        "Gains of a `position` actuator: `motorKp`, `motorKd`.",
        two('<actuator><position joint="j" kp="9" kv="2"/></actuator>'),
        "C.getFrame('j').getAttributes()['motorKp'] == 9 and C.getFrame('j').getAttributes()['motorKd'] == 2",
    ),
    E(
        "dampratio",
        "number",
        "none",
        "It becomes `motorDampingRatio`.",
        two('<actuator><position joint="j" kp="9" dampratio="1"/></actuator>'),
        "C.getFrame('j').getAttributes()['motorDampingRatio'] == 1",
    ),
    E(
        "gainprm biasprm biastype",
        "up to 10 numbers; `none`, `affine`",
        "1; 0; none",
        "Gains of a `general` actuator.",
        two('<actuator><general joint="j" gainprm="9" biasprm="0 -9 -2" biastype="affine"/></actuator>'),
        "C.getFrame('j').getAttributes()['motorKp'] == 9",
    ),
]

SECTIONS_READ = [
    E(
        "joint1 joint2 polycoef active",
        "names; up to 5 numbers; flag",
        "required; none; 0 1 0 0 0; true",
        "`<equality><joint>`: the first joint follows the second one.",
        two('<equality><joint joint1="k" joint2="j" polycoef="0 -1 0 0 0"/></equality>'),
        "C.getJointDimension() == 1",
    ),
    E(
        "body1 body2",
        "names",
        "required",
        "`<contact><exclude>`: geoms of these bodies do not collide.",
        '<worldbody><body name="a"><joint/><geom size=".1"/></body><body name="b"><joint/><geom size=".1"/></body></worldbody><contact><exclude body1="a" body2="b"/></contact>',
        "not C.getCollisions()",
    ),
    E(
        "geom1 geom2",
        "names",
        "required",
        "`<contact><pair>`: the geoms collide.",
        '<worldbody><body name="a"><joint/><geom name="g" size=".1" contype="0" conaffinity="0"/></body><body name="b"><geom name="h" size=".1" contype="0" conaffinity="0"/></body></worldbody><contact><pair geom1="g" geom2="h"/></contact>',
        "len(C.getCollisions()) == 1",
    ),
    E(
        "filterparent",
        "enable, disable",
        "enable",
        "`<option><flag>`: bodies that one joint connects do not collide; a warning says so of `disable`.",
        '<option><flag filterparent="disable"/></option><worldbody><body name="a"><joint/><geom name="g" size=".1"/><body name="b"><joint/><geom name="h" size=".1"/></body></body></worldbody>',
        "len(C.getCollisions()) == 0",
    ),
    E(
        "qpos",
        "numbers",
        "0",
        "`<keyframe><key>` with a `name` becomes a named state.",
        two('<keyframe><key name="home" qpos=".1 .2"/></keyframe>'),
        "equal(C.getNamedState('home'), [0.1, 0.2])",
    ),
    E(
        "gravity",
        "x y z, m/s^2",
        "0 0 -9.81",
        "`<option>`: another gravity gives a warning; pass it to the simulation.",
        '<option gravity="0 0 0"/><worldbody/>',
        "any('gravity' in warning for warning in C.fileWarnings())",
    ),
]

ASSETS = [
    E(
        "file",
        "path",
        "none",
        "File of a mesh, texture or height field, below `meshdir` or `texturedir`; of an `<include>` or a `<model>`, too.",
        '<asset><mesh name="m" file="tetra.obj"/></asset><worldbody><geom name="g" type="mesh" mesh="m"/></worldbody>',
        "len(C.getFrame('g').getMeshPoints()) == 4",
    ),
    E(
        "scale refpos refquat",
        "3 numbers; m; w x y z",
        "1; 0 0 0; 1 0 0 0",
        "Scale and pose of a mesh asset.",
        '<asset><mesh name="m" file="tetra.obj" scale="2 2 2"/></asset><worldbody><geom name="g" type="mesh" mesh="m"/></worldbody>',
        "equal(np.ptp(C.getFrame('g').getMeshPoints()[:, 0]), 2)",
    ),
    E(
        "fitscale fitaabb",
        "number; flag of the compiler",
        "1; false",
        "A primitive geom with a `mesh` gets the size of the mesh's inertia, or of its bounding box, times `fitscale`.",
        '<compiler fitaabb="true"/><asset><mesh name="m" vertex="0 0 0 1 0 0 0 2 0 1 2 0 0 0 3 1 0 3 0 2 3 1 2 3"/></asset><worldbody><geom name="g" type="box" mesh="m" fitscale="2"/></worldbody>',
        "equal(sorted(C.getFrame('g').getSize()[:3]), [2, 4, 6])",
    ),
    E(
        "vertex face",
        "numbers",
        "none",
        "A mesh in the file itself.",
        '<asset><mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset><worldbody><geom name="g" type="mesh" mesh="m"/></worldbody>',
        "C.getFrame('g').getShapeType() == ry.ST.ssCvx",
    ),
    E(
        "inertia",
        "`legacy`, `exact`, `convex`, `shell`",
        "legacy",
        "How the mass of a mesh is computed.",
        '<asset><mesh name="m" file="tetra.obj" inertia="convex"/></asset><worldbody><body name="a"><joint/><geom type="mesh" mesh="m"/></body></worldbody>',
        "sum(f.getMass() for f in C.getFrames()) > 100",
    ),
    E(
        "nrow ncol elevation",
        "whole numbers; numbers",
        "0; none",
        "A height field in the file itself.",
        '<asset><hfield name="h" nrow="2" ncol="2" size="1 1 1 .1" elevation="0 0 1 1"/></asset><worldbody><geom name="g" type="hfield" hfield="h"/></worldbody>',
        "C.getFrame('g').getShapeType() == ry.ST.mesh",
    ),
    E(
        "texture texrepeat texuniform",
        "name; 2 numbers; flag",
        "none; 1 1; false",
        "Picture of a material; a `<layer>` of the `role` rgb names one, too.",
        '<asset><texture name="t" type="2d" file="dot.png"/><material name="m" texture="t" texrepeat="2 2"/></asset><worldbody><geom name="g" type="box" size="1 1 1" material="m"/></worldbody>',
        "not C.fileWarnings()",
    ),
    E(
        "builtin rgb1 rgb2",
        "`flat`, `gradient`, `checker`; colors",
        "none",
        "A generated texture gives its mean color.",
        '<asset><texture name="t" type="2d" builtin="flat" rgb1="1 0 0" width="8" height="8"/><material name="m" texture="t"/></asset><worldbody><geom name="g" type="box" size="1 1 1" material="m"/></worldbody>',
        "C.getFrame('g').asDict()['color'][0] > C.getFrame('g').asDict()['color'][1]",
    ),
]

COMPILER = [
    E(
        "angle",
        "`degree`, `radian`",
        "degree",
        "Unit of angles.",
        '<compiler angle="degree"/><worldbody><body name="a"><joint range="-90 90"/><geom size=".1"/></body></worldbody>',
        "equal(C.getJointLimits()[1], [np.pi / 2])",
    ),
    E(
        "eulerseq",
        "3 letters",
        "xyz",
        "Axes of `euler`; capitals are fixed axes.",
        '<compiler eulerseq="zyx"/><worldbody><body name="a" euler="90 0 0"><geom size=".1"/></body></worldbody>',
        "equal(a.getRotationMatrix()[:, 0], [0, 1, 0])",
    ),
    E(
        "coordinate",
        "`local`",
        "local",
        "MuJoCo has removed `global`.",
        '<compiler coordinate="local"/><worldbody><body name="a"><geom size=".1"/></body></worldbody>',
        "a is not None",
    ),
    E(
        "autolimits",
        "flag",
        "true",
        "A `range` alone limits a joint.",
        '<compiler autolimits="false"/><worldbody><body name="a"><joint range="-90 90"/><geom size=".1"/></body></worldbody>',
        "not np.isfinite(C.getJointLimits()).any()",
    ),
    E(
        "meshdir texturedir assetdir strippath",
        "folders; flag",
        "the file's folder; false",
        "Folders of assets.",
        '<compiler meshdir="nowhere" strippath="true"/><worldbody><body name="a"><geom size=".1"/></body></worldbody>',
        "a is not None",
    ),
    E(
        "inertiafromgeom inertiagrouprange",
        "`auto`, `false`, `true`; 2 numbers",
        "auto; 0 5",
        "Whether and which geoms give masses.",
        '<compiler inertiafromgeom="true"/><worldbody><body name="a"><inertial pos="0 0 0" mass="9" diaginertia="1 1 1"/><joint/><geom size=".1" mass="2"/></body></worldbody>',
        "equal(sum(f.getMass() for f in C.getFrames()), 2)",
    ),
    E(
        "settotalmass boundmass boundinertia balanceinertia",
        "kg; kg; kg m^2; flag",
        "none",
        "Changes of masses.",
        '<compiler settotalmass="7"/><worldbody><body name="a"><joint/><geom size=".1" mass="2"/></body></worldbody>',
        "equal(sum(f.getMass() for f in C.getFrames()), 7)",
    ),
]

STRUCTURE = [
    E(
        "count sep offset",
        "whole number; text; x y z",
        "required; none; 0 0 0",
        "`<replicate>` repeats its content, moved by `offset` and rotated by `euler`.",
        '<worldbody><replicate count="3" offset="1 0 0"><body name="a"><geom size=".1"/></body></replicate></worldbody>',
        "sum(name.startswith('a') and C.getFrame(name).getShapeType() == ry.ST.none for name in C.getFrameNames()) == 3",
    ),
    E(
        "model prefix body",
        "name; text; name",
        "required",
        "`<attach>` adds a body of another model, an `<asset><model>`, with a prefix.",
        '<asset><model name="m" file="part.xml"/></asset><worldbody><attach model="m" body="p" prefix="x_"/></worldbody>',
        "'x_p' in C.getFrameNames()",
    ),
]

SECTIONS = {
    "`<actuator>`": (
        "`motor`, `position` and `general` of joints are simulated; `kinegraph info` lists all.",
        ACTUATORS,
    ),
    "`<equality>`, `<contact>`, `<keyframe>`, `<option>`": ("", SECTIONS_READ),
    "`<asset>`": ("", ASSETS),
    "`<compiler>`": ("", COMPILER),
    "`<replicate>`, `<attach>`, `<include>`, `<default>`": (
        "Included files and classes of defaults are read as in MuJoCo.",
        STRUCTURE,
    ),
}
