"""States, recordings, batches, errors and hostile parameters of simulations."""

import base64
import gzip
import pickle
import re
import threading

import numpy as np
import pytest

import kinegraph as ry
from panda_scenes import add_box, panda


def test_a_state_is_complete():
    C = panda()
    add_box(C, [-0.3, 0.35, 0.75])
    S = ry.Simulation(C)
    S.setSplineRef(C.getJointState() + 0.2, [0.5])
    S.moveGripper("l_gripper", 0.02)
    S.attach("l_gripper", "box")
    S.multi_step(0.1)

    def future(simulation, config):
        simulation.multi_step(0.3)
        return simulation.get_q(), config.getFrame("box").getPose(), simulation.getGripperWidth("l_gripper")

    state = S.getState()
    expected = future(S, C)
    S.detach("l_gripper", "box")
    S.moveGripper("l_gripper", 0.08)
    S.multi_step(0.2)
    S.setState(state)
    assert S.getState() == state
    again = future(S, C)
    other = panda()
    add_box(other, [0.5, 0.5, 1.0])
    T = ry.Simulation(other)
    T.setState(pickle.loads(pickle.dumps(state)))
    elsewhere = future(T, other)
    for one in again, elsewhere:
        assert all(np.array_equal(a, b) for a, b in zip(one, expected))


def test_fields_of_a_state_may_be_changed():
    C = panda()
    add_box(C, [-0.3, 0.35, 0.68])
    S = ry.Simulation(C)
    state = S.getState()
    state.freePos = [[-0.3, 0.35, 1.5, 1, 0, 0, 0]]
    state.q = state.q + 0.1
    state.time = 3.0
    S.setState(state)
    assert S.get_t() == 3.0
    assert np.allclose(C.getFrame("box").getPosition(), [-0.3, 0.35, 1.5])
    S.step()
    assert np.allclose(S.get_q(), state.q, atol=1e-9)
    assert S.get_frameVelocities()[0, 0, 2] == pytest.approx(-9.81 * 0.01, rel=1e-6)


def test_a_recording_is_repeated_bit_for_bit(tmp_path):
    C = panda()
    add_box(C, [-0.3, 0.35, 0.75])
    S = ry.Simulation(C)
    S.step()
    S.startRecording()
    S.setSplineRef(C.getJointState() + 0.1, [0.2])
    S.closeGripper("l_gripper", 0.01, 0.2, 5.0)
    S.multi_step(0.1)
    S.applyForce("box", [1, 0, 0])
    S.step(S.get_q(), 0.02, ry.ControlMode.position)
    S.clearForces()
    S.pushConfigToSim()
    S.step()
    recording = S.stopRecording()
    assert recording.q.shape == (12, 7) and recording.freePos.shape == (12, 1, 7)
    recording.save(tmp_path / "run")
    read = ry.SimulationRecording.load(tmp_path / "run")
    again = read.replay(read.makeConfig())
    assert again.getState() == S.getState()
    (tmp_path / "bad").write_bytes((tmp_path / "run").read_bytes()[:-100])
    with pytest.raises(ry.ArgumentError, match="recording"):
        ry.SimulationRecording.load(tmp_path / "bad")


def test_environments_of_a_batch_are_simulations_at_any_number_of_threads():
    C = panda()
    add_box(C, [-0.3, 0.35, 0.75])
    rng = np.random.default_rng(0)
    commands = rng.uniform(-0.5, 0.5, (5, 4, 7))
    results = []
    for threads in (1, 2):
        batch = ry.SimulationBatch(C, 4, threads)
        for u in commands:
            batch.step(u, 0.01, ry.ControlMode.velocity, 5)
        results.append((batch.q(), batch.qDot(), batch.freePos(), batch.freeVel()))
    assert all(np.array_equal(a, b) for a, b in zip(*results))
    S = ry.Simulation(C)
    for u in commands:
        for _ in range(5):
            S.step(u[2], 0.01, ry.ControlMode.velocity)
    assert np.array_equal(S.get_q(), results[0][0][2])
    batch.reset([2])
    assert np.allclose(batch.times(), [0.25, 0.25, 0, 0.25])
    batch.reset([])  # such as np.flatnonzero(done) while none is done
    batch.place(np.empty(0, int), np.empty((0, len(C.getJointState()))))
    assert np.allclose(batch.times(), [0.25, 0.25, 0, 0.25])
    with pytest.raises(ry.ArgumentError, match=r"environments is a mask; .*np.flatnonzero"):
        batch.reset(np.array([True, False, False, True]))
    with pytest.raises(ry.ArgumentError, match=r"environments has 0\.5; expected indices"):
        batch.reset([0.5])
    assert np.allclose(batch.times(), [0.25, 0.25, 0, 0.25])
    batch.reset()
    assert np.allclose(batch.times(), 0)


