"""Mesh files: those that Frame.setMeshFile reads, as a class."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinegraph.errors import NotFound

from ..scenes import Config


class MeshTool:
    """Reads a mesh file, like Frame.setMeshFile.

    Args:
        file: h5, ply, stl, obj, dae, glb and other formats.
    Attributes:
        C: A scene whose only frame has the mesh.
        frame: The frame.
    Raises:
        FileError: The file cannot be read.
    """

    def __init__(self, file: str) -> None:
        self.load(file)

    def load(self, file: str) -> None:
        """Reads another file.

        Args:
            file: The file.
        Raises:
            FileError: It cannot be read.
        """
        self.file = str(file)
        self.C = Config()
        self.frame = self.C.addFrame("mesh").setMeshFile(self.file)

    @property
    def points(self) -> NDArray[np.float64]:
        """The vertices, (n, 3), m."""
        return self.frame.getMeshPoints()

    def view(self) -> None:
        """Shows the mesh."""
        self.C.view(True)

    def report(self) -> None:
        """Prints the numbers of vertices and triangles, and the box around them."""
        points = self.points
        print(f"{self.file}: {len(points)} vertices, {len(self.frame.getMeshTriangles())} triangles")
        print(f"  from {points.min(0)} to {points.max(0)} m")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        raise NotFound(
            f"MeshTool.{name}: not part of Kinegraph; instead: the package trimesh edits and converts meshes"
        )
