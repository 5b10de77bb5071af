"""Robots and things from URDF and MJCF files in a simulation: what collides, what falls, what brakes; against
MuJoCo."""

import warnings

import mujoco
import numpy as np
import pytest

import kinegraph as ry

INERTIA = '<inertial><mass value="2"/><inertia ixx=".01" ixy="0" ixz="0" iyy=".01" iyz="0" izz=".01"/></inertial>'


def load(tmp_path, text, **options):
    file = tmp_path / ("scene.urdf" if text.startswith("<robot") else "scene.xml")
    file.write_text(text)
    C = ry.Config()
    C.addFile(str(file), **options)
    return C


def simulate(C, seconds, mode=ry.ControlMode.none, u=()):
    S = ry.Simulation(C)
    for _ in range(round(seconds / 0.01)):
        S.step(u, 0.01, mode)
    return S


def box(tag, width, more=""):
    return f'<{tag}><geometry><box size="{width} {width} {width}"/></geometry>{more}</{tag}>'


TRANSPARENT = '<material name="g"><color rgba="0 0 1 .3"/></material>'
THINGS = {
    "urdf collision only": box("collision", 0.2),
    "urdf both": box("visual", 0.2) + box("collision", 0.2),
    "urdf large visual": box("visual", 0.6) + box("collision", 0.2),
    "urdf small visual": box("visual", 0.04) + box("collision", 0.2),
    "urdf transparent visual": box("visual", 0.6, TRANSPARENT) + box("collision", 0.2),
    "mjcf default": '<geom type="box" size=".1 .1 .1"/>',
    "mjcf group 3": '<geom type="box" size=".1 .1 .1" group="3"/>',
    "mjcf visual and collision": '<geom type="box" size=".3 .3 .3" contype="0" conaffinity="0" mass="0"/>'
    '<geom type="box" size=".1 .1 .1" group="3"/>',
    "mjcf transparent": '<geom type="box" size=".1 .1 .1" rgba="0 1 0 .3"/>',
    "mjcf affinity only": '<geom type="box" size=".1 .1 .1" contype="0"/>',
}


@pytest.mark.parametrize("name", THINGS)
def test_a_thing_rests_on_its_collision_shape(name, tmp_path):
    shapes = THINGS[name]
    text = (
        f'<robot name="b"><link name="box">{INERTIA}{shapes}</link></robot>'
        if name.startswith("urdf")
        else f'<mujoco><worldbody><body name="box"><freejoint/>{shapes}</body></worldbody></mujoco>'
    )
    C = load(tmp_path, text)
    C.getFrame("box").setPosition([0, 0, 0.5])
    simulate(C, 2.0)
    assert C.getFrame("box").getPosition()[2] == pytest.approx(0.1, abs=0.005)


def test_a_transparent_shape_with_contact_is_solid_unless_it_is_drawn_around_an_opaque_one():
    for around, height in (("", 0.1), ("core (ball): { shape: sphere, size: [.05] }", 0.05)):
        C = ry.Config()
        C.addText(
            f"ball: {{ X: [0 0 .5], mass: 1 }} hull (ball): {{ shape: sphere, size: [.1], color: [1 0 0 .2], contact: 1 }} {around}"
        )
        simulate(C, 2.0)
        assert C.getFrame("ball").getPosition()[2] == pytest.approx(height, abs=0.005)


def test_shapes_without_volume_that_have_contact_are_named():
    C = ry.Config()
    C.addText("sheet: { shape: quad, size: [1 1], contact: 1 }")
    with pytest.warns(ry.KinegraphWarning, match="'sheet' has contact, but shapes without a volume"):
        ry.Simulation(C)


