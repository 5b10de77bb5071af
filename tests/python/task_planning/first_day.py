"""Scenes as somebody would set them up on the first day: boxes and trays on a table beside a Panda."""

import kinegraph as ry

TOP = 0.65  # m: height of the table


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def box(C, name, parent, position, size=(0.05, 0.05, 0.07)) -> ry.Frame:
    frame = C.addFrame(name, parent).setPosition([*position[:2], position[2] + 0.5 * size[2]])
    return frame.setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1).setMass(0.1).setJoint(ry.JT.rigid)


def tray(C, size=(0.2, 0.2, 0.01)) -> ry.Frame:
    frame = C.addFrame("tray", "table").setPosition([-0.3, 0.3, TOP + 0.5 * size[2]])
    return frame.setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1)


def crane(sign: int) -> ry.Config:
    """A hand with two turning fingers at slides; the root of the robot has a pose. sign 1: larger positions open."""
    low, high = (-0.25, 0.6) if sign > 0 else (-0.6, 0.25)
    C = ry.Config()
    C.addText(f"""
table: {{ X: [0 0 .55], shape: ssBox, size: [1.6 1.6 .1 .005], contact: 1, logical: {{ is_place }} }}
mast: {{ X: [0 0 1.1], multibody: true }}
slide_x (mast): {{ joint: transX, limits: [-.6 .6] }}
slide_y (slide_x): {{ joint: transY, limits: [-.6 .6] }}
slide_z (slide_y): {{ joint: transZ, limits: [-.4 .2] }}
yaw (slide_z): {{ joint: hingeZ, limits: [-2 2] }}
palm (yaw): {{ shape: ssBox, size: [.14 .05 .04 .005], contact: -3, mass: 1 }}
f1_base (palm): {{ Q: [.035 0 -.03] }}
f1 (f1_base): {{ joint: hingeY, joint_active: false, q: {0.1 * sign}, limits: [{low} {high}], joint_scale: {-sign} }}
f1_shape (f1): {{ Q: [0 0 -.06], shape: ssBox, size: [.015 .02 .1 .003], contact: -3, mass: .05 }}
f2_base (palm): {{ Q: [-.035 0 -.03] }}
f2 (f2_base): {{ joint: hingeY, mimic: f1, joint_active: false, joint_scale: -1 }}
f2_shape (f2): {{ Q: [0 0 -.06], shape: ssBox, size: [.015 .02 .1 .003], contact: -3, mass: .05 }}
gripper (palm): {{ Q: [0 0 -.12], shape: marker, size: [.05], logical: {{ is_gripper }} }}
tray: {{ X: [.3 .3 .605], shape: ssBox, size: [.3 .3 .01 .004], contact: 1, logical: {{ is_place }} }}
box (table): {{ X: [-.3 .2 .64], shape: ssBox, size: [.04 .04 .08 .004], contact: 1, mass: .1, joint: rigid }}""")
    return C
