"""What planTask tried, as a scene: the waypoint at which a branch failed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._core import ST, Config
from .errors import ArgumentError

if TYPE_CHECKING:
    from .task_plan import TaskPlan

_GHOST = [0.9, 0.2, 0.2, 0.4]
_MOVED = 1e-3  # m or rad: what moved less than that is no ghost


def ghostScene(plan: TaskPlan, C: Config) -> Config:
    """A copy of the scene in which the waypoint that the farthest branch failed at stands as a red ghost.

    Raises ArgumentError where no branch failed.
    """
    failed = [branch for branch in plan.tree if branch.ghost is not None]
    if not failed:
        raise ArgumentError(f"view: no branch failed at a waypoint; {plan.message}")
    branch = max(failed, key=lambda b: len(b.actions))
    scene, ghost = C.copy(), branch.ghost
    assert ghost is not None
    for frame in C.getFrames():
        there = ghost.getFrame(frame.name)
        moved = abs(there.getPose() - frame.getPose()).max() > _MOVED
        if not moved or frame.getShapeType() in (ST.none, ST.marker):
            continue
        copy = scene.addFrame(f"ghost of {frame.name}").setPose(there.getPose())
        if frame.getShapeType() == ST.mesh:
            copy.setMesh(frame.getMeshPoints(), frame.getMeshTriangles())
        else:
            copy.setShape(frame.getShapeType(), frame.getSize())
        copy.setColor(_GHOST).setContact(0)
    return scene
