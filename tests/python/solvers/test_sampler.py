"""Samples that satisfy the constraints of a problem."""

import signal

import numpy as np
import pytest

import kinegraph as ry


@pytest.mark.parametrize("name", ["Box", "Modes", "Wedge", "HalfCircle", "LinearProgram"])
def test_samples_are_feasible_and_differ(name):
    nlp = ry.make_NLP_Problem(name)
    sampler = ry.NLP_Sampler(nlp)
    points = []
    for _ in range(20):
        ret = sampler.sample()
        assert ret.feasible and ret.done, ret.message
        assert max(0, nlp.summarizeErrors(nlp.evaluate(ret.x)[0])[2]) <= 1e-3
        points.append(ret.x)
    assert len(np.unique(points, axis=0)) == 20


def test_hit_and_run_is_uniform_in_a_half_circle():
    """Returns the shares of the quarters (by width) of the disk of radius .5 right of x = -.2, from 1e6 grid points."""
    sampler = ry.NLP_Sampler(ry.make_NLP_Problem("HalfCircle")).setOptions(interiorBurnInSteps=20)
    x = np.array([sampler.sample().x for _ in range(2000)])
    grid = np.linspace(-0.5, 0.5, 1001)
    X, Y = np.meshgrid(grid, grid)
    inside = X[(X**2 + Y**2 <= 0.25) & (X >= -0.2)]
    edges = np.linspace(-0.2, 0.5, 5)
    expected = np.histogram(inside, edges)[0] / inside.size
    share = np.histogram(np.clip(x[:, 0], -0.2, 0.5), edges)[0] / len(x)
    assert np.abs(share - expected).max() < 4 * np.sqrt(0.25 / len(x))
    assert abs(x[:, 1].mean()) < 4 * 0.25 / np.sqrt(len(x))


def test_the_seed_decides_the_samples():
    nlp = ry.make_NLP_Problem("HalfCircle")
    first, same, other = (
        [s.sample().x.tolist() for _ in range(3)]
        for s in (ry.NLP_Sampler(nlp).setSeed(5), ry.NLP_Sampler(nlp).setSeed(5), ry.NLP_Sampler(nlp).setSeed(6))
    )
    assert first == same != other


@pytest.mark.parametrize("interior", ["HR", "MCMC", "Langevin", "manifoldRRT", "none"])
def test_postures_of_a_robot_that_hold_a_position(interior):
    nlp = ry.make_NLP_Problem("IK")
    sampler = ry.NLP_Sampler(nlp).setOptions(interiorMethod=interior, interiorSampleSteps=5)
    samples = [sampler.sample() for _ in range(20)]
    assert sum(s.feasible for s in samples) >= 19
    low, high = nlp.getBounds()
    for s in samples:
        if s.feasible:
            assert s.eq + s.ineq <= 1e-3 and (s.x >= low).all() and (s.x <= high).all()
        else:
            assert s.status.name == "infeasible" and "sum of violations" in s.message


def test_options_are_told_and_mistakes_named():
    sampler = ry.NLP_Sampler(ry.make_NLP_Problem("Box"))
    assert sampler.setOptions(eps=0.1, useCentering=True, interiorNoiseMethod="iso").getOptions()["eps"] == 0.1
    assert sampler.setOptions(interiorMethod="MCMC").getOptions()["eps"] == 0.1, "others stay as they are"
    with pytest.raises(ry.ArgumentError, match="no option 'interiorMetod'; similar names: interiorMethod"):
        sampler.setOptions(interiorMetod="HR")
    with pytest.raises(ry.ArgumentError, match="interiorMethod is 'Gibbs'; expected one of none, HR"):
        sampler.setOptions(interiorMethod="Gibbs")
    with pytest.raises(ry.ArgumentError, match="option eps is 'much'"):
        sampler.setOptions(eps="much")


@pytest.mark.usefixtures("first_ctrl_c")
@pytest.mark.parametrize("way", ["raised in it", "signal"])
def test_ctrl_c_ends_it(way):
    """A signal counts once the function it came in has returned, whether or not the interpreter has raised
    KeyboardInterrupt."""

    class Slow:
        dimension, types, bounds, evals = 1, [ry.OT.ineq], np.array([[-1.0], [1.0]]), 0

        def evaluate(self, x):
            self.evals += 1
            if self.evals == 5 and way == "signal":
                signal.raise_signal(signal.SIGINT)
            elif self.evals == 5:
                raise KeyboardInterrupt
            return np.array([x[0] - 0.5]), np.ones((1, 1))

    problem = Slow()
    nlp = ry.NLP_Solver().setPyProblem(problem).getProblem()
    ret = ry.NLP_Sampler(nlp).setSeed(0).setOptions(interiorSampleSteps=100000).sample()
    assert (ret.status.name, ret.message) == ("cancelled", "interrupted by Ctrl-C"), problem.evals
    assert problem.evals == 5
    assert ret.feasible and ret.x[0] <= 0.5