def test_masses_and_frictions_of_a_batch_may_differ():
    C = ry.Config()
    C.addFrame("slope", "", "shape: box, size: [6 2 .1], friction: .3").setPose([0, 0, 3, *slope(0.4)])
    C.addFrame("box", "", "shape: box, size: [.1 .1 .05], mass: 1, friction: .3")
    C.getFrame("box").setPose([*np.array([0, 0, 3]) + 0.0751 * normal(0.4), *slope(0.4)])
    batch = ry.SimulationBatch(C, 3)
    batch.setMasses("box", [0.1, 1, 10])
    batch.setFrictions("box", [0.1, 0.3, 1.1])
    batch.step([], 0.5)
    way = np.linalg.norm(batch.freePos()[:, 0, :3] - C.getFrame("box").getPosition(), axis=1)
    assert way[0] == pytest.approx(0.5 * 9.81 * (np.sin(0.4) - 0.2 * np.cos(0.4)) * 0.25, rel=0.02)
    assert way[1] == pytest.approx(0.5 * 9.81 * (np.sin(0.4) - 0.3 * np.cos(0.4)) * 0.25, rel=0.02)
    assert way[2] < 1e-3


def slope(angle):
    return [np.cos(angle / 2), 0, np.sin(angle / 2), 0]


def normal(angle):
    return np.array([np.sin(angle), 0, np.cos(angle)])


def test_errors_change_nothing_and_are_explained():
    C = panda()
    add_box(C, [-0.3, 0.35, 0.68])
    S = ry.Simulation(C)
    state = S.getState()
    for call in (
        lambda: S.step([0, 0, 0], 0.01, ry.ControlMode.position),
        lambda: S.step([np.nan] * 7, 0.01, ry.ControlMode.position),
        lambda: S.step([], 0.0),
        lambda: S.step([], np.inf),
        lambda: S.moveGripper("box", 0.1),
        lambda: S.moveGripper("l_gripper", -1),
        lambda: S.moveGripper("nobody", 0.1),
        lambda: S.setSplineRef([[0, 0]], [1.0]),
        lambda: S.setState(ry.Simulation(panda()).getState()),
        lambda: S.attach("box", "box"),
        lambda: S.selectSensor("eye"),
    ):
        with pytest.raises(ry.Error):
            call()
    assert S.getState() == state
    with pytest.raises(ry.ArgumentError, match="bullet"):
        ry.Simulation(C, ry.SimulationEngine.bullet)
    with pytest.raises(ry.ArgumentError, match="inner_step"):
        ry.Simulation(C, options={"inner_step": 1.0})


def test_scenes_that_cannot_be_simulated_name_the_frame():
    C = ry.Config()
    C.addFrame("stone", "", "shape: sphere, size: [.1], mass: 1, friction: -1")
    with pytest.raises(ry.ArgumentError, match="stone"):
        ry.Simulation(C)
    D = ry.Config()
    D.addFrame("rod").setShape(ry.ST.sphere, [0.1]).setMass(1.0, [0.1, 0.1, 0.3])
    with pytest.warns(ry.KinegraphWarning, match="rod"):
        ry.Simulation(D)


