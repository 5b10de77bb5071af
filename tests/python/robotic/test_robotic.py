"""Scripts written for the reference: its names, and its rule of what is feasible."""

from __future__ import annotations

import copy
import importlib
import pickle

import numpy as np
import pytest

import kinegraph
import robotic as ry

# The exports of `robotic` 0.4.2: __all__ of its stub, and what its __init__ adds.
EXPORTS = [
    "ArgWord",
    "BSpline",
    "BotOp",
    "CameraView",
    "CameraViewSensor",
    "Config",
    "ConfigurationViewer",
    "ControlMode",
    "DataGen",
    "FS",
    "Frame",
    "ImageViewer",
    "JT",
    "KOMO",
    "KOMO_ManipulationHelper",
    "KOMO_Objective",
    "LGP_TAMP_Abstraction",
    "LGP_Tool",
    "NLP",
    "NLP_Factory",
    "NLP_Sampler",
    "NLP_Solver",
    "NLP_SolverOptions",
    "OT",
    "OptBench_Skeleton_Handover",
    "OptBench_Skeleton_Pick",
    "OptBench_Skeleton_StackAndBalance",
    "OptBenchmark_InvKin_Endeff",
    "OptMethod",
    "Quaternion",
    "RRT_PathFinder",
    "ST",
    "SY",
    "Simulation",
    "SimulationEngine",
    "SimulationState",
    "Skeleton",
    "SolverReturn",
    "StepObservation",
    "_left",
    "_path",
    "_right",
    "_sequence",
    "algo",
    "calib",
    "clear_params",
    "compiled",
    "default_LGP_TAMP_Abstraction",
    "depthImage2PointCloud",
    "getArucoImage",
    "get_NLP_Problem_names",
    "get_params",
    "make_NLP_Problem",
    "params_add",
    "params_clear",
    "params_file",
    "params_get",
    "params_print",
    "raiPath",
    "rai_path",
    "rnd_seed",
    "rnd_seed_random",
    "setRaiPath",
    "set_params",
    "test",
    "version",
]


def contradiction(apart: float) -> kinegraph.NLP:
    """x is to be 0 and `apart`: the violations of both equalities sum up to that."""
    problem = ry.NLP_Factory()
    problem.setDimension(1)
    problem.setTypes([ry.OT.eq, ry.OT.eq])
    problem.setEvalCallback(lambda x: (np.array([x[0], x[0] - apart]), np.ones((2, 1))))
    return problem


@pytest.mark.parametrize("name", EXPORTS)
def test_every_name_of_the_reference_can_be_imported(name: str) -> None:
    assert hasattr(ry, name)
    assert hasattr(importlib.import_module("robotic.ry"), name)


def test_all_spellings_of_the_import_give_the_same_module() -> None:
    from robotic import _robotic
    from robotic import ry as inner

    assert inner is ry and _robotic is ry and importlib.import_module("robotic._robotic") is ry
    assert issubclass(ry.Config, kinegraph.Config) and ry.KOMO is kinegraph.KOMO  # no second world of objects


def test_each_package_speaks_its_own_rule_of_feasible() -> None:
    strict = kinegraph.NLP_Solver(contradiction(0.06), verbose=0).solve()
    lenient = ry.NLP_Solver(contradiction(0.06), verbose=0).solve()
    assert lenient.eq == pytest.approx(strict.eq) and strict.eq == pytest.approx(0.06, abs=1e-6)
    assert not strict.feasible and lenient.feasible
    assert lenient.dict()["feasible"] is True and "feasible: 1" in str(lenient) and "feasible: 0" in str(strict)
    assert "violated by 0.03" in lenient.message and "eq 0.06" in lenient.message
    assert not ry.NLP_Solver(contradiction(0.3), verbose=0).solve().feasible
    assert not kinegraph.NLP_Solver(contradiction(0.06), verbose=0).solve().feasible  # nothing was switched


