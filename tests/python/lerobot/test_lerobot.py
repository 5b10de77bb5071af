"""Data sets of LeRobot: written, merged, checked, and made by simulation."""

import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

import kinegraph as ry

NAMES = ["a.pos", "b.pos"]


def filled(folder: Path, shard: int = 0, episodes: int = 2, merge: bool = True, task: str = "do it") -> None:
    rng = np.random.default_rng(shard)
    with ry.LeRobotWriter(folder, 10, NAMES, cameras={"top": (16, 24)}, shard=shard, merge=merge) as writer:
        for k in range(episodes):
            n = 5 + k
            images = [rng.integers(0, 255, (16, 24, 3), np.uint8) for _ in range(n)]
            writer.addEpisode(rng.normal(size=(n, 2)), rng.normal(size=(n, 2)), {"top": images}, task)


def digest(folder: Path) -> dict[str, str]:
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): hashlib.sha1(path.read_bytes()).hexdigest() for path in files}


def tables(folder: Path) -> dict[str, str]:
    """All files but the films, whose encoder does not repeat its bytes; statistics of the images are among them."""
    return {name: found for name, found in digest(folder).items() if not name.endswith(".mp4")}


def test_a_data_set_has_the_fields_and_types_of_the_format(tmp_path: Path) -> None:
    filled(tmp_path)
    assert ry.checkDataset(tmp_path) == []
    info = json.loads((tmp_path / "meta/info.json").read_text())
    assert info["codebase_version"] == "v3.0" and info["splits"] == {"train": "0:2"}
    assert (info["total_episodes"], info["total_frames"], info["total_tasks"], info["chunks_size"]) == (2, 11, 1, 1000)
    assert info["features"]["observation.images.top"]["shape"] == [16, 24, 3]
    frames = pq.read_table(tmp_path / "data/chunk-000/file-000.parquet")
    assert str(frames.schema.field("action").type) in (
        "fixed_size_list<item: float>[2]",
        "fixed_size_list<element: float>[2]",
    )
    assert frames["index"].to_pylist() == list(range(11))
    np.testing.assert_array_equal(frames["timestamp"].to_numpy()[5:], (np.arange(6) / 10).astype(np.float32))
    assert frames["next.success"].to_pylist() == [k in (4, 10) for k in range(11)]
    (first, second) = pq.read_table(tmp_path / "meta/episodes").to_pylist()
    assert (second["dataset_from_index"], second["dataset_to_index"]) == (5, 11)
    assert (second["videos/observation.images.top/from_timestamp"], second["length"]) == (0.5, 6)
    assert np.array(first["stats/observation.images.top/mean"]).shape == (3, 1, 1)
    tasks = pq.read_table(tmp_path / "meta/tasks.parquet")
    assert json.loads(tasks.schema.metadata[b"pandas"])["index_columns"] == ["task"]


def test_statistics_are_those_of_all_frames(tmp_path: Path) -> None:
    filled(tmp_path, episodes=4)
    table = pq.read_table(tmp_path / "data/chunk-000/file-000.parquet")
    action = np.array(table["action"].to_pylist())
    stats = json.loads((tmp_path / "meta/stats.json").read_text())["action"]
    np.testing.assert_allclose(stats["mean"], action.mean(0), atol=1e-6)
    np.testing.assert_allclose(stats["std"], action.std(0), atol=1e-6)
    np.testing.assert_allclose(stats["min"], action.min(0), atol=1e-6)
    assert stats["count"] == [len(action)]


def test_shards_of_several_writers_become_one_data_set(tmp_path: Path) -> None:
    filled(tmp_path, shard=0, merge=False)
    filled(tmp_path, shard=3, merge=False, task="do that")
    assert "meta is missing" in ry.checkDataset(tmp_path)[0]
    info = ry.mergeShards(tmp_path)
    assert (info["total_episodes"], info["total_frames"], info["total_tasks"]) == (4, 22, 2)
    assert ry.checkDataset(tmp_path) == []
    frames = pq.read_table(tmp_path / "data/chunk-000/file-003.parquet")
    assert frames["index"].to_pylist() == list(range(11, 22)) and set(frames["task_index"].to_pylist()) == {1}
    filled(tmp_path, shard=1, task="do that")
    assert ry.checkDataset(tmp_path) == [] and digest(tmp_path) == digest(tmp_path)
    with pytest.raises(ry.Error, match="has a finished shard 1"):
        filled(tmp_path, shard=1)


