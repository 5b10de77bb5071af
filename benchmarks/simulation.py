"""Measures the accuracy and speed of the simulation: a table of slips, sags and processor times.

    python benchmarks/simulation.py

Times are processor times of this process, best of several rounds, except for the wall-time ratio of threads.
"""

import time
from itertools import pairwise

import numpy as np

import kinegraph as ry

BOX = [0.06, 0.06, 0.06, 0.005]
START = np.array([0.0, 0.3, 0.68])


def panda(box=None, mass=1.0):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    if box is not None:
        C.addFrame("box").setShape(ry.ST.ssBox, BOX).setPosition(box).setMass(mass)
    return C


def reach(position, side):
    result = ry.solveIk(panda(), {"l_gripper": {"position": position, "z": [0, 0, 1], "y": side}})
    assert result.feasible
    return np.array(result.q)


def tracking():
    """Returns the largest error on a spline of .5 rad in 1 s with all joints, and the error .2 s later, mrad."""
    C = panda()
    q = C.getJointState()
    S = ry.Simulation(C)
    S.setSplineRef(q + 0.5, [1.0])
    spline = ry.BSpline().set(3, np.array([q, q + 0.5]), [0.0, 1.0])
    worst = 0.0
    for _ in range(100):
        S.step([], 0.01, ry.ControlMode.spline)
        worst = max(worst, np.abs(S.get_q() - spline.eval([S.get_t()])[0]).max())
    S.multi_step(0.2)
    return 1e3 * worst, 1e3 * np.abs(S.get_q() - q - 0.5).max()


class Grasp:
    """A Panda that grasps the frame box in a simulation, and the pose of the box in its hand."""

    def __init__(self, C, side, force):
        self.C = C
        above, at, self.up = (reach(START + np.array([0, 0, z]), side) for z in (0.12, 0.0, 0.2))
        C.setJointState(above)
        self.S = ry.Simulation(C)
        self.go(above, at)
        self.S.closeGripper("l_gripper", 0.0, 0.1, force)
        while not self.S.gripperIsDone("l_gripper"):
            self.S.step()
        self.at, self.turned = at, self.up + np.eye(7)[0]

    def go(self, start, end):
        for s in np.linspace(0.01, 1, 100):
            q = start + (10 * s**3 - 15 * s**4 + 6 * s**5) * (end - start)
            self.S.step(q, 0.01, ry.ControlMode.position)

    def place(self):
        """Returns position (3,), m, and axes (3, 3) in the axes of the hand."""
        hand, box = self.C.getFrame("l_gripper"), self.C.getFrame("box")
        R = hand.getRotationMatrix().T
        return R @ (box.getPosition() - hand.getPosition()), R @ box.getRotationMatrix()


def grasp(mass, force, side):
    """Returns slips in the hand, mm, for a lift by .2 m, 10 s of holding, a rotation by 1 rad in 1 s, and the placement
    error.
    """
    g = Grasp(panda(START, mass), side, force)
    places = [g.place()[0]]
    g.go(g.at, g.up)
    places.append(g.place()[0])
    for _ in range(1000):
        g.S.step()
    places.append(g.place()[0])
    g.go(g.up, g.turned)
    places.append(g.place()[0])
    g.go(g.turned, g.up)
    g.go(g.up, g.at)
    slips = [1e3 * np.linalg.norm(b - a) for a, b in pairwise(places)]
    return [*slips, 1e3 * np.linalg.norm(g.C.getFrame("box").getPosition() - START)]


def random_grasp(rng):
    """Grips a box of random size, mass, angle and position with half more force than needed, and rotates it by 1 rad in
    1 s.

    The flat of a finger, 1 cm wide, carries weight times 1, and moment with an arm of 3.8 mm. Returns the slip during
    the rotation, mm and degrees; infinite if the box was lost.
    """
    mass, yaw, aside = rng.uniform(0.05, 1.0), rng.uniform(-0.19, 0.19), rng.uniform(-0.01, 0.01, 2)
    size = [rng.uniform(0.03, 0.06), rng.uniform(0.03, 0.045), rng.uniform(0.03, 0.09), 0.003]
    C = panda()
    place = [*(START[:2] + aside), START[2] - 0.03 + size[2] / 2]
    C.addFrame("box").setShape(ry.ST.ssBox, size).setPosition(place).setMass(mass)
    C.getFrame("box").setQuaternion([np.cos(yaw / 2), 0, 0, np.sin(yaw / 2)])
    g = Grasp(C, [1, 0, 0], 1.5 * mass * np.hypot(9.81, 2.5) / 2 * (1 + abs(aside[0]) / 0.0038))
    g.go(g.at, g.up)
    before, axes = g.place()
    g.go(g.up, g.turned)
    after, turned = g.place()
    slip = 1e3 * np.linalg.norm(after - before)
    angle = np.degrees(np.arccos(np.clip((np.trace(axes.T @ turned) - 1) / 2, -1, 1)))
    return (slip, angle) if np.linalg.norm(after) < 0.06 else (np.inf, np.inf)


def random_grasps(count=40):
    """Returns the number of held random boxes, their median and worst slip, mm, and the worst angle, degrees."""
    slips, angles = np.array([random_grasp(np.random.default_rng(seed)) for seed in range(count)]).T
    held = np.isfinite(slips)
    return held.sum(), np.median(slips), slips[held].max(), angles[held].max()


