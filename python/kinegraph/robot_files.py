"""Robots by name, from the description packages on this machine."""

from __future__ import annotations

import difflib
import importlib
import importlib.util
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path

from .errors import FileError

_SUFFIXES = (".urdf", ".xml", ".mjcf", ".urdf.xacro")
# Where Python packages keep their robots: folders below the package.
_PACKAGES = {
    "robosuite": ("models/assets/robots", "models/assets/grippers", "models/assets/bases"),
    "mujoco": ("testdata",),
    "dm_control": ("suite", "locomotion/walkers/assets", "third_party"),
    "gymnasium": ("envs/mujoco/assets",),
    "gymnasium_robotics": ("envs/assets", "envs/mujoco/assets"),
    "pybullet_data": (".",),
}
_GENERIC = ("robot", "model", "scene", "main", "arm", "gripper", "description")  # their folder names the robot
_FOLDERS = ("urdf", "robots", "robot", "xml", "mjcf", "xacro", "assets", "models")  # that say nothing of a robot


def robotNames() -> list[str]:
    """Lists the robots that `robotPath` finds on this machine.

    Returns:
        Names "package/robot", sorted: of example-robot-data, robosuite, mujoco, dm_control, gymnasium,
        gymnasium_robotics and pybullet_data, as far as they are installed, and of the ROS packages in
        ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and KINEGRAPH_PACKAGE_PATH. Robots of the package robot_descriptions are
        not listed, because it downloads them.
    """
    return sorted(_robots())


def robotPath(name: str) -> str:
    """Returns the file of a robot of an installed package.

    Args:
        name: "package/robot" as in robotNames(), or the robot alone: "panda". A name of the package robot_descriptions,
            such as "panda_description" or "panda_mj_description", loads that description; the package downloads it at
            its first use.
    Returns:
        The path of a URDF, MJCF or xacro file, for `Config.addFile`. If several packages have the robot, the first in
        the order example-robot-data, ROS packages, robosuite, others counts.
    Raises:
        FileError: There is no such robot; the message lists similar names.
    """
    robots = _robots()
    if name in robots:
        return str(robots[name])
    for key, path in robots.items():
        if key.rsplit("/", 1)[-1] == name:
            return str(path)
    if described := _describedPath(name.rsplit("/", 1)[-1]):
        return described
    short = [key.rsplit("/", 1)[-1] for key in robots]
    near = difflib.get_close_matches(name, [*robots, *dict.fromkeys(short)], 5, 0.5)
    hint = f"; similar names: {', '.join(near)}" if near else f"; {len(robots)} robots are known: ry.robotNames()"
    raise FileError(
        f"robotPath: no installed package has a robot '{name}'{hint}"
        + ("" if robots else "; pip install example-robot-data provides 30 of them")
    )


def _robots() -> dict[str, Path]:
    """The files by name, in the order of the search."""
    found: dict[str, Path] = {}
    for package, root in _roots():
        for file in _files(root):
            robot = _nameOf(file, root)
            while f"{package}/{robot}" in found and found[f"{package}/{robot}"] != file:
                robot = f"{robot}_{file.suffix[1:]}" if file.parent.name == robot else f"{file.parent.name}_{robot}"
                if len(robot) > 200:
                    break
            found.setdefault(f"{package}/{robot}", file)
    return found


def _roots() -> Iterator[tuple[str, Path]]:
    """Packages and the folders that hold their robots."""
    shares = [Path(folder) / "cmeel.prefix" / "share" for folder in sys.path]
    for share in shares:
        if (share / "example-robot-data").is_dir():
            yield "example-robot-data", share / "example-robot-data" / "robots"
    for variable in ("KINEGRAPH_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"):
        for entry in os.environ.get(variable, "").split(os.pathsep):
            if entry and Path(entry) not in shares:
                yield from _rosPackages(Path(entry))
    for package, folders in _PACKAGES.items():
        spec = importlib.util.find_spec(package)
        for place in (spec.submodule_search_locations or []) if spec else []:
            for folder in folders:
                if (Path(place) / folder).is_dir():
                    yield package, Path(place) / folder


def _rosPackages(entry: Path) -> Iterator[tuple[str, Path]]:
    for folder, inner, files in os.walk(entry if not (entry / "share").is_dir() else entry / "share"):
        inner[:] = sorted(name for name in inner if not name.startswith("."))
        if "package.xml" in files:
            inner.clear()  # packages hold no packages
            yield _packageName(Path(folder)), Path(folder)


def _packageName(folder: Path) -> str:
    """The <name> in package.xml, as rospack reads it; without one, the name of the folder."""
    named = re.search(r"<name>\s*([^<\s]+)\s*</name>", (folder / "package.xml").read_text(errors="replace"))
    return named[1] if named else folder.name


def _files(root: Path) -> Iterator[Path]:
    for folder, inner, files in os.walk(root):
        inner.sort()
        for file in sorted(files):
            path = Path(folder) / file
            if file.endswith(_SUFFIXES) and (file.endswith((".urdf", ".xacro")) or _isModel(path)):
                yield path


def _isModel(path: Path) -> bool:
    """Whether an XML file is a MuJoCo model with bodies; included parts have none."""
    try:
        text = path.read_text(errors="replace")
    except OSError:
        return False
    return "<mujoco" in text and ("<body" in text or "<include" in text) and "<worldbody" in text


def _nameOf(file: Path, root: Path) -> str:
    """The robot's name: the file's, or that of the folder around a file of a generic name."""
    name = file.name
    for suffix in (".xacro", *_SUFFIXES):
        name = name.removesuffix(suffix)
    if name not in _GENERIC:
        return name
    for folder in file.parents:
        if folder == root or folder.name not in _FOLDERS:
            return folder.name.removesuffix("_description")
    return name


def _describedPath(name: str) -> str | None:
    """The file of a module of robot_descriptions, which downloads it; None if there is no such module."""
    for module in (name, f"{name}_description", f"{name}_mj_description"):
        if not module.isidentifier() or importlib.util.find_spec("robot_descriptions") is None:
            continue
        if importlib.util.find_spec(f"robot_descriptions.{module}") is None:
            continue
        try:
            description = importlib.import_module(f"robot_descriptions.{module}")
        except Exception as error:  # no network, no git
            raise FileError(f"robotPath: robot_descriptions cannot load '{module}': {error}") from error
        for attribute in ("URDF_PATH", "MJCF_PATH", "XACRO_PATH"):
            if path := getattr(description, attribute, None):
                return str(path)
    return None
