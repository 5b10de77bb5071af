"""Cameras in the loop: things are found, and other things stop motions and shape new plans."""

import numpy as np
import pytest

import kinegraph as ry


def believed(cube=(-0.3, 0.3)):
    """A Panda, a tray and a cube, and a fixed camera beyond the table."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("tray", "table").setShape(ry.ST.ssBox, [0.2, 0.2, 0.02, 0.005]).setRelativePosition([0.35, 0.3, 0.06])
    C.getFrame("tray").setContact(1)
    frame = C.addFrame("cube", "table").setRelativePosition([*cube, 0.075]).setJoint(ry.JT.rigid)
    frame.setShape(ry.ST.ssBox, [0.05, 0.05, 0.05, 0.004]).setContact(1).setMass(0.1)
    frame.setAttributes({"friction": 1.0})
    eye, target = np.array([-0.6, 1.0, 1.3]), np.array([0, 0.3, 0.65])
    z = (target - eye) / np.linalg.norm(target - eye)
    x = np.cross(z, [0, 0, 1]) / np.linalg.norm(np.cross(z, [0, 0, 1]))
    camera = C.addFrame("camera").setPosition(eye).setRotationMatrix(np.stack([x, np.cross(z, x), z], 1))
    camera.setAttributes({"focalLength": 1.1, "width": 640, "height": 480})
    return C


def image(C):
    view = ry.CameraView(C)
    view.setCamera("camera")
    return ry.DepthView(view.computeImageAndDepth()[1], view.getFxycxy(), "camera")


def add_bottle(C, at):
    bottle = C.addFrame("bottle", "table").setShape(ry.ST.ssBox, [0.07, 0.07, 0.3, 0.005])
    bottle.setRelativePosition([*at, 0.2]).setJoint(ry.JT.rigid).setContact(1).setMass(0.5)


def test_an_unknown_thing_in_the_way_stops_the_robot_and_is_not_touched():
    C = believed()
    world = C.copy()
    world.getFrame("cube").setRelativePosition([-0.27, 0.33, 0.075])
    add_bottle(world, [0.1, 0.6])
    bot = ry.BotOp(world)
    map = ry.OccupancyMap(C, region=[[-0.5, 0, 0.66], [0.55, 0.75, 1.1]], cell=0.02)
    observer = ry.SceneObserver(lambda: image(bot.getWorld()), ["cube"], support="table", search_radius=0.1, map=map)
    pose = observer.observe(C)["cube"]
    assert np.linalg.norm(pose[:3] - [-0.27, 0.33, 0.675]) < 0.002
    assert observer.seen["cube"].status == ry.SeenStatus.seen and observer.map is map
    run = ry.planTask(C, "(on tray cube)").run(bot, observe=observer)
    kinds = []
    for event in run:
        kinds.append(event.kind)
        if event.kind == ry.TaskEventKind.grip and run.result.done == 1 and run.result.repairs == 0:
            bot.setFramePose("bottle", [0.1, 0.3, 0.8, 1, 0, 0, 0])
        if event.kind == ry.TaskEventKind.failure and run.result.done == 1 and run.result.repairs == 0:
            assert "would enter 'map' by" in str(event)
    assert run.result.done >= 1 and ry.TaskEventKind.failure in kinds
    off = bot.getWorld().getFrame("bottle").getPosition()[:2] - [0.1, 0.3]
    assert np.linalg.norm(off) < 0.002
    assert "bottle" not in run.result.C.getFrameNames() and "map" in run.result.C.getFrameNames()
    assert "map" not in bot.getWorld().getFrameNames()  # else cameras would see it, and hands would touch it


def test_with_cameras_the_execution_does_not_know_the_simulated_world():
    C = believed()
    world = C.copy()
    add_bottle(world, [0.1, 0.6])
    bot = ry.BotOp(world)
    plan = ry.planTask(C, "(on tray cube)")
    run = plan.execute(bot, observe=lambda: {"cube": bot.getWorld().getFrame("cube").getPose()})
    assert run.feasible and "bottle" not in run.C.getFrameNames()
    assert not any(name.startswith(("grasp_", "place_")) for name in run.C.getFrameNames())  # of the plan


def test_wrong_arguments_are_named():
    with pytest.raises(ry.ArgumentError, match="expected 'blocked', 'shadows' or 'free'"):
        ry.SceneObserver(lambda: [], ["cube"], unseen="maybe")
    with pytest.raises(ry.ArgumentError, match="search_radius|radius"):
        ry.SceneObserver(lambda: [], ["cube"], search_radius=-1)
    C = believed()
    with pytest.raises(ry.FrameNotFound, match="'cup'"):
        ry.SceneObserver(lambda: image(C), ["cup"]).observe(C)
    with pytest.raises(ry.ArgumentError, match="take returned an object of type int; expected a DepthView"):
        ry.SceneObserver(lambda: 3, ["cube"]).observe(C)
