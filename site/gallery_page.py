"""Writes the gallery: each entry's picture or loop, and its code."""

import ast
import hashlib
import inspect
import textwrap
from pathlib import Path
from types import ModuleType
from typing import Any

from gallery import motions, physics_and_tasks, scenes

import kinegraph as ry

SIZE = (400, 300)  # pixels
RATE = 10.0  # pictures per second of loops
LONGEST = 4.0  # s; longer motions are shown faster, since each picture takes 50 ms of processor time
LONGEST_CODE = 40  # lines
CHAPTERS: dict[str, ModuleType] = {"Scenes": scenes, "Motions": motions, "Physics and tasks": physics_and_tasks}


def entries(module: ModuleType) -> dict[str, Any]:
    """The functions of a module that return a picture or a loop, by name; helpers take part in their code only."""
    found = {name: value for name, value in vars(module).items() if inspect.isfunction(value)}
    own = {name: value for name, value in found.items() if value.__module__ == module.__name__}
    return {name: value for name, value in own.items() if name not in HELPERS}


HELPERS = {"panda", "simulated", "tray_scene"}


def title(name: str) -> str:
    return name.replace("_", " ").capitalize()


def code(function: Any) -> str:
    """The source without its docstring."""
    source = textwrap.dedent(inspect.getsource(function))
    body = ast.parse(source).body[0]
    assert isinstance(body, ast.FunctionDef)
    lines = source.splitlines()
    text = body.body[0]
    return "\n".join(lines[: text.lineno - 1] + lines[text.end_lineno or text.lineno :])


def show(function: Any, view: Any, folder: Path) -> Path:
    """Renders an entry and returns its file, .png or .mp4."""
    result = function()
    C, path, seconds = result if isinstance(result, tuple) else (result, None, 0.0)
    viewer = C.viewer()
    C.view(offscreen=True)
    viewer.visualsOnly(any("panda" in name for name in C.getFrameNames()))  # without its collision shapes
    viewer.setWindow(function.__name__, *SIZE)
    if view:
        viewer.setCamera(*view)
    else:
        viewer.fit()
    if path is None:
        file = folder / f"{function.__name__}.png"
        viewer.savePng(str(file))
    else:
        file = folder / f"{function.__name__}.mp4"
        ry.saveFilm(file, C, path, min(max(seconds, 1.0), LONGEST), rate=RATE, size=SIZE)
    return file


def kept(module: ModuleType, name: str, function: Any, cache: Path) -> Path:
    """The picture of an entry, from the cache if neither its code nor the helpers' has changed."""
    texts = [inspect.getsource(function), *(inspect.getsource(f) for f in helpers())]
    view = getattr(module, "VIEW", {}).get(name)
    key = hashlib.sha256("\n".join([*texts, repr((view, SIZE, RATE, LONGEST))]).encode()).hexdigest()[:16]
    folder = cache / "gallery" / key
    for suffix in (".png", ".mp4"):
        if (folder / f"{name}{suffix}").exists():
            return folder / f"{name}{suffix}"
    folder.mkdir(parents=True, exist_ok=True)
    return show(function, view, folder)


def helpers() -> list[Any]:
    """The functions that entries share, each once."""
    found = [getattr(module, name) for module in CHAPTERS.values() for name in sorted(HELPERS) if name in vars(module)]
    return list(dict.fromkeys(found))


def element(file: Path, text: str) -> str:
    if file.suffix == ".png":
        return f"![{text}](gallery/{file.name})"
    options = "autoplay loop muted playsinline"
    return f'<video {options} width="{SIZE[0]}" height="{SIZE[1]}" src="../_static/gallery/{file.name}"></video>'


def writePage(out: Path, static: Path, cache: Path) -> int:
    """Writes gallery/index.md; returns the number of entries."""
    for folder in (out / "gallery", static / "gallery"):
        folder.mkdir(parents=True, exist_ok=True)
    lines = ["# Gallery", "", "Pictures and loops, each with its code. The functions start from", "", "```python"]
    lines += ["import numpy as np", "import kinegraph as ry", "", *(code(f) + "\n" for f in helpers()), "```", ""]
    lines += ["They return a scene, shown by `C.view()`; or a scene, a path and a duration, shown by"]
    lines += [
        f"`C.view_path(path, duration)`, or saved by `ry.saveFilm`. Loops of more than {LONGEST:g} s are shown faster.",
        "",
    ]
    count = 0
    for chapter, module in CHAPTERS.items():
        lines += [f"## {chapter}", "", ":::::{grid} 1 1 2 2", ":gutter: 3", ""]
        for name, function in entries(module).items():
            file = kept(module, name, function, cache)
            target = (out if file.suffix == ".png" else static) / "gallery" / file.name
            target.write_bytes(file.read_bytes())
            caption = " ".join((inspect.getdoc(function) or "").split())
            lines += [f"::::{{grid-item-card}} {title(name)}", "", element(file, title(name)), "", caption, ""]
            lines += [":::{dropdown} Code", "```python", code(function), "```", ":::", "::::", ""]
            count += 1
        lines += [":::::", ""]
    (out / "index.md").write_text("\n".join(lines))
    return count
