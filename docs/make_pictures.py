#!/usr/bin/env python3
"""Makes the pictures of the documentation: of the viewer's page in a headless Chromium, and by CameraView's renderer;
and films of tasks.

    python docs/make_pictures.py [FOLDER]

FOLDER is docs if none is given. Needs the package, `websockets`, `av` and EGL. The tests make all of them, too.
"""

import base64
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

import kinegraph as ry
from kinegraph.png import writePng

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "tests"))

from viewer.browser import Browser  # noqa: E402


def reaching() -> ry.Config:
    """A Panda whose gripper is at a target, and what it went through on its way."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("target", "table").setShape(ry.ST.marker, [0.2]).setRelativePosition([0.25, 0.35, 0.35])
    C.addFrame("box", "table").setShape(ry.ST.ssBox, [0.12, 0.12, 0.16, 0.02]).setRelativePosition(
        [-0.25, 0.3, 0.13]
    ).setColor([1.0, 0.5, 0.1])
    C.addFrame("ball", "table").setShape(ry.ST.sphere, [0.06]).setRelativePosition([-0.05, 0.45, 0.11]).setColor(
        [0.2, 0.6, 0.9]
    )
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointState())
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
    assert ry.NLP_Solver(komo.nlp(), verbose=0).solve().feasible
    C.setJointState(komo.getPath()[0])
    return C


def plannedMotion(folder: Path) -> None:
    """A Panda at the start of a plan, white, at its goal, blue, and in between: around a column."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    column = C.addFrame("column", "table").setShape(ry.ST.ssBox, [0.1, 0.1, 0.8, 0.02])
    column.setRelativePosition([0, 0.38, 0.4]).setContact(1).setColor([0.95, 0.55, 0.15])
    targets = [{"l_gripper": {"position": [x, 0.32, 0.8], "z": [0, 0, 1]}} for x in (-0.45, 0.45)]
    C.setJointState(ry.solveIk(C, targets[0]).q)
    plan = ry.planMotion(C, targets[1], margin=0.01)
    assert plan.feasible and plan.clearance() > 0.0099
    shown = ry.Config()
    times = np.linspace(0, plan.duration, 8)
    for i, at in enumerate(times):
        copy = C.copy()
        copy.setJointState(plan.eval(at)[0])
        for frame in copy.getFrames():
            is_thing = frame.name in ("table", "column")
            if frame.getShapeType() == ry.ST.none or (is_thing and i == 0):
                continue
            if frame.getShapeType() == ry.ST.marker:
                frame.setShape(ry.ST.sphere, [0.001])
            hidden = is_thing or frame.getAttributes().get("contact", 0) != 0  # shapes for collisions
            alpha = 0.0 if hidden else 1.0 if i in (0, len(times) - 1) else 0.3
            frame.setColor([0.9, 0.9, 0.9, alpha] if i == 0 else [0.15, 0.45, 0.95, alpha])
        shown.addConfigurationCopy(copy, f"{i}_")
    shown.view(offscreen=True)
    viewer = shown.viewer()
    viewer.setWindow("plan", 960, 480)
    viewer.setCamera([0.85, 1.85, 2.0], [0, 0.15, 1.0])
    viewer.savePng(str(folder / "planned_motion.png"))


def gripperAxes(folder: Path) -> None:
    """The Panda's hand without its arm, and the axes of the frame `gripper`: x red, y green, z blue."""
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    hand = {"panda_hand_joint", *(frame.name for frame in C.getFrame("panda_hand_joint").getSubtree())}
    for frame in C.getFrames():
        if frame.name not in hand and frame.getShapeType() != ry.ST.none:
            frame.setColor([1.0, 1.0, 1.0, 0.0])
    for color, length in zip(np.eye(3), (0.1, 0.1, 0.2)):
        rod = C.addFrame("", "gripper").setShape(ry.ST.capsule, [length, 0.004]).setColor(color)
        rod.setRelativePosition(length / 2 * color).setRelativeQuaternion(
            ry.Quaternion().setDiff([0, 0, 1], color).asArr()
        )
    viewer = C.viewer()
    C.view(offscreen=True)
    viewer.visualsOnly()
    viewer.setWindow("gripper", 800, 600)
    center = C.getFrame("gripper").getTransform() @ [0.0, 0.0, 0.08, 1.0]
    view = C.getFrame("gripper").getRotationMatrix() @ [0.15, 0.45, 0.1]
    viewer.setCamera(center[:3] + view, center[:3])
    viewer.savePng(str(folder / "gripper_axes.png"))


