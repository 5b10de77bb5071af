"""Writes the page of the robots that come with the package: picture, frames, dofs, collision pairs, gripper, source."""

import hashlib
from pathlib import Path

import numpy as np

import kinegraph as ry

SIZE = (320, 280)  # pixels
KIND = {"panda", "ur5e", "ur10e", "ur10", "irb120", "allegro", "g1", "pr2", "ranger", "robotiq", "trossen", "basler"}


def robotFiles(models: Path) -> list[Path]:
    """The main file of each folder with a robot, and of scenes that are a robot alone, in alphabetical order."""
    return sorted(models / name / f"{name}.g" for name in KIND)


def variants(file: Path) -> list[str]:
    return [other.name for other in sorted(file.parent.glob("*.g")) if other != file]


def comment(file: Path) -> list[str]:
    """The paragraphs of the comment at the top of a file."""
    lines = []
    for line in file.read_text().splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# ").rstrip())
    return [" ".join(part.split("\n")) for part in "\n".join(lines).strip().split("\n\n")]


def source(file: Path) -> str:
    """The sentences on where the figures come from, from the comments of a robot's files."""
    words = ("manufacturer", "data sheet", "identified", "published")
    for candidate in [file, *sorted(file.parent.glob("*.g"))]:
        if candidate.suffix != ".g":
            continue
        for paragraph in comment(candidate):
            sentences = [s.strip(" .") for s in paragraph.split(". ")]
            found = [s for s in sentences if any(word in s for word in words)]
            if found:
                return ". ".join(found) + "."
    return "made for this package"


def picture(C: ry.Config, file: Path) -> None:
    viewer = C.viewer()
    C.view(offscreen=True)
    opaque = any((f.asDict().get("color") or [1])[3:4] in ([], [1.0]) for f in C.getFrames() if f.getShapeType() != -1)
    viewer.visualsOnly(opaque and any("panda" in name for name in C.getFrameNames()))
    viewer.setWindow(file.stem, *SIZE)
    viewer.fit()
    viewer.savePng(str(file))


def facts(file: Path) -> dict[str, str]:
    """What the page says about a robot."""
    C = ry.Config()
    C.addFile(str(file))
    grippers = [name for name in C.getFrameNames() if name.split("_")[-1].lower() in ("gripper", "grippercenter")]
    pairs = str(len(C.getCollidablePairs()) // 2)
    colliding = file.with_name(f"{file.stem}_collision.g")
    if pairs == "0" and colliding.exists():
        other = ry.Config()
        other.addFile(str(colliding))
        pairs += f"; {len(other.getCollidablePairs()) // 2} in `{colliding.name}`"
    masses = float(np.sum([f.getMass() for f in C.getFrames()]))
    return {
        "file": f"`{file.parent.name}/{file.name}`",
        "frames": str(len(C)),
        "dofs": str(C.getJointDimension()),
        "collision pairs": pairs,
        "mass": f"{masses:.1f} kg",
        "gripper": ", ".join(f"`{name}`" for name in grippers) or "none",
        "source of its figures": source(file),
        "license": "MIT, as the package: lengths, limits and masses are facts, and the shapes were made for it",
    }


def writePage(out: Path, cache: Path) -> int:
    """Writes robots/index.md with a card per robot; returns their number."""
    pictures = out / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    models = Path(ry.raiPath(""))
    lines = [
        "# Robots that come with the package",
        "",
        "`C.addFile(ry.raiPath(file))` loads them without any download.",
    ]
    lines += [
        "[Robots of other packages](../robots.md) are found by name.",
        "",
        "::::::{grid} 1 1 2 2",
        ":gutter: 3",
        "",
    ]
    files = robotFiles(models)
    for file in files:
        text = "\n".join(f.read_text() for f in sorted(file.parent.glob("*.g")))
        key = hashlib.sha256((text + repr(SIZE)).encode()).hexdigest()[:16]
        kept = cache / "robots" / f"{file.stem}_{key}.png"
        if not kept.exists():
            kept.parent.mkdir(parents=True, exist_ok=True)
            C = ry.Config()
            C.addFile(str(file))
            picture(C, kept)
        (pictures / f"{file.stem}.png").write_bytes(kept.read_bytes())
        lines += [f":::::{{grid-item-card}} {file.stem}", "", f"![{file.stem}](pictures/{file.stem}.png)", ""]
        lines += [comment(file)[0], "", "| | |", "|---|---|", *(f"| {k} | {v} |" for k, v in facts(file).items())]
        if others := variants(file):
            lines += [f"| variants | {', '.join(f'`{name}`' for name in others)} |"]
        lines += ["", ":::::", ""]
    lines += ["::::::", ""]
    (out / "index.md").write_text("\n".join(lines))
    return len(files)
