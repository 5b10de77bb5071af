"""Messages of ROS 2 as bytes (CDR), encoded and decoded by the package rosbags. No ROS is needed."""

from __future__ import annotations

import functools
import io
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from ..packages import needed

CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
CLOCK = "rosgraph_msgs/msg/Clock"
IMAGE = "sensor_msgs/msg/CompressedImage"
JOINT_STATE = "sensor_msgs/msg/JointState"
TEXT = "std_msgs/msg/String"
TRANSFORMS = "tf2_msgs/msg/TFMessage"


@functools.cache
def _store() -> Any:
    typesys = needed("rosbags.typesys")
    return typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)


def definition(kind: str) -> str:
    """Returns the text that defines a type of message and all types in it, as MCAP files hold it."""
    return str(_store().generate_msgdef(kind, ros_version=2)[0])


def decode(data: bytes, kind: str) -> Any:
    """Decodes a message; its fields are attributes, and arrays of numbers are arrays of numpy."""
    return _store().deserialize_cdr(data, kind)


def _type(name: str) -> Any:
    return _store().types[name]


def _stamp(time: int) -> Any:
    return _type("builtin_interfaces/msg/Time")(sec=time // 10**9, nanosec=time % 10**9)


def _header(time: int, frame: str) -> Any:
    return _type("std_msgs/msg/Header")(stamp=_stamp(time), frame_id=frame)


def _encode(kind: str, *fields: Any) -> bytes:
    return bytes(_store().serialize_cdr(_type(kind)(*fields), kind))


def encodeJoints(
    time: int, names: Sequence[str], q: np.ndarray, velocity: np.ndarray, effort: np.ndarray | None = None
) -> bytes:
    """Encodes a JointState.

    Args:
        time: Stamp, ns.
        names: Names of the joints.
        q, velocity, effort: One number per joint; effort may be missing.
    """
    return _encode(JOINT_STATE, _header(time, ""), list(names), q, velocity, np.zeros(0) if effort is None else effort)


def encodeTransforms(time: int, transforms: Iterable[tuple[str, str, np.ndarray]]) -> bytes:
    """Encodes a TFMessage.

    Args:
        time: Stamp, ns.
        transforms: Name of the parent, name of the child, and its pose in the parent: x y z qw qx qy qz.
    """
    vector, quaternion = _type("geometry_msgs/msg/Vector3"), _type("geometry_msgs/msg/Quaternion")
    transform, stamped = _type("geometry_msgs/msg/Transform"), _type("geometry_msgs/msg/TransformStamped")
    return _encode(
        TRANSFORMS,
        [
            stamped(_header(time, parent), child, transform(vector(x, y, z), quaternion(qx, qy, qz, qw)))
            for parent, child, (x, y, z, qw, qx, qy, qz) in transforms
        ],
    )


def encodeClock(time: int) -> bytes:
    """Encodes a Clock with a time in ns."""
    return _encode(CLOCK, _stamp(time))


def encodeText(text: str) -> bytes:
    """Encodes a String."""
    return _encode(TEXT, text)


def encodeImage(time: int, frame: str, image: np.ndarray) -> bytes:
    """Encodes an image, shape (height, width, 3), 0..255, as JPEG in a CompressedImage."""
    return _encode(IMAGE, _header(time, frame), "jpeg", np.frombuffer(encodeJpeg(image), np.uint8))


def encodeCamera(time: int, frame: str, size: tuple[int, int], fxycxy: np.ndarray) -> bytes:
    """Encodes a CameraInfo of a camera without distortion.

    Args:
        time: Stamp, ns.
        frame: Frame of the camera: z forward, x right, y down.
        size: Height and width, pixels.
        fxycxy: fx, fy, cx, cy, pixels.
    """
    fx, fy, cx, cy = (float(x) for x in fxycxy)
    region = _type("sensor_msgs/msg/RegionOfInterest")(0, 0, 0, 0, False)
    return _encode(
        CAMERA_INFO,
        _header(time, frame),
        size[0],
        size[1],
        "plumb_bob",
        np.zeros(5),
        np.array([fx, 0, cx, 0, fy, cy, 0, 0, 1]),
        np.eye(3).ravel(),
        np.array([fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0]),
        0,
        0,
        region,
    )


def encodeJpeg(image: np.ndarray) -> bytes:
    """Encodes an image, shape (height, width, 3), 0..255, as JPEG.

    Raises:
        NotFound: The package av is not installed.
    """
    av = needed("av")
    codec = av.CodecContext.create("mjpeg", "w")
    codec.height, codec.width = image.shape[:2]
    codec.pix_fmt, codec.time_base = "yuvj420p", Fraction(1, 25)
    codec.options = {"qmin": "2", "qmax": "4"}
    frame = av.VideoFrame.from_ndarray(np.ascontiguousarray(image), "rgb24").reformat(format="yuvj420p")
    return b"".join(bytes(packet) for packet in [*codec.encode(frame), *codec.encode(None)])


def decodeImage(data: bytes) -> np.ndarray:
    """Decodes the bytes of a JPEG or PNG to an image, shape (height, width, 3), 0..255."""
    av = needed("av")
    with av.open(io.BytesIO(data)) as container:
        return np.asarray(next(container.decode(video=0)).to_ndarray(format="rgb24"))
