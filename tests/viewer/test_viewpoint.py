"""The camera of the page: set by the program, and moved by users."""

from __future__ import annotations

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser
from .camera import HEIGHT, WIDTH
from .program import KinematicModel
from .waiting import wait_until

BALLS = {
    "red": ([1, 0, 0], [0.0, 0.0, 0.5]),
    "green": ([0, 1, 0], [0.5, 0.1, 0.6]),
    "blue": ([0, 0, 1], [-0.2, 0.4, 0.8]),
}
EDGE = 4  # pixels of the frame that shows the focus
NEAR = 5  # pixels: the dark side of a ball does not count


@pytest.fixture
def balls(config: kg.Config) -> kg.Config:
    for name, (color, place) in BALLS.items():
        config.addFrame(name).setShape(kg.ST.sphere, [0.05]).setColor(color).setPosition(place)
    return config


def camera_frame(config: kg.Config, attributes: str, place: list[float], target: list[float], roll: float) -> kg.Frame:
    """A camera frame that faces a target: x to the right, y down, z forward, turned about z."""
    forward = np.array(target) - place
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0, 0, 1]) if np.linalg.norm(forward[:2]) > 1e-6 else np.array([1.0, 0, 0])
    right /= np.linalg.norm(right)
    axes = np.column_stack([right, np.cross(forward, right), forward])
    turned = axes @ [[np.cos(roll), -np.sin(roll), 0], [np.sin(roll), np.cos(roll), 0], [0, 0, 1]]
    frame = config.addFrame("eye", "", attributes).setPosition(place)
    return frame.setRotationMatrix(turned)


def seen(picture: np.ndarray) -> dict[str, np.ndarray]:
    """The middle of each ball on a picture: x and y."""
    middles = {}
    for name, (color, _) in BALLS.items():
        own = picture.astype(int)[..., np.argmax(color)]
        others = picture.astype(int).sum(axis=2) - own
        rows, columns = np.nonzero((own > 60 + others)[EDGE:-EDGE, EDGE:-EDGE])
        assert len(rows) > 20, f"{name} is not to be seen"
        middles[name] = np.array([columns.mean(), rows.mean()]) + EDGE
    return middles


def expected(frame: kg.Frame, focal: float, ortho: float, width: int, height: int) -> dict[str, np.ndarray]:
    """The middle of each ball where a camera has it; `focal` and `ortho` (m) are those of `height`."""
    middles = {}
    for name, (_, place) in BALLS.items():
        x, y, z = frame.getRotationMatrix().T @ (np.array(place) - frame.getPosition())
        scale = height / ortho if ortho else focal * height / z
        middles[name] = np.array([width / 2 + scale * x, height / 2 + scale * y])
    return middles


CAMERAS = {
    "rolled": ("focalLength: 1.5", [0.3, -2.5, 1.2], [0.1, 0, 0.6], 0.7),
    "upside down": ("heightAngle: 50", [1.5, 1.5, 1.2], [0.1, 0, 0.6], 3.0),
    "from above": ("focalLength: 1.2", [0.1, 0.1, 2.5], [0.1, 0.1, 0], 0.4),
    "orthographic": ("orthoAbsHeight: 1.6", [0.3, -2.5, 1.2], [0.1, 0, 0.6], 0.3),
}


@pytest.mark.parametrize("name", CAMERAS)
def test_the_page_sees_what_a_camera_frame_sees(name: str, balls: kg.Config, browser: Browser) -> None:
    attributes, place, target, roll = CAMERAS[name]
    frame = camera_frame(balls, attributes + ", width: 640, height: 480", place, target, roll)
    balls.viewer().setCamera("eye")  # before there is a page
    balls.view()
    browser.open(balls.viewer().url)
    focal = {"focalLength: 1.5": 1.5, "heightAngle: 50": 0.5 / np.tan(np.deg2rad(25)), "focalLength: 1.2": 1.2}
    places = expected(frame, focal.get(attributes, 0), 1.6 if name == "orthographic" else 0, WIDTH, HEIGHT)
    page, picture = seen(browser.picture()), seen(balls.viewer().getRgb())
    for ball, middle in places.items():
        np.testing.assert_allclose(page[ball], middle, atol=NEAR)
        np.testing.assert_allclose(picture[ball], middle, atol=NEAR)


def test_a_wide_picture_fits_into_the_page(balls: kg.Config, browser: Browser) -> None:
    frame = camera_frame(balls, "focalLength: 3, width: 960, height: 240", [0.3, -2.5, 1.2], [0.1, 0, 0.6], 0)
    balls.view()
    balls.viewer().setCamera(frame)
    browser.open(balls.viewer().url)
    page = seen(browser.picture())
    for ball, middle in expected(frame, 3 * (WIDTH / HEIGHT) / (960 / 240), 0, WIDTH, HEIGHT).items():
        np.testing.assert_allclose(page[ball], middle, atol=NEAR)


