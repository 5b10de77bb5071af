"""What is below <worldbody> in MJCF: bodies, joints, geoms, inertias, sites."""

from .entries import Entry as E

DOCUMENT = '<mujoco><compiler angle="radian"/><worldbody>{}</worldbody></mujoco>'
GEOM = '<geom size=".1"/>'


def inBody(text: str) -> str:
    return f'<body name="a">{text}{GEOM}</body>'


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

SECTIONS = {
    "`<body>` and placement": (
        "Bodies, geoms, sites, cameras and `<frame>` share these attributes of placement.",
        BODY,
    ),
    "`<joint>`, `<freejoint>`": ("", JOINT),
    "`<geom>`": ("", GEOMS),
    "`<inertial>`": ("", INERTIAL),
    "`<site>`, `<camera>`": ("A site becomes a marker, transparent from group 3 on.", SITES),
}
