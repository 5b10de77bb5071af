"""A Panda in simulation: what it reaches for, and how it moves there."""

import kinegraph as ry


def panda():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def add_box(C, position, mass=0.1, name="box"):
    return C.addFrame(name).setPosition(position).setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.005]).setMass(mass)
