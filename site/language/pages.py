"""Writes the pages of the three languages."""

from pathlib import Path

from . import mjcf, scene, urdf
from .entries import examples, table


def writePages(out: Path) -> list[str]:
    """Returns the names of the pages."""
    out.mkdir(parents=True, exist_ok=True)
    lines = [
        "# Attributes of the .g language",
        "",
        "[Scenes](../scenes.md) introduces the language. An unknown attribute is kept",
    ]
    lines += ["with its frame, with a warning if it resembles one of these.", ""]
    for title, (text, entries) in scene.SECTIONS.items():
        lines += [f"## {title}", "", text, "", *table(entries), *examples(entries, "g")]
    (out / "scene_attributes.md").write_text("\n".join(lines))
    for page, name, module in (("urdf", "URDF", urdf), ("mjcf", "MJCF", mjcf)):
        lines = [
            f"# {name}, attribute by attribute",
            "",
            f"`C.addFile` reads {name} files. The tables name what is read;",
        ]
        lines += [
            "all numbers become m, rad and kg. The attributes of frames are those of the [.g language](scene_attributes.md).",
            "",
        ]
        for title, (text, _, entries) in module.SECTIONS.items():
            lines += [f"## {title}", "", text, "", *table(entries), *examples(entries, "xml")]
        lines += ["## Not read", "", module.NOT_READ, ""]
        (out / f"{page}.md").write_text("\n".join(lines))
    return ["scene_attributes", "urdf", "mjcf"]
