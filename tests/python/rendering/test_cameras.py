"""Cameras and their images, against rays that are cast on paper."""

import numpy as np
import pytest

import kinegraph as ry
from camera_scene import FOCAL, FORWARD, HEIGHT, WIDTH, needs_egl, scene

PIXELS = FOCAL * HEIGHT  # focal length in pixels
EYE = np.array([0.0, 0.0, 2.0])


def rays():
    """Directions of the pixels' centers in the world, with 1 m along the camera's axis: (HEIGHT, WIDTH, 3)."""
    column, row = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    x, y = (column - WIDTH / 2) / PIXELS, (row - HEIGHT / 2) / PIXELS
    return np.stack([np.ones_like(x), -x, -y], axis=-1)


def sphere_depth(center, radius):
    """Depth of a sphere along each pixel's ray; infinite where it misses."""
    direction = rays()
    a, b = (direction**2).sum(-1), direction @ (EYE - center)
    root = b**2 - a * (((EYE - center) ** 2).sum() - radius**2)
    return np.where(root > 0, (-b - np.sqrt(np.maximum(root, 0))) / a, np.inf)


@needs_egl
def test_images_have_the_cameras_size_and_the_promised_types():
    _, view = scene("")
    rgb, depth = view.computeImageAndDepth()
    assert rgb.shape == (HEIGHT, WIDTH, 3) and rgb.dtype == np.uint8
    assert depth.shape == (HEIGHT, WIDTH) and depth.dtype == np.float32
    ids = view.computeSegmentationID()
    assert ids.shape == (HEIGHT, WIDTH) and ids.dtype == np.int32
    assert view.getFxycxy().tolist() == [PIXELS, PIXELS, WIDTH / 2, HEIGHT / 2]


@needs_egl
def test_a_wall_two_meters_away_is_two_meters_deep_in_every_pixel():
    _, view = scene("wall: { X: [2.5 0 2], shape: box, size: [1 9 9] }")
    _, depth = view.computeImageAndDepth()
    np.testing.assert_allclose(depth, 2.0, atol=1e-4)


@needs_egl
@pytest.mark.parametrize("range", ["[.01 100]", "[.5 5]", "[1.9 2.1]"])
def test_depth_is_in_meters_whatever_the_range(range):
    C = ry.Config()
    C.addText(
        f"camera: {{ X: {FORWARD}, width: 40, height: 30, zRange: {range} }}\n"
        "wall: { X: [2.5 0 2], shape: box, size: [1 9 9] }"
    )
    view = ry.CameraView(C)
    view.setCamera(C.getFrame("camera"))
    np.testing.assert_allclose(view.computeImageAndDepth()[1], 2.0, atol=1e-4)


@needs_egl
def test_a_slanted_plane_is_as_deep_as_its_rays_say():
    C, view = scene('plane: { X: "t(3 0 2) d(30 0 0 1) d(-70 0 1 0)", shape: quad, size: [20 20] }')
    normal = C.getFrame("plane").getRotationMatrix()[:, 2]
    expected = (np.array([3.0, 0.0, 2.0]) - EYE) @ normal / (rays() @ normal)
    _, depth = view.computeImageAndDepth()
    seen = (depth > 0) & (expected > 0.2) & (expected < 10)
    assert seen.sum() > 0.5 * depth.size
    np.testing.assert_allclose(depth[seen], expected[seen], rtol=1e-4)


@needs_egl
def test_nothing_is_minus_one_deep_and_white():
    _, view = scene("")
    rgb, depth = view.computeImageAndDepth()
    sky = rays()[..., 2] > 0
    assert (depth[sky] == -1).all() and (rgb[sky] == 255).all()
    assert (view.computeSegmentationID() == -1).all()


@needs_egl
@pytest.mark.parametrize("far, depth", [(1.9, -1.0), (2.1, 2.0)])
def test_what_is_outside_of_the_range_is_not_seen(far, depth):
    C = ry.Config()
    C.addText(f"camera: {{ X: {FORWARD}, zRange: [.1 {far}] }}\nwall: {{ X: [2.5 0 2], shape: box, size: [1 9 9] }}")
    view = ry.CameraView(C)
    view.setCamera("camera")
    np.testing.assert_allclose(view.computeImageAndDepth()[1], depth, atol=1e-4)


