"""Path finders with the arguments of earlier versions."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

import kinegraph


class RRT_PathFinder(kinegraph.RRT_PathFinder):
    """Like kinegraph.RRT_PathFinder; setProblem takes the tolerance of collisions, too, as until 0.2.3."""

    def setProblem(
        self,
        Configuration: kinegraph.Config,
        q0: ArrayLike | None = None,
        qT: ArrayLike | None = None,
        collisionTolerance: float | None = None,
    ) -> Any:
        """Sets the scene, as kinegraph.RRT_PathFinder.setProblem.

        Args:
            Configuration, q0, qT: As in kinegraph.RRT_PathFinder.setProblem.
            collisionTolerance: Allowed penetration of each pair, m; None keeps the option.
        Returns:
            This path finder.
        Raises:
            ArgumentError: Only one of q0 and qT is passed, one is not a joint vector, or the tolerance is negative.
        """
        if collisionTolerance is not None:
            self.setOptions(collisionTolerance=collisionTolerance)
        super().setProblem(Configuration, q0, qT)
        return self
