"""Texts of small robots with a flaw, and their meshes."""

from pathlib import Path

import kinegraph as ry

ARM = (
    '<link name="a">{shape}</link><link name="b"/><joint name="j" type="{type}"><parent link="a"/><child link="b"/>'
    "{joint}</joint>"
)


def urdf(folder: Path, shape: str = "", joint: str = "", type: str = "continuous", **options: object) -> ry.Config:
    file = folder / "r.urdf"
    file.write_text(f'<robot name="r">{ARM.format(shape=shape, joint=joint, type=type)}</robot>')
    C = ry.Config()
    C.addFile(file, **options)
    return C
