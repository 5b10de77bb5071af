"""URDF files: Config.addFile as a class."""

from __future__ import annotations

from typing import Any

from ..scenes import Config


class URDFLoader:
    """Reads a URDF file into a new scene, like Config.addFile.

    Args:
        file: The file.
        options: Not used; Kinegraph finds meshes by itself.
    Attributes:
        C: The scene.
    Raises:
        FileError: The file cannot be read.
        ParseError: It is invalid.
    """

    def __init__(self, file: str, *_options: Any, **options: Any) -> None:
        self.C = Config()
        self.C.addFile(str(file))
