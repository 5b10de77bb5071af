"""A data set for LeRobot.

Makes data sets of LeRobot for three tasks, by plans in simulation.

    python 32_a_data_set_overnight.py [EPISODES]
"""

import sys
import tempfile
from pathlib import Path

import kinegraph as ry

TASKS = {
    "(on tray box)": "put the box on the tray",
    "(on tray can)": "put the can on the tray",
    "(on box can)": "stack the can on the box",
}


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = C.addFrame("box", "table").setRelativePosition([0.2, 0.25, 0.08])
    box.setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.004]).setJoint(ry.JT.rigid).setMass(0.1).setContact(1)
    can = C.addFrame("can", "table").setRelativePosition([0.0, 0.4, 0.09])
    can.setShape(ry.ST.ssCylinder, [0.08, 0.025, 0.004]).setJoint(ry.JT.rigid).setMass(0.1).setContact(1)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.25, 0.055])
    tray.setShape(ry.ST.ssBox, [0.16, 0.16, 0.01, 0.004]).setContact(1)
    return C


def main() -> None:
    episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    root = Path(tempfile.mkdtemp())
    vary = ry.Randomization(position=0.06, rotation=0.8)
    for goal, sentence in TASKS.items():
        made = ry.demonstrate(
            scene(),
            goal,
            episodes,
            root / sentence.replace(" ", "_"),
            cameras=["cameraTop", "cameraWrist"],
            size=128 if episodes > 3 else 64,
            randomize=vary,
            task=sentence,
        )
        print(made, "faults:", ry.checkDataset(made.folder))


main()