@pytest.mark.parametrize("attributes", ["mass: 1e-9", "mass: 1e9", "mass: 1, friction: 1e9", "mass: 1, friction: 0"])
def test_hostile_parameters_give_a_result_or_a_clear_error(attributes):
    C = ry.Config()
    for i in range(2):  # they overlap
        C.addFrame(f"b{i}", "", f"shape: box, size: [.1 .1 .1], {attributes}").setPosition([0, 0, 0.05 + 0.03 * i])
    S = ry.Simulation(C)
    try:
        S.step([], 10.0)
    except ry.Error as error:
        assert "all bounds" in str(error)
        assert S.get_t() == 0
    assert np.isfinite(S.get_frameVelocities()).all()


def test_random_scenes_stay_finite():
    rng = np.random.default_rng(1)
    for _ in range(100):
        C = ry.Config()
        for i in range(rng.integers(1, 8)):
            size = rng.uniform(0.03, 0.2, 3)
            shape, sizes = [
                (ry.ST.box, size),
                (ry.ST.sphere, size[:1]),
                (ry.ST.capsule, size[:2]),
                (ry.ST.cylinder, size[:2]),
                (ry.ST.ssBox, [*size, 0.01]),
            ][rng.integers(5)]
            frame = (
                C.addFrame(f"f{i}")
                .setShape(shape, list(sizes))
                .setPosition(rng.uniform(-0.3, 0.3, 3) + np.array([0, 0, 0.5]))
            )
            turn = rng.normal(size=4)
            frame.setQuaternion(turn / np.linalg.norm(turn))
            if rng.uniform() < 0.8:
                frame.setMass(rng.uniform(0.01, 3))
        S = ry.Simulation(C)
        for _ in range(10):
            S.step([], 0.2)
        assert np.isfinite(C.getFrameState()).all()


def test_a_perturbation_is_a_spring_that_is_part_of_the_state():
    C = ry.Config()
    C.addFrame("ball").setShape(ry.ST.sphere, [0.1]).setPosition([0, 0, 1.0]).setMass(2.0)
    C.addFrame("wall").setShape(ry.ST.box, [0.1, 0.1, 0.1]).setPosition([1, 0, 1])
    S = ry.Simulation(C)
    assert S.getPerturbation() is None
    S.perturb("ball", [0, 0, 0], [0.3, 0, 1.2])
    for _ in range(50):
        S.step()
    state = S.getState()
    positions = []
    for simulation in (S, ry.Simulation(C)):
        simulation.setState(state)
        for _ in range(250):
            simulation.step()
        positions.append(C.getFrame("ball").getPosition())
    assert np.array_equal(*positions)
    # it hangs at the equilibrium of the spring of 10 rad/s: g / w^2 below the target
    assert positions[0] == pytest.approx([0.3, 0, 1.2 - 9.81 / 100], abs=1e-4)
    assert S.getPerturbation()["force"] == pytest.approx([0, 0, 2 * 9.81], abs=1e-2)
    assert S.getPerturbation()["position"] == pytest.approx(positions[0], abs=1e-3)
    S.endPerturbation()
    S.step([], 0.1)
    assert S.getPerturbation() is None
    assert S.get_frameVelocities()[0, 0, 2] == pytest.approx(-0.981, abs=1e-3)  # it falls
    with pytest.raises(ry.ArgumentError, match="'wall' is fixed to the world"):
        S.perturb("wall", [0, 0, 0], [0, 0, 0])


@pytest.mark.parametrize("kind", ["free box", "box on a hinge"])
@pytest.mark.parametrize("point", [[0, 0, 0], [0.035, 0.035, 0.035], [1.1, 0, 0], [0, -30, 20], [1e3, 1e3, 0]])
@pytest.mark.parametrize("target", [[5, 0, 1], [0, 0, -3], [1e6, 0, 1e6]])
def test_no_perturbation_ends_a_simulation(kind: str, point: list[float], target: list[float]) -> None:
    C = ry.Config()
    C.addFrame("floor").setShape(ry.ST.box, [4, 4, 0.1]).setPosition([0, 0, -0.05]).setContact(1)
    C.addFrame("base").setPosition([0, 0, 0.5])
    box = C.addFrame("box", "base" if kind == "box on a hinge" else "")
    box.setShape(ry.ST.box, [0.07, 0.07, 0.07]).setMass(0.2).setContact(1)
    if kind == "box on a hinge":
        box.setJoint(ry.JT.hingeX)
    else:
        box.setPosition([0, 0, 0.2])
    S = ry.Simulation(C)
    S.perturb("box", point, target)
    for _ in range(100):
        S.step()
    assert np.all(np.isfinite(C.getFrameState()))
    assert np.abs(S.get_frameVelocities()).max(initial=0.0) < 1e3