def test_a_result_without_violations_says_nothing_of_rules() -> None:
    result = ry.NLP_Solver(contradiction(0.0), verbose=0).solve()
    assert result.feasible and "rule" not in result.message


def test_a_result_is_pickled_and_explains_itself() -> None:
    result = ry.NLP_Solver(contradiction(0.06), verbose=0).solve()
    again = pickle.loads(pickle.dumps(result))
    assert isinstance(again, ry.SolverReturn) and again.feasible and again.eq == result.eq
    assert isinstance(result, kinegraph.SolverReturn) and result.explain()


def test_evaluations_add_up_over_the_solves_of_a_solver() -> None:
    solver = ry.NLP_Solver(contradiction(0.0), verbose=0)
    first = solver.solve()
    second = solver.solve()
    own = kinegraph.SolverReturn.evals.__get__(second)
    assert first.evals == first.totalEvals and second.evals == first.evals + own
    assert second.dict()["evals"] == second.evals and f"evals: {second.evals}," in str(second)


def test_options_of_earlier_years_are_those_of_today() -> None:
    solver = ry.NLP_Solver(contradiction(0.0), verbose=0)
    assert solver.setOptions(maxLambda=3.0, damping=0.1) is solver
    assert solver.getOptions().dict()["lambdaMax"] == 3.0
    assert ry.NLP_SolverID.newton == ry.OptMethod.Newton == ry.OptMethod.newton


@pytest.mark.parametrize(
    "use",
    [
        "ry.SRRT_PathFinder()",
        "ry.algo.box_filter([1])",
        "ry.DataGen.RndStableConfigs()",
    ],
)
def test_what_is_not_there_yet_says_so_and_what_does_the_same(use: str) -> None:
    with pytest.raises(kinegraph.NotFound, match="Kinegraph does not have it yet; .+"):
        eval(use)


def test_a_mistyped_name_gives_the_most_similar_one() -> None:
    with pytest.raises(AttributeError, match="robotic has no 'Confg'; similar names: Config"):
        _ = ry.Confg


def test_a_problem_of_ones_own_has_a_base() -> None:
    from robotic.nlp import NLP, RastriginSOS

    class Hill(NLP):
        def __init__(self) -> None:
            self.dimension = 1
            self.featureTypes = [ry.OT.sos]
            self.bounds = [[-2.0], [2.0]]

        def evaluate(self, x):
            return np.array([x[0] - 1.0]), np.ones((1, 1))

    assert ry.NLP_Solver().setOptions(verbose=0).setPyProblem(Hill()).solve().x == pytest.approx([1.0])
    waves = RastriginSOS()
    x = np.array([0.3, -0.2])
    J = waves.evaluate(x)[1]
    for i in range(2):
        step = 1e-6 * np.eye(2)[i]
        slope = (waves.evaluate(x + step)[0] - waves.evaluate(x - step)[0]) / 2e-6
        np.testing.assert_allclose(J[:, i], slope, atol=1e-4)


def test_a_frame_that_is_not_there_is_none() -> None:
    C = ry.Config()
    C.addFrame("table")
    with pytest.warns(kinegraph.KinegraphWarning, match="'tabel' doesn't exist; similar names: table"):
        assert C.getFrame("tabel") is None
    assert C.getFrame("tabel", False) is None and C.getFrame("table").name == "table"
    with pytest.warns(kinegraph.KinegraphWarning, match="'cloud' doesn't exist"):
        C.delFrame("cloud")  # as notebooks do before they add it
    with pytest.raises(kinegraph.FrameNotFound):
        kinegraph.Config().getFrame("tabel")


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, ry.Config.copy, lambda C: pickle.loads(pickle.dumps(C))])
def test_copies_of_scenes_are_of_the_same_kind(copied) -> None:
    C = ry.Config()
    C.addFrame("table")
    again = copied(C)
    assert type(again) is ry.Config and again.getFrameNames() == ["table"]
    again.addFrame("cup")
    assert C.getFrame("cup", False) is None
