"""Path finders with the arguments of earlier versions."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

import kinegraph
from kinegraph.compatibility.parameters import RRT_OPTIONS


class RRT_PathFinder(kinegraph.RRT_PathFinder):
    """Like kinegraph.RRT_PathFinder; the parameters `rrt/...` are its defaults, and setProblem takes the tolerance of
    collisions, too, as until 0.2.3."""

    def __init__(self) -> None:
        """Creates a path finder without a problem, with the options that params_add set as `rrt/<option>`.

        Raises:
            ArgumentError: A parameter has an invalid value.
        """
        super().__init__()
        parameters = kinegraph.params_get()
        self.setOptions(**{name: parameters[f"rrt/{name}"] for name in RRT_OPTIONS if f"rrt/{name}" in parameters})

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
