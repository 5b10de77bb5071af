"""Measures RosBridge against a node of rclpy in another process: messages, latencies, processor time, goals.

make test-ros && PYTHONPATH=python build/ros/bin/python benchmarks/ros_bridge.py
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time

import numpy as np

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


def listen(seconds: float) -> None:
    """Receives joint states for some time and prints their latencies and stamps."""
    from sensor_msgs.msg import JointState

    from kinegraph.ros.node import RunningNode

    running, found = RunningNode("listener", 2), []

    def take(message: JointState) -> None:
        found.append((time.time(), message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec))

    running.node.create_subscription(JointState, "/joint_states", take, 100)
    running.start()
    while not found:
        time.sleep(0.01)
    time.sleep(0.5)
    found.clear()
    time.sleep(seconds)
    rows = np.array(found)
    running.close()
    print(json.dumps({"stamps": rows[:, 1].tolist(), "late": (rows[:, 0] - rows[:, 1]).tolist()}))


def goal(client_seconds: float) -> None:
    """Sends a goal of one point and prints how long its acceptance and its result took."""
    from builtin_interfaces.msg import Duration
    from control_msgs.action import FollowJointTrajectory
    from rclpy.action import ActionClient
    from sensor_msgs.msg import JointState
    from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

    from kinegraph.ros.node import RunningNode

    running, states = RunningNode("client", 2), []
    action = ActionClient(running.node, FollowJointTrajectory, "/joint_trajectory_controller/follow_joint_trajectory")
    running.node.create_subscription(JointState, "/joint_states", states.append, 10)
    running.start()
    action.wait_for_server()
    while not states:
        time.sleep(0.01)
    names, q = list(states[-1].name)[:7], np.array(states[-1].position)[:7]
    point = JointTrajectoryPoint(positions=(q + 0.3 * np.eye(7)[0]).tolist())
    point.time_from_start = Duration(sec=int(client_seconds))
    began = time.monotonic()
    future = action.send_goal_async(
        FollowJointTrajectory.Goal(trajectory=JointTrajectory(joint_names=names, points=[point]))
    )
    while not future.done():
        time.sleep(0.0005)
    accepted = time.monotonic() - began
    result = future.result().get_result_async()
    while not result.done():
        time.sleep(0.001)
    took = time.monotonic() - began
    time.sleep(0.2)
    error = np.abs(np.array(states[-1].position)[:7] - point.positions).max()
    running.close()
    code = result.result().result.error_code
    print(json.dumps({"accepted": accepted, "took": took, "error": float(error), "code": int(code)}))


def child(*arguments: str) -> dict:
    command = [sys.executable, __file__, *arguments]
    return json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0, help="length of each measurement, s")
    parser.add_argument("--rates", default="100,500", help="rates of /joint_states, Hz")
    parser.add_argument("--listen", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--goal", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.listen:
        listen(arguments.seconds)
        return
    if arguments.goal:
        goal(2.0)
        return
    import kinegraph as ry
    from kinegraph.ros import RosBridge

    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    print(f"load average {os.getloadavg()[0]:.1f} of {os.cpu_count()} cores")
    bot = ry.BotOp(C, driver=ry.KinematicDriver(C), realtime=True)
    began = time.process_time()
    time.sleep(arguments.seconds / 2)
    alone = (time.process_time() - began) / (arguments.seconds / 2)
    print(f"robot alone: {alone:.3f} cores")
    for rate in map(float, arguments.rates.split(",")):
        for tf in (True, False):
            with RosBridge(bot, rate=rate, tf=tf):
                began, wall = time.process_time(), time.monotonic()
                seen = child("--listen", "--seconds", str(arguments.seconds))
                cores = (time.process_time() - began) / (time.monotonic() - wall) - alone
            late, stamps = 1e3 * np.array(seen["late"]), np.array(seen["stamps"])
            gaps = np.diff(stamps) * rate
            print(
                f"{rate:g} Hz{', with /tf' if tf else ''}: {len(stamps) / (stamps[-1] - stamps[0]):.1f} per second, "
                f"{int((gaps > 1.9).sum())} gaps; latency p50 {np.percentile(late, 50):.2f}, "
                f"p99 {np.percentile(late, 99):.2f}, max {late.max():.2f} ms; {cores:.3f} cores more"
            )
    with RosBridge(bot):
        seen = child("--goal")
    print(
        f"goal of 2 s: accepted after {1e3 * seen['accepted']:.1f} ms, result {seen['code']} after "
        f"{seen['took']:.2f} s, error {seen['error']:.1e}"
    )
    bot.close()


if __name__ == "__main__":
    main()