STATIC = {
    "mjcf": '<mujoco><worldbody><body name="table" pos="0 0 1"><geom type="box" size=".5 .5 .05"/></body>'
    '<body name="cup" pos="0 0 1.2"><freejoint/><geom type="box" size=".05 .05 .05"/></body></worldbody></mujoco>',
    "urdf": '<robot name="s"><link name="world"/><link name="table"><inertial><mass value="20"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial><collision><geometry>'
    '<box size="1 1 .1"/></geometry></collision></link><joint name="w" type="fixed"><parent link="world"/>'
    '<child link="table"/><origin xyz="0 0 1"/></joint></robot>',
    "g": "world: {} table (world): { Q: [0 0 1], shape: box, size: [1 1 .1], contact: 1, mass: 20 }",
}


@pytest.mark.parametrize("name", STATIC)
def test_what_is_fixed_to_the_world_stays(name, tmp_path):
    C = ry.Config()
    if name == "g":
        C.addText(STATIC[name])
    else:
        C = load(tmp_path, STATIC[name])
    with pytest.warns(ry.KinegraphWarning, match=r"'table\w*' has a mass, but is rigidly attached to 'world'"):
        simulate(C, 1.0)
    assert C.getFrame("table").getPosition()[2] == 1.0
    assert np.allclose(C.getFrame("world").getPosition(), 0.0)
    if name == "mjcf":
        assert C.getFrame("cup").getPosition()[2] == pytest.approx(1.1, abs=0.002)


def test_the_mass_of_a_link_counts_for_the_parts_fixed_below_it(tmp_path):
    text = (
        f'<robot name="b"><link name="footprint"/><joint name="f" type="fixed"><parent link="footprint"/>'
        f'<child link="body"/></joint><link name="body">{INERTIA}{box("collision", 0.2)}</link></robot>'
    )
    C = load(tmp_path, text)
    C.getFrame("footprint").setPosition([0, 0, 0.5])
    simulate(C, 2.0)
    assert C.getFrame("body").getPosition()[2] == pytest.approx(0.1, abs=0.005)


def walker():
    legs = ""
    for x in (-0.2, 0.2):
        for y in (-0.1, 0.1):
            n = f"leg{x}{y}"
            legs += (
                f'<link name="{n}">{INERTIA}<collision><origin xyz="0 0 -.2"/><geometry><box size=".04 .04 .4"/>'
                f'</geometry></collision></link><joint name="j{n}" type="revolute"><parent link="base"/><child link="{n}"/>'
                f'<origin xyz="{x} {y} 0"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="100" velocity="9"/></joint>'
            )
    return f'<robot name="w"><link name="base">{INERTIA}{box("collision", 0.1)}</link>{legs}</robot>'


def test_a_robot_that_hangs_in_the_air_says_so(tmp_path):
    C = load(tmp_path, walker())
    C.getFrame("base").setPosition([0, 0, 0.6])
    with pytest.warns(ry.KinegraphWarning, match="the base 'base' of a robot is fixed in the air, 0.55 m above"):
        simulate(C, 1.0, ry.ControlMode.position, np.zeros(4))
    assert C.getFrame("base").getPosition()[2] == 0.6
    C.getFrame("base").setAttributes({"multibody_fixedBase": True})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ry.Simulation(C)


def test_a_floating_base_falls(tmp_path):
    C = load(tmp_path, walker(), floating=True)
    assert C.getJointDimension() == 11
    q = C.getJointState()
    C.getFrame("base").setPosition([0, 0, 0.6])
    S = ry.Simulation(C)
    for _ in range(150):
        S.step(C.getJointState(), 0.01, ry.ControlMode.position)
    assert C.getFrame("base").getPosition()[2] == pytest.approx(0.4, abs=0.01)
    assert len(S.getContacts()) >= 4
    assert len(q) == 11


