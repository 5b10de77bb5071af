"""Where the models are that come with the package."""

from __future__ import annotations

import difflib
import os
from pathlib import Path

from .errors import FileError

_SHIPPED = Path(__file__).parent / "models"


def announce() -> None:
    """Lets `$RAI_PATH` in scene files mean the models that come with the package, unless the user has set it."""
    os.environ.setdefault("RAI_PATH", str(_SHIPPED))


def setRaiPath(folder: str | os.PathLike[str]) -> None:
    """Makes `folder` the model collection that `raiPath` and `$RAI_PATH` refer to."""
    if not Path(folder).is_dir():
        raise FileError(f"setRaiPath: there is no folder '{folder}'")
    os.environ["RAI_PATH"] = str(Path(folder).resolve())


def raiPath(path: str = "") -> str:
    """The absolute path of a model file or folder.

    Args:
        path: Relative to the model collection: 'panda/panda.g', 'scenarios/pandaSingle.g'. The older spellings
            '../rai-robotModels/...' and 'rai-robotModels/...' mean the same.
    Raises:
        FileError: Nothing is there; the message lists similar names.
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
    known = sorted({str(file.relative_to(folder)) for folder in folders for file in folder.rglob("*.g")})
    near = difflib.get_close_matches(relative, known, 3, 0.5)
    hint = f"; similar names: {', '.join(near)}" if near else f"; there are: {', '.join(known)}"
    raise FileError(f"raiPath: there is no model '{path}' in {folders[0]}{hint}")