def taskFilm(file: Path, C: ry.Config, goal: str, view: list[float], at: list[float]) -> None:
    """Films a plan of planTask."""
    plan = ry.planTask(C, goal)
    assert plan.feasible, plan
    viewer = C.viewer()
    C.view(offscreen=True)
    viewer.visualsOnly()
    viewer.setWindow(file.stem, 480, 360)
    viewer.setCamera(view, at)
    ry.saveFilm(file, C, plan.frames(C), plan.duration, rate=15.0)


def taskFilms(folder: Path) -> None:
    """Problems of the benchmarks' families: a tower, two trays, a box that is turned over, a drawer that is opened for
    a box, cups that are carried."""
    sys.path.append(str(HERE.parent / "benchmarks"))
    import panda_tasks
    import tasks

    taskFilm(folder / "task_tower.mp4", *_scene(panda_tasks.tower(0, 4)), [1.1, 1.3, 1.5], [0.0, 0.2, 0.75])
    taskFilm(folder / "task_sort.mp4", *_scene(panda_tasks.sort(0, 4)), [0.9, 1.5, 1.6], [0.0, 0.2, 0.7])
    taskFilm(folder / "task_turn.mp4", *_scene(tasks.turn(0)), [0.6, -0.7, 1.15], [0.0, 0.0, 0.68])
    taskFilm(folder / "task_drawer.mp4", *_scene(panda_tasks.stow(0)), [-0.9, -0.9, 1.7], [0.0, 0.3, 0.75])
    taskFilm(folder / "task_carry.mp4", *_scene(tasks.carry(0)), [0.3, -1.7, 1.9], [0.0, 0.0, 0.6])


def everydayFilms(folder: Path) -> None:
    """Of four scenes of benchmarks/everyday.py; the nightly run makes them."""
    sys.path.append(str(HERE.parent / "benchmarks"))
    from everyday_scenes import GENERATORS

    for name in ("boxes to a tray", "shelf", "slabs", "UR10 and Robotiq"):
        scene = GENERATORS[name](np.random.default_rng(0))
        file = folder / f"everyday_{name.lower().replace(' ', '_')}.mp4"
        taskFilm(file, scene.C, scene.goal, [1.1, 1.4, 1.7], [0.0, 0.2, 0.75])


def examplePictures(folder: Path) -> None:
    """Pictures that examples draw: of planning, of simulations, and of how a policy learns."""

    def example(name: str, *arguments: Path) -> None:
        # quiet, and with a shorter training than the example's own
        environment = {**os.environ, "KINEGRAPH_HEADLESS": "1", "GENERATIONS": "12"}
        program = [sys.executable, HERE.parent / "examples" / name, *arguments]
        subprocess.run(program, check=True, env=environment, stdout=subprocess.DEVNULL)

    plans = folder / "plans"
    plans.mkdir()
    example("11_plan_motions.py", plans)
    for picture in plans.iterdir():
        picture.rename(folder / f"plan_{picture.name}")
    plans.rmdir()
    example("15_grasp_and_lift.py", folder / "simulation_grasp.png")
    example("16_conveyor.py", folder / "simulation_conveyor.png")
    example("20_two_robots.py", folder / "simulation_two_robots.png")
    example("26_train_a_policy.py", folder / "simulation_training.svg")


