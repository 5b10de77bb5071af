#!/usr/bin/env bash
# Tests the connection to ROS 2: makes an environment of wheels of rclpy in build/ros, installs Kinegraph into it unless
# this tree has a built module, and runs tests/ros. Arguments are passed to pytest.
set -euo pipefail
cd "$(dirname "$0")/.."
export KINEGRAPH_HEADLESS=1 ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST PIP_DISABLE_PIP_VERSION_CHECK=1
bash tools/ros_venv.sh build/ros
if compgen -G "python/kinegraph/_core.*.so" >/dev/null; then
  export PYTHONPATH=$PWD/python
else
  build/ros/bin/python -m pip install -q .
fi
# Peers: rclpy of another distribution, and a DDS of another vendor.
if [ ! -f build/ros_jazzy/ready ]; then
  "${PYTHON:-python3}" -m venv build/ros_jazzy
  build/ros_jazzy/bin/pip install -q ros-jazzy-rclpy ros-jazzy-rmw-fastrtps-cpp ros-jazzy-sensor-msgs \
    ros-jazzy-trajectory-msgs ros-jazzy-std-msgs numpy
  touch build/ros_jazzy/ready
fi
if [ ! -f build/ros_dds/ready ]; then
  "${PYTHON:-python3}" -m venv build/ros_dds
  build/ros_dds/bin/pip install -q cyclonedds==11.0.1
  touch build/ros_dds/ready
fi
build/ros/bin/python -m pytest -q tests/ros "$@"
