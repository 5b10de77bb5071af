"""Runs in the environment of another distribution: sees a bridge and moves it by its topic. Prints what it saw."""

import json
import os
import sys
import threading
import time

import rclpy
from builtin_interfaces.msg import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

by, seconds = float(sys.argv[1]), float(sys.argv[2])
rclpy.init()
node = rclpy.create_node("peer")
states, descriptions = [], []
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_subscription(JointState, "/joint_states", states.append, 100)
node.create_subscription(String, "/robot_description", descriptions.append, latched)
publisher = node.create_publisher(JointTrajectory, "/joint_trajectory_controller/joint_trajectory", 1)
executor = SingleThreadedExecutor()
executor.add_node(node)
thread = threading.Thread(target=executor.spin, daemon=True)
thread.start()
end = time.monotonic() + 20
while time.monotonic() < end and not (states and descriptions and publisher.get_subscription_count()):
    time.sleep(0.01)
names, q = list(states[-1].name)[:7], list(states[-1].position)[:7]
goal = [q[0] + by, *q[1:]]
point = JointTrajectoryPoint(positions=goal, time_from_start=Duration(sec=1))
publisher.publish(JointTrajectory(joint_names=names, points=[point]))
time.sleep(0.2)
states.clear()
time.sleep(seconds)
print(
    json.dumps(
        {
            "states": len(states),
            "urdf": "<robot" in descriptions[0].data,
            "goal": goal,
            "q": list(states[-1].position)[:7],
        }
    )
)
executor.shutdown()
rclpy.try_shutdown()
thread.join(timeout=5)
sys.stdout.flush()
os._exit(0)  # rclpy of Jazzy may abort at the end of Python
