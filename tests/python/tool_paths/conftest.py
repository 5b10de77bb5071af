import pytest

import kinegraph as ry


@pytest.fixture
def scene():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    hand = "l_gripper"
    C.addFrame("pen", hand).setShape(ry.ST.capsule, [0.06, 0.008]).setRelativePosition([0, 0, -0.032]).setContact(-2)
    C.addFrame("tool", hand).setRelativePosition([0, 0, -0.08])
    return C
