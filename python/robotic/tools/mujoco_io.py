"""MuJoCo's files: Config.addFile and Config.writeMJCF as classes."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

import kinegraph

from ..scenes import Config


class MujocoLoader:
    """Reads an MJCF file into a new scene, like Config.addFile.

    Args:
        file: The file.
        verbose, visualsOnly, defaultConType, options: Not used.
        basePos: Position of a frame above the file's frames, (3,), m.
        baseQuat: Its orientation, (4,).
    Attributes:
        C: The scene.
        base: The frame above the file's frames.
    Raises:
        FileError: The file cannot be read.
        ParseError: It is invalid.
    """

    def __init__(
        self,
        file: str,
        verbose: int = 0,
        visualsOnly: bool = True,
        defaultConType: str = "0",
        basePos: ArrayLike = (0.0, 0.0, 0.0),
        baseQuat: ArrayLike = (1.0, 0.0, 0.0, 0.0),
        **options: Any,
    ) -> None:
        self.C = Config()
        self.C.addFile(str(file))
        roots = [frame for frame in self.C.getFrames() if frame.getParent() is None]
        self.base = self.C.addFrame("mujoco_base").setPosition(basePos).setQuaternion(baseQuat)
        for frame in roots:
            frame.setParent(self.base, keepAbsolutePose_and_adaptRelativePose=False)


class MujocoWriter:
    """Writes a scene as MJCF, like Config.writeMJCF.

    Args:
        C: The scene.
        options: Not used.
    """

    def __init__(self, C: kinegraph.Config, **options: Any) -> None:
        self.C = C

    def str(self) -> str:
        """Returns the text."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "scene.xml"
            self.C.writeMJCF(file)
            return file.read_text()

    def dump(self) -> None:
        """Prints the text."""
        print(self.str())