def test_the_page_follows_a_camera_frame_until_a_user_moves_it(balls: kg.Config, browser: Browser) -> None:
    frame = camera_frame(balls, "focalLength: 1.5", [0, -2.5, 1.2], [0, 0, 0.6], 0)
    balls.view()
    viewer = balls.viewer()
    viewer.setCamera(frame)
    browser.open(viewer.url)
    frame.setPosition([0.4, -2.5, 1.2])
    balls.view()
    browser.wait_for("Math.abs(kinegraph.camera()[0] - 0.4) < 1e-4")
    browser.drag((320, 100), (380, 130))
    place = browser.evaluate("kinegraph.camera()")
    browser.wait_for("kinegraph.idle()")
    np.testing.assert_allclose(viewer.getCamera_pose()[:3], place, atol=1e-5)
    frame.setPosition([0, -2.5, 1.2])
    balls.view()
    np.testing.assert_allclose(viewer.getCamera_pose()[:3], place, atol=1e-5)
    assert browser.evaluate("kinegraph.camera()") == place


@pytest.mark.parametrize("attributes", ["focalLength: 1.5", "orthoAbsHeight: 1.6"])
def test_pictures_use_the_camera_that_users_moved(attributes: str, balls: kg.Config, browser: Browser) -> None:
    frame = camera_frame(balls, attributes + ", width: 640, height: 480", [0.3, -2.5, 1.2], [0.1, 0, 0.6], 0.5)
    balls.view()
    viewer = balls.viewer()
    viewer.setCamera(frame)
    browser.open(viewer.url)
    before = seen(browser.picture())
    browser.drag((320, 100), (350, 120))
    browser.call("Input.dispatchMouseEvent", type="mouseWheel", x=320, y=100, deltaX=0, deltaY=-120)
    browser.wait_for("kinegraph.idle()")
    page, picture = seen(browser.picture()), seen(viewer.getRgb())
    for ball, middle in page.items():
        np.testing.assert_allclose(picture[ball], middle, atol=NEAR)
    assert any(np.linalg.norm(page[ball] - before[ball]) > 10 for ball in page)
    browser.press("Home")
    again = seen(browser.picture())
    for ball, middle in before.items():
        np.testing.assert_allclose(again[ball], middle, atol=1)
    viewer.setCamera([0, 3, 1], [0, 0, 0.5])  # replaces the camera of users
    np.testing.assert_allclose(viewer.getCamera_pose()[:3], [0, 3, 1], atol=1e-9)


CTRL = 2


def axes(browser: Browser) -> np.ndarray:
    """Returns the axes of the page's camera, as columns: x to the right, y down, z forward."""
    w, x, y, z = browser.evaluate("kinegraph.viewpoint()")["pose"][3:]
    return kg.Quaternion([w, x, y, z]).getMatrix()


def target(browser: Browser) -> np.ndarray:
    seen_from = browser.evaluate("kinegraph.viewpoint()")
    return np.array(seen_from["pose"][:3]) + seen_from["distance"] * axes(browser)[:, 2]


def test_ctrl_drag_rotates_freely_and_over_the_pole(balls: kg.Config, browser: Browser) -> None:
    balls.view()
    balls.viewer().setCamera([0, -3, 1], [0, 0, 0.5])
    browser.open(balls.viewer().url)
    before, middle = axes(browser), target(browser)
    x, y = WIDTH / 2, HEIGHT / 2
    browser.drag((x, y - 110), (x, y + 110), 40, CTRL)
    angle = 3 * 220 / (HEIGHT / 2)  # 3 rad for half the shorter side
    over = np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])
    np.testing.assert_allclose(axes(browser), before @ over.T, atol=1e-4)
    assert axes(browser)[2, 1] > 0  # upside down
    np.testing.assert_allclose(target(browser), middle, atol=1e-4)
    np.testing.assert_allclose(
        balls.viewer().getCamera_pose(), browser.evaluate("kinegraph.viewpoint().pose"), atol=1e-9
    )
    browser.drag((x, y + 110), (x, y - 110), 40, CTRL)
    np.testing.assert_allclose(axes(browser), before, atol=1e-4)


def test_ctrl_drag_near_the_rim_rolls(balls: kg.Config, browser: Browser) -> None:
    balls.view()
    balls.viewer().setCamera([0, -3, 1], [0, 0, 0.5])
    browser.open(balls.viewer().url)
    before, place = axes(browser), browser.evaluate("kinegraph.camera()")
    browser.drag((WIDTH / 2 + 250, HEIGHT / 2), (WIDTH / 2, HEIGHT / 2 + 250 - 20), 40, CTRL)  # a quarter, clockwise
    after = axes(browser)
    np.testing.assert_allclose(after[:, 2], before[:, 2], atol=1e-4)
    np.testing.assert_allclose(after[:, 0], -before[:, 1], atol=1e-4)  # up becomes right
    np.testing.assert_allclose(browser.evaluate("kinegraph.camera()"), place, atol=1e-6)


