"""Processor time and size of demonstrations: python benchmarks/demonstrations.py [EPISODES]."""

import sys
import tempfile
import time
from pathlib import Path

import kinegraph as ry


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = C.addFrame("box", "table").setRelativePosition([0.2, 0.25, 0.09])
    box.setShape(ry.ST.ssBox, [0.04, 0.05, 0.08, 0.004]).setContact(1).setJoint(ry.JT.rigid).setMass(0.1)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.25, 0.055])
    tray.setShape(ry.ST.ssBox, [0.14, 0.14, 0.01, 0.004]).setContact(1)
    return C


def main() -> None:
    episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    print("cameras  pixels  frames  CPU s per episode  kB per episode  attempts")
    for cameras, size in (([], 128), (["cameraTop", "cameraWrist"], 128), (["cameraTop", "cameraWrist"], 256)):
        folder = Path(tempfile.mkdtemp())
        begin = time.process_time()
        made = ry.demonstrate(
            scene(), "(on tray box)", episodes, folder, cameras=cameras, size=size, workers=1, progress=False
        )
        spent = (time.process_time() - begin) / episodes
        size_kb = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) / 1e3 / episodes
        frames = made.frames / episodes
        print(f"{len(cameras):7d}  {size:6d}  {frames:6.0f}  {spent:17.2f}  {size_kb:14.0f}  {made.attempts:8d}")
        assert ry.checkDataset(folder) == []


main()