def test_a_writer_that_is_killed_leaves_the_finished_shards(tmp_path: Path) -> None:
    filled(tmp_path)
    before = digest(tmp_path)
    script = (
        "import os, numpy as np, kinegraph as ry\n"
        f"w = ry.LeRobotWriter({str(tmp_path)!r}, 10, ['a.pos', 'b.pos'], cameras={{'top': (16, 24)}}, shard=1)\n"
        "w.addEpisode(np.zeros((5, 2)), np.zeros((5, 2)), {'top': [np.zeros((16, 24, 3), np.uint8)] * 5}, 'x')\n"
        "os.kill(os.getpid(), 9)\n"
    )
    assert subprocess.run([sys.executable, "-c", script], env=os.environ).returncode == -9
    assert ry.checkDataset(tmp_path) == []
    after = digest(tmp_path)
    assert {name: after[name] for name in before} == before
    filled(tmp_path, shard=1)
    assert ry.checkDataset(tmp_path) == []


@pytest.mark.parametrize(
    "change, message",
    [
        ({"state": np.zeros((4, 2))}, "4 states and 5 actions"),
        ({"state": np.zeros((5, 3))}, r"state has shape \(5, 3\); expected \(K, 2\)"),
        ({"action": np.full((5, 2), np.nan)}, "action of frame 0 has nan at entry 0"),
        ({"images": {}}, r"images of \[\]; expected the cameras \['top'\]"),
        ({"images": {"top": [np.zeros((16, 24, 3), np.uint8)] * 4}}, "camera 'top' has 4 images; expected 5"),
        ({"images": {"top": [np.zeros((16, 24, 3))] * 5}}, "type float64; expected"),
        ({"task": " "}, "task is empty"),
    ],
)
def test_episodes_that_do_not_fit_are_refused(tmp_path: Path, change: dict, message: str) -> None:
    writer = ry.LeRobotWriter(tmp_path, 10, NAMES, cameras={"top": (16, 24)})
    images = {"top": [np.zeros((16, 24, 3), np.uint8)] * 5}
    episode = {"state": np.zeros((5, 2)), "action": np.zeros((5, 2)), "images": images, "task": "x"}
    with pytest.raises(ry.ArgumentError, match=message):
        writer.addEpisode(**(episode | change))
    writer.addEpisode(**episode)
    writer.close()
    assert ry.checkDataset(tmp_path) == []


@pytest.mark.parametrize(
    "damage, message",
    [
        (
            lambda root: (root / "videos/observation.images.top/chunk-000/file-000.mp4").write_bytes(b"x"),
            "cannot be read",
        ),
        (lambda root: (root / "data/chunk-000/file-000.parquet").unlink(), "is missing"),
        (lambda root: replaced(root, '"total_frames": 11', '"total_frames": 12'), "total_frames is 12"),
        (lambda root: replaced(root, '"v3.0"', '"v2.1"'), "codebase_version is v2.1"),
        (lambda root: replaced(root, '"fps": 10', '"fps": 20'), "timestamp of episode 0 does not fit"),
    ],
)
def test_the_check_finds_damage(tmp_path: Path, damage, message: str) -> None:
    filled(tmp_path)
    damage(tmp_path)
    assert any(message in fault for fault in ry.checkDataset(tmp_path)), ry.checkDataset(tmp_path)


def replaced(root: Path, old: str, new: str) -> None:
    path = root / "meta/info.json"
    path.write_text(path.read_text().replace(old, new))


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = (
        C.addFrame("box", "table")
        .setRelativePosition([0.2, 0.25, 0.09])
        .setShape(ry.ST.ssBox, [0.04, 0.05, 0.08, 0.004])
    )
    box.setContact(1).setJoint(ry.JT.rigid).setMass(0.1)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.25, 0.055])
    tray.setShape(ry.ST.ssBox, [0.14, 0.14, 0.01, 0.004]).setContact(1)
    return C


