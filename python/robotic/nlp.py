"""Base class of user-defined problems for `NLP_Solver.setPyProblem`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinegraph import OT as OT


class NLP:
    """A problem with `dimension` variables and a type per residual. Subclasses set the fields and implement evaluate.

    Attributes:
        dimension: Number of variables.
        types: An OT per residual; featureTypes is an alias.
        bounds: (2, dimension): lower bounds, then upper bounds; empty without bounds.
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
        """Computes the residuals and their Jacobian.

        Args:
            x: (dimension,).
        Returns:
            phi, one per type, and J, shape (residuals, dimension).
        """
        raise NotImplementedError(f"{type(self).__name__}.evaluate(x) -> (phi, J)")

    def getDimension(self) -> int:
        """Returns the number of variables."""
        return self.dimension

    def getFeatureTypes(self) -> list[OT]:
        """Returns the OT of each residual."""
        return self.types

    def getBounds(self) -> Any:
        """Returns the bounds, (2, dimension), or an empty sequence."""
        return self.bounds


class RastriginSOS(NLP):
    """Rastrigin's function of two variables as a sum of four squares, with many minima; the least is 0 at the origin.

    Args:
        a: Frequency of the waves.
        condition: Factor on the second variable.
    """

    def __init__(self, a: float = 4.0, condition: float = 20.0) -> None:
        super().__init__()
        self.a, self.condition = a, condition
        self.dimension = 2
        self.types = [OT.sos] * 4
        self.bounds = np.array([[-2.0, -2.0], [2.0, 2.0]])

    def evaluate(self, x: NDArray[np.float64]) -> tuple[Any, Any]:
        """Computes phi = (sin(a x0), sin(a c x1), 2 x0, 2 c x1) with c the condition, and J.

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