def movingFilm(folder: Path) -> None:
    """A load that is carried past: the arm waits for it; then the arm is sent elsewhere on its way, and bends."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("cart").setPosition([-0.6, 0.35, 1.1])
    C.addFrame("load", "cart").setShape(ry.ST.ssBox, [0.3, 0.3, 0.5, 0.02]).setContact(1).setColor([0.8, 0.5, 0.2])
    turn = np.array([0.6, 0, 0, 0, 0, 0, 0])
    start, goal = C.getJointState() - turn, C.getJointState() + turn
    poses = [[-0.6, 0.35, 1.1, 1, 0, 0, 0], [0.6, 0.35, 1.1, 1, 0, 0, 0], [0.6, 1.5, 1.1, 0.7, 0, 0, 0.7]]
    plan = ry.planMotion(
        C, goal, start, margin=0.01, obstacle_trajectories={"cart": (np.array([0.0, 2.0, 4.0]), np.array(poses))}
    )
    assert plan.feasible, plan.message
    at = 0.6 * plan.duration
    bend = plan.replan(C, at=at, goal=goal + np.array([0.3, 0.4, 0, 0.3, 0, 0, 0]))
    assert bend.feasible, bend.message
    frames = []
    for t in np.arange(0, at + bend.duration + 0.5, 1 / 15):
        motion, now = (plan, t) if t < at else (bend, t - at)
        C.setJointState(motion.eval(now)[0])
        C.getFrame("cart").setPose(motion.obstaclesAt(now)["cart"])
        frames.append(C.getFrameState())
    viewer = C.viewer()
    C.view(offscreen=True)
    viewer.visualsOnly()
    viewer.setWindow("moving", 480, 360)
    viewer.setCamera([-1.3, -1.5, 2.7], [0.0, 0.35, 0.95])
    ry.saveFilm(folder / "plan_among_what_moves.mp4", C, np.array(frames), len(frames) / 15, rate=15.0)


def _scene(problem: Any) -> tuple[ry.Config, str]:
    return problem.C, problem.goal


def page(folder: Path) -> None:
    """The viewer in a browser."""
    C = reaching()
    viewer = C.viewer()
    C.view()
    with Browser() as browser:
        browser.open(viewer.url)
        viewer.waitForClient(60)
        center = C.getFrame("l_gripper").getPosition() * [0.4, 0.4, 0.85]
        viewer.setCamera(center + np.array([1.35, 1.35, 0.65]), center)
        time.sleep(5)  # software rendering takes its time
        browser.wait_for("kinegraph.idle()")
        (folder / "panda.png").write_bytes(
            base64.b64decode(browser.call("Page.captureScreenshot", format="png")["data"])
        )


def arms(folder: Path) -> None:
    """The arms of the pages on their drivers."""
    bent = [0.0, -1.2, 1.6, -2.0, -1.6, 0.0]
    above = [0.4, -0.6, 1.0, 1.0, 0.0]
    for name, file, home in (
        ("trossen", "trossen/trossen.g", None),
        ("ur5e", "ur5e/ur5e.g", bent),
        ("so101", "so101/so101.g", above),
    ):
        C = ry.Config()
        C.addFile(ry.raiPath(file))
        if home is not None:
            C.setJointState(home)
        viewer = C.viewer()
        C.view(offscreen=True)
        viewer.visualsOnly()
        viewer.setWindow(name, 640, 480)
        reach = max(0.4, max(np.linalg.norm(frame.getPosition()) for frame in C.getFrames()))
        at = np.mean([frame.getPosition() for frame in C.getFrames()], axis=0)
        viewer.setCamera(at + reach * np.array([1.3, -2.0, 1.0]), at)
        viewer.savePng(str(folder / f"{name}.png"))


def recordedImage(folder: Path) -> None:
    """An image out of a recording of a task plan."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = C.addFrame("box", "table").setRelativePosition([0.2, 0.25, 0.09])
    box.setShape(ry.ST.ssBox, [0.04, 0.05, 0.08, 0.004]).setColor([0.9, 0.4, 0.1])
    box.setContact(1).setJoint(ry.JT.rigid).setMass(0.1)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.25, 0.055])
    tray.setShape(ry.ST.ssBox, [0.14, 0.14, 0.01, 0.004]).setContact(1)
    bot = ry.BotOp(C)
    with tempfile.TemporaryDirectory() as temporary:
        bot.recordTo(temporary + "/run.mcap", cameras=["cameraTop"])
        ry.planTask(C, "(on tray box)").execute(bot)
        bot.recordTo("")
        _, images = ry.readRecording(temporary + "/run.mcap").images("cameraTop")
    writePng(folder / "mcap.png", images[-1])


def ownRobot(folder: Path) -> None:
    """The arm of the page on a robot of one's own, by the code of that page."""
    blocks = re.findall(r"```python\n(.*?)```", (HERE / "own_robot.md").read_text(), re.DOTALL)
    last = next(i for i, block in enumerate(blocks) if '"robot.png"' in block)
    with tempfile.TemporaryDirectory() as place:
        code = "\n".join(blocks[: last + 1])
        environment = {**os.environ, "KINEGRAPH_HEADLESS": "1"}
        subprocess.run([sys.executable, "-c", code], cwd=place, check=True, env=environment, stdout=subprocess.DEVNULL)
        shutil.copy(Path(place) / "robot.png", folder / "own_robot.png")


PICTURES = [plannedMotion, gripperAxes, arms, recordedImage, ownRobot, taskFilms, movingFilm, examplePictures, page]

if __name__ == "__main__":
    for make in PICTURES:
        make(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE)