SMALL = {"cameras": ["cameraTop"], "size": 32, "fps": 10, "shard": 1, "progress": False}


def test_demonstrations_reach_the_goal_and_are_the_same_for_a_seed(tmp_path: Path) -> None:
    made = ry.demonstrate(scene(), "(on tray box)", 2, tmp_path / "a", **SMALL)
    assert ry.checkDataset(made.folder) == [] and made.episodes == 2 and made.attempts >= 2
    again = ry.demonstrate(scene(), "(on tray box)", 2, tmp_path / "b", engine="processes", workers=2, **SMALL)
    assert tables(again.folder) == tables(made.folder)
    table = pq.read_table(made.folder / "data/chunk-000/file-000.parquet")
    state, action = (np.array(table[key].to_pylist()) for key in ("observation.state", "action"))
    assert state.shape[1] == 8 and state[:, 7].max() > 0.07 and 0.03 < state[:, 7].min() < 0.06
    assert set(np.round(action[:, 7], 5)) == {0.0, 0.08}  # the command closes the hand, the box stops it
    ahead = np.abs(action[:-1, :7] - state[1:, :7]).max()
    assert ahead < 0.03 and not np.array_equal(action[:-1, :7], state[1:, :7])
    (tasks,) = pq.read_table(made.folder / "meta/tasks.parquet")["task"].to_pylist()
    assert tasks == "put box on tray"
    first, second = (pq.read_table(made.folder / f"data/chunk-000/file-00{k}.parquet") for k in (0, 1))
    assert first["observation.state"].to_pylist() != second["observation.state"].to_pylist()


def test_demonstrations_continue_where_they_ended(tmp_path: Path) -> None:
    whole = ry.demonstrate(scene(), "(on tray box)", 2, tmp_path / "whole", **SMALL)
    ry.demonstrate(scene(), "(on tray box)", 1, tmp_path / "parts", **SMALL)
    (tmp_path / "parts/videos/observation.images.cameraTop/chunk-000/file-001.mp4").write_bytes(b"of a killed run")
    stamp = (tmp_path / "parts/shards/000000/frames.parquet").stat().st_mtime_ns
    parts = ry.demonstrate(scene(), "(on tray box)", 2, tmp_path / "parts", **SMALL)
    assert (tmp_path / "parts/shards/000000/frames.parquet").stat().st_mtime_ns == stamp
    assert tables(parts.folder) == tables(whole.folder)
    with pytest.raises(ry.ArgumentError, match="has demonstrations with seed 0 instead of 1; choose another folder"):
        ry.demonstrate(scene(), "(on tray box)", 2, tmp_path / "parts", seed=1, **SMALL)


def test_a_call_that_fails_at_once_leaves_the_folder_to_the_next_one(tmp_path: Path) -> None:
    for wrong, message in (
        ({"cameras": ["cameraTpo"]}, "cameraTpo.*similar names: cameraTop"),
        ({"codec": "hevc"}, "codec is 'hevc'; expected one of h264, av1"),
    ):
        with pytest.raises(ry.Error, match=message):
            ry.demonstrate(scene(), "(on tray box)", 1, tmp_path / "set", **{**SMALL, **wrong})
    assert not (tmp_path / "set").exists()
    with pytest.raises(ry.ParseError, match="unknown symbol 'trya'.*similar names: tray"):
        ry.demonstrate(scene(), "(on trya box)", 1, tmp_path / "set", **SMALL)
    assert ry.demonstrate(scene(), "(on tray box)", 1, tmp_path / "set", **SMALL).episodes == 1


def test_failures_are_kept_if_asked(tmp_path: Path) -> None:
    C = scene()
    C.getFrame("box").setMass(60.0)  # too heavy for the friction of the fingers

    def still(*_: object) -> None:
        pass

    made = ry.demonstrate(C, "(on tray box)", 1, tmp_path, keep="all", randomize=still, **SMALL)
    assert made.episodes == 1 and sum(made.failures.values()) == 1, made.failures
    table = pq.read_table(tmp_path / "data/chunk-000/file-000.parquet")
    assert not any(table["next.success"].to_pylist())