def test_a_robot_without_collision_shapes_that_falls_through_the_floor_says_so(tmp_path):
    C = load(tmp_path, f'<robot name="w"><link name="ball">{INERTIA}{box("visual", 0.1)}</link></robot>', floating=True)
    ry.Simulation(C)  # nothing is there to fall through
    C.addText("floor: { shape: box, size: [4 4 .1], X: [0 0 -.3], contact: 1 }")
    with pytest.warns(ry.KinegraphWarning, match="frame 'ball' can fall, but no shape collides: nothing stops the"):
        ry.Simulation(C)
    C.getFrame("ball_0").setContact(1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ry.Simulation(C)


def test_an_attribute_lets_the_base_fall_without_a_joint(tmp_path):
    C = load(tmp_path, walker())
    base = C.getFrame("base").setPosition([0, 0, 0.6])
    base.setAttributes({"multibody_fixedBase": False})
    simulate(C, 1.5, ry.ControlMode.position, np.zeros(4))
    assert base.getPosition()[2] == pytest.approx(0.4, abs=0.01)


def test_only_a_root_that_can_move_may_float(tmp_path):
    with pytest.raises(ry.ArgumentError, match="`floating` needs a root frame that can move"):
        load(tmp_path, "<mujoco><worldbody><geom size='.1'/></worldbody></mujoco>", floating=True)


def test_links_of_a_robot_collide_as_in_plans(tmp_path):
    """A heavy pendulum of two links folds; without self-collision it would swing through its base."""
    link = '<inertial><mass value="1"/><origin xyz="0 0 .2"/><inertia ixx=".01" ixy="0" ixz="0" iyy=".01" iyz="0" izz=".01"/></inertial>'
    stick = '<collision><origin xyz="0 0 {z}"/><geometry><box size=".05 .05 {l}"/></geometry></collision>'
    joint = '<joint name="j{n}" type="revolute"><parent link="l{p}"/><child link="l{n}"/><origin xyz="0 0 {z}"/><axis xyz="0 1 0"/><limit lower="-3.1" upper="3.1" effort="99" velocity="9"/></joint>'
    text = '<robot name="f"><link name="world"/><joint name="w" type="fixed"><parent link="world"/><child link="l0"/></joint>'
    text += f'<link name="l0">{box("collision", 0.3)}</link><link name="l1">{link}{stick.format(z=0.4, l=0.3)}</link>'
    text += f'<link name="l2">{link}</link><link name="l3">{link}{stick.format(z=0.35, l=0.68)}</link>'
    text += joint.format(n=1, p=0, z=0.15) + joint.format(n=2, p=1, z=0.6) + joint.format(n=3, p=2, z=0) + "</robot>"
    C = load(tmp_path, text)
    q = np.array([0.0, 1.5, 1.5])
    C.setJointState(q)
    assert ("l0_0", "l3_0") in {tuple(c[:2]) for c in C.getCollisions()}
    C.setJointState(np.zeros(3))
    S = ry.Simulation(C)
    for i in range(300):
        S.step(q * min(i / 200, 1), 0.01, ry.ControlMode.position)
    depth = min((c[2] for c in C.getCollisions() if {"l0_0", "l3_0"} == set(c[:2])), default=0.0)
    assert depth > -0.01  # the arm stops at the base
    assert len(S.getContacts()) > 0


DYNAMICS = {
    "plain": "",
    "damping": 'damping="5"',
    "stiffness": 'stiffness="50" springref="30"',
    "frictionloss": 'frictionloss="20"',
    "armature": 'armature="5"',
}


@pytest.mark.parametrize("name", DYNAMICS)
def test_joints_of_mjcf_brake_and_spring_as_in_mujoco(name, tmp_path):
    text = f"""<mujoco><worldbody><body name="p" pos="0 0 2"><joint name="j" axis="0 1 0" {DYNAMICS[name]}/>
        <geom type="capsule" fromto="0 0 0 .5 0 0" size=".03" mass="1"/></body></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    while data.time < 1:
        mujoco.mj_step(model, data)
    C = load(tmp_path, text)
    C.getFrame("j").setAttributes({"noMotor": True})
    simulate(C, 1.0)
    assert C.getJointState()[0] == pytest.approx(data.qpos[0], abs=0.02)


def test_joints_of_urdf_brake(tmp_path):
    def swung(dynamics):
        C = load(
            tmp_path,
            f'<robot name="p"><link name="world"/><link name="arm">{INERTIA.replace("<mass", "<origin xyz=" + chr(34) + ".3 0 0" + chr(34) + "/><mass")}</link>'
            f'<joint name="j" type="continuous"><parent link="world"/><child link="arm"/><origin xyz="0 0 2"/><axis xyz="0 1 0"/>{dynamics}</joint></robot>',
        )
        C.getFrame("j").setAttributes({"noMotor": True})
        simulate(C, 0.5)
        return C.getJointState()[0]

    free, damped, held = swung(""), swung('<dynamics damping="5"/>'), swung('<dynamics friction="10"/>')
    assert free > 1.0
    assert 0.2 < damped < 0.7 * free
    assert abs(held) < 0.02


def test_contacts_of_mjcf_have_the_larger_friction(tmp_path):
    for box_friction, floor_friction in ((0.1, 0.1), (0.1, 1.0), (0.5, 0.2)):
        slope = 0.3  # rad; slides for friction below .309
        text = f"""<mujoco><worldbody>
            <geom name="floor" type="box" size="3 3 .1" axisangle="0 1 0 {np.degrees(slope)}" friction="{floor_friction}" pos="0 0 2"/>
            <body name="box" pos="0 0 2.2" axisangle="0 1 0 {np.degrees(slope)}"><freejoint/>
            <geom type="box" size=".1 .1 .05" friction="{box_friction}"/></body></worldbody></mujoco>"""
        C = load(tmp_path, text)
        simulate(C, 1.0)
        slides = np.hypot(*C.getFrame("box").getPosition()[:2]) > 0.3
        assert slides == (max(box_friction, floor_friction) < np.tan(slope))


def test_actuators_of_mjcf_limit_and_soften_the_motors(tmp_path):
    text = """<mujoco><worldbody><body name="p" pos="0 0 2"><joint name="j" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 .5 0 0" size=".03" mass="1"/></body></worldbody>
        <actuator>{}</actuator></mujoco>"""
    C = load(tmp_path, text.format('<motor joint="j" gear="2" ctrlrange="-.5 .5"/>'))
    assert C.getEffortLimits()[0] == 1.0
    simulate(C, 0.5, ry.ControlMode.position, [0.0])
    assert C.getJointState()[0] > 0.2  # 1 N m does not hold 2.45 N m
    C = load(tmp_path, text.format('<position joint="j" kp="40" kv="4" forcerange="-9 9"/>'))
    attributes = C.getFrame("j").getAttributes()
    assert (attributes["motorKp"], attributes["motorKd"]) == (40, 4)
    assert C.getEffortLimits()[0] == 9.0


def test_bodies_of_mjcf_may_compensate_gravity(tmp_path):
    text = """<mujoco><worldbody>
        <body name="a" pos="0 0 1" gravcomp="1"><freejoint/><geom size=".05"/></body>
        <body name="b" pos="1 0 1" gravcomp=".5"><freejoint/><geom size=".05"/></body></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    for _ in range(150):  # of 2 ms
        mujoco.mj_step(model, data)
    C = load(tmp_path, text)
    simulate(C, 0.3)
    for body, height in (("a", data.qpos[2]), ("b", data.qpos[9])):
        assert C.getFrame(body).getPosition()[2] == pytest.approx(height, abs=2e-3)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 2.0])