def built_tower():
    """Returns the largest horizontal error of a box, mm, in a tower of four boxes of .2 kg built by the robot."""
    C = panda()
    starts = [START + np.array([0.15 * i - 0.3, -0.15 if i % 2 else -0.03, 0]) for i in range(4)]
    for i, start in enumerate(starts):
        C.addFrame(f"box{i}").setShape(ry.ST.ssBox, [0.05, 0.05, 0.06, 0.003]).setPosition(start).setMass(0.2)
    S = ry.Simulation(C)

    arm = panda()

    def via(position):
        """Moves to a pose in 2 s, straight and upright."""
        path = []
        for point in np.linspace(C.getFrame("l_gripper").getPosition(), position, 21)[1:]:
            ry.solveIk(arm, {"l_gripper": {"position": point, "z": [0, 0, 1], "y": [1, 0, 0]}}, apply=True)
            path.append(arm.getJointState())
        S.setSplineRef(path, np.linspace(0, 2, 21)[1:])
        S.step([], S.getTimeToSplineEnd() + 0.3, ry.ControlMode.spline)

    def fingers(call, *arguments):
        call("l_gripper", *arguments)
        while not S.gripperIsDone("l_gripper"):
            S.step([], 0.01, ry.ControlMode.spline)

    to, high = START + np.array([0.0, 0.1, 0.0]), np.array([0, 0, 0.25])
    for i, start in enumerate(starts):
        over = np.add(to, [0, 0, 0.06 * i])
        fingers(S.moveGripper, 0.08)
        for position in (np.add(start, high), start):
            via(position)
        fingers(S.closeGripper, 0.0, 0.1, 10.0)
        for position in (np.add(start, high), np.add(over, high), np.add(over, [0, 0, 0.0002])):
            via(position)
        fingers(S.moveGripper, 0.08)
        via(np.add(over, high))
    S.step([], 1.0, ry.ControlMode.spline)
    return max(1e3 * np.linalg.norm(C.getFrame(f"box{i}").getPosition()[:2] - to[:2]) for i in range(4))


def tower():
    """Returns creep of the top of ten boxes from 1 s to 10 s, and its sag, mm."""
    C = ry.Config()
    for i in range(10):
        C.addFrame(f"b{i}").setShape(ry.ST.ssBox, BOX).setPosition([0, 0, 0.03 + 0.06 * i]).setMass(0.1)
    S = ry.Simulation(C)
    S.step([], 1.0)
    top = C.getFrame("b9").getPosition()
    S.step([], 9.0)
    return 1e3 * np.linalg.norm(C.getFrame("b9").getPosition() - top), 1e3 * (0.57 - top[2])


def turntable():
    """Returns the growth of the radius, mm, of a box at .4 m on a disc that rotates at 1 rad/s for 10 s."""
    C = ry.Config()
    C.addText("hub: {} disc (hub): { joint: hingeZ, shape: cylinder, size: [.05 .6], mass: 1 }")
    C.addFrame("box").setShape(ry.ST.ssBox, BOX).setPosition([0.4, 0, 0.055]).setMass(0.1)
    S = ry.Simulation(C, options={"ground": False})
    S.pushConfigToSim([[[0, 0.4, 0], [0, 0, 1]]], [1.0])
    S.step([1.0], 10.0, ry.ControlMode.velocity)
    return 1e3 * abs(np.linalg.norm(C.getFrame("box").getPosition()[:2]) - 0.4)


def best(function, rounds=5):
    times = []
    for _ in range(rounds):
        start = time.process_time()
        function()
        times.append(time.process_time() - start)
    return min(times)


def steps():
    """Returns processor times of 10 ms of a Panda with a box, us, and of creating the simulation, ms."""
    C = panda([-0.3, 0.35, 0.68], 0.1)
    S = ry.Simulation(C)
    S.step([], 0.5)
    return 1e6 * best(lambda: [S.step() for _ in range(200)]) / 200, 1e3 * best(lambda: ry.Simulation(C))


def environments():
    """Returns steps of 50 ms per second of processor time, Panda with a box, and the speedup by two threads."""
    C = panda([-0.3, 0.35, 0.68], 0.1)
    u = np.full((32, 7), 0.05)

    def walk(batch, times):
        for _ in range(times):
            batch.step(u, 0.05, ry.ControlMode.velocity)

    batches = {threads: ry.SimulationBatch(C, 32, threads) for threads in (1, 2)}
    walls = {1: np.inf, 2: np.inf}
    for _ in range(5):
        for threads, batch in batches.items():
            start = time.perf_counter()
            walk(batch, 5)
            walls[threads] = min(walls[threads], time.perf_counter() - start)
    rate = 320 / best(lambda: walk(batches[1], 10), 3)
    return rate, walls[1] / walls[2]


def main():
    print("tracking of a spline, largest / .2 s after (mrad): {:.6f} / {:.6f}".format(*tracking()))
    for side, words in ([1, 0, 0], "along the radius"), ([0, 1, 0], "across it"):
        needed = 5.05  # N per kg: the force that friction needs during the lift
        for mass, force in (1.0, 30.0), (0.1, 10.0), (1.0, needed * 1.2), (0.1, 0.1 * needed * 1.2):
            numbers = " / ".join(f"{value:.4f}" for value in grasp(mass, force, side))
            print(f"grasp {words}, {mass} kg, {force:.2f} N: lift / hold 10 s / turn / place (mm): {numbers}")
    print(
        "40 random grasps: held {}, slip while turned, median {:.4f}, worst {:.4f} mm, {:.4f} degrees".format(
            *random_grasps()
        )
    )
    print(f"tower of four built by the robot: largest error across (mm): {built_tower():.4f}")
    print("tower of ten: creep in 9 s / sag (mm): {:.4f} / {:.4f}".format(*tower()))
    print(f"turntable, 10 s (mm): {turntable():.4f}")
    print("10 ms of a Panda with a box (us): {:.1f}; creation (ms): {:.1f}".format(*steps()))
    print("steps of 50 ms per second and core: {:.0f}; two threads: x {:.2f}".format(*environments()))


if __name__ == "__main__":
    main()
