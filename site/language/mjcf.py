"""The elements and attributes of MJCF that the reader takes, with what becomes of them."""

from .entries import Entry as E

WORLD = '<mujoco><compiler angle="radian"/><worldbody>{}</worldbody></mujoco>'
FILE = "<mujoco>{}</mujoco>"
GEOM = '<geom size=".1"/>'


def inBody(text: str) -> str:
    return f'<body name="a">{text}{GEOM}</body>'


def two(text: str) -> str:
    """A joint j of body a, and a joint k of a body below."""
    body = f'<body name="a"><joint name="j" axis="0 0 1"/>{GEOM}<body name="b"><joint name="k" axis="0 0 1"/>{GEOM}</body></body>'
    return f'<compiler angle="radian"/><worldbody>{body}</worldbody>{text}'


BODY = [
    E(
        "name",
        "name",
        "`body_0`, ...",
        "Name of the frame, of bodies, joints, geoms, sites and cameras.",
        '<body name="a"><geom size=".1"/></body>',
        "a is not None",
    ),
    E(
        "pos",
        "x y z, m",
        "0 0 0",
        "Position in the parent body.",
        '<body name="a" pos="1 2 3"><geom size=".1"/></body>',
        "equal(a.getPosition(), [1, 2, 3])",
    ),
    E(
        "quat",
        "w x y z",
        "1 0 0 0",
        "Rotation.",
        '<body name="a" quat="1 0 0 1"><geom size=".1"/></body>',
        "equal(a.getRotationMatrix()[:, 0], [0, 1, 0])",
    ),
    E(
        "axisangle",
        "x y z angle",
        "none",
        "Rotation about an axis, in the unit of the compiler.",
        '<body name="a" axisangle="0 0 1 1.5707963267948966"><geom size=".1"/></body>',
        "equal(a.getRotationMatrix()[:, 0], [0, 1, 0])",
    ),
    E(
        "xyaxes",
        "6 numbers",
        "none",
        "The x and y axes.",
        '<body name="a" xyaxes="0 1 0 -1 0 0"><geom size=".1"/></body>',
        "equal(a.getRotationMatrix()[:, 0], [0, 1, 0])",
    ),
    E(
        "zaxis",
        "3 numbers",
        "none",
        "The z axis, by the smallest rotation.",
        '<body name="a" zaxis="0 1 0"><geom size=".1"/></body>',
        "equal(a.getRotationMatrix()[:, 2], [0, 1, 0])",
    ),
    E(
        "euler",
        "3 angles",
        "none",
        "Rotations about the axes of `eulerseq`.",
        '<body name="a" euler="0 0 1.5707963267948966"><geom size=".1"/></body>',
        "equal(a.getRotationMatrix()[:, 0], [0, 1, 0])",
    ),
    E(
        "childclass",
        "name of a class",
        "none",
        "Class of defaults for elements inside of the body or frame.",
        '</worldbody><default><default class="c"><geom size=".3"/></default></default><worldbody><body name="a" childclass="c"><geom name="g"/></body>',
        "equal(C.getFrame('g').getSize(), [0.3])",
    ),
    E(
        "gravcomp",
        "share",
        "0",
        "It becomes `gravityCompensation`.",
        '<body name="a" gravcomp="1"><joint/><geom size=".1"/></body>',
        "a.getAttributes()['gravityCompensation'] == 1",
    ),
]

