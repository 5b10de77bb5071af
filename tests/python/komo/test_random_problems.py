"""Random motion problems of benchmarks/komo_family.py: evaluations, and costs beside those of a stricter solve."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

spec = importlib.util.spec_from_file_location(
    "komo_family", Path(__file__).parents[3] / "benchmarks" / "komo_family.py"
)
family = importlib.util.module_from_spec(spec)
spec.loader.exec_module(family)

STRICT = {"stopTolerance": 1e-6}
SEED = 1


def drawn(kind, count):
    return family.drawFamily(ry, np, {"seed": SEED, "count": count, "kinds": [kind]})["problems"]


@pytest.mark.parametrize(("kind", "count", "most"), [("phases", 3, 145), ("reach 32", 10, 138), ("switches", 10, 1200)])
def test_all_are_solved_in_few_evaluations(kind, count, most):
    problems = drawn(kind, count)
    answers = [family.solve(ry, np, problem, {}) for problem in problems]
    assert all(family.isSolved(ry, np, problem, answer) for problem, answer in zip(problems, answers))
    assert sum(answer["evaluations"] for answer in answers) <= most


@pytest.mark.parametrize("kind", ["reach 32", "mobile"])
def test_costs_are_those_of_a_stricter_solve(kind):
    for problem in drawn(kind, 6):
        answer, strict = family.solve(ry, np, problem, {}), family.solve(ry, np, problem, STRICT)
        assert answer["evaluations"] <= strict["evaluations"]
        assert answer["cost"] == pytest.approx(strict["cost"], rel=1e-3)
        assert answer["violation"] <= 1e-3 and strict["violation"] <= 1e-5


def test_the_seed_determines_the_problems():
    def draw(seed):
        return family.drawFamily(ry, np, {"seed": seed, "count": 1, "kinds": list(family.KINDS)})["problems"]

    assert draw(3) == draw(3)
    assert draw(3) != draw(4)
    assert [problem["kind"] for problem in draw(3)] == list(family.KINDS)