def test_actuators_of_mjcf_may_give_a_damping_ratio(ratio, tmp_path):
    text = f"""<mujoco><worldbody><body name="p" pos="0 0 2">
        <joint name="j" axis="0 1 0" armature=".1"/>
        <geom type="capsule" fromto="0 0 0 .5 0 0" size=".03" mass="1"/></body></worldbody>
        <actuator><position joint="j" kp="40" dampratio="{ratio}"/></actuator></mujoco>"""
    damping = -mujoco.MjModel.from_xml_string(text).actuator_biasprm[0, 2]  # N m s, computed by MuJoCo
    paths = []
    for number, gains in enumerate((f'dampratio="{ratio}"', f'kv="{damping}"')):
        (tmp_path / str(number)).mkdir()
        C = load(tmp_path / str(number), text.replace(f'dampratio="{ratio}"', gains))
        S = ry.Simulation(C)
        paths.append([])
        for _ in range(40):
            S.step([0.5], 0.01, ry.ControlMode.position)
            paths[-1].append(C.getJointState()[0])
    assert paths[0] == pytest.approx(paths[1], abs=1e-6)
    assert paths[0][-1] > 0.1


def test_what_of_mjcf_is_not_simulated_is_said(tmp_path):
    with pytest.warns(
        ry.KinegraphWarning, match=r"not part of the simulation: geom condim=1, geom solref, option wind"
    ):
        load(
            tmp_path,
            '<mujoco><option wind="1 0 0"/><worldbody><geom size=".1" solref=".1 1" condim="1"/></worldbody></mujoco>',
        )


