"""Writes the pages of robots, of this package and of the extra `meshes`: picture, frames, dofs, collision pairs, ..."""

import hashlib
import inspect
import json
import re
import warnings
from importlib import metadata
from pathlib import Path

import numpy as np

import kinegraph as ry

SIZE = (320, 280)  # pixels
EXTRA = "example-robot-data"  # the package of the extra `meshes`
KIND = {
    "panda",
    "ur5e",
    "ur10e",
    "ur10",
    "irb120",
    "allegro",
    "g1",
    "pr2",
    "ranger",
    "robotiq",
    "so101",
    "trossen",
    "basler",
}


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


def counts(C: ry.Config) -> dict[str, str]:
    """What the pages say about a scene with a robot."""
    grippers = [name for name in C.getFrameNames() if name.split("_")[-1].lower() in ("gripper", "grippercenter")]
    masses = float(np.sum([f.getMass() for f in C.getFrames()]))
    return {
        "frames": str(len(C)),
        "dofs": str(C.getJointDimension()),
        "collision pairs": str(len(C.getCollidablePairs()) // 2),
        "mass": f"{masses:.1f} kg",
        "gripper": ", ".join(f"`{name}`" for name in grippers) or "none",
    }


def facts(file: Path) -> dict[str, str]:
    """What the page says about a robot of this package."""
    C = ry.Config()
    C.addFile(str(file))
    found = counts(C)
    colliding = file.with_name(f"{file.stem}_collision.g")
    if found["collision pairs"] == "0" and colliding.exists():
        other = ry.Config()
        other.addFile(str(colliding))
        found["collision pairs"] += f"; {len(other.getCollidablePairs()) // 2} in `{colliding.name}`"
    return {
        "file": f"`{file.parent.name}/{file.name}`",
        **found,
        "source of its figures": source(file),
        "license": "MIT, as the package: lengths, limits and masses are facts, and the shapes were made for it",
    }


def card(title: str, picture: str | None, text: str, rows: dict[str, str]) -> list[str]:
    shown = [f"![{title}](pictures/{picture})", ""] if picture else []
    table = ["| | |", "|---|---|", *(f"| {key} | {value} |" for key, value in rows.items())]
    return [f":::::{{grid-item-card}} {title}", "", *shown, text, "", *table, "", ":::::", ""]


def grid(cards: list[list[str]]) -> list[str]:
    return ["::::::{grid} 1 1 2 2", ":gutter: 3", "", *(line for lines in cards for line in lines), "::::::", ""]


def description(folder: Path) -> tuple[str, str, str]:
    """Title, source and license of a robot of the extra, from the text beside it."""
    text = next(folder.glob("README*")).read_text()
    values = dict(re.findall(r"(?mi)^(upstream|license): *(.+?) *$", text))
    values = {key.lower(): value for key, value in values.items()}
    return text.splitlines()[0].lstrip("# "), values.get("upstream", ""), values.get("license", "")


def extraFolders() -> dict[Path, list[str]]:
    """Folders of descriptions in the extra, with the names of their robots; the shortest name comes first."""
    found: dict[Path, list[str]] = {}
    for name in ry.robotNames():
        if name.startswith(f"{EXTRA}/"):
            file = Path(ry.robotPath(name))
            folder = next(parent for parent in file.parents if parent.parent.name == "robots")
            found.setdefault(folder, []).append(name)
    return {folder: sorted(names, key=lambda name: (len(name), name)) for folder, names in found.items()}


def loaded(names: list[str]) -> tuple[str, ry.Config]:
    """The first robot that loads."""
    for name in names:
        C = ry.Config()
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                C.addFile(ry.robotPath(name))
        except ry.Error:
            continue
        return name, C
    raise SystemExit(f"site: none of {', '.join(names)} loads")


def standOnGround(C: ry.Config) -> None:
    """Raises a robot whose base is its middle."""
    lowest = min(frame.getPosition()[2] for frame in C.getFrames())
    for frame in C.getFrames():
        if lowest < -0.05 and frame.getParent() is None:
            frame.setPosition(frame.getPosition() + [0, 0, 0.05 - lowest])


def extraCard(folder: Path, names: list[str], pictures: Path, cache: Path) -> list[str]:
    title, origin, license = description(folder)
    code = [inspect.getsource(function) for function in (counts, picture, standOnGround)]
    key = hashlib.sha256(repr((metadata.version(EXTRA), ry.__version__, SIZE, code)).encode()).hexdigest()[:16]
    kept = cache / "robots" / f"{folder.name}_{key}.json"
    drawn = kept.with_suffix(".png")
    may_draw = "-ND" not in license  # no derived works
    if not kept.exists():
        kept.parent.mkdir(parents=True, exist_ok=True)
        name, C = loaded(names)
        if may_draw:
            standOnGround(C)
            picture(C, drawn)
        kept.write_text(json.dumps({"name": name, **counts(C)}))
    rows = json.loads(kept.read_text())
    others = [f"`{name.removeprefix(f'{EXTRA}/')}`" for name in names if name != rows["name"]]
    rows["name"] = f"`{rows['name'].removeprefix(f'{EXTRA}/')}`"
    rows |= {"others": ", ".join(others)} if others else {}
    link = f"[{origin.split('/')[2]}]({origin})" if origin.startswith("http") else origin
    rows |= {"source": link, "license": license}
    if may_draw:
        (pictures / f"{folder.name}.png").write_bytes(drawn.read_bytes())
    return card(
        title, f"{folder.name}.png" if may_draw else None, "" if may_draw else "Its license forbids pictures.", rows
    )


def writeExtraPage(out: Path, cache: Path) -> int:
    """Writes robot_gallery/extra.md; returns the number of robots."""
    folders = extraFolders()
    cards = [extraCard(folder, names, out / "pictures", cache) for folder, names in sorted(folders.items())]
    lines = ["# Robots of the extra `meshes`", "", "`pip install 'kinegraph[meshes]'` installs them, and"]
    lines += ["`C.addFile(ry.robotPath(name))` loads them. Each has the license of its authors."]
    lines += ["[Robots of other packages](../robots.md) tells which flaws of such files are mended.", "", *grid(cards)]
    (out / "extra.md").write_text("\n".join(lines))
    return sum(map(len, folders.values()))


def writePage(out: Path, cache: Path) -> int:
    """Writes the pages with a card per robot; returns the number of robots."""
    pictures = out / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    models = Path(ry.raiPath(""))
    lines = ["# Robots that come with the package", ""]
    lines += ["`C.addFile(ry.raiPath(file))` loads them without any download. More are among those [of the extra"]
    lines += ["`meshes`](extra.md), and [of other packages](../robots.md), all found by name.", ""]
    cards = []
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
        rows = facts(file)
        if others := variants(file):
            rows["variants"] = ", ".join(f"`{name}`" for name in others)
        cards.append(card(file.stem, f"{file.stem}.png", comment(file)[0], rows))
    count = writeExtraPage(out, cache)
    (out / "index.md").write_text("\n".join([*lines, *grid(cards), "```{toctree}", ":hidden:", "", "extra", "```", ""]))
    return len(files) + count
