"""Robot files with flaws: a robot with a warning that says what was assumed, or an error under strict=True."""

import os
import struct
import sys
import types
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from flawed_robots import ARM, urdf

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"

TRIANGLE = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)

STL = b"\0" * 80 + struct.pack("<I", 4) + 4 * TRIANGLE


def mesh(name: str, element: str = "visual", more: str = "") -> str:
    return f'<{element}><geometry><mesh filename="{name}" {more}/></geometry></{element}>'


@pytest.mark.parametrize(
    "name, content",
    [
        ("v.stl", b"version https://git-lfs.github.com/spec/v1\noid sha256:0123\nsize 48211\n"),
        ("v.stl", b"solid a\nendsolid a\n"),
        ("v.stl", b""),
        ("v.stl", STL[:-20]),
        ("v.step", b"ISO-10303-21;\n"),
    ],
)
@pytest.mark.parametrize("element", ["visual", "collision"])
def test_a_mesh_that_cannot_be_read_is_a_warning(name: str, content: bytes, element: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.warns(ry.KinegraphWarning, match=r"r.urdf:1:\d+: link 'a': mesh file .*the shape is left out"):
        C = urdf(tmp_path, mesh(name, element))
    assert C.getJointDimension() == 1 and C.getFrame("a_0").getShapeType() == ry.ST.none
    with pytest.raises(ry.ParseError, match="the shape is left out"):
        urdf(tmp_path, mesh(name, element), strict=True)


@pytest.mark.parametrize(
    "name, content",
    [("v.stl", STL + b"\0\0\0"), ("V.STL", STL), ("v.stl", STL.replace(b"\0" * 80, b"solid".ljust(80, b"\0")))],
)
def test_stl_files_of_careless_writers_are_read(name: str, content: bytes, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    C = urdf(tmp_path, mesh(name))
    assert C.getFrame("a_0").getMeshPoints().shape == (3, 3)  # equal corners are one vertex


def test_obj_files_may_write_numbers_without_a_leading_zero(tmp_path: Path) -> None:
    (tmp_path / "t.obj").write_text(TETRAHEDRON.replace("1 0 0", "-.5 0 0"))
    np.testing.assert_allclose(urdf(tmp_path, mesh("t.obj")).getFrame("a_0").getMeshPoints().min(), -0.5)


@pytest.mark.parametrize("file, name", [("a b.obj", "a%20b.obj"), ("m$x.obj", "m$x.obj"), ("m/c.obj", "m\\c.obj")])
def test_odd_names_of_meshes_are_found(file: str, name: str, tmp_path: Path) -> None:
    (tmp_path / file).parent.mkdir(exist_ok=True)
    (tmp_path / file).write_text(TETRAHEDRON)
    assert urdf(tmp_path, mesh(name)).getFrame("a_0").getShapeType() == ry.ST.mesh


def test_names_of_meshes_with_variables_and_schemes_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "t.obj").write_text(TETRAHEDRON)
    monkeypatch.setenv("ROBOT_MESHES", str(tmp_path / "meshes"))
    absolute = tmp_path / "meshes" / "t.obj"
    for name in ("$ROBOT_MESHES/t.obj", "${ROBOT_MESHES}/t.obj", f"file://{absolute}", f"file:{absolute}"):
        assert urdf(tmp_path, mesh(name)).getFrame("a_0").getShapeType() == ry.ST.mesh


def test_a_mesh_of_other_capitals_is_read_with_a_warning(tmp_path: Path) -> None:
    (tmp_path / "Base.OBJ").write_text(TETRAHEDRON)
    with pytest.warns(ry.KinegraphWarning, match="'Base.OBJ' is read instead"):
        assert urdf(tmp_path, mesh("base.obj")).getFrame("a_0").getShapeType() == ry.ST.mesh


def test_a_robot_whose_package_is_somewhere_in_the_workspace_has_its_meshes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "src" / "repository" / "arm-main"
    (package / "meshes").mkdir(parents=True)
    (package / "meshes" / "t.obj").write_text(TETRAHEDRON)
    (package / "package.xml").write_text("<package><name>arm_description</name></package>")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    C = urdf(tmp_path / "elsewhere", mesh("package://arm_description/meshes/t.obj"))
    assert C.getFrame("a_0").getShapeType() == ry.ST.mesh


def test_warnings_are_kept_with_the_scene(tmp_path: Path) -> None:
    with pytest.warns(ry.KinegraphWarning) as raised:
        C = urdf(tmp_path, mesh("lost.stl"), '<limit lower="1" upper="-1" effort="1" velocity="1"/>', "prismatic")
    assert C.fileWarnings() == [str(warning.message) for warning in raised]
    assert [w.split("r.urdf:")[1].split(":")[0] for w in C.fileWarnings()] == ["1", "1"]
    assert C.copy().fileWarnings() == C.fileWarnings()
    C.clear()
    assert C.fileWarnings() == []


def test_a_strict_file_leaves_the_scene_as_it_was(tmp_path: Path) -> None:
    file = tmp_path / "m.xml"
    file.write_text('<mujoco><worldbody><geom size=".1" rgba="1 0 0"/></worldbody></mujoco>')
    C = ry.Config()
    with pytest.raises(ry.ParseError, match="m.xml:1:36: .*the alpha is read as 1"):
        C.addFile(file, strict=True)
    assert len(C) == 0
    with pytest.raises(ry.ParseError, match="unknown attribute 'colour'"):
        C.addText("a: { shape: box, size: [1 1 1], colour: [1] }", strict=True)
    with pytest.warns(ry.KinegraphWarning, match="rgba"):
        C.addFile(file)
    assert len(C) == 2


def test_files_in_utf16_are_read(tmp_path: Path) -> None:
    file = tmp_path / "r.urdf"
    file.write_bytes('<robot name="r"><link name="brazo_é"/></robot>'.encode("utf-16"))
    C = ry.Config()
    C.addFile(file)
    assert C.getFrameNames() == ["brazo_é"]


def test_a_mesh_shared_by_two_shapes_is_read_once(tmp_path: Path) -> None:
    (tmp_path / "t.stl").write_bytes(STL)
    C = urdf(tmp_path, mesh("t.stl") + mesh("t.stl", "collision"))
    points = [C.getFrame(name).getMeshPoints() for name in ("a_0", "a_1")]
    np.testing.assert_array_equal(*points)


def test_actuators_of_mjcf_files_are_listed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from kinegraph.cli import main

    file = tmp_path / "m.xml"
    file.write_text(
        '<mujoco><default><position kp="100"/></default><worldbody><body name="arm"><joint name="j"/><geom size=".1"/>'
        '</body></worldbody><actuator><position name="servo" joint="j" ctrlrange="-1 1"/></actuator></mujoco>'
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)
        assert main(["info", str(file)]) == 0
    assert "actuators (1):\n  servo: position of joint j (ctrlrange -1 1, kp 100)" in capsys.readouterr().out


XACRO = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="arm"><xacro:arg name="name" default="arm"/>
<xacro:include filename="part.xacro"/><link name="$(arg name)_base"/></robot>"""


def test_files_with_macros_load_with_their_arguments(tmp_path: Path) -> None:
    pytest.importorskip("xacrodoc", reason="needs the extra xacro")
    (tmp_path / "arm.urdf.xacro").write_text(XACRO)
    (tmp_path / "part.xacro").write_text('<robot xmlns:xacro="http://www.ros.org/wiki/xacro"/>')
    C = ry.Config()
    C.addFile(tmp_path / "arm.urdf.xacro", xacro={"name": "ur5e"})
    assert C.getFrameNames() == ["ur5e_base"]
    with pytest.raises(ry.FileError, match="has no xacro argument 'nmae'; it has: name"):
        C.addFile(tmp_path / "arm.urdf.xacro", xacro={"nmae": "ur5e"})
    empty = (tmp_path / "part.xacro").read_text()
    (tmp_path / "none.xacro").write_text(empty)
    (tmp_path / "part.xacro").write_text(empty.replace("/>", '><xacro:arg name="speed" default="1"/></robot>'))
    (tmp_path / "other.xacro").write_text(XACRO.replace("part.", "none."))
    ry.Config().addFile(tmp_path / "arm.urdf.xacro", xacro={"speed": "2"})
    with pytest.raises(ry.FileError, match="has no xacro argument 'speed'; it has: name"):
        C.addFile(tmp_path / "other.xacro", xacro={"speed": "2"})
    assert C.getFrameNames() == ["ur5e_base"]


def test_without_the_extra_the_error_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xacrodoc", None)
    monkeypatch.setitem(sys.modules, "xacro", types.ModuleType("xacro"))
    (tmp_path / "arm.urdf.xacro").write_text(XACRO)
    with pytest.raises(ry.FileError, match=r"pip install kinegraph\[xacro\]"):
        ry.Config().addFile(tmp_path / "arm.urdf.xacro")


def test_a_ros_package_has_the_name_of_its_package_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "arm-main"
    folder.mkdir()
    (folder / "package.xml").write_text('<package format="3">\n  <name> arm_description </name></package>')
    (folder / "arm7.urdf").write_text('<robot name="arm7"><link name="base"/></robot>')
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    assert ry.robotPath("arm_description/arm7") == str(folder / "arm7.urdf")
    assert "arm-main/arm7" not in ry.robotNames()


def test_robots_of_ros_packages_are_found_by_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "vendor" / "arm_description"
    (package / "urdf").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>arm_description</name></package>")
    (package / "urdf" / "arm7.urdf").write_text('<robot name="arm7"><link name="base"/></robot>')
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    assert "arm_description/arm7" in ry.robotNames()
    C = ry.Config()
    C.addFile(ry.robotPath("arm7"))
    assert C.getFrameNames() == ["base"] and ry.robotPath("arm_description/arm7") == ry.robotPath("arm7")
    with pytest.raises(ry.FileError, match="similar names: .*arm7"):
        ry.robotPath("arm_7")


@pytest.mark.skipif(
    "example-robot-data" not in str(os.environ.get("KINEGRAPH_PACKAGE_PATH"))
    and not any(n.startswith("example-robot-data/") for n in ry.robotNames()),
    reason="needs robots: pip install example-robot-data==6.0.0",
)
def test_robots_of_example_robot_data_are_found_by_name() -> None:
    assert ry.robotPath("panda").endswith("panda.urdf")


def test_shipped_scenes_are_found_by_their_names(tmp_path: Path) -> None:
    own = tmp_path / "own.g"
    own.write_text("Prefix: my_\nInclude: <scenarios/pandaSingle.g>\nbin: { shape: box, size: [.1 .1 .1] }\n")
    C = ry.Config()
    C.addFile(own, strict=True)
    D = ry.Config()
    D.addFile(ry.raiPath("scenarios/pandaSingle.g"), "my_")
    assert C.getFrameNames() == [*D.getFrameNames(), "bin"]
    (tmp_path / "scenarios").mkdir()
    (tmp_path / "scenarios" / "pandaSingle.g").write_text("mine: {}\n")
    C = ry.Config()
    C.addFile(own)
    assert C.getFrameNames() == ["my_mine", "bin"]  # a file beside the scene comes first


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("scenarios/pandaSingel.g", r"the shipped models have <\$RAI_PATH/scenarios/pandaSingle.g>"),
        ("pandaSingle.g", r"the shipped models have <\$RAI_PATH/scenarios/pandaSingle.g>"),
        ("tabel.g", "similar names: table.g"),
    ],
)
def test_a_missing_include_names_similar_files(name: str, hint: str, tmp_path: Path) -> None:
    (tmp_path / "table.g").write_text("table: {}\n")
    own = tmp_path / "own.g"
    own.write_text(f"Include: <{name}>\n")
    with pytest.raises(ry.ParseError, match=rf"own.g:1:\d+: scene file .*{hint}"):
        ry.Config().addFile(own)
    if name.startswith("scenarios"):
        with pytest.raises(ry.FileError, match=hint):
            ry.Config().addFile(name)


def test_a_text_of_triangles_that_ends_within_one_is_truncated(tmp_path: Path) -> None:
    corner = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    facet = f"facet normal 0 0 1\nouter loop\n{corner}endloop\nendfacet\n"
    (tmp_path / "v.stl").write_text(f"solid x\n{facet}facet normal 0")
    with pytest.warns(ry.KinegraphWarning, match="truncated"):
        C = urdf(tmp_path, mesh("v.stl"))
    assert C.getFrame("a_0").getShapeType() == ry.ST.none
    (tmp_path / "v.stl").write_text(f"solid x\n{facet}")  # without its last word
    assert urdf(tmp_path, mesh("v.stl")).fileWarnings() == []


@pytest.mark.parametrize("name", ["package://some_description/meshes/visual/v.stl", "v.stl", "/home/me/v.stl"])
def test_meshes_of_robots_for_mujoco_are_in_its_folder(name: str, tmp_path: Path) -> None:
    """MuJoCo drops folders from the names of meshes in URDF files, and reads them from `meshdir`."""
    (tmp_path / "assets").mkdir()
    (tmp_path / "assets" / "v.stl").write_bytes(STL)
    file = tmp_path / "r.urdf"
    shapes = ARM.format(shape=mesh(name), type="continuous", joint="")
    for folder, shape in [("assets", ry.ST.mesh), ("elsewhere", ry.ST.none)]:
        file.write_text(f'<robot name="r"><mujoco><compiler meshdir="{folder}"/></mujoco>{shapes}</robot>')
        C = ry.Config()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ry.KinegraphWarning)
            C.addFile(file)
        assert C.getFrame("a_0").getShapeType() == shape
        assert bool(C.fileWarnings()) == (folder == "elsewhere")


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("cup.OBJ", "is a mesh; scenes are .* setMeshFile"),
        ("room.sdf", "is SDFormat, .* Convert it to URDF"),
        ("room.usda", "is USD, .* Convert it to MJCF or URDF"),
        ("arm.mjb", "is a compiled model of MuJoCo, .* load the .xml file"),
    ],
)
def test_files_of_other_kinds_are_named(name: str, told: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(TETRAHEDRON)
    C = ry.Config()
    with pytest.raises(ry.FileError, match=f"{name}' {told}"):
        C.addFile(tmp_path / name)
    with pytest.raises(ry.FileError, match="does not exist"):
        C.addFile(f"no{name}")
    (tmp_path / "scene.g").write_text(f"a: {{ shape: box, size: [1 1 1] }}\nInclude: <{name}>\n")
    with pytest.raises(ry.ParseError, match=f"scene.g:2:.*{name}' {told}"):
        C.addFile(tmp_path / "scene.g")
    assert C.getFrameNames() == []
