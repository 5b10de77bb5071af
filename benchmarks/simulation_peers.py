"""Compares scenes in three engines, in turns: kinegraph, the package `robotic`, and plain MuJoCo.

    python benchmarks/simulation_peers.py --robotic PYTHON --mujoco PYTHON [--scenes panda_with_boxes reach]

Both PYTHON are interpreters, one with `robotic`, one with `mujoco` and numpy; an engine without one is skipped. Each
scene runs in a process of its own, all engines one after the other. Times are processor times, the best of three
rounds. MuJoCo has its defaults, steps of 2 ms, position actuators, and an arm of seven capsules. The others take steps
of 10 ms of their own. Slips are in mm. The grippers of `robotic` have a fixed, unknown force, so that a light box is
grasped there.
"""

import argparse
import importlib
import json
import os
import subprocess
import sys
import time

import numpy as np

BOX = [0.06, 0.06, 0.06, 0.005]
ROUNDS = 3
SLOPE = np.deg2rad(20)
TUMBLING = np.array([0.0008, 0.0010, 0.0016])  # inertia, kg m^2, of a body of .5 kg that rotates about the second axis
TOP = np.array([0.00205, 0.00205, 0.0016])  # about the tip, of a top of .5 kg with its center .05 m above it
BOXES_AT_REST = [[-0.5 + 0.09 * (i % 5), 0.25 + 0.1 * (i // 5), 0.68] for i in range(20)]
BOXES_IN_THE_AIR = [[-0.3 + 0.05 * (i % 3) + 0.01 * (i % 2), 0.45 + 0.04 * (i % 2), 1 + 0.09 * i] for i in range(20)]
LEAN = np.array([np.cos(0.2), np.sin(0.2), 0, 0])  # of the top: .4 rad


def wall(function, *arguments):
    start = time.process_time()
    function(*arguments)
    return time.process_time() - start


class Ry:
    """Kinegraph and robotic, by one interface."""

    def __init__(self, module, configurations="{}"):
        self.ry = importlib.import_module(module)
        self.configurations = json.loads(configurations)  # for the grasp

    def simulation(self, C):
        return self.ry.Simulation(C, self.ry.SimulationEngine.physx, 0)

    def add_box(self, C, name, position, mass=0.1):
        box = C.addFrame(name)
        box.setPosition(position)
        box.setShape(self.ry.ST.ssBox, BOX)
        box.setMass(mass)
        return box

    def tower(self):
        C = self.ry.Config()
        boxes = [self.add_box(C, f"b{i}", [0, 0, 0.03 + 0.06 * i]) for i in range(10)]
        S = self.simulation(C)
        self.steps(S, 100)
        top = boxes[-1].getPosition()
        self.steps(S, 900)
        return {
            "tower of ten, creep in 9 s": 1e3 * np.linalg.norm(boxes[-1].getPosition() - top),
            "tower of ten, sag": 1e3 * (0.57 - top[2]),
        }

    def steps(self, S, count):
        for _ in range(count):
            S.step([], 0.01, self.ry.ControlMode.none)

    def slope(self):
        C = self.ry.Config()
        half = SLOPE / 2
        plate = C.addFrame("plate").setShape(self.ry.ST.box, [2, 2, 0.1]).setPosition([0, 0, 2])
        plate.setQuaternion([np.cos(half), 0, np.sin(half), 0]).setAttributes({"friction": 0.5})
        normal = np.array([np.sin(SLOPE), 0, np.cos(SLOPE)])
        box = self.add_box(C, "box", [0, 0, 2] + 0.08 * normal)
        box.setQuaternion([np.cos(half), 0, np.sin(half), 0]).setAttributes({"friction": 0.5})
        S = self.simulation(C)
        self.steps(S, 100)
        start = box.getPosition()
        self.steps(S, 900)
        return {"slope of 20 degrees, friction .5, creep in 9 s": 1e3 * np.linalg.norm(box.getPosition() - start)}

    def turntable(self):
        if self.ry.__name__ == "robotic":
            return {}  # the box is thrown off immediately there, for an unknown reason
        C = self.ry.Config()
        C.addFrame("hub").setPosition([0, 0, 0.5]).setAttributes({"multibody": True})
        disc = C.addFrame("disc", "hub").setJoint(self.ry.JT.hingeZ)
        disc.setShape(self.ry.ST.cylinder, [0.05, 0.6])
        disc.setMass(10.0)
        box = self.add_box(C, "box", [0.4, 0, 0.555])
        S = self.simulation(C)
        self.steps(S, 20)
        angle, start = 0.0, np.linalg.norm(box.getPosition()[:2])
        for i in range(1000):
            angle += 0.01 * min(1.0, i / 100)
            S.step([angle], 0.01, self.ry.ControlMode.position)
        return {"turntable, 1 rad/s, radius .4 m, slip in 10 s": 1e3 * (np.linalg.norm(box.getPosition()[:2]) - start)}

    def heap(self):
        C = self.ry.Config()
        for i in range(20):
            self.add_box(C, f"b{i}", [0.05 * (i % 2), 0.03 * (i % 3), 0.05 + 0.075 * i])
        S = self.simulation(C)
        self.steps(S, 300)
        return {"heap of 20 boxes, 10 ms (us)": 1e4 * wall(self.steps, S, 100)}

    def panda(self):
        C = self.ry.Config()
        C.addFile(self.ry.raiPath("scenarios/pandaSingle.g"))
        return C

    def tracking(self):
        C = self.panda()
        q = C.getJointState()
        S = self.simulation(C)
        worst = 0.0
        for s in np.linspace(0.01, 1, 100):
            now = q + (10 * s**3 - 15 * s**4 + 6 * s**5) * np.array([0.5, 0.5, 0.5, -0.5, 0.5, 0.5, 0.5])
            S.step(now, 0.01, self.ry.ControlMode.position)
            worst = max(worst, np.abs(C.getJointState() - now).max())
        for _ in range(20):
            S.step(now, 0.01, self.ry.ControlMode.position)
        after = np.abs(C.getJointState() - now).max()
        return {"all joints .5 rad in 1 s, largest error (mrad)": 1e3 * worst, ".2 s after (mrad)": 1e3 * after}

    def step_time(self):
        C = self.panda()
        self.add_box(C, "box", [-0.3, 0.35, 0.68])
        making = wall(self.simulation, C)
        S = self.simulation(C)
        self.steps(S, 50)
        return {
            "Panda and a box, 10 ms (us)": 1e4 * wall(self.steps, S, 100),
            "Panda and a box, creation (ms)": 1e3 * making,
        }

    def panda_with_boxes(self):
        at_rest = self.panda()
        for i, position in enumerate(BOXES_AT_REST):
            self.add_box(at_rest, f"b{i}", position)
        S = self.simulation(at_rest)
        self.steps(S, 100)
        found = {"Panda and 20 boxes at rest, 10 ms (us)": 1e4 * wall(self.steps, S, 100)}
        falling = self.panda()
        for i, position in enumerate(BOXES_IN_THE_AIR):
            self.add_box(falling, f"b{i}", position)
        S = self.simulation(falling)
        return found | {"Panda and 20 boxes that fall for 1.5 s, 10 ms (us)": 1e4 / 1.5 * wall(self.steps, S, 150)}

    def reach(self):
        C = self.panda()
        velocity = np.random.default_rng(0).uniform(-0.5, 0.5, 7)
        if self.ry.__name__ == "kinegraph":
            batch = self.ry.SimulationBatch(C, 32)
            u = np.tile(velocity, (32, 1))
            time = wall(lambda: [batch.step(u, 0.05, self.ry.ControlMode.velocity) for _ in range(10)]) / 320
        else:
            S = self.simulation(C)
            q = C.getJointState() + 0.01 * np.arange(1, 101)[:, None] * velocity
            time = wall(lambda: [S.step(row, 0.01, self.ry.ControlMode.position) for row in q]) / 20
        return {"arm in the air, one core, 50 ms (us)": 1e6 * time}

    def grasp(self):
        configurations = self.configurations
        C = self.panda()
        box = self.add_box(C, "box", [0, 0.3, 0.68])
        C.setJointState(configurations["above"])
        S = self.simulation(C)
        hand = C.getFrame("l_gripper")
        q = np.array(configurations["above"])

        def go(end, seconds=1.0):
            nonlocal q
            count = round(100 * seconds)
            for i in range(count):
                s = (i + 1) / count
                now = q + (10 * s**3 - 15 * s**4 + 6 * s**5) * (np.array(end) - q)
                S.step(now, 0.01, self.ry.ControlMode.position)
            q = np.array(end)
            for _ in range(50):
                S.step(q, 0.01, self.ry.ControlMode.position)

        def held():
            return hand.getRotationMatrix().T @ (box.getPosition() - hand.getPosition())

        go(configurations["at"])
        S.moveGripper("l_gripper", 0.0, 0.1)
        for _ in range(150):
            S.step(q, 0.01, self.ry.ControlMode.position)
        before = held()
        go(configurations["up"])
        lift = held()
        go(q + np.eye(7)[0])
        go(configurations["up"])
        turned = held()
        return {
            "box of .1 kg in the hand, slip when lifted": 1e3 * np.linalg.norm(lift - before),
            "turned by 1 rad in 1 s and back": 1e3 * np.linalg.norm(turned - lift),
        }

    def tops(self):
        if self.ry.__name__ != "kinegraph":
            return {}
        C = self.ry.Config()
        C.addText("body: { X: [0 0 1], mass: .5, inertia: [.0008 .0010 .0016] }")
        S = self.ry.Simulation(C, options={"gravity": 0})

        def energy():
            return 0.5 * TUMBLING @ (C.getFrame("body").getRotationMatrix().T @ S.get_frameVelocities()[0, 1]) ** 2

        S.pushConfigToSim([[[0, 0, 0], [12, 40, 8]]])
        start = energy()
        S.step([], 5.0)
        found = {"free body, 40 rad/s, energy after 5 s / before": energy() / start}

        C = self.ry.Config()
        C.addText(
            "tip: { X: [0 0 1] } top (tip): { joint: quatBall, noMotor: true } "
            "disc (top): { Q: [0 0 .05], mass: .5, inertia: [.0008 .0008 .0016] }"
        )
        C.setJointState(LEAN)
        S = self.ry.Simulation(C)
        S.pushConfigToSim(jointVelocities=50 * np.array([-LEAN[3], LEAN[2], -LEAN[1], LEAN[0]]))

        def energy_of_top():
            (w, *v), (a, *b) = S.get_q(), S.get_qDot()
            turn = 2 * (w * np.array(b) - a * np.array(v) - np.cross(v, b))
            return 0.5 * TOP @ turn**2 + 0.5 * 9.81 * (C.getFrame("disc").getPosition()[2] - 1)

        start = energy_of_top()
        S.step([], 20.0)
        return found | {"top on a ball joint, 100 rad/s, energy after 20 s / before": energy_of_top() / start}


class Mujoco:
    """MuJoCo with the defaults of its manual."""

    def __init__(self):
        self.mujoco = importlib.import_module("mujoco")

    def make(self, bodies, more=""):
        model = self.mujoco.MjModel.from_xml_string(
            f"<mujoco><option timestep='.002'/><worldbody><geom type='plane' size='9 9 1'/>{bodies}</worldbody>{more}</mujoco>"
        )
        return model, self.mujoco.MjData(model)

    def box(self, position, more="", geom=""):
        x, y, z = position
        return (
            f"<body pos='{x} {y} {z}' {more}><freejoint/><geom type='box' size='.03 .03 .03' mass='.1' {geom}/></body>"
        )

    def steps(self, model, data, seconds):
        for _ in range(round(seconds / 0.002)):
            self.mujoco.mj_step(model, data)

    def tower(self):
        model, data = self.make("".join(self.box([0, 0, 0.03 + 0.06 * i]) for i in range(10)))
        self.steps(model, data, 1)
        top = data.xpos[10].copy()
        self.steps(model, data, 9)
        return {
            "tower of ten, creep in 9 s": 1e3 * np.linalg.norm(data.xpos[10] - top),
            "tower of ten, sag": 1e3 * (0.57 - top[2]),
        }

    def slope(self):
        normal = np.array([np.sin(SLOPE), 0, np.cos(SLOPE)])
        turn = f"axisangle='0 1 0 {np.rad2deg(SLOPE)}'"
        plate = f"<geom type='box' size='1 1 .05' pos='0 0 2' {turn} friction='.5 .005 .0001'/>"
        model, data = self.make(
            plate + self.box([0, 0, 2] + 0.08 * normal, turn, "friction='.5 .005 .0001'"),
        )
        self.steps(model, data, 1)
        start = data.xpos[1].copy()
        self.steps(model, data, 9)
        return {"slope of 20 degrees, friction .5, creep in 9 s": 1e3 * np.linalg.norm(data.xpos[1] - start)}

    def turntable(self):
        disc = "<body pos='0 0 .5'><joint name='turn' axis='0 0 1'/><geom type='cylinder' size='.6 .025' mass='10'/></body>"
        motor = "<actuator><position joint='turn' kp='1000' kv='100'/></actuator>"
        model, data = self.make(disc + self.box([0.4, 0, 0.555]), motor)
        self.steps(model, data, 0.2)
        start, angle = np.linalg.norm(data.xpos[2][:2]), 0.0
        for i in range(5000):
            angle += 0.002 * min(1.0, i / 500)
            data.ctrl[0] = angle
            self.mujoco.mj_step(model, data)
        return {"turntable, 1 rad/s, radius .4 m, slip in 10 s": 1e3 * (np.linalg.norm(data.xpos[2][:2]) - start)}

    def heap(self):
        model, data = self.make(
            "".join(self.box([0.05 * (i % 2), 0.03 * (i % 3), 0.05 + 0.075 * i]) for i in range(20))
        )
        self.steps(model, data, 3)
        return {"heap of 20 boxes, 10 ms (us)": 1e4 * wall(self.steps, model, data, 1)}

    def arm(self):
        """Returns an arm of seven capsules on a table and its actuators: as many joints as the Panda."""
        arm = ""
        for i in reversed(range(7)):
            axis, away = ("0 0 1", "0 0 .1") if i % 2 == 0 else ("0 1 0", "0 0 .16")
            link = f"<joint name='j{i}' axis='{axis}' damping='1' armature='.1'/><geom type='capsule' fromto='0 0 0 {away}' size='.04'/>"
            place = "0 0 .68" if i == 0 else "0 0 .14"
            arm = f"<body name='l{i}' pos='{place}'>{link}{arm}</body>"
        more = "".join(f"<position joint='j{i}' kp='1000' kv='50'/>" for i in range(7))
        table = "<geom type='box' size='1.25 1 .05' pos='0 0 .6'/>"
        return table + arm, f"<actuator>{more}</actuator>"

    def panda_with_boxes(self):
        arm, actuators = self.arm()
        model, data = self.make(arm + "".join(map(self.box, BOXES_AT_REST)), actuators)
        self.steps(model, data, 1)
        found = {"Panda and 20 boxes at rest, 10 ms (us)": 1e4 * wall(self.steps, model, data, 1)}
        model, data = self.make(arm + "".join(map(self.box, BOXES_IN_THE_AIR)), actuators)
        time = wall(self.steps, model, data, 1.5)
        return found | {"Panda and 20 boxes that fall for 1.5 s, 10 ms (us)": 1e4 / 1.5 * time}

    def reach(self):
        model, data = self.make(*self.arm())
        data.ctrl[:] = np.random.default_rng(0).uniform(-0.5, 0.5, 7)
        return {"arm in the air, one core, 50 ms (us)": 1e6 / 20 * wall(self.steps, model, data, 1)}

    def tops(self):
        """Simulates the top with each integrator."""
        free = "<inertial pos='0 0 0' mass='.5' diaginertia='.0008 .0010 .0016'/><freejoint/>"
        top = "<inertial pos='0 0 .05' mass='.5' diaginertia='.0008 .0008 .0016'/><joint type='ball'/>"
        found = {
            "free body, 40 rad/s, energy after 5 s / before": "",
            "top on a ball joint, 100 rad/s, energy after 20 s / before": "",
        }
        for name in ("EULER", "RK4", "IMPLICIT", "IMPLICITFAST"):
            for (what, words), body, seconds in zip(found.items(), (free, top), (5, 20), strict=True):
                model, data = self.make(f"<body pos='0 0 1'>{body}</body>", "<option><flag energy='enable'/></option>")
                model.opt.integrator = getattr(self.mujoco.mjtIntegrator, f"mjINT_{name}")
                if body == free:
                    model.opt.gravity[:] = 0
                    data.qvel[3:] = [12, 40, 8]
                else:
                    data.qpos[:] = LEAN
                    data.qvel[:] = [0, 0, 100]
                self.mujoco.mj_forward(model, data)
                start = data.energy.sum() - 0.5 * 9.81 * (body == top)
                self.steps(model, data, seconds)
                self.mujoco.mj_forward(model, data)
                ratio = (data.energy.sum() - 0.5 * 9.81 * (body == top)) / start
                found[what] = f"{words} {name} {ratio:.5g}".strip()
        return found


TIMED = ["heap", "step_time", "panda_with_boxes", "reach"]
SCENES = ["tower", "slope", "turntable", "heap", "tracking", "step_time", "panda_with_boxes", "reach", "grasp", "tops"]


def measure(python, engine, scene, configurations):
    """Returns the results of a scene in an engine; nothing if the engine lacks it."""
    own = engine == "kinegraph"  # it contains a package `robotic`, which the others must not find
    environment = {name: value for name, value in os.environ.items() if own or name != "PYTHONPATH"}
    run = subprocess.run(
        [python, __file__, "--one", engine, scene, configurations],
        capture_output=True,
        text=True,
        check=False,
        env=environment,
    )
    if run.returncode != 0:
        return {f"{scene} failed": run.stderr.strip().splitlines()[-1] if run.stderr else "no message"}
    return json.loads(run.stdout.rsplit("RESULT", 1)[1])


def one(engine, scene, configurations):
    world = Mujoco() if engine == "mujoco" else Ry(engine, configurations)
    found = getattr(world, scene)() if hasattr(world, scene) else {}
    print("RESULT" + json.dumps(found))


def configurations():
    """Returns configurations of the grasp, computed once, so that both arms do the same."""
    import kinegraph as ry

    C = Ry("kinegraph").panda()
    found = {}
    for name, height in ("above", 0.8), ("at", 0.68), ("up", 0.88):
        target = {"position": [0, 0.3, height], "z": [0, 0, 1], "y": [1, 0, 0]}
        answer = ry.solveIk(C, {"l_gripper": target})
        assert answer.feasible
        found[name] = list(answer.q)
        C.setJointState(answer.q)
    return json.dumps(found)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--robotic", help="a Python with robotic")
    parser.add_argument("--mujoco", help="a Python with mujoco")
    parser.add_argument("--scenes", nargs="*", choices=SCENES, help="all by default")
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        one(*arguments.one)
        return
    engines = {"kinegraph": sys.executable, "robotic": arguments.robotic, "mujoco": arguments.mujoco}
    engines = {name: python for name, python in engines.items() if python}
    poses = configurations()
    for scene in arguments.scenes or SCENES:
        best = {name: {} for name in engines}
        for _ in range(ROUNDS if scene in TIMED else 1):
            for name, python in engines.items():
                for what, value in measure(python, name, scene, poses).items():
                    is_less = what not in best[name] or (isinstance(value, float) and value < best[name][what])
                    if is_less:
                        best[name][what] = value
        for what in dict.fromkeys(what for found in best.values() for what in found):
            numbers = [f"{name} {best[name][what]:.4g}" for name in engines if isinstance(best[name].get(what), float)]
            words = [f"{name}: {best[name][what]}" for name in engines if isinstance(best[name].get(what), str)]
            print(f"{what}: " + " | ".join(numbers + words), flush=True)


if __name__ == "__main__":
    main()
