"""Images, point clouds and markers of a RosBridge."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .._core import CameraView, Config, Trajectory, depthImage2PointCloud
from ..errors import NotFound
from ..png import encodePng
from ..recording.messages import encodeJpeg
from .node import needed

ARROW = 0.01  # m per N of a contact's force
SHORTEST = 0.02  # m, of a contact's arrow
ORANGE, BLUE = (1.0, 0.45, 0.0, 1.0), (0.1, 0.4, 0.9, 1.0)  # red, green, blue, opacity


class Camera:
    """Publishes what a camera of the scene sees, where someone listens."""

    def __init__(self, node: Any, name: str):
        """Creates the topics.

        Args:
            node: The node.
            name: Frame of the camera.
        """
        messages, qos = needed("sensor_msgs.msg"), needed("rclpy.qos").qos_profile_sensor_data
        self._messages, self.name = messages, name
        self._header = needed("std_msgs.msg").Header
        self._view: CameraView | None = None
        self._image = node.create_publisher(messages.Image, f"/{name}/image_raw", qos)
        self._compressed = node.create_publisher(messages.CompressedImage, f"/{name}/image_raw/compressed", qos)
        self._info = node.create_publisher(messages.CameraInfo, f"/{name}/camera_info", qos)
        self._depth = node.create_publisher(messages.Image, f"/{name}/depth/image_rect_raw", qos)
        self._points = node.create_publisher(messages.PointCloud2, f"/{name}/points", qos)

    def publish(self, world: Config, stamp: Any) -> None:
        """Renders and publishes.

        Args:
            world: The scene.
            stamp: Time of the messages.
        """
        pixels = [self._image, self._compressed, self._depth, self._points]
        wanted = {topic: topic.get_subscription_count() > 0 for topic in [*pixels, self._info]}
        if not any(wanted.values()):
            return
        if self._view is None:  # in the thread that renders
            self._view = CameraView(world)
        sensor = self._view.setCamera(self.name)
        fxycxy, size = self._view.getFxycxy(), (sensor.height, sensor.width)
        header = self._header(stamp=stamp, frame_id=self.name)
        if wanted[self._info]:
            self._info.publish(self._cameraInfo(header, size, fxycxy))
        if not any(wanted[topic] for topic in pixels):
            return
        image, depth = self._view.computeImageAndDepth(world)
        if wanted[self._image]:
            self._image.publish(self._rows(header, image, "rgb8"))
        if wanted[self._compressed]:
            self._compressed.publish(self._compress(header, image))
        unseen = np.where(depth < 0, np.float32(np.nan), depth).astype(np.float32)
        if wanted[self._depth]:
            self._depth.publish(self._rows(header, unseen, "32FC1"))
        if wanted[self._points]:
            self._points.publish(self._cloud(header, image, depth, fxycxy))

    def _rows(self, header: Any, pixels: np.ndarray, encoding: str) -> Any:
        message = self._messages.Image(header=header, height=pixels.shape[0], width=pixels.shape[1], encoding=encoding)
        message.step = pixels.strides[0]
        message.data = np.ascontiguousarray(pixels).tobytes()
        return message

    def _compress(self, header: Any, image: np.ndarray) -> Any:
        try:
            kind, data = "jpeg", encodeJpeg(image)
        except NotFound:  # needs the extra mcap
            kind, data = "png", encodePng(image)
        return self._messages.CompressedImage(header=header, format=kind, data=data)

    def _cameraInfo(self, header: Any, size: tuple[int, int], fxycxy: np.ndarray) -> Any:
        fx, fy, cx, cy = (float(x) for x in fxycxy)
        message = self._messages.CameraInfo(header=header, height=size[0], width=size[1], distortion_model="plumb_bob")
        message.d = [0.0] * 5
        message.k = [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]
        message.r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
        message.p = [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]
        return message

    def _cloud(self, header: Any, image: np.ndarray, depth: np.ndarray, fxycxy: np.ndarray) -> Any:
        """Returns the points as x, y, z (float32, m) and rgb (packed in a float32), NaN where nothing was seen."""
        rows = np.zeros(depth.shape, [("xyz", "<f4", 3), ("rgb", "<u4")])
        rows["xyz"] = depthImage2PointCloud(depth, fxycxy)
        rows["xyz"][depth < 0] = np.nan
        red, green, blue = (image[..., i].astype(np.uint32) for i in range(3))
        rows["rgb"] = red << 16 | green << 8 | blue
        field, names = self._messages.PointField, ("x", "y", "z", "rgb")
        return self._messages.PointCloud2(
            header=header,
            height=depth.shape[0],
            width=depth.shape[1],
            fields=[field(name=name, offset=4 * i, datatype=field.FLOAT32, count=1) for i, name in enumerate(names)],
            point_step=16,
            row_step=16 * depth.shape[1],
            is_dense=False,
            data=rows.tobytes(),
        )


class Markers:
    """Publishes contacts as arrows, and the way of a frame along a plan as a line."""

    def __init__(self, node: Any, latched: Any, stamp: Any):
        """Creates the topics.

        Args:
            node: The node.
            latched: The QoS of the plan.
            stamp: Returns the present time.
        """
        self._messages, geometry = needed("visualization_msgs.msg"), needed("geometry_msgs.msg")
        self._point, self._color, self._stamp = geometry.Point, needed("std_msgs.msg").ColorRGBA, stamp
        self._contacts = node.create_publisher(self._messages.MarkerArray, "/kinegraph/contacts", 1)
        self._plan = node.create_publisher(self._messages.MarkerArray, "/kinegraph/plan", latched)

    def contacts(self, found: Any) -> None:
        """Publishes contacts: arrows of their forces on the second frame, .01 m per N.

        Args:
            found: Returns them, as BotOp.getContacts.
        """
        if self._contacts.get_subscription_count() == 0:
            return
        kind = self._messages.Marker
        markers = [kind(action=kind.DELETEALL)]
        markers[0].header.frame_id = "world"
        for contact in found():
            begin = np.asarray(contact["position"])
            force = ARROW * np.asarray(contact["force"])
            length = float(np.linalg.norm(force))
            if length < SHORTEST:
                force = SHORTEST * (force / length if length > 1e-9 else np.asarray(contact["normal"]))
            arrow = self._marker(kind.ARROW, len(markers), "contacts", ORANGE, np.stack([begin, begin + force]))
            arrow.scale.x, arrow.scale.y, arrow.scale.z = 0.006, 0.012, 0.012
            arrow.text = " and ".join(contact["frames"])
            markers.append(arrow)
        self._contacts.publish(self._messages.MarkerArray(markers=markers))

    def plan(self, motion: Trajectory, config: Config, frames: Sequence[str], rate: float) -> None:
        """Publishes the ways of frames along a motion as lines.

        Args:
            motion: The motion.
            config: A scene whose q the motion has; it is moved.
            frames: Names of the frames.
            rate: Points per second of the motion.
        """
        kind, points = self._messages.Marker, []
        for q in motion.sample(rate)[1]:
            config.setJointState(q)
            points.append([config.getFrame(name).getPosition() for name in frames])
        markers = [kind(action=kind.DELETEALL)]
        markers[0].header.frame_id = "world"
        for i, name in enumerate(frames):
            line = self._marker(kind.LINE_STRIP, i, name, BLUE, np.array(points)[:, i])
            line.scale.x = 0.005
            markers.append(line)
        self._plan.publish(self._messages.MarkerArray(markers=markers))

    def _marker(self, kind: int, number: int, group: str, color: Sequence[float], points: np.ndarray) -> Any:
        red, green, blue, opacity = color
        marker = self._messages.Marker(type=kind, id=number, ns=group)
        marker.header.frame_id, marker.header.stamp = "world", self._stamp()
        marker.color = self._color(r=red, g=green, b=blue, a=opacity)
        marker.pose.orientation.w = 1.0
        marker.points = [self._point(x=float(x), y=float(y), z=float(z)) for x, y, z in points]
        return marker
