"""The base of problems of one's own, as scripts write them for `NLP_Solver.setPyProblem`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinegraph import OT as OT


class NLP:
    """A problem: of `dimension` variables, with a type per residual. Subclasses set the fields and write evaluate.

    Attributes:
        dimension: Number of variables.
        types: An OT per residual; featureTypes is the same by its earlier name.
        bounds: (2, dimension), the lower row and the upper one; none if empty.
    """

    dimension: int = 0
    bounds: Any = ()

    def __init__(self) -> None:
        self.types: list[OT] = []

    @property
    def featureTypes(self) -> list[OT]:
        """The OT of each residual."""
        return self.types

    @featureTypes.setter
    def featureTypes(self, types: list[OT]) -> None:
        self.types = types

    def evaluate(self, x: NDArray[np.float64]) -> tuple[Any, Any]:
        """The residuals and their Jacobian.

        Args:
            x: (dimension,).
        Returns:
            phi, one per type, and J, a row per residual.
        """
        raise NotImplementedError(f"{type(self).__name__}.evaluate(x) -> (phi, J)")

    def getDimension(self) -> int:
        """Number of variables."""
        return self.dimension

    def getFeatureTypes(self) -> list[OT]:
        """The OT of each residual."""
        return self.types

    def getBounds(self) -> Any:
        """(2, dimension), or nothing."""
        return self.bounds


class RastriginSOS(NLP):
    """Rastrigin's function of two variables as a sum of four squares: many minima, the least is 0 at 0.

    Args:
        a: How high the waves are.
        condition: How much steeper the second variable is.
    """

    def __init__(self, a: float = 4.0, condition: float = 20.0) -> None:
        super().__init__()
        self.a, self.condition = a, condition
        self.dimension = 2
        self.types = [OT.sos] * 4
        self.bounds = np.array([[-2.0, -2.0], [2.0, 2.0]])

    def evaluate(self, x: NDArray[np.float64]) -> tuple[Any, Any]:
        """phi = (sin(a x0), sin(a c x1), 2 x0, 2 c x1), c the condition, and J.

        Args:
            x: (2,).
        Returns:
            phi (4,) and J (4, 2).
        """
        a, c = self.a, self.condition
        phi = np.array([np.sin(a * x[0]), np.sin(a * c * x[1]), 2.0 * x[0], 2.0 * c * x[1]])
        J = np.zeros((4, 2))
        J[0, 0], J[1, 1] = a * np.cos(a * x[0]), a * c * np.cos(a * c * x[1])
        J[2, 0], J[3, 1] = 2.0, 2.0 * c
        return phi, J
