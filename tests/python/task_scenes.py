"""Tasks of the benchmarks, and how tests come by plans of them."""

import sys
from pathlib import Path
from typing import Any

import kinegraph as ry

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "benchmarks"))

import everyday_scenes
import panda_tasks
import tasks as families

__all__ = ["everyday_scenes", "families", "panda_tasks", "planned"]


def planned(problem: Any) -> tuple[ry.Config, ry.TaskPlan]:
    """The scene of a problem, and a plan of its goal."""
    plan = ry.planTask(problem.C, problem.goal)
    assert plan.feasible, plan
    return problem.C, plan
