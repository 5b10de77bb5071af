"""A scene with a camera, and whether pictures can be drawn here: they need EGL and an OpenGL driver, no display."""

import pytest

import kinegraph as ry


def missing() -> str:
    """Why nothing can be drawn here, or ''."""
    try:
        ry.CameraView(ry.Config()).computeImageAndDepth()
    except ry.FileError as error:
        return str(error)
    return ""


REASON = missing()
needs_egl = pytest.mark.skipif(bool(REASON), reason=REASON or "EGL is there")

WIDTH, HEIGHT, FOCAL = 200, 160, 1.25
# looks along the world's x axis: its x is -y of the world, its y is -z, its z is x
FORWARD = "[0 0 2 .5 -.5 .5 -.5]"


def scene(text, attributes="", pose=FORWARD):
    """A configuration, and its camera."""
    C = ry.Config()
    C.addText(
        f"camera: {{ X: {pose}, width: {WIDTH}, height: {HEIGHT}, focalLength: {FOCAL}, zRange: [.1 20] {attributes} }}\n"
        + text
    )
    view = ry.CameraView(C)
    view.setCamera("camera")
    return C, view
