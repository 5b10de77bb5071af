"""Notebook views of a Config, a table of its frames, and of a Frame."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from typing import TYPE_CHECKING

from .errors import Error
from .png import encodePng

if TYPE_CHECKING:
    from . import Config, Frame

_SHOWN = 20  # rows; further ones are counted


def _row(frame: Frame) -> str:
    parent = frame.getParent()
    joint, shape = frame.getJointType(), frame.getShapeType()
    cells = [
        frame.name,
        parent.name if parent else "",
        "" if joint == 0 else joint.name,
        "" if shape == -1 else shape.name,
        " ".join(f"{x:.3g}" for x in frame.getPosition()),
    ]
    return "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"


def _picture(config: Config) -> str:
    """Renders the viewer's picture as a page element; empty if rendering is not possible."""
    try:
        png = encodePng(config.viewer().getRgb())
    except Error:
        return ""
    return f'<img alt="the scene" src="data:image/png;base64,{b64encode(png).decode()}">'


def sceneHtml(config: Config) -> str:
    """Returns a picture, a summary line, and a table of the first frames: name, parent, joint, shape, world position in
    m."""
    frames = config.getFrames()
    summary = f"Config: {len(frames)} frames, {config.getJointDimension()} dofs"
    if not frames:
        return f"<p>{summary}</p>"
    head = "".join(f"<th>{title}</th>" for title in ("frame", "parent", "joint", "shape", "position"))
    rows = "".join(_row(frame) for frame in frames[:_SHOWN])
    more = f"<p>and {len(frames) - _SHOWN} more</p>" if len(frames) > _SHOWN else ""
    return f"{_picture(config)}<p>{summary}</p><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>{more}"


def frameHtml(frame: Frame) -> str:
    """Returns a table of the frame's present pose, m and quaternion, and its attributes as in a .g file."""
    parent = frame.getParent()
    described = {"parent": parent.name if parent else "none", "world pose": frame.getPose().tolist(), **frame.asDict()}
    rows = "".join(
        f"<tr><th>{escape(key)}</th><td>{escape(_text(value))}</td></tr>" for key, value in described.items()
    )
    return f"<p>Frame '{escape(frame.name)}'</p><table><tbody>{rows}</tbody></table>"


def _text(value: object) -> str:
    """Formats numbers briefly, and only the first of long lists."""
    if isinstance(value, list):
        more = f" ... ({len(value)} in all)" if len(value) > _SHOWN else ""
        return " ".join(_text(item) for item in value[:_SHOWN]) + more
    return f"{value:.4g}" if isinstance(value, float) else str(value)
