"""Pictures by another renderer."""

from .pending import pending

NvisiiRenderer = pending("render.NvisiiRenderer", "CameraView(C).computeImageAndDepth draws pictures")
