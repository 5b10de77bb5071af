"""Paths of the models in the package."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

from .errors import FileError

_SHIPPED = Path(__file__).parent / "models"


def announce() -> None:
    """Sets search paths of scene files, unless the user has: `$RAI_PATH` to the package's models, and `package://` to
    the data of installed packages such as example-robot-data."""
    os.environ.setdefault("RAI_PATH", str(_SHIPPED))
    shares = [str(share) for folder in sys.path if (share := Path(folder) / "cmeel.prefix" / "share").is_dir()]
    if shares:
        os.environ.setdefault("KINEGRAPH_PACKAGE_PATH", os.pathsep.join(shares))


def setRaiPath(folder: str | os.PathLike[str]) -> None:
    """Sets the model collection that `raiPath` and `$RAI_PATH` refer to.

    Args:
        folder: Path of the collection.
    Raises:
        FileError: There is no such folder.
    """
    if not Path(folder).is_dir():
        raise FileError(f"setRaiPath: there is no folder '{folder}'")
    os.environ["RAI_PATH"] = str(Path(folder).resolve())


def raiPath(path: str = "") -> str:
    """Returns the absolute path of a model file or folder.

    Args:
        path: Relative to the model collection: 'panda/panda.g', 'scenarios/pandaSingle.g'. The older spellings
            '../rai-robotModels/...' and 'rai-robotModels/...' work, too. Meshes of robots, such as
            'g1/meshes/head_link.h5', are those of the extra 'meshes'.
    Returns:
        The path.
    Raises:
        FileError: There is no such model, and the message lists similar names; or the extra 'meshes' has it and is
            not installed.
    """
    relative = str(path).lstrip("/")
    for prefix in ("../rai-robotModels/", "rai-robotModels/"):
        relative = relative.removeprefix(prefix)
    if relative in ("../rai-robotModels", "rai-robotModels"):
        relative = ""
    folders = [Path(os.environ.get("RAI_PATH", _SHIPPED)), _SHIPPED]
    for folder in folders:
        if (folder / relative).exists():
            return str(folder / relative) + ("/" if relative == "" else "")
    if mesh := _meshOfPackage(relative):
        for folder in os.environ.get("KINEGRAPH_PACKAGE_PATH", "").split(os.pathsep):
            if folder and (Path(folder) / mesh).is_file():
                return str(Path(folder) / mesh)
        raise FileError(
            f"raiPath: the mesh '{path}' is not part of Kinegraph; package://{mesh} has its shape: "
            "python -m pip install 'kinegraph[meshes]'"
        )
    near = similarModels(relative)
    hint = (
        f"; similar names: {', '.join(near)}"
        if near
        else f"; models: {', '.join(sorted(p.name for p in _SHIPPED.iterdir()))}"
    )
    raise FileError(f"raiPath: there is no model '{path}' in {folders[0]}{hint}")


def _meshOfPackage(relative: str) -> str | None:
    """Returns the mesh of another package that a shipped robot shows instead of a file in its folder `meshes`."""
    robot, _, file = relative.partition("/meshes/")
    shown = re.compile(rf"<package://([^>]*/{re.escape(Path(file).stem)}\.\w+)>") if file else None
    for scene in sorted((_SHIPPED / robot).glob("*.g")) if shown else []:
        if match := shown.search(scene.read_text()):
            return match[1]
    return None


def similarModels(path: str) -> list[str]:
    """Returns up to three models with names similar to `path`, relative to the model collection."""
    import difflib  # not at import: it takes milliseconds, and is rarely needed

    folders = [Path(os.environ.get("RAI_PATH", _SHIPPED)), _SHIPPED]
    known = sorted({str(file.relative_to(folder)) for folder in folders for file in folder.rglob("*.*")})
    return difflib.get_close_matches(path, known, 3, 0.5)
