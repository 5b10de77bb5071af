"""Data sets of LeRobot, format v3.0, written with pyarrow and PyAV alone (extra `lerobot`)."""

from .checking import checkDataset
from .demonstrations import Demonstrations, Randomization, demonstrate
from .rehearsal import rehearse
from .writer import LeRobotWriter, mergeShards

__all__ = ["Demonstrations", "LeRobotWriter", "Randomization", "checkDataset", "demonstrate", "mergeShards", "rehearse"]