@needs_egl
def test_a_sphere_has_the_silhouette_and_the_depth_of_its_rays():
    center, radius = np.array([3.0, 0.3, 2.2]), 0.5
    _, view = scene("ball: { X: [3 .3 2.2], shape: sphere, size: [.5] }")
    _, depth = view.computeImageAndDepth()
    expected = sphere_depth(center, radius)
    ball = view.computeSegmentationID() == 1
    assert abs(ball.sum() - np.isfinite(expected).sum()) < 0.01 * ball.sum()
    inside = ball & np.isfinite(sphere_depth(center, 0.97 * radius))
    np.testing.assert_allclose(depth[inside], expected[inside], atol=3e-3 * radius)
    # the silhouette's radius on the axis: tan of the angle whose sine is radius / distance
    _, view = scene("ball: { X: [3 0 2], shape: sphere, size: [.5] }")
    row = view.computeSegmentationID()[HEIGHT // 2] == 1
    half = PIXELS * np.tan(np.arcsin(0.5 / 3.0))
    assert abs(row.sum() / 2 - half) < 1


@needs_egl
@pytest.mark.parametrize(
    "shape, size, half_width, half_height, front",
    [
        ("box", "[.2 .6 .4]", 0.3, 0.2, 0.1),
        ("ssBox", "[.2 .6 .4 .001]", 0.3, 0.2, 0.1),
        ("capsule", "[.4 .15]", 0.15, 0.35, 0.15),
        ("cylinder", "[.4 .15]", 0.15, 0.2, 0.15),
        ("ssCylinder", "[.4 .15 .001]", 0.15, 0.2, 0.15),
        ("ssBoxElip", "[.2 .6 .4 0 0 0 .001]", 0.3, 0.2, 0.1),
        ("sphere", "[.25]", 0.25, 0.25, 0.25),
    ],
)
def test_every_shape_is_drawn_in_its_size(shape, size, half_width, half_height, front):
    """With an orthographic camera, so that sizes in the image are sizes in the world."""
    _, view = scene(f"thing: {{ X: [2 0 2], shape: {shape}, size: {size} }}", ", orthoAbsHeight: 1")
    ids, (_, depth) = view.computeSegmentationID(), view.computeImageAndDepth()
    rows, columns = np.nonzero(ids == 1)
    pixel = 1.0 / HEIGHT
    assert abs((columns.max() - columns.min() + 1) * pixel / 2 - half_width) < 1.1 * pixel
    assert abs((rows.max() - rows.min() + 1) * pixel / 2 - half_height) < 1.1 * pixel
    assert depth[HEIGHT // 2, WIDTH // 2] == pytest.approx(2.0 - front, abs=2e-3)


@needs_egl
def test_meshes_and_hulls_are_drawn_where_they_are():
    C, view = scene("", ", orthoAbsHeight: 4")
    corners = np.array([[x, y, z] for x in (-0.1, 0.1) for y in (-0.2, 0.2) for z in (-0.3, 0.3)])
    triangle = np.array([[0, -0.2, -0.2], [0, 0.2, -0.2], [0, 0, 0.2]])
    C.addFrame("hull").setConvexMesh(corners, [], 0.0).setPosition([2, 1.0, 2.5])
    C.addFrame("triangle").setMesh(triangle, np.array([[0, 1, 2]])).setPosition([2, 0, 2.5])
    ids = view.computeSegmentationID()
    pixel = 4 / HEIGHT
    for frame, (y, bottom, top) in {1: (1.0, 2.2, 2.8), 2: (0.0, 2.3, 2.7)}.items():
        rows, columns = np.nonzero(ids == frame)
        assert (WIDTH - columns.min() - columns.max() - 1) / 2 * pixel == pytest.approx(y, abs=pixel)
        assert 2 + (HEIGHT / 2 - rows.max() - 1) * pixel == pytest.approx(bottom, abs=pixel)
        assert 2 + (HEIGHT / 2 - rows.min()) * pixel == pytest.approx(top, abs=2 * pixel)


@needs_egl
def test_points_are_drawn_a_few_millimeters_thick():
    C, view = scene("", ", orthoAbsHeight: .2")
    square = np.array([[0, -0.05, -0.05], [0, 0.05, -0.05], [0, 0.05, 0.05], [0, -0.05, 0.05]])
    C.addFrame("points").setPointCloud(square).setPosition([2, 0, 2])
    rows, columns = np.nonzero(view.computeSegmentationID() == 1)
    assert 4 * 4 <= len(rows) <= 4 * 16
    for extent in (rows.max() - rows.min(), columns.max() - columns.min()):
        assert extent * 0.2 / HEIGHT == pytest.approx(0.1, abs=0.005)


@needs_egl
def test_right_is_right_and_up_is_up():
    """x of the camera frame points to the right of the image, y down."""
    C, view = scene("ball: { shape: sphere, size: [.1] }")
    camera, ball = C.getFrame("camera"), C.getFrame("ball")
    for x, y in [(0.5, 0), (-0.5, 0), (0, 0.5), (0, -0.5)]:
        ball.setPosition(camera.getPosition() + camera.getRotationMatrix() @ [x, y, 2.0])
        rows, columns = np.nonzero(view.computeSegmentationID() == 1)
        assert columns.mean() + 0.5 == pytest.approx(WIDTH / 2 + PIXELS * x / 2, abs=1)
        assert rows.mean() + 0.5 == pytest.approx(HEIGHT / 2 + PIXELS * y / 2, abs=1)


@needs_egl
def test_every_visible_frame_appears_and_no_other():
    boxes = [
        f"b{i}: {{ X: [3 {0.3 * (i % 6 - 2.5)} {1.4 + 0.25 * (i // 6)}], shape: box, size: [.1 .2 .2] }}"
        for i in range(24)
    ]
    others = """
behind: { X: [5 0 2], shape: box, size: [.1 .1 .1] }
hider: { X: [4 0 2], shape: box, size: [.1 6 6] }
outside: { X: [0 5 2], shape: box, size: [1 1 1] }
back: { X: [-3 0 2], shape: box, size: [1 1 1] }
empty: { X: [2 0 2] }
marked: { X: [2 0 2], shape: marker, size: [.3] }
glass: { X: [1 0 2], shape: box, size: [.1 1 1], color: [1 0 0 .3] }
"""
    C, view = scene("\n".join(boxes) + others)
    names = {C.getFrames()[i].name for i in np.unique(view.computeSegmentationID())}
    assert names == {f"b{i}" for i in range(24)} | {"hider"}
    everything = {C.getFrames()[i].name for i in np.unique(view.computeSegmentationID(visualsOnly=False))}
    assert "glass" in everything


@needs_egl
def test_segmentation_colors_encode_the_ids():
    C, view = scene("")
    for i in range(70):
        C.addFrame(f"empty{i}")
    C.addFrame("ball").setShape("sphere", [0.3]).setPosition([2, 0, 2])
    ids, image = view.computeSegmentationID(), view.computeSegmentationImage().astype(int)
    bit = lambda channel, n: image[..., channel] >> n & 1  # noqa: E731
    decoded = sum(bit(i % 3, 7 - i // 3) << i for i in range(6)) + sum(
        (image[..., c] & 63) << 6 + 6 * c for c in range(3)
    )
    assert set(np.unique(ids)) == {-1, 71}
    np.testing.assert_array_equal(decoded, np.where(ids < 0, 0xFFFFFF, ids))


@needs_egl
@pytest.mark.parametrize("color", [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.2, 0.4, 0.6]])
def test_colors_are_those_of_the_shapes(color):
    C, view = scene("wall: { X: [2.5 0 2], shape: box, size: [1 9 9] }")
    C.getFrame("wall").setColor(color)
    shown = view.computeImageAndDepth()[0][HEIGHT // 2, WIDTH // 2].astype(float)
    assert shown.max() > 60
    np.testing.assert_allclose(shown / shown.max(), np.array(color) / max(color), atol=0.04)


PLY = """ply
format ascii 1.0
element vertex 6
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 2
property list uchar int vertex_indices
end_header
0 1 -1 255 0 0
0 0 -1 255 0 0
0 0 1 255 0 0
0 0 -1 0 0 255
0 -1 -1 0 0 255
0 0 1 0 0 255
3 0 1 2
3 3 4 5
"""


@needs_egl
def test_meshes_keep_the_colors_of_their_vertices(tmp_path):
    (tmp_path / "flag.ply").write_text(PLY)
    _, view = scene(f"flag: {{ X: [2 0 2], mesh: <{tmp_path}/flag.ply> }}", ", orthoAbsHeight: 2")
    image = view.computeImageAndDepth()[0].astype(int)
    left, right = image[3 * HEIGHT // 4, WIDTH // 2 - 20], image[3 * HEIGHT // 4, WIDTH // 2 + 20]
    assert left[0] > 60 and left[2] < 20
    assert right[2] > 60 and right[0] < 20


@needs_egl
def test_transparent_shapes_are_blended_when_asked_for_and_not_deep():
    _, view = scene(
        "wall: { X: [2.5 0 2], shape: box, size: [1 9 9], color: [0 0 1] }\n"
        "glass: { X: [1 0 2], shape: box, size: [.01 5 5], color: [1 0 0 .5] }"
    )
    middle = HEIGHT // 2, WIDTH // 2
    without, _ = view.computeImageAndDepth()
    blended, depth = view.computeImageAndDepth(visualsOnly=False)
    assert without[middle][0] < 20 < 60 < without[middle][2]
    assert blended[middle][0] > 40 and blended[middle][2] < 0.7 * without[middle][2]
    assert depth[middle] == pytest.approx(2.0, abs=1e-4)


@needs_egl
def test_the_floor_looks_as_it_does_in_the_reference():
    """robotic 0.4.2 shows it as about (107, 121, 134), from above only."""
    _, view = scene("", pose="[0 0 2 0 1 0 0]")
    rgb, depth = view.computeImageAndDepth()
    np.testing.assert_allclose(depth, 2.0, atol=1e-4)
    np.testing.assert_allclose(rgb[HEIGHT // 2, WIDTH // 2], [107, 121, 134], atol=3)
    assert (view.computeSegmentationID() == -1).all()
    _, below = scene("", pose="[0 0 -2 1 0 0 0]")
    assert (below.computeImageAndDepth()[1] == -1).all()


@needs_egl
def test_a_camera_follows_its_frame_and_sees_every_change():
    C, view = scene("wall: { X: [2.5 0 2], shape: box, size: [1 9 9] }")
    for x in (0.0, 0.5, -1.0):
        C.getFrame("camera").setPosition([x, 0, 2])
        np.testing.assert_allclose(view.computeImageAndDepth()[1], 2.0 - x, atol=1e-4)
    C.getFrame("camera").setPosition([0, 0, 2])
    C.getFrame("wall").setShape("ssBox", [0.5, 9, 9, 0.01])
    np.testing.assert_allclose(view.computeImageAndDepth(C, False, True)[1], 2.25, atol=1e-4)


@needs_egl
def test_points_of_a_depth_image_lie_on_what_is_seen():
    C, view = scene("wall: { X: [2.5 0 2], shape: box, size: [1 9 9] }")
    _, depth = view.computeImageAndDepth()
    points = ry.depthImage2PointCloud(depth, view.getFxycxy())
    assert points.shape == (HEIGHT, WIDTH, 3) and points.dtype == np.float64
    camera = C.getFrame("camera")
    world = points @ camera.getRotationMatrix().T + camera.getPosition()
    np.testing.assert_allclose(world[..., 0], 2.0, atol=1e-4)


def test_points_of_a_depth_image_are_those_of_the_formula():
    points = ry.depthImage2PointCloud(np.array([[1.0, 2.0], [-1.0, 4.0]], np.float32), [10, 20, 0.5, 1.0])
    np.testing.assert_allclose(points[0, 1], [0.2, -0.05, 2.0])
    np.testing.assert_allclose(points[1], [[0, 0, 0], [0.4, 0.1, 4.0]])
    with pytest.raises(ry.ArgumentError, match="4"):
        ry.depthImage2PointCloud(np.ones((2, 2), np.float32), [1, 2, 3])


@needs_egl
def test_simulated_depth_noise_is_small_random_and_repeatable():
    _, view = scene("wall: { X: [2.5 0 2], shape: box, size: [1 9 9] }")
    images = []
    for seed in (0, 0, 1):
        ry.rnd_seed(seed)
        images.append(view.computeImageAndDepth(simulateDepthNoise=True)[1])
    np.testing.assert_array_equal(images[0], images[1])
    assert (images[0] != images[2]).mean() > 0.5
    seen = images[0] > 0
    assert 0.9 < seen.mean() < 1.0  # the left edge is outside of the other eye's image
    assert 0.002 < images[0][seen].std() < 0.1


def test_wrong_cameras_are_errors_that_say_so():
    C, view = scene("bad: { zRange: [2 1] }")
    with pytest.raises(ry.ArgumentError, match="zRange"):
        view.setCamera("bad")
    with pytest.raises(ry.FrameNotFound, match="camera"):
        view.setCamera("camra")
    with pytest.raises(TypeError):
        ry.CameraView("not a configuration")
    assert view.setCamera(C.getFrame("camera")).zRange == (0.1, 20.0)


@needs_egl
def test_the_pandas_camera_sees_table_and_arm(panda):
    view = ry.CameraView(panda)
    view.setCamera("cameraTop")
    np.testing.assert_allclose(view.getFxycxy(), [322.2, 322.2, 320, 180])
    _, depth = view.computeImageAndDepth()
    assert depth.shape == (360, 640)
    names = {panda.getFrames()[i].name for i in np.unique(view.computeSegmentationID()) if i >= 0}
    assert "table" in names and any("panda" in name for name in names)
    ids = view.computeSegmentationID()
    points = ry.depthImage2PointCloud(depth, view.getFxycxy())
    camera = panda.getFrame("cameraTop")
    height = (points @ camera.getRotationMatrix().T + camera.getPosition())[..., 2]
    table = ids == panda.getFrame("table").ID
    assert table.mean() > 0.5
    assert abs(np.median(height[table]) - 0.65) < 2e-3
