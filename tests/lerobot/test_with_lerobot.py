"""Data sets, plugins and environments with the package lerobot itself. `make test-lerobot` runs these tests."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

lerobot = pytest.importorskip("lerobot", reason="needs lerobot; make test-lerobot installs it (8 GB)")

import torch  # noqa: E402
from lerobot.datasets.lerobot_dataset import LeRobotDataset  # noqa: E402
from lerobot.utils.import_utils import make_device_from_device_class, register_third_party_plugins  # noqa: E402

import kinegraph as ry  # noqa: E402
from kinegraph.lerobot import rehearse  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore")  # of packages of LeRobot
GOAL = "(on tray box)"


def boxAndTray(rng: np.random.Generator | None = None) -> ry.Config:
    """A scene, also for the settings `module:function` of the plugins."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = C.addFrame("box", "table").setRelativePosition([0.2, 0.25, 0.09])
    box.setShape(ry.ST.ssBox, [0.04, 0.05, 0.08, 0.004]).setContact(1).setJoint(ry.JT.rigid).setMass(0.1)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.25, 0.055])
    tray.setShape(ry.ST.ssBox, [0.14, 0.14, 0.01, 0.004]).setContact(1)
    return C


SCENE = f"{Path(__file__).stem}:boxAndTray"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("data") / "box_on_tray"
    ry.demonstrate(boxAndTray(), GOAL, 2, out, cameras=["cameraTop"], size=96, progress=False)
    return out


def test_lerobot_reads_a_data_set(folder: Path) -> None:
    data = LeRobotDataset(
        "me/box_on_tray", root=folder, video_backend="pyav", delta_timestamps={"action": [0.0, 0.05, 0.1]}
    )
    assert (data.num_episodes, data.fps) == (2, 20)
    first = data[0]
    assert first["observation.state"].shape == (8,) and first["action"].shape == (3, 8)
    image = first["observation.images.cameraTop"]
    assert image.shape == (3, 96, 96) and image.min() >= 0 and image.max() <= 1 and image.std() > 0.05
    assert first["task"] == "put box on tray"
    loader = torch.utils.data.DataLoader(data, batch_size=8, shuffle=False)
    assert sum(len(batch["index"]) for batch in loader) == data.num_frames
    second = data[1]
    np.testing.assert_allclose(
        second["observation.state"][:7], first["action"][0][:7], atol=0.05
    )  # commands are followed
    assert float(data.meta.stats["action"]["max"][0]) >= float(first["action"][0, 0])


def test_lerobot_trains_on_a_data_set(folder: Path, tmp_path: Path) -> None:
    command = [
        str(Path(sys.executable).parent / "lerobot-train"),
        "--dataset.repo_id=me/box_on_tray",
        f"--dataset.root={folder}",
        "--dataset.video_backend=pyav",
        "--policy.type=act",
        "--policy.device=cpu",
        "--policy.push_to_hub=false",
        "--policy.pretrained_backbone_weights=null",
        "--policy.dim_model=64",
        "--policy.n_heads=4",
        "--policy.dim_feedforward=128",
        "--policy.chunk_size=20",
        "--policy.n_action_steps=20",
        f"--output_dir={tmp_path / 'out'}",
        "--steps=8",
        "--batch_size=4",
        "--num_workers=0",
        "--log_freq=1",
        "--save_freq=8",
        "--wandb.enable=false",
    ]
    run = subprocess.run(command, capture_output=True, text=True, timeout=500, check=False)
    said = run.stdout + run.stderr
    assert run.returncode == 0, said[-3000:]
    losses = [float(part.split()[0]) for part in said.split("loss:")[1:]]
    assert len(losses) == 8 and losses[-1] < losses[0]
    assert list((tmp_path / "out" / "checkpoints").glob("*/pretrained_model/model.safetensors"))


def test_the_robot_and_the_planner_are_found_by_name() -> None:
    register_third_party_plugins()
    from lerobot.robots import RobotConfig
    from lerobot.teleoperators import TeleoperatorConfig

    kinds = RobotConfig.get_known_choices(), TeleoperatorConfig.get_known_choices()
    assert "kinegraph" in kinds[0] and "kinegraph_planner" in kinds[1]
    robot = make_device_from_device_class(kinds[0]["kinegraph"](scene=SCENE, views=["cameraTop"], width=64, height=48))
    planner = make_device_from_device_class(kinds[1]["kinegraph_planner"](goal=GOAL))
    with pytest.raises(ConnectionError, match="connect a robot of type kinegraph first"):
        planner.connect()
    robot.connect()
    planner.connect()
    assert set(planner.action_features) == set(robot.action_features)
    observation = robot.get_observation()
    assert observation["cameraTop"].shape == robot.observation_features["cameraTop"] == (48, 64, 3)
    with pytest.raises(ValueError, match=r"the action lacks 'l_panda_joint1\.pos'"):
        robot.send_action({})
    with pytest.raises(ValueError, match="not finite"):
        robot.send_action(dict.fromkeys(robot.action_features, float("nan")))
    end = time.monotonic() + 9
    while time.monotonic() < end:
        sent = robot.send_action(planner.get_action())
        time.sleep(0.05)
    assert set(sent) == set(robot.action_features)
    world = robot.bot.getWorld()
    apart = world.getFrame("box").getPosition() - world.getFrame("tray").getPosition()
    assert np.abs(apart[:2]).max() < 0.07 and 0.03 < apart[2] < 0.06
    planner.disconnect()
    robot.disconnect()
    assert not robot.is_connected and not planner.is_connected


def test_policies_are_evaluated_in_an_environment() -> None:
    from lerobot.envs.factory import make_env
    from lerobot.envs.utils import env_to_policy_features, preprocess_observation
    from lerobot_env_kinegraph import KinegraphEnv
    from lerobot_env_kinegraph import make_env as makeForHub

    config = KinegraphEnv(scene=SCENE, goal=GOAL, cameras=["cameraTop"], size=64, episode_length=300)
    features = env_to_policy_features(config)
    assert features["action"].shape == (8,) and features["observation.images.cameraTop"].shape == (3, 64, 64)
    (envs,) = make_env(config, n_envs=2)["kinegraph"].values()
    observation, _ = envs.reset(seed=[1, 2])
    batch = preprocess_observation(observation)
    assert batch["observation.state"].shape == (2, 8)
    assert batch["observation.images.cameraTop"].shape == (2, 3, 64, 64)
    assert envs.call("task_description") == ("put box on tray", "put box on tray")
    assert envs.call("_max_episode_steps") == (300, 300)
    rows = [rehearse(env.unwrapped.world, GOAL) for env in envs.envs]
    reached = np.zeros(2, bool)
    for k in range(max(map(len, rows)) + 20):
        actions = np.stack([r[min(k, len(r) - 1)] for r in rows])
        _, _, done, _, info = envs.step(actions)
        reached |= done
        if done.any():
            assert "final_info" in info or "is_success" in info
        if reached.all():
            break
    assert reached.all()
    envs.close()
    hub = makeForHub(n_envs=1, cfg=config)
    assert list(hub) == ["kinegraph"]