def test_a_recording_is_shown_with_its_fingers_and_saved_as_a_page(tmp_path):
    C = panda()
    S = ry.Simulation(C)
    S.startRecording()
    S.setSplineRef(C.getJointState() + 0.2, [0.5])
    S.moveGripper("l_gripper", 0.02)
    for _ in range(50):
        S.step([], 0.01, ry.ControlMode.spline)
    recording = S.stopRecording()
    recording.save(tmp_path / "run.bin")
    ry.SimulationRecording.load(tmp_path / "run.bin").saveHtml(tmp_path / "run.html")
    page = (tmp_path / "run.html").read_text()
    messages = gzip.decompress(base64.b64decode(re.search(r'id="recording">([^<]*)<', page)[1]))
    slices, seconds = re.search(rb'"slices":(\d+),"seconds":([\d.E+-]+)', messages).groups()
    assert int(slices) == 26 and float(seconds) == pytest.approx(0.5)
    assert recording.view() == 0  # nobody is there
    recording.view_close()
    recording.saveHtml(tmp_path / "shared.html", client=tmp_path / "viewer.js")
    assert '<script src="viewer.js">' in (tmp_path / "shared.html").read_text() and (tmp_path / "viewer.js").exists()
    with pytest.raises(ry.ArgumentError, match="has no steps"):
        S.startRecording()
        S.stopRecording().saveHtml(tmp_path / "none.html")


def test_states_of_earlier_years_are_poses_of_frames():
    C = panda()
    add_box(C, [0.1, 0.35, 0.9])
    q, poses = C.getJointState(), C.getFrameState()
    S = ry.Simulation(C, ry.SimulationEngine.physx, 0)
    for _ in range(50):
        S.step(np.full(7, -0.2), 0.01, ry.ControlMode.velocity)
    assert C.getFrame("box").getPosition()[2] < 0.8
    S.setState(poses, q)
    assert S.get_q() == pytest.approx(q) and np.abs(S.get_qDot()).max() == 0
    assert C.getFrame("box").getPosition() == pytest.approx([0.1, 0.35, 0.9])
    S.setState(poses)
    assert S.get_q() == pytest.approx(q)


def test_a_run_takes_as_many_steps_as_its_time_has_and_needs_an_end():
    C = panda()
    S = ry.Simulation(C)
    S.setSplineRef(C.getJointState() + 0.2, [0.5])
    assert S.run(0.5) == 0
    other = ry.Simulation(panda())
    other.setSplineRef(other.get_q() + 0.2, [0.5])
    other.multi_step(0.5)
    assert np.array_equal(S.get_q(), other.get_q()) and S.get_t() == pytest.approx(0.5)
    with pytest.raises(ry.ArgumentError, match="seconds is None"):
        S.run()
    with pytest.raises(ry.ArgumentError, match="tau"):
        S.run(1.0, tau=0)


def test_other_threads_run_during_many_steps(panda):
    counted = []
    stop = threading.Event()

    def count():
        while not stop.wait(0.001):
            counted.append(1)

    counter = threading.Thread(target=count)
    counter.start()
    ry.Simulation(panda).multi_step(20.0)
    stop.set()
    counter.join()
    assert len(counted) > 10


def test_a_state_from_before_a_force_sensor_says_so():
    C = panda()
    S = ry.Simulation(C)
    state = S.getState()
    S.addForceTorqueSensor("l_gripper")
    with pytest.raises(ry.ArgumentError, match="was taken before addForceTorqueSensor; take states after the sensors"):
        S.setState(state)
    S.setState(S.getState())
