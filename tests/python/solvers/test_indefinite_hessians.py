"""Problems of W. Hock and K. Schittkowski, Test Examples for Nonlinear Programming Codes, 1981, by their numbers,
solved with the exact Hessian of the costs, which is indefinite in most of them."""

import numpy as np
import pytest

import kinegraph as ry

inf = np.inf


def hs84(x):
    return [np.dot(row, x[0] * np.array([1, x[1], x[2], x[3], x[4]])) for row in HS84_ROWS]


HS84_ROWS = [
    [-145421.402, 2931.1506, -40.427932, 5106.192, 15711.36],
    [-155011.1084, 4360.53352, 12.9492344, 10236.884, 13176.786],
    [-326669.5104, 7390.68412, -27.8986976, 16643.076, 30988.146],
]
HS84_COSTS = [8720288.849, -150512.5253, 156.6950325, -476470.3222, -729482.8271]
HS25_Y = 0.01 * np.arange(1, 100)
HS25_U = 25 + (-50 * np.log(HS25_Y)) ** (2 / 3)
HS112_C = np.array([-6.089, -17.164, -34.054, -5.914, -24.721, -14.986, -24.1, -10.708, -26.662, -22.179])
S = np.sqrt

# costs, constraints >= 0, constraints == 0, lower and upper bounds, start, least cost
PROBLEMS = {
    "HS24": (
        lambda x: ((x[0] - 3) ** 2 - 9) * x[1] ** 3 / (27 * S(3)),
        lambda x: [x[0] / S(3) - x[1], x[0] + S(3) * x[1], 6 - x[0] - S(3) * x[1]],
        None,
        ([0, 0], [inf, inf]),
        [1, 0.5],
        -1,
    ),
    "HS25": (  # a gradient near zero at the start
        lambda x: np.sum((np.exp(-((HS25_U - x[1]) ** x[2]) / x[0]) - HS25_Y) ** 2),
        None,
        None,
        ([0.1, 0, 0], [100, 25.6, 5]),
        [100, 12.5, 3],
        0,
    ),
    "HS29": (
        lambda x: -x[0] * x[1] * x[2],
        lambda x: [48 - x[0] ** 2 - 2 * x[1] ** 2 - 4 * x[2] ** 2],
        None,
        ([-inf] * 3, [inf] * 3),
        [1, 1, 1],
        -16 * S(2),
    ),
    "HS33": (
        lambda x: (x[0] - 1) * (x[0] - 2) * (x[0] - 3) + x[2],
        lambda x: [x[2] ** 2 - x[1] ** 2 - x[0] ** 2, x[0] ** 2 + x[1] ** 2 + x[2] ** 2 - 4],
        None,
        ([0, 0, 0], [inf, inf, 5]),
        [0, 0, 3],
        S(2) - 6,
    ),
    "HS36": (
        lambda x: -x[0] * x[1] * x[2],
        lambda x: [72 - x[0] - 2 * x[1] - 2 * x[2]],
        None,
        ([0, 0, 0], [20, 11, 42]),
        [10, 10, 10],
        -3300,
    ),
    "HS37": (
        lambda x: -x[0] * x[1] * x[2],
        lambda x: [72 - x[0] - 2 * x[1] - 2 * x[2], x[0] + 2 * x[1] + 2 * x[2]],
        None,
        ([0, 0, 0], [42, 42, 42]),
        [10, 10, 10],
        -3456,
    ),
    "HS41": (
        lambda x: 2 - x[0] * x[1] * x[2],
        None,
        lambda x: [x[0] + 2 * x[1] + 2 * x[2] - x[3]],
        ([0] * 4, [1, 1, 1, 2]),
        [2, 2, 2, 2],
        52 / 27,
    ),
    "HS44": (
        lambda x: x[0] - x[1] - x[2] - x[0] * x[2] + x[0] * x[3] + x[1] * x[2] - x[1] * x[3],
        lambda x: [
            8 - x[0] - 2 * x[1],
            12 - 4 * x[0] - x[1],
            12 - 3 * x[0] - 4 * x[1],
            8 - 2 * x[2] - x[3],
            8 - x[2] - 2 * x[3],
            5 - x[2] - x[3],
        ],
        None,
        ([0] * 4, [inf] * 4),
        [0, 0, 0, 0],
        -15,
    ),
    "HS54": (  # variables from 1e-3 to 1e8
        lambda x: (
            -np.exp(
                -(((x[0] - 1e4) ** 2 / 6.4e7 + (x[0] - 1e4) * (x[1] - 1) / 2e4 + (x[1] - 1) ** 2) / 0.96) / 2
                - (x[2] - 2e6) ** 2 / 9.8e13
                - (x[3] - 10) ** 2 / 5e3
                - (x[4] - 1e-3) ** 2 / 5e-3
                - (x[5] - 1e8) ** 2 / 5e17
            )
        ),
        None,
        lambda x: [x[0] + 4e3 * x[1] - 1.76e4],
        ([0, -10, 0, 0, -1, 0], [2e4, 10, 1e7, 20, 1, 2e8]),
        [6e3, 1.5, 4e6, 2, 3e-3, 5e7],
        -np.exp(-27 / 280),
    ),
    "HS56": (
        lambda x: -x[0] * x[1] * x[2],
        None,
        lambda x: [
            x[0] - 4.2 * np.sin(x[3]) ** 2,
            x[1] - 4.2 * np.sin(x[4]) ** 2,
            x[2] - 4.2 * np.sin(x[5]) ** 2,
            x[0] + 2 * x[1] + 2 * x[2] - 7.2 * np.sin(x[6]) ** 2,
        ],
        ([-inf] * 7, [inf] * 7),
        [1, 1, 1, *[np.arcsin(S(1 / 4.2))] * 3, np.arcsin(S(5 / 7.2))],
        -3.456,
    ),
    "HS84": (
        lambda x: 24345 + np.dot(HS84_COSTS, x[0] * np.array([1, x[1], x[2], x[3], x[4]])),
        lambda x: [*hs84(x), *(np.array([294000, 294000, 277200]) - hs84(x))],
        None,
        ([0, 1.2, 20, 9, 6.5], [1000, 2.4, 60, 9.3, 7]),
        [2.52, 2, 37.5, 9.25, 6.8],
        -5280335.133,
    ),
    "HS106": (
        lambda x: x[0] + x[1] + x[2],
        lambda x: [
            1 - 0.0025 * (x[3] + x[5]),
            1 - 0.0025 * (x[4] + x[6] - x[3]),
            1 - 0.01 * (x[7] - x[4]),
            x[0] * x[5] - 833.33252 * x[3] - 100 * x[0] + 83333.333,
            x[1] * x[6] - 1250 * x[4] - x[1] * x[3] + 1250 * x[3],
            x[2] * x[7] - 1250000 - x[2] * x[4] + 2500 * x[4],
        ],
        None,
        ([100, 1000, 1000, *[10] * 5], [*[10000] * 3, *[1000] * 5]),
        [5000, 5000, 5000, 200, 350, 150, 225, 425],
        7049.24802,
    ),
    "HS108": (
        lambda x: -0.5 * (x[0] * x[3] - x[1] * x[2] + x[2] * x[8] - x[4] * x[8] + x[4] * x[7] - x[5] * x[6]),
        lambda x: [
            1 - x[2] ** 2 - x[3] ** 2,
            1 - x[8] ** 2,
            1 - x[4] ** 2 - x[5] ** 2,
            1 - x[0] ** 2 - (x[1] - x[8]) ** 2,
            1 - (x[0] - x[4]) ** 2 - (x[1] - x[5]) ** 2,
            1 - (x[0] - x[6]) ** 2 - (x[1] - x[7]) ** 2,
            1 - (x[2] - x[4]) ** 2 - (x[3] - x[5]) ** 2,
            1 - (x[2] - x[6]) ** 2 - (x[3] - x[7]) ** 2,
            1 - x[6] ** 2 - (x[7] - x[8]) ** 2,
            x[0] * x[3] - x[1] * x[2],
            x[2] * x[8],
            -x[4] * x[8],
            x[4] * x[7] - x[5] * x[6],
        ],
        None,
        ([-inf] * 8 + [0], [inf] * 9),
        [1] * 9,
        -S(3) / 2,
    ),
    "HS112": (
        lambda x: np.sum(x * (HS112_C + np.log(x / np.sum(x)))),
        None,
        lambda x: [
            x[0] + 2 * x[1] + 2 * x[2] + x[5] + x[9] - 2,
            x[3] + 2 * x[4] + x[5] + x[6] - 1,
            x[2] + x[6] + x[7] + 2 * x[8] + x[9] - 1,
        ],
        ([1e-6] * 10, [inf] * 10),
        [0.1] * 10,
        -47.76109,
    ),
}