JOINT = [
    E(
        "class",
        "name of a class",
        "none",
        "Class of defaults, of joints, geoms, sites and cameras.",
        '</worldbody><default><default class="c"><joint type="slide"/></default></default><worldbody>'
        + inBody('<joint name="j" class="c"/>'),
        "C.getFrame('j').getJointType() == ry.JT.transZ",
    ),
    E(
        "type",
        "`hinge`, `slide`, `ball`, `free`",
        "hinge",
        "Type of the joint; `<freejoint>` is the last one.",
        inBody('<joint name="j" type="ball"/>'),
        "C.getFrame('j').getJointType() == ry.JT.quatBall",
    ),
    E(
        "pos",
        "x y z, m",
        "0 0 0",
        "Point through which the axis passes.",
        inBody('<joint name="j" pos="1 0 0" axis="0 0 1"/>'),
        "(C.setJointState([np.pi]), equal(a.getPosition(), [2, 0, 0]))[1]",
    ),
    E(
        "axis",
        "x y z",
        "0 0 1",
        "Axis.",
        inBody('<joint name="j" type="slide" axis="0 1 0"/>'),
        "(C.setJointState([1]), equal(a.getPosition(), [0, 1, 0]))[1]",
    ),
    E(
        "ref",
        "rad, degrees or m",
        "0",
        "Value of q in the pose of the file.",
        inBody('<joint name="j" type="slide" ref="2"/>'),
        "equal(C.getJointState(), [2]) and equal(a.getPosition(), [0, 0, 0])",
    ),
    E(
        "range limited",
        "2 numbers; `auto`, `true`, `false`",
        "none; auto",
        "Limits.",
        inBody('<joint name="j" range="-1 2"/>'),
        "equal(C.getJointLimits(), [[-1], [2]])",
    ),
    E(
        "damping",
        "N m s/rad or N s/m",
        "0",
        "It becomes `angularDamping`.",
        inBody('<joint name="j" damping=".5"/>'),
        "C.getFrame('j').getAttributes()['angularDamping'] == 0.5",
    ),
    E(
        "stiffness springref",
        "N m/rad or N/m; q",
        "0",
        "They become `springStiffness` and `springReference`.",
        inBody('<joint name="j" stiffness="3" springref=".2"/>'),
        "C.getFrame('j').getAttributes()['springStiffness'] == 3 and equal(C.getFrame('j').getAttributes()['springReference'], 0.2)",
    ),
    E(
        "frictionloss",
        "N m or N",
        "0",
        "It becomes `jointFriction`.",
        inBody('<joint name="j" frictionloss=".5"/>'),
        "C.getFrame('j').getAttributes()['jointFriction'] == 0.5",
    ),
    E(
        "armature",
        "kg m^2 or kg",
        "0",
        "It becomes `armature`.",
        inBody('<joint name="j" armature=".5"/>'),
        "C.getFrame('j').getAttributes()['armature'] == 0.5",
    ),
    E(
        "actuatorfrcrange actuatorfrclimited",
        "2 numbers; `auto`, `true`, `false`",
        "none; auto",
        "Limit of the motors' effort: it becomes `ctrl_limits`.",
        inBody('<joint name="j" actuatorfrcrange="-9 9"/>'),
        "equal(C.getEffortLimits(), [9])",
    ),
]

GEOMS = [
    E(
        "type",
        "`plane`, `hfield`, `sphere`, `capsule`, `ellipsoid`, `cylinder`, `box`, `mesh`, `sdf`",
        "sphere",
        "Shape.",
        '<geom name="g" type="box" size="1 2 3"/>',
        "C.getFrame('g').getShapeType() == ry.ST.box",
    ),
    E(
        "size",
        "1 to 3 numbers, m",
        "required",
        "Radius, half lengths or half sides, which become full lengths.",
        '<geom name="g" type="box" size="1 2 3"/>',
        "equal(C.getFrame('g').getSize(), [2, 4, 6])",
    ),
    E(
        "fromto",
        "6 numbers, m",
        "none",
        "The ends of a capsule, cylinder, box or ellipsoid, instead of its pose and length.",
        '<geom name="g" type="capsule" fromto="0 0 0 0 0 2" size=".1"/>',
        "equal(C.getFrame('g').getPosition(), [0, 0, 1])",
    ),
    E(
        "mesh",
        "name of an asset",
        "none",
        "Mesh of a geom.",
        '</worldbody><asset><mesh name="m" file="tetra.obj"/></asset><worldbody><geom name="g" type="mesh" mesh="m"/>',
        "len(C.getFrame('g').getMeshPoints()) == 4",
    ),
    E(
        "hfield",
        "name of an asset",
        "none",
        "Height field of a geom.",
        '</worldbody><asset><hfield name="h" nrow="2" ncol="2" size="1 1 1 .1" elevation="0 0 1 1"/></asset><worldbody><geom name="g" type="hfield" hfield="h"/>',
        "C.getFrame('g').getShapeType() == ry.ST.mesh",
    ),
    E(
        "rgba material",
        "4 numbers, 0 to 1; name of an asset",
        ".5 .5 .5 1",
        "Color.",
        '<geom name="g" size=".1" rgba="1 0 0 1"/>',
        "equal(C.getFrame('g').asDict()['color'][:3], [1, 0, 0])",
    ),
    E(
        "contype conaffinity",
        "bit masks",
        "1",
        "Two geoms collide if the type of one has a bit in common with the affinity of the other.",
        inBody('<joint/><geom name="g" size=".1" contype="0" conaffinity="0"/>'),
        "C.getFrame('g').getAttributes()['visual']",
    ),
    E(
        "group",
        "whole number",
        "0",
        "Geoms of groups 3 and above are drawn transparent.",
        '<geom name="g" size=".1" group="3"/>',
        "C.getFrame('g').asDict()['color'][3] < 1",
    ),
    E(
        "mass density",
        "kg; kg/m^3",
        "of the density; 1000",
        "Mass of bodies without `<inertial>`.",
        '<body name="a"><joint/><geom name="g" size=".1" mass="2"/></body>',
        "equal(sum(f.getMass() for f in C.getFrames()), 2)",
    ),
    E(
        "shellinertia",
        "flag",
        "false",
        "The mass is that of the surface.",
        '<body name="a"><joint/><geom name="g" type="box" size=".1 .1 .1" mass="1" shellinertia="true"/></body>',
        "equal(sum(f.getMass() for f in C.getFrames()), 1)",
    ),
    E(
        "friction",
        "1 to 3 numbers",
        "1 .005 .0001",
        "They become `friction`, `torsionalFriction` and `rollingFriction`, with the rule `max`.",
        '<geom name="g" size=".1" friction=".5"/>',
        "C.getFrame('g').getAttributes()['friction'] == 0.5",
    ),
]

