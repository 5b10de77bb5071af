"""Trajectories as text files."""

import numpy as np
import pytest

import kinegraph as ry


def test_a_plan_is_written_at_a_rate_and_read_back(tmp_path):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    plan = ry.planMotion(C, {"l_gripper": [0.3, 0.3, 1.1]})
    file = tmp_path / "motion.csv"
    names = C.getJointNames()[: C.getJointDimension()]
    plan.writeCsv(file, rate=250.0, names=names)
    table = np.genfromtxt(file, delimiter=",", names=True)
    assert table.dtype.names[:3] == ("time", *names[:2]) and np.diff(table["time"]).max() <= 1 / 250 + 1e-12
    back = ry.SampledTrajectory.read(file)
    assert back.duration == plan.duration
    for t in table["time"][[0, 5, -1]]:
        np.testing.assert_array_equal(back.eval(t), plan.eval(t))
    bot = ry.BotOp(C, False)
    bot.follow(back)
    bot.wait(C)
    np.testing.assert_allclose(bot.get_q(), plan.eval(plan.duration)[0], atol=1e-2)


def test_other_files_are_refused_with_their_place(tmp_path):
    file = tmp_path / "q.csv"
    file.write_text("time,a\n0,1\n0.1,2\n")
    with pytest.raises(ry.ParseError, match=r"q.csv:2:1: .* 2 numbers; expected time, q, velocity.*retime"):
        ry.SampledTrajectory.read(file)
    with pytest.raises(ry.FileError, match="none.csv"):
        ry.SampledTrajectory.read(tmp_path / "none.csv")