def gradient(f, x):
    """Exact to rounding: the imaginary part after a tiny imaginary step."""
    return np.array([f(x + 1e-30j * e).imag / 1e-30 for e in np.eye(len(x))])


class Problem:
    """The problem as the solver sees it: costs as f, constraints, and the Hessian of the costs if wanted."""

    def __init__(self, name, with_hessian):
        self.f, above, equal, bounds, start, self.least = PROBLEMS[name]
        self.rows = [self.f]
        self.types = [ry.OT.f]
        self.start = np.clip(np.array(start, dtype=float), *bounds)
        self.dimension = len(start)
        self.bounds = np.array(bounds, dtype=float)
        self.evals = 0
        for constraints, type_, sign in ((above, ry.OT.ineq, -1), (equal, ry.OT.eq, 1)):
            for k in range(len(constraints(self.start)) if constraints else 0):
                self.rows.append(lambda x, c=constraints, k=k, sign=sign: sign * c(x)[k])
                self.types.append(type_)
        if with_hessian:
            self.getFHessian = self.hessian

    def evaluate(self, x):
        self.evals += 1
        return np.array([row(x) for row in self.rows]), np.array([gradient(row, x) for row in self.rows])

    def hessian(self, x):
        h = 1e-6 * np.maximum(1, abs(x))
        columns = [
            (gradient(self.f, x + d) - gradient(self.f, x - d)) / (2 * s) for d, s in zip(np.diag(h), h, strict=True)
        ]
        return 0.5 * (np.array(columns) + np.array(columns).T)


