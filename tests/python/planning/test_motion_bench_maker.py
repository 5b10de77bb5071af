"""planMotion on a sample of MotionBenchMaker; skipped if the package with its files cannot be fetched."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[3] / "benchmarks"))
pytest.importorskip("yaml")

import motion_bench_maker

import planning


@pytest.fixture(scope="module")
def panda() -> motion_bench_maker.Robot:
    try:
        return motion_bench_maker.Robot("panda")
    except (subprocess.CalledProcessError, OSError) as error:
        pytest.skip(f"no problems: {error}")


@pytest.mark.filterwarnings("ignore:.*at a constant relative pose")
@pytest.mark.parametrize("scene", motion_bench_maker.SCENES)
def test_a_problem_of_each_scene_is_solved_and_the_motion_is_free(panda: motion_bench_maker.Robot, scene: str) -> None:
    row = planning.ours(panda.problem(scene, 11), {"seed": 1, "optimize": "length"})
    assert row["valid"] and row["solved"], row["message"]
    assert row["free"]  # the path every milliradian, and the motion every 5 ms
    assert row["clearance"] >= 0 and 1 - 1e-9 <= row["ratio"] < 2.5