INERTIAL = [
    E(
        "mass",
        "kg",
        "required",
        "Mass of the body; `pos` and the rotation are those of its center of mass.",
        '<body name="a"><inertial pos="0 0 1" mass="2" diaginertia="1 1 1"/></body>',
        "a.getMass() == 2 and equal(a.getInertia()[1], [0, 0, 1])",
    ),
    E(
        "diaginertia",
        "3 numbers, kg m^2",
        "0",
        "Principal moments.",
        '<body name="a"><inertial pos="0 0 0" mass="2" diaginertia="1 2 2.5"/></body>',
        "equal(a.getInertia()[2], np.diag([1, 2, 2.5]))",
    ),
    E(
        "fullinertia",
        "xx yy zz xy xz yz",
        "none",
        "All moments.",
        '<body name="a"><inertial pos="0 0 0" mass="2" fullinertia="1 2 2.5 .1 0 0"/></body>',
        "equal(a.getInertia()[2][0], [1, 0.1, 0])",
    ),
]

SITES = [
    E(
        "fovy",
        "degrees",
        "45",
        "Vertical field of view of a camera.",
        '<camera name="c" fovy="60"/>',
        "equal(C.getFrame('c').getAttributes()['heightAngle'], 60)",
    ),
    E(
        "resolution",
        "width height, pixels",
        "none",
        "Size of the picture.",
        '<camera name="c" resolution="64 48"/>',
        "C.getFrame('c').getAttributes()['width'] == 64",
    ),
    E(
        "mode",
        "`fixed`, ...",
        "fixed",
        "A moving camera is read as a fixed one, with a warning.",
        '<camera name="c" mode="track"/>',
        "any('fixed' in warning for warning in C.fileWarnings())",
    ),
]

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
    "`<body>` and placement": (
        "Bodies, geoms, sites, cameras and `<frame>` share these attributes of placement.",
        WORLD,
        BODY,
    ),
    "`<joint>`, `<freejoint>`": ("", WORLD, JOINT),
    "`<geom>`": ("", WORLD, GEOMS),
    "`<inertial>`": ("", WORLD, INERTIAL),
    "`<site>`, `<camera>`": ("A site becomes a marker, transparent from group 3 on.", WORLD, SITES),
    "`<actuator>`": (
        "`motor`, `position` and `general` of joints are simulated; `kinegraph info` lists all.",
        FILE,
        ACTUATORS,
    ),
    "`<equality>`, `<contact>`, `<keyframe>`, `<option>`": ("", FILE, SECTIONS_READ),
    "`<asset>`": ("", FILE, ASSETS),
    "`<compiler>`": ("", FILE, COMPILER),
    "`<replicate>`, `<attach>`, `<include>`, `<default>`": (
        "Included files and classes of defaults are read as in MuJoCo.",
        FILE,
        STRUCTURE,
    ),
}
NOT_READ = "Read as nothing, with a warning: `<composite>`, `<flexcomp>`, `<plugin>`, `<deformable>`, `<tendon>`, `<sensor>`, other kinds of `<equality>`, `solref`, `solimp`, `priority`, `margin`, `gap`, `springdamper`, and wind and fluids of `<option>`. `<visual>`, `<statistic>`, `<size>`, `<custom>` and `<extension>` are skipped."
