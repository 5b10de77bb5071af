"""Shapes of frames: meshes, lines, grids, convex parts."""

import numpy as np
import pytest

import kinegraph as ry
from conftest import DATA
from test_structure import TETRAHEDRON


def sphere_grid(n: int = 20, radius: float = 0.5) -> np.ndarray:
    """Signed distance to a sphere on a grid from -1 to 1."""
    axes = np.mgrid[-1 : 1 : n * 1j, -1 : 1 : n * 1j, -1 : 1 : n * 1j]
    return np.sqrt((axes**2).sum(axis=0)) - radius


@pytest.fixture
def frame() -> ry.Frame:
    return ry.Config().addFrame("f")


def outward(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return (np.cross(b - a, c - a) * a).sum(axis=1)


def test_a_level_set_is_a_closed_surface_at_zero(frame):
    frame.setImplicitSurface(sphere_grid(), [2, 2, 2])
    points, triangles, _ = frame.getMesh()
    assert frame.getShapeType() == ry.ST.mesh
    assert np.abs(np.linalg.norm(points, axis=1) - 0.5).max() < 0.01
    assert (outward(points, triangles) > -1e-12).all()
    edges = {}
    for a, b, c in triangles.tolist():
        for edge in ((a, b), (b, c), (c, a)):
            edges[edge] = edges.get(edge, 0) + 1
    assert all(count == 1 and (b, a) in edges for (a, b), count in edges.items())
    volume = outward(points, triangles).sum() / 6
    assert volume == pytest.approx(4 / 3 * np.pi * 0.5**3, rel=0.03)


def test_a_plane_level_set_is_exact_at_any_resolution(frame):
    z = np.linspace(-1, 1, 7)[None, None, :] * np.ones((3, 4, 1)) - 0.25
    frame.setImplicitSurface(z, [1, 1, 2], resample=0.11)
    assert np.allclose(frame.getMeshPoints()[:, 2], 0.25, atol=1e-6)
    frame.setImplicitSurface(data=z, size=[1, 1, 2], blur=2)
    assert np.allclose(frame.getMeshPoints()[:, 2], 0.25, atol=1e-6)


def test_blurring_shrinks_a_ball_a_little(frame):
    frame.setImplicitSurface(sphere_grid(), [2, 2, 2], 3)
    radii = np.linalg.norm(frame.getMeshPoints(), axis=1)
    assert 0.4 < radii.mean() < 0.49


@pytest.mark.parametrize(
    "grid, size, words",
    [
        (np.ones((3, 3, 3)), [1, 1, 1], "never cross zero"),
        (np.ones((3, 3)), [1, 1, 1], "2 dimensions"),
        (np.ones((1, 3, 3)), [1, 1, 1], "2 x 2 x 2"),
        (np.full((3, 3, 3), np.nan), [1, 1, 1], "finite"),
        (sphere_grid(4), [1, 1], "expected 3 numbers for size"),
    ],
)
def test_grids_that_make_no_surface_are_refused(frame, grid, size, words):
    with pytest.raises(ry.ArgumentError, match=words):
        frame.setImplicitSurface(grid, size)
    assert frame.getShapeType() == ry.ST.none


def test_a_tensor_is_a_box_of_numbers(frame):
    frame.setTensorShape(np.zeros((3, 4, 5), dtype=np.float32), [1, 2, 3])
    assert frame.getShapeType() == ry.ST.tensor and np.allclose(frame.getSize(), [1, 2, 3])


def test_an_sdf_is_the_solid_where_its_grid_is_not_positive():
    C = ry.Config()
    ticks = np.linspace(-0.3, 0.3, 25)
    x, y, z = np.meshgrid(ticks, ticks, ticks, indexing="ij")
    C.addFrame("solid").setSdf(np.sqrt(x**2 + y**2 + z**2) - 0.2, [0.6, 0.6, 0.6]).setContact(1)
    C.addFrame("ball").setShape(ry.ST.sphere, [0.05]).setPosition([0.24, 0, 0]).setContact(1)
    C.addFrame("box").setShape(ry.ST.box, [0.1, 0.1, 0.1]).setPosition([0, 0.27, 0]).setContact(1)
    assert C.getFrame("solid").getShapeType() == ry.ST.sdf
    assert C.getFrame("solid").getMeshPoints().shape[0] > 100
    [(a, b, depth)] = C.getCollisions()
    assert (a, b) == ("solid", "ball") and np.isclose(depth, -0.01, atol=1e-3)
    assert np.isclose(C.eval(ry.FS.negDistance, ["solid", "box"])[0][0], -0.02, atol=1e-3)
    C.getFrame("ball").setPosition([0.3, 0, 0])
    assert not C.getCollisions()
    with pytest.raises(ry.ArgumentError, match="finite"):
        C.getFrame("solid").setSdf(np.full((3, 3, 3), np.nan), [1, 1, 1])


def test_an_sdf_is_read_from_a_file(tmp_path):
    ticks = np.linspace(-0.3, 0.3, 13)
    x, y, z = np.meshgrid(ticks, ticks, ticks, indexing="ij")
    values = np.sqrt(x**2 + y**2 + z**2) - 0.2
    (tmp_path / "ball.sdf").write_text(
        f"lo: [-.3 -.3 -.3]\nup: [.3 .3 .3]\nfield: <13 13 13> [{' '.join(f'{v:.7g}' for v in values.flat)}]\n"
    )
    scene = tmp_path / "scene.g"
    scene.write_text(
        "solid: { X: [1 0 0], sdf: <ball.sdf>, contact: 1 }\n"
        "ball: { X: [1.24 0 0], shape: sphere, size: [.05], contact: 1 }"
    )
    C, same = ry.Config(), ry.Config()
    C.addFile(str(scene))
    solid = C.getFrame("solid")
    assert solid.getShapeType() == ry.ST.sdf and np.allclose(solid.getSize(), [0.6, 0.6, 0.6])
    assert np.isclose(C.getCollisions()[0][2], -0.01, atol=2e-3)
    same.addText(C.write())
    assert same.getFrame("solid").getShapeType() == ry.ST.sdf and np.isclose(
        same.getCollisions()[0][2], C.getCollisions()[0][2], atol=1e-6
    )
    for text, parts in [
        ("solid: { sdf: <bal.sdf> }", ["scene.g:1", "'solid'", "does not exist"]),
        ("solid: { shape: box, size: [1 1 1], sdf: <ball.sdf> }", ["box has no grid"]),
    ]:
        scene.write_text(text)
        with pytest.raises(ry.Error) as raised:
            ry.Config().addFile(str(scene))
        assert all(part in str(raised.value) for part in parts), raised.value


def test_a_point_cloud_and_a_divided_mesh_collide_as_what_they_are():
    C = ry.Config()
    C.addFrame("cloud").setPointCloud([[0, 0, 0], [1, 0, 0]]).setContact(1)
    C.addFrame("ball").setShape(ry.ST.sphere, [0.1]).setPosition([0.5, 0, 0]).setContact(1)
    assert not C.getCollisions() and np.isclose(C.getCollisions(1.0)[0][2], 0.4)
    boxes = np.array([[x, y, z] for x in (0, 0.1) for y in (0, 0.1) for z in (0, 0.1)])
    vertices = np.vstack([boxes, np.add(boxes, [0.9, 0, 0])])
    C.getFrame("cloud").setMesh(vertices, [[0, 1, 3], [0, 2, 6], [8, 9, 11], [8, 10, 14]], cvxParts=[0, 8])
    assert np.isclose(C.getCollisions(1.0)[0][2], 0.3)


def test_lines_are_pairs_of_points_or_one_line_through_all(frame):
    points = np.arange(12.0).reshape(4, 3)
    frame.setLines(points)
    assert frame.getShapeType() == ry.ST.lines
    assert np.allclose(frame.getMeshPoints(), points) and frame.getMeshTriangles().tolist() == [[0, 1], [2, 3]]
    frame.setLines(points, [[255, 0, 0]] * 4, singleConnectedLine=True)
    assert np.allclose(frame.getMeshPoints(), points[[0, 1, 1, 2, 2, 3]])
    assert frame.getMeshColors().shape == (6, 3)
    frame.setMeshAsLines([0, 0, 0, 1, 1, 1])
    assert np.allclose(frame.getMeshPoints(), [[0, 0, 0], [1, 1, 1]])
    with pytest.raises(ry.ArgumentError, match="even number"):
        frame.setLines(points[:3])


def test_colors_of_a_mesh_are_kept(frame):
    frame.setMesh(*TETRAHEDRON, colors=[[255, 0, 0], [0, 255, 0], [0, 0, 255], [10, 20, 30]])
    assert frame.getMeshColors().dtype == np.uint8 and frame.getMeshColors()[3].tolist() == [10, 20, 30]
    frame.setPointCloud([[0, 0, 0], [1, 0, 0]], [1, 2, 3, 4])
    assert frame.getMeshColors().tolist() == [[1, 2, 3, 4]]
    frame.setShape("box", [1, 1, 1]).setColor([0, 0, 1])
    assert frame.getMeshColors().tolist() == [[0, 0, 255]]
    points, triangles, colors = frame.getMesh()
    assert (points.shape, triangles.shape, colors.shape) == ((8, 3), (12, 3), (1, 3))
    for colors, words in (([1, 2], "2 color numbers"), ([300, 0, 0], "300")):
        with pytest.raises(ry.ArgumentError, match=words):
            frame.setMesh(*TETRAHEDRON, colors=colors)


def test_a_convex_mesh_without_radius_is_a_mesh(frame):
    cube = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    frame.setConvexMesh([*cube, [0.5, 0.5, 0.5]])
    assert frame.getShapeType() == ry.ST.mesh and len(frame.getMeshPoints()) == 8
    frame.setConvexMesh(cube, radius=0.1)
    assert frame.getShapeType() == ry.ST.ssCvx and np.allclose(frame.getSize(), [0.1])


def test_convex_parts_become_children():
    C = ry.Config()
    vertices, triangles = np.array(TETRAHEDRON[0]), np.array(TETRAHEDRON[1])
    both = np.vstack([vertices, vertices + 5])
    for parts in ([0, 4, 8], []):  # named (the last is empty), or connected components
        C.clear()
        frame = C.addFrame("a").setMesh(both, np.vstack([triangles, triangles + 4]), [], parts)
        frame.setColor([1, 0, 0]).setContact(-1)
        assert frame.convertDecomposedShapeToChildFrames() == frame
        assert C.getFrameNames() == ["a", "a_0", "a_1"] and frame.getShapeType() == ry.ST.none
        assert np.allclose(C["a_1"].getMeshPoints().min(axis=0), [5, 5, 5])
        assert C["a_0"].asDict()["contact"] == -1 and C["a_0"].asDict()["color"] == [1, 0, 0]
    with pytest.raises(ry.ArgumentError, match="'a' has no mesh"):
        C["a"].convertDecomposedShapeToChildFrames()


def test_meshes_become_swept_hulls_of_nearly_the_same_extent():
    C = ry.Config()
    cube = np.array([[x, y, z] for x in (0.0, 1) for y in (0, 1) for z in (0, 1)])
    C.addFrame("cube").setConvexMesh(cube).setContact(1)
    C.addFrame("probe").setShape("sphere", [0.1]).setContact(1).setPosition([0.5, 0.5, 1.3])
    C.makeMeshesSSCvx(radius=0.05)
    assert C["cube"].getShapeType() == ry.ST.ssCvx and np.allclose(C["cube"].getSize(), [0.05])
    assert C.eval(ry.FS.distance, ["cube", "probe"])[0][0] == pytest.approx(-0.2, abs=1e-6)
    with pytest.raises(ry.ArgumentError, match="radius"):
        C.makeMeshesSSCvx(-1.0)


def test_a_texture_is_a_picture_that_is_there(frame):
    image = DATA / "images" / "colors.png"
    frame.setShape("box", [1, 1, 1]).setTextureFile(image)
    assert frame.getAttributes()["texture"] == f"<{image}>"
    with pytest.raises(ry.FileError, match="nothing.png"):
        frame.setTextureFile("nothing.png")
    with pytest.raises(ry.FileError, match="neither a PNG nor a JPEG"):
        frame.setTextureFile(__file__)
    with pytest.raises(ry.ArgumentError, match="no mesh"):
        frame.setTextureFile(image, [[0, 0], [1, 1]])


def test_joint_samples_have_the_deviation_that_was_set():
    C = ry.Config()
    C.addFrame("a")
    joint = C.addFrame("b", "a").setJoint(ry.JT.hingeX).setJointSampleStdDev(2.0)
    ry.rnd_seed(0)
    draws = []
    for _ in range(500):
        C.setRandom()
        draws.append(C.getJointState()[0])
    assert 1.7 < np.std(draws) < 2.3
    with pytest.raises(ry.ArgumentError, match="-1"):
        joint.setJointSampleStdDev(-1.0)


def test_an_object_of_an_hdf5_file_is_a_frame_with_its_parts():
    C = ry.Config()
    base = C.addH5Object("thing", DATA / "tetrahedron.h5")
    assert base.name == "thing" and "thing_mesh" in C
    assert C["thing_mesh"].getShapeType() == ry.ST.mesh
    with pytest.raises(ry.ArgumentError, match="'thing' already"):
        C.addH5Object("thing", DATA / "tetrahedron.h5")
    with pytest.raises(ry.FileError):
        C.addH5Object("other", DATA / "panda.json")
    assert "other" not in C
