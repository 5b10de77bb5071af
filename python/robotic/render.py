"""Rendering by other engines."""

from .pending import pending

NvisiiRenderer = pending("render.NvisiiRenderer", "CameraView(C).computeImageAndDepth renders pictures")