def test_wrong_arguments_are_told_first(tmp_path: Path) -> None:
    with pytest.raises(ry.ArgumentError, match="fps is 30; expected a divisor of the control rate"):
        ry.demonstrate(scene(), "(on tray box)", 1, tmp_path / "x", fps=30)
    with pytest.raises(ry.ArgumentError, match="keep is 'good'; expected one of success, clean, all"):
        ry.demonstrate(scene(), "(on tray box)", 1, tmp_path / "x", keep="good")
    with pytest.raises(ry.NotFound, match="cameraTopp"):
        ry.demonstrate(scene(), "(on tray box)", 1, tmp_path / "x", cameras=["cameraTopp"], progress=False)
    assert not (tmp_path / "x/meta").exists()


def test_the_command_makes_and_continues_a_data_set(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from kinegraph.cli import main

    C = scene()
    C.write(str(tmp_path / "scene.g"))
    words = ["demonstrate", str(tmp_path / "scene.g"), "--goal", "(on tray box)", "-o", str(tmp_path / "out")]
    words += ["--engine", "threads", "--workers", "1", "--fps", "10"]
    for episodes in ("1", "11"):
        assert main([*words, "--episodes", episodes]) == (0 if episodes == "1" else 1)
    told = capsys.readouterr()
    assert "1 episodes of 1 attempts" in told.out and "has 1 episodes in shard 0; expected 10" in told.err
    assert ry.checkDataset(tmp_path / "out") == []


@pytest.mark.parametrize("camera", [False, True])
def test_a_full_disk_names_the_file_and_leaves_the_finished_shards(tmp_path: Path, camera: bool) -> None:
    script = (
        "import resource, signal, numpy as np, kinegraph as ry\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "rng = np.random.default_rng(0)\n"
        f"cameras = {{'top': (64, 64)}} if {camera} else {{}}\n"
        "def write(shard, count):\n"
        "    images = {'top': list(rng.integers(0, 255, (count, 64, 64, 3), np.uint8))} if cameras else {}\n"
        "    with ry.LeRobotWriter('data', 10, ['a.pos', 'b.pos'], cameras=cameras, shard=shard) as writer:\n"
        "        writer.addEpisode(rng.normal(size=(count, 2)), rng.normal(size=(count, 2)), images, 'x')\n"
        "write(0, 5)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))\n"
        "try:\n    write(1, 100 if cameras else 20000)\nexcept ry.FileError as error:\n    print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, env=os.environ)
    assert (
        done.stderr == ""
        and done.stdout.startswith("LeRobotWriter: cannot write 'data/")
        and "File too large" in done.stdout
    )
    assert ry.checkDataset(tmp_path / "data") == []


def test_a_goal_out_of_reach_ends_with_its_reason(tmp_path):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = (
        C.addFrame("box", "table")
        .setRelativePosition([3.0, 0.25, 0.09])
        .setShape(ry.ST.ssBox, [0.04, 0.05, 0.08, 0.004])
    )
    box.setContact(1).setJoint(ry.JT.rigid).setMass(0.1)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.25, 0.055])
    tray.setShape(ry.ST.ssBox, [0.14, 0.14, 0.01, 0.004]).setContact(1)
    with pytest.raises(ry.Error, match="20 attempts of shard 0 gave 0 episodes; the last one: no plan: "):
        ry.demonstrate(C, "(on tray box)", 1, tmp_path / "out", progress=False)


def test_tasks_of_an_index_without_a_name_are_read_as_lerobot_writes_them(tmp_path: Path) -> None:
    filled(tmp_path)
    path = tmp_path / "meta" / "tasks.parquet"
    table = pq.read_table(path)
    for name, faults in (
        ("__index_level_0__", []),
        ("words", ["tasks.parquet has the columns task_index, words; expected task_index and task"]),
    ):
        renamed = table.rename_columns(["task_index", name]).replace_schema_metadata(table.schema.metadata)
        pq.write_table(renamed, path)
        assert ry.checkDataset(tmp_path) == faults
