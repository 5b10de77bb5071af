"""Part 2: a box, built step by step in Python, and the same box read from a file."""

import os
import sys
from pathlib import Path

import numpy as np

from robotic import ry

SCENE = str(Path(__file__).with_name("box.g"))

# Every setter returns the frame, so the description of a frame can be one sentence.
C = ry.Config()
box = (
    C.addFrame("box1")
    .setPosition([0, 0, 0.25])
    .setShape(ry.ST.ssBox, size=[0.5, 0.5, 0.5, 0.05])
    .setColor([1, 0.5, 0])
    .setMass(0.1)
    .setContact(True)
)
print("made in Python:", box.asDict())
C.view(True, "a rounded box")

# Anything can be changed afterwards.
box.setColor([0, 0.5, 1])
box.setShape(ry.ST.ssBox, size=[0.8, 0.5, 0.2, 0.02])
box.setPosition([0, 0, 0.1])
print("flat and blue: ", box.asDict())
C.view(True, "the same box, now flat and blue")

D = ry.Config()
D.addFile(SCENE)
from_file = D.getFrame("box1")
print("from box.g:    ", from_file.asDict())
assert np.allclose(from_file.getPosition(), [0, 0, 0.25])
assert np.allclose(from_file.getSize(), [0.5, 0.5, 0.5, 0.05])

if sys.stdin.isatty() and not os.environ.get("KINEGRAPH_HEADLESS"):
    print(f'\nwatching {SCENE}: try X: "t(1 1 .25)" and save; close the view to end')
    D.watchFile(SCENE)
