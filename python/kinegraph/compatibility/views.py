"""Methods of viewers and cameras by their earlier names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import CameraView, Config, ConfigurationViewer, Frame
from ..errors import ArgumentError

if TYPE_CHECKING:  # numpy.typing takes half a millisecond
    from numpy.typing import NDArray


def get_viewer(self: Config, window_title: str = "", offscreen: bool = False) -> ConfigurationViewer:
    """Returns the viewer of this scene, like viewer.

    Args:
        window_title, offscreen: Not used: the viewer is a page, and renders pictures without it, too.
    Returns:
        The viewer.
    """
    return self.viewer()


def view_getRgb(self: Config) -> NDArray[np.uint8]:
    """Renders a picture, shape (height, width, 3), 0..255, like viewer().getRgb."""
    return self.viewer().getRgb()


def view_getDepth(self: Config) -> NDArray[np.float32]:
    """Renders the depth, shape (height, width), m, like viewer().getDepth."""
    return self.viewer().getDepth()


def view_savePng(self: Config, pathPrefix: str = "z.vid/") -> str:
    """Saves a picture, like viewer().savePng.

    Args:
        pathPrefix: The file, if it ends in .png; else the prefix of a six-digit number and .png.
    Returns:
        The file's name.
    Raises:
        OSError: The file cannot be written.
    """
    return self.viewer().savePng(pathPrefix)


def view_focalLength(self: Config) -> float:
    """Returns the view's focal length in image heights, the first entry of viewer().getCamera_focalLength."""
    return float(self.viewer().getCamera_focalLength()[0])


def view_fxycxy(self: Config) -> NDArray[np.float64]:
    """Returns fx, fy, cx, cy of the view in pixels, shape (4,), like viewer().getCamera_fxycxy."""
    return self.viewer().getCamera_fxycxy()


def view_pose(self: Config) -> NDArray[np.float64]:
    """Returns the view's pose: x y z (m) qw qx qy qz, shape (7,), like viewer().getCamera_pose."""
    return self.viewer().getCamera_pose()


def view_raise(self: Config) -> None:
    """Brings the page to the front, like viewer().raiseWindow."""
    self.viewer().raiseWindow()


def view_focus(self: Config, frameName: str, absHeight: float = 1.0) -> None:
    """Turns the view to a frame, like viewer().focus to its position.

    Args:
        frameName: Name of the frame.
        absHeight: Height at the frame that fits into the window, m.
    Raises:
        FrameNotFound: There is no such frame.
        ArgumentError: absHeight is not positive.
    """
    self.viewer().focus(self.getFrame(frameName).getPosition(), absHeight)


def view_recopyMeshes(self: Config) -> None:
    """Shows the present scene, like view, which updates meshes itself."""
    self.view()


def view_setCamera(self: Config, *where: Any) -> None:
    """Sets the camera to a frame, to a pose, or to a position directed to a target.

    Args:
        where: None for the initial camera; a frame or its name; (7,): x y z in m, qw qx qy qz, the camera's z forward;
        or two arrays (3,), m: the
            camera's position and its target.
    Raises:
        ArgumentError: The arguments have another form.
    """
    viewer = self.viewer()
    if len(where) == 1 and where[0] is None:
        return viewer.setCamera(None)
    if len(where) == 1 and isinstance(where[0], (str, Frame)):
        return viewer.setCamera(where[0])
    sizes = [np.size(one) for one in where]
    if sizes == [7]:
        return viewer.setCameraPose(where[0])
    if sizes == [3, 3]:
        return viewer.setCamera(*where)
    raise ArgumentError(
        "view_setCamera: expected a frame or its name, a pose of 7 numbers, or a position and a target of 3 numbers each; "
        f"got {', '.join(repr(one) for one in where) or 'nothing'}"
    )


def getFxyCxy(self: CameraView) -> NDArray[np.float64]:
    """Returns fx, fy, cx, cy in pixels, shape (4,), like getFxycxy."""
    return self.getFxycxy()


def setConfiguration(self: ConfigurationViewer, C: Config, text: str = "", watch: bool = False) -> int:
    """Shows a scene in this viewer, like C.set_viewer(viewer) and C.view().

    Args:
        C: The scene.
        text: Text in the corner of the page.
        watch: Whether to wait for a key.
    Returns:
        The code of the key, or 0, like C.view.
    """
    C.set_viewer(self)
    return C.view(watch, text)


def updateConfiguration(self: ConfigurationViewer, C: Config) -> int:
    """Shows a scene in this viewer, like setConfiguration.

    Args:
        C: The scene.
    Returns:
        The code of the key, or 0, like C.view.
    """
    return setConfiguration(self, C)


def recopyMeshes(self: ConfigurationViewer, C: Config) -> None:
    """Does nothing: viewers take changes of shapes over by themselves.

    Args:
        C: The scene.
    """


CONFIG_METHODS = [
    get_viewer,
    view_getRgb,
    view_getDepth,
    view_savePng,
    view_focalLength,
    view_fxycxy,
    view_pose,
    view_raise,
    view_focus,
    view_recopyMeshes,
    view_setCamera,
]
VIEWER_METHODS = [setConfiguration, updateConfiguration, recopyMeshes]
CAMERA_METHODS = [getFxyCxy]
