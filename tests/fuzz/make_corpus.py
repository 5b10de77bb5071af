"""Seeds for the fuzzers of this folder, made from the models that come with the package: a folder per fuzzer.

    python tests/fuzz/make_corpus.py build/fuzz/corpus

Needs the package kinegraph. Start a fuzzer with its folder: build/fuzz/tests/fuzz/fuzz_g -max_len=4096
build/fuzz/corpus/g
"""

import struct
import sys
import tempfile
import warnings
from pathlib import Path

import kinegraph as ry

ROOT = Path(__file__).resolve().parents[2]
SRDF = """<robot name="r"><virtual_joint name="w" type="fixed" parent_frame="o" child_link="base"/>
<group name="a"><chain base_link="base" tip_link="l2"/><joint name="j1"/><link name="l1"/></group><group name="b"><group name="a"/></group>
<group_state name="home" group="a"><joint name="j1" value=".5"/><joint name="j2" value="1 2 3 0 0 0 1"/></group_state>
<disable_collisions link1="l1" link2="l2" reason="Never"/><disable_default_collisions link="base"/>
<enable_collisions link1="base" link2="l2"/></robot>"""
OBJ = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf 1 2 3\nf 1 3 4\nusemtl a\nf 1//1 2//1 4//1\n"
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
    "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n"
)
PLY_BINARY = PLY[: PLY.index("0 0 0 1")].replace("ascii", "binary_little_endian").encode()
MSH = struct.pack("<4i", 3, 1, 1, 1) + struct.pack("<14f", *range(14)) + struct.pack("<3i", 0, 1, 2)
STL = b"\0" * 80 + struct.pack("<I", 2) + 2 * struct.pack("<12fH", *range(12), 0)
STL_TEXT = (
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
)


GCODE = (
    "%\nN1 G21 G17 G90 F600\nG0 X10 Y-5 Z5 (down)\nG64 P.5\nG1 Z0 F60\nX40\nG3 Y5 I0 J5\nG2 X10 Y-5 R8\nG91\nG1 X1\n"
    "G90.1 G18\nG2 X5 Z3 I2 K1\nG4 P2 ; wait\nG28\nM30\n"
)


def meshes() -> dict[str, list[bytes]]:
    vertices = b"".join(struct.pack("<3f3B", *p, 1, 2, 3) for p in [(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    return {
        "obj": [OBJ.encode()],
        "ply": [PLY.encode(), PLY_BINARY + vertices + struct.pack("<B3i", 3, 0, 1, 2)],
        "stl": [STL, STL_TEXT.encode()],
        "msh": [MSH],
        "h5": [(ROOT / f"tests/data/{name}.h5").read_bytes() for name in ("tetrahedron", "textured")],
        "image": [file.read_bytes() for file in sorted((ROOT / "tests/data/images").iterdir())],
        "srdf": [SRDF.encode()],
        "targets": [
            b"t, x, y, z, qw, qx, qy, qz\n0, 0, 0, 1, 1, 0, 0, 0\n2, 1, 0, 1, 0, 0, 0, -2\n",
            b"# a\n0,1,2,3\n",
        ],
        "tool_path_csv": [
            b"x; y; z; nx; ny; nz\n0;0;0;0;0;1\n1;0;0;0;0;1\n1;1;0;0;1;1\n# end\n",
            b"0 0 0 1 0 0 0\n.1,0,0,1,0,0,.1\n",
        ],
        "tool_path_nc": [GCODE.encode()],
    }


def commands() -> dict[str, list[bytes]]:
    """Messages of a browser: each message with its length in front."""
    pose = struct.pack("<i7d", 7, 0.1, 0.2, 0.3, 1, 0, 0, 0)
    messages = [
        struct.pack("<3i", 1, ord("a"), 0),
        struct.pack("<3id", 2, 1, 0, 0.7),
        struct.pack("<2i", 3, 1),
        struct.pack("<2i", 4, 1),
        *(struct.pack("<3i", 5, 1, frame) + pose for frame in range(4)),
        struct.pack("<2id", 6, 1, 0.05),
        struct.pack("<4i", 7, 3, 0, 0),
        struct.pack("<2i", 8, 2) + struct.pack("<i3d", 3, 1, 2, 3) + struct.pack("<i3d", 3, 0, 0, 1),
        struct.pack("<i", 9) + pose + struct.pack("<3d", 2, 1.4, 0),
    ]
    lines = [bytes([len(message)]) + message for message in messages]
    return {"command": [*lines, b"".join(lines)]}


def exports() -> dict[str, list[bytes]]:
    """A small scene in the formats that are written for others to read."""
    C = ry.Config()
    C.addFrame("box").setShape("box", [0.1, 0.2, 0.3]).setColor([1, 0, 0])
    C.addFrame("picture", "box").setShape("quad", [1, 1]).setTextureFile(ROOT / "tests/data/images/colors.png")
    with tempfile.TemporaryDirectory() as folder:
        C.writeGltf(Path(folder) / "a.glb")
        C.writeCollada(Path(folder) / "a.dae")
        return {kind: [(Path(folder) / f"a.{kind}").read_bytes()] for kind in ("glb", "dae")}


def scenes() -> dict[str, list[bytes]]:
    """Every model as it is, and its smaller ones in all formats that scenes are written in."""
    files = [*ROOT.glob("models/**/*.g"), *ROOT.glob("tests/data/scenes/*.g")]
    seeds: dict[str, list[bytes]] = {"g": [file.read_bytes() for file in files], "yml": [], "urdf": [], "xml": []}
    seeds["yml"] += [file.read_bytes() for file in ROOT.glob("tests/data/scenes/*.yml")]
    for file in files:
        C = ry.Config()
        try:
            C.addFile(file)
        except ry.Error:  # needs a package with meshes
            continue
        texts = {"yml": C.asYaml(), "urdf": C.writeURDF(), "xml": C.asMJCF(), "g": C.write()}
        for kind, text in texts.items():
            if len(text) < 20000:
                seeds[kind].append(text.encode())
    return seeds


def main(folder: Path) -> None:
    warnings.simplefilter("ignore", ry.KinegraphWarning)
    for kind, seeds in {**meshes(), **commands(), **exports(), **scenes()}.items():
        (folder / kind).mkdir(parents=True, exist_ok=True)
        for number, seed in enumerate(seeds):
            (folder / kind / f"seed{number}").write_bytes(seed)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
