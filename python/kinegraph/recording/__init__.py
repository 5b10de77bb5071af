"""Recordings in MCAP files with the messages of ROS 2, for Foxglove, Rerun and rosbag2 (extra `mcap`)."""

from .live import serveFoxglove
from .reading import Recording, readRecording
from .recorder import recordRobot, recordSimulation
from .saving import saveRecording

__all__ = ["Recording", "readRecording", "recordRobot", "recordSimulation", "saveRecording", "serveFoxglove"]