def test_a_plane_is_endless_and_replaces_the_ground(tmp_path):
    text = """<mujoco><worldbody><geom name="floor" type="plane" size="1 1 .1" pos="0 0 -1"/>
        <body name="ball" pos="30 0 0"><freejoint/><geom size=".1"/></body></worldbody></mujoco>"""
    C = load(tmp_path, text)
    simulate(C, 2.0)
    assert C.getFrame("ball").getPosition()[2] == pytest.approx(-0.9, abs=0.005)


def rebound(attributes: str, ground: str = "", height: float = 0.5, shape: str = "shape: sphere, size: [.05]") -> float:
    """The share of the velocity after the first impact of a body that falls on a plate."""
    C = ry.Config()
    C.addText(
        f"plate: {{ X: [0 0 .1], shape: box, size: [2 2 .2] {ground} }}\n"
        f"ball: {{ X: [0 0 {0.25 + height}], {shape}, mass: .3, contact: 1 {attributes} }}"
    )
    S, ball, heights = ry.Simulation(C), C.getFrame("ball"), []
    for _ in range(500):
        S.step()
        heights.append(ball.getPosition()[2])
    first = next(i for i in range(1, 499) if heights[i] < heights[i - 1] and heights[i] <= heights[i + 1])
    return float(np.sqrt(max(max(heights[first:]) - 0.25, 0) / height))


@pytest.mark.parametrize("restitution", [0.3, 0.5, 0.7, 0.9, 1.0])
@pytest.mark.parametrize("height", [0.1, 0.5, 1.0])
def test_balls_bounce_as_high_as_their_restitution_says(restitution: float, height: float) -> None:
    assert rebound(f", restitution: {restitution}", height=height) == pytest.approx(restitution, abs=0.03)


def test_of_two_restitutions_the_larger_one_counts() -> None:
    for ball, plate in (("", 0.8), (0.8, ""), (0.8, 0.4), (0.4, 0.8), (0.8, 0.8)):
        got = rebound(*(f", restitution: {x}" if x else "" for x in (ball, plate)))
        assert got == pytest.approx(0.8, abs=0.03), (ball, plate)
    assert rebound("") < 0.25
    assert rebound(", restitution: .1") < 0.25
    with pytest.raises(ry.ArgumentError, match="'ball' has restitution 1.5; expected 0 to 1"):
        rebound(", restitution: 1.5")


def test_what_bounces_comes_to_rest() -> None:
    C = ry.Config()
    C.addText(
        "stack: { X: [0 0 .3], shape: box, size: [.2 .2 .2], mass: 1, contact: 1, restitution: .6 }\n"
        "above: { X: [0 0 .8], shape: box, size: [.2 .2 .2], mass: 2, contact: 1, restitution: .3, friction: .5 }"
    )
    S = ry.Simulation(C)
    for _ in range(500):
        S.step()
    assert C.getFrame("stack").getPosition() == pytest.approx([0, 0, 0.1], abs=2e-3)
    assert C.getFrame("above").getPosition() == pytest.approx([0, 0, 0.3], abs=4e-3)
