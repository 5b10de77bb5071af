"""A node of ROS 2 with a context and threads of its own."""

from __future__ import annotations

import importlib
import threading
from typing import Any

from ..errors import NotFound


def needed(module: str) -> Any:
    """Imports a module of ROS 2.

    Args:
        module: Its name.
    Raises:
        NotFound: It is not installed, or its setup file was not sourced.
    """
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError:
        package = module.split(".")[0]
        raise NotFound(
            f"the ROS 2 package {package} is not found: run 'source /opt/ros/DISTRO/setup.bash' first, or install it"
        ) from None


class RunningNode:
    """A node whose callbacks run in threads until close()."""

    def __init__(self, name: str, threads: int):
        """Creates the node; start() begins to spin it.

        Args:
            name: Name of the node.
            threads: Number of threads for callbacks, 2 or more.
        """
        rclpy, executors = needed("rclpy"), needed("rclpy.executors")
        self._rclpy = rclpy
        self._context = rclpy.Context()
        rclpy.init(context=self._context)
        self.node: Any = rclpy.create_node(name, context=self._context)
        self._executor = executors.MultiThreadedExecutor(threads, context=self._context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin, daemon=True)

    def start(self) -> None:
        """Begins to spin."""
        self._thread.start()

    def _spin(self) -> None:
        try:
            self._executor.spin()
        except Exception:
            if self._context.ok():  # else it was closed
                raise

    def close(self) -> None:
        """Ends the threads and removes the node."""
        if not self._context.ok():
            return
        self._rclpy.shutdown(context=self._context)  # ends the spinning before the node, whose callbacks may run
        if self._thread.is_alive():
            self._thread.join(timeout=2.0)
        self._executor.shutdown(timeout_sec=2.0)
        self.node.destroy_node()


def seconds(duration: Any) -> float:
    """Converts a Time or Duration of ROS to s."""
    return float(duration.sec) + 1e-9 * float(duration.nanosec)