def test_ctrl_wheel_widens_the_view_and_things_keep_their_size(balls: kg.Config, browser: Browser) -> None:
    balls.view()
    balls.viewer().setCamera([0, -3, 0.5], [0, 0, 0.5])
    browser.open(balls.viewer().url)
    before = browser.evaluate("kinegraph.viewpoint()")
    edge = browser.pixel([0.05, 0, 0.5])
    browser.call("Input.dispatchKeyEvent", type="rawKeyDown", key="Control", modifiers=CTRL)
    browser.mouse("mouseWheel", 320, 100, deltaX=0, deltaY=-120, modifiers=CTRL)
    browser.call("Input.dispatchKeyEvent", type="keyUp", key="Control")
    browser.wait_for(f"kinegraph.viewpoint().focal > {1.05 * before['focal']}")
    after = browser.evaluate("kinegraph.viewpoint()")
    assert after["focal"] / before["focal"] == pytest.approx(1.1)
    assert after["distance"] / before["distance"] == pytest.approx(1.1)
    np.testing.assert_allclose(browser.pixel([0.05, 0, 0.5]), edge, atol=0.1)


@pytest.mark.parametrize("projection", ["focalLength: 1.5", "orthoAbsHeight: 1.6"])
def test_the_page_shows_no_more_than_a_cameras_range(projection: str, balls: kg.Config, browser: Browser) -> None:
    frame = camera_frame(balls, projection + ", zRange: [2.2, 2.7]", [0, -2.5, 0.5], [0, 0, 0.5], 0)
    balls.view()
    balls.viewer().setCamera(frame)
    browser.open(balls.viewer().url)

    def sees(color: int) -> bool:
        rgb = browser.picture().astype(int)[EDGE:-EDGE, EDGE:-EDGE]
        return bool((2 * rgb[..., color] - rgb.sum(axis=2) > 60).sum() > 20)

    assert [sees(0), sees(1), sees(2)] == [True, True, False]  # at 2.5, 2.6 and 2.9 m
    browser.press("1", code="Digit1", modifiers=1)  # from the front
    browser.wait_for("kinegraph.idle()")
    assert sees(2)


def test_a_view_of_the_program_leaves_the_camera_of_users(balls: kg.Config, browser: Browser) -> None:
    balls.view()
    browser.open(balls.viewer().url)
    browser.drag((320, 100), (380, 130))
    before = browser.evaluate("kinegraph.viewpoint()")
    balls.view(False, "hello")
    browser.wait_for("kinegraph.message() === 'hello'")
    assert browser.evaluate("kinegraph.viewpoint()") == before


def test_a_new_page_begins_where_viewers_start(balls: kg.Config) -> None:
    viewer = balls.viewer()
    start = viewer.getCamera_pose()
    viewer.setCameraPose([0, 0, 3, 0, 1, 0, 0])
    viewer.visualsOnly()
    assert not np.allclose(viewer.getCamera_pose(), start)
    balls.view_close()
    np.testing.assert_array_equal(viewer.getCamera_pose(), start)


def test_digits_switch_what_is_drawn_while_a_file_is_watched(browser: Browser, start: type[KinematicModel]) -> None:
    program = start(
        "open('scene.g', 'w').write('ball: { shape: sphere, size: [.2], X: [0 0 1] }')\nkg.Config().watchFile('scene.g')"
    )
    browser.open(program.url())
    x, y = browser.pixel([0, 0, 1])

    def is_seen() -> bool:
        browser.click(x, y)
        found = browser.evaluate("kinegraph.selected()") == "ball"
        browser.press("Escape")
        return found

    assert is_seen()
    browser.press("1")
    assert not is_seen()
    browser.press("1")
    assert is_seen()
    browser.press("7")
    browser.wait_for("document.querySelector('.name')?.checkVisibility()")
    browser.press("q")
    assert program.end() == 0


def test_digits_are_keys_like_others_elsewhere(balls: kg.Config, browser: Browser) -> None:
    balls.view()
    browser.open(balls.viewer().url)
    browser.press("7")
    assert not browser.evaluate("document.querySelector('.name')?.checkVisibility()")
    wait_until(lambda: balls.view() == ord("7"))


@pytest.mark.parametrize("flat", [False, True])
def test_colors_without_light(flat: bool, balls: kg.Config, browser: Browser, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "kinegraph.compatibility.parameters._values", {"Render/flatColors": flat, "Render/lights": [0, 0, 5]}
    )
    wall = balls.addFrame("wall").setShape(kg.ST.box, [3, 1, 3]).setPosition([0, 1.2, 0.5])
    wall.setColor([0.6, 0.4, 0.2])
    balls.view()
    viewer = balls.viewer()
    viewer.setCamera([0, -3, 0.5], [0, 0, 0.5])
    browser.open(viewer.url)
    wanted = 255 * np.array([0.6, 0.4, 0.2])
    page, picture = browser.picture()[60, 100], viewer.getRgb()[100, 100]
    assert (np.abs(page - wanted).max() < 8) == flat  # a light from above leaves the wall dark
    assert (np.abs(picture - wanted).max() < 3) == flat
