"""MeshTool under its name of 0.3.x."""

from .mesh_tool import MeshTool as MeshHelper

__all__ = ["MeshHelper"]
