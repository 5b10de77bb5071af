"""Masses of MJCF files: the rules of <compiler>, <geom> and <mesh>, compared with MuJoCo."""

import mujoco
import numpy as np
import pytest

import kinegraph as ry

TWO = (
    '<geom type="box" size=".1 .2 .3" pos=".1 0 0" euler="10 20 30"/>'
    '<geom type="box" size=".1 .1 .1" group="1" contype="0" conaffinity="0"/>'
)
WEDGE = 'vertex="0 0 0 .2 0 0 0 .3 0 0 0 .1 .05 .05 .06" face="0 2 1 0 1 3 0 3 2 1 2 4 2 3 4 3 1 4"'


def mesh(mode):
    return (
        f'<asset><mesh name="m" {WEDGE} {mode}/></asset>',
        '<geom type="mesh" mesh="m" pos=".1 .2 .3" euler="5 6 7"/>',
    )


# a box whose upper face is pulled in: pyramids around its center of mass overlap
DENTED = (
    '<asset><mesh name="m" vertex="-1 -1 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 1 1 -1 1 1 1 1 -1 1 1 .3 .2 -.8" scale=".1 .1 .1" '
    'face="0 2 1 0 3 2 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7 4 5 8 5 6 8 6 7 8 7 4 8"/></asset>'
)
CASES = {
    "plain": ("", TWO),
    "group range": ('<compiler inertiagrouprange="0 0"/>', TWO),
    "group range of the other": ('<compiler inertiagrouprange="1 3"/>', TWO),
    "total mass": ('<compiler settotalmass="3"/>', TWO),
    "bound mass": ('<compiler boundmass="1" boundinertia=".1"/>', '<geom size=".001"/>'),
    "bound mass is not needed": ('<compiler boundmass="1"/>', TWO),
    "bound and total": ('<compiler boundmass="1" boundinertia=".01" settotalmass="7"/>', '<geom size=".001"/>'),
    "balance": (
        '<compiler balanceinertia="true"/>',
        '<inertial pos=".1 0 0" mass="1" diaginertia="1 1 5"/><geom size=".1"/>',
    ),
    "only geoms": ('<compiler inertiafromgeom="true"/>', '<inertial pos="0 0 0" mass="9" diaginertia="1 1 1"/>' + TWO),
    "shell box": ("", '<geom type="box" size=".1 .2 .3" shellinertia="true" density="5"/>'),
    "shell ball": ("", '<geom size=".1" shellinertia="true" density="5"/>'),
    "shell cylinder": ("", '<geom type="cylinder" size=".1 .3" shellinertia="true" mass="2"/>'),
    "shell capsule": ("", '<geom type="capsule" size=".1 .3" shellinertia="true" density="5"/>'),
    "shell ellipsoid": ("", '<geom type="ellipsoid" size=".1 .2 .3" shellinertia="true" density="5"/>'),
    "mesh": mesh(""),
    "mesh exact": mesh('inertia="exact"'),
    "mesh legacy": mesh('inertia="legacy"'),
    "mesh convex": mesh('inertia="convex"'),
    "mesh shell": mesh('inertia="shell"'),
    "dented mesh": (DENTED, '<geom type="mesh" mesh="m"/>'),
    "dented mesh exact": (DENTED.replace("/><", ' inertia="exact"/><'), '<geom type="mesh" mesh="m"/>'),
    "mesh mirrored": mesh('scale="-1 2 1" inertia="exact"'),
    "mesh of points": (
        '<asset><mesh name="m" vertex="0 0 0 .2 0 0 0 .2 0 0 0 .2"/></asset>',
        '<geom type="mesh" mesh="m"/>',
    ),
    "mesh with a mass": (mesh('inertia="exact"')[0], '<geom type="mesh" mesh="m" mass="3"/>'),
}
for primitive in ("sphere", "box", "capsule", "cylinder", "ellipsoid"):
    for bounds in ("true", "false"):
        CASES[f"{primitive} fitted to a mesh, bounds {bounds}"] = (
            f'<compiler fitaabb="{bounds}"/>' + mesh('scale="1 -1 2"')[0],
            f'<geom type="{primitive}" mesh="m" pos=".1 .2 .3" euler="5 6 7" fitscale="1.1"/>',
        )


JOINTS = (
    '<joint type="slide" axis="1 0 0"/><joint axis="1 0 0"/><joint axis="0 1 0" pos=".1 0 0"/><joint axis="0 0 1"/>'
)


@pytest.mark.parametrize("name", CASES)
def test_masses_and_inertias_follow_the_rules_of_the_file(name, tmp_path):
    head, geoms = CASES[name]
    text = f'<mujoco>{head}<worldbody><body name="a">{JOINTS}{geoms}</body></worldbody></mujoco>'
    model = mujoco.MjModel.from_xml_string(text)
    (tmp_path / "s.xml").write_text(text)
    C = ry.Config()
    C.addFile(str(tmp_path / "s.xml"))
    assert sum(frame.getMass() for frame in C.getFrames()) == pytest.approx(float(model.body_mass.sum()), rel=2e-6)
    data = mujoco.MjData(model)
    data.qpos[:] = [0.1, 0.2, 0.3, 0.4]
    mujoco.mj_forward(model, data)
    expected = np.zeros((4, 4))
    mujoco.mj_fullM(model, data, expected)
    C.setJointState(data.qpos)
    M, _ = C.equationOfMotion(np.zeros(4))
    np.testing.assert_allclose(M, expected, rtol=1e-5, atol=1e-7)


def test_a_stated_mass_counts_where_the_mesh_is_missing(tmp_path):
    (tmp_path / "s.xml").write_text(
        '<mujoco><asset><mesh name="m" file="none.stl"/></asset><worldbody><body name="a"><joint/>'
        '<geom type="mesh" mesh="m" mass="3"/></body></worldbody></mujoco>'
    )
    C = ry.Config()
    with pytest.warns(ry.KinegraphWarning, match="none.stl"):
        C.addFile(str(tmp_path / "s.xml"))
    assert sum(frame.getMass() or 0 for frame in C.getFrames()) == 3


def test_a_primitive_with_a_mesh_is_fitted_to_it_as_in_mujoco(tmp_path):
    head, _ = mesh("")
    for kind in ("sphere", "capsule", "cylinder", "box", "ellipsoid"):
        text = (
            f"""<mujoco>{head}<worldbody><geom name="g" type="{kind}" mesh="m" pos=".1 .2 .3"/></worldbody></mujoco>"""
        )
        model = mujoco.MjModel.from_xml_string(text)
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        (tmp_path / "s.xml").write_text(text)
        C = ry.Config()
        C.addFile(str(tmp_path / "s.xml"))
        frame = C.getFrame("g")
        np.testing.assert_allclose(frame.getPosition(), data.geom_xpos[0], atol=1e-7)
        size = np.array(frame.getSize())
        expected = model.geom_size[0]
        if kind == "sphere":
            np.testing.assert_allclose(size, expected[:1], rtol=1e-6)
        elif kind in ("capsule", "cylinder"):
            np.testing.assert_allclose(size, [2 * expected[1], expected[0]], rtol=1e-6)
            axis = frame.getRotationMatrix()[:, 2] @ data.geom_xmat[0].reshape(3, 3)[:, 2]
            assert abs(axis) == pytest.approx(1, abs=1e-6)
        elif kind == "box":
            np.testing.assert_allclose(size, 2 * expected, rtol=1e-6)
        else:
            np.testing.assert_allclose(size[3:6], expected, rtol=1e-6)