def solve(name, with_hessian):
    problem = Problem(name, with_hessian)
    solver = ry.NLP_Solver().setPyProblem(problem).setInitialization(problem.start)
    return problem, solver.setOptions(verbose=0, stopTolerance=1e-6, stopGTolerance=1e-6).solve()


@pytest.mark.parametrize("name", PROBLEMS)
def test_with_the_hessian_the_least_cost_is_found(name):
    problem, result = solve(name, True)
    assert result.feasible and result.status.name == "converged", result.message
    cost = problem.f(result.x)
    assert cost <= problem.least + 1e-4 * max(1, abs(problem.least))
    assert cost >= problem.least - 1e-4 * max(1, abs(problem.least))


def test_the_hessian_saves_evaluations():
    counts = np.array([[solve(name, with_hessian)[0].evals for with_hessian in (False, True)] for name in PROBLEMS])
    assert np.median(counts[:, 1] / counts[:, 0]) <= 1
    assert counts[:, 1].sum() < counts[:, 0].sum()


class Waves:
    """sum_i cos x_i, which has a maximum at 0, with many variables."""

    def __init__(self, n):
        self.dimension, self.types = n, [ry.OT.f]
        self.bounds = np.array([[-1.0] * n, [4.0] * n])

    def evaluate(self, x):
        return np.array([np.cos(x).sum()]), -np.sin(x)[None]

    def getFHessian(self, x):
        return np.diag(-np.cos(x))


@pytest.mark.parametrize("n", [2, 30, 250])
def test_a_maximum_is_no_solution_whatever_the_size(n):
    problem = Waves(n)
    solver = ry.NLP_Solver().setPyProblem(problem).setInitialization(np.zeros(n))
    result = solver.setOptions(verbose=0, stopEvals=2000).solve()
    assert result.status.name == "converged", result.message
    moved = np.minimum(abs(result.x - np.pi), abs(result.x + 1))
    np.testing.assert_allclose(moved, 0, atol=1e-3)  # a minimum, inside or at a bound


@pytest.mark.parametrize("method", ["augmentedLag", "newton"])
def test_a_saddle_is_left(method):
    class Saddle:
        dimension, types = 2, [ry.OT.f]
        bounds = np.array([[-2.0, -2.0], [2.0, 3.0]])

        def evaluate(self, x):
            return np.array([x[0] ** 2 - x[1] ** 2 + x[0] * x[1] / 10]), np.array(
                [[2 * x[0] + x[1] / 10, -2 * x[1] + x[0] / 10]]
            )

        def getFHessian(self, x):
            return np.array([[2, 0.1], [0.1, -2]])

    solver = ry.NLP_Solver().setPyProblem(Saddle()).setInitialization(np.zeros(2))
    result = solver.setSolver(getattr(ry.OptMethod, method)).setOptions(verbose=0).solve()
    assert result.status.name == "converged", result.message
    assert abs(result.x[1]) in (pytest.approx(2), pytest.approx(3))
