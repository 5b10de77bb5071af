"""Robots with random flaws: each gives a robot whose numbers are sound, or a clear error.

KINEGRAPH_MUTATIONS sets the number of robots of each format (default: 300; the nightly run takes 50,000).
"""

import os
import random
import warnings
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from test_mjcf import ARM as MJCF
from test_urdf import ARM as URDF

COUNT = int(os.environ.get("KINEGRAPH_MUTATIONS", "300"))
VALUES = [
    *("", " ", "nan", "inf", "-inf", "0", "-1", "1e400", "1,2,3", "0 0 0", "1 2", "1 2 3 4 5", "a", "true", "../x.stl"),
    *("package://p/x.dae", "$(find p)/x", "${x}", "x%20y.obj", "world", "mesh", "revolute", "free", "é"),
]


def mutate(root: ET.Element, chance: random.Random) -> None:
    """Removes, doubles, moves or renames an element, or changes, removes or adds an attribute."""
    elements = list(root.iter())
    parents = {child: parent for parent in elements for child in parent}
    element, other = chance.choice(elements), chance.choice(elements)
    kind = chance.randrange(7)
    if kind == 0 and element in parents:
        parents[element].remove(element)
    elif kind == 1 and element in parents:
        parents[element].append(element)
    elif kind == 2 and element in parents and other not in list(element.iter()):
        parents[element].remove(element)
        other.append(element)
    elif kind == 3:
        element.tag = chance.choice(elements).tag
    elif element.attrib:
        name = chance.choice(list(element.attrib))
        value = chance.choice([*VALUES, *(v for e in elements for v in e.attrib.values())])
        if kind == 4:
            del element.attrib[name]
        elif kind == 5:
            element.set(chance.choice([n for e in elements for n in e.attrib]), value)
        else:
            element.set(name, value)


@pytest.mark.parametrize("name, text", [("r.urdf", URDF), ("r.xml", MJCF)])
def test_a_mutated_robot_is_a_sound_robot_or_a_clear_error(name: str, text: str, tmp_path: Path) -> None:
    file = tmp_path / name
    loaded = 0
    for seed in range(COUNT):
        chance = random.Random(seed)
        root = ET.fromstring(text)
        for _ in range(chance.choice([1, 1, 1, 2, 4])):
            mutate(root, chance)
        try:
            mutant = ET.tostring(root)
        except RecursionError:
            continue
        if len(mutant) > 100_000:
            continue
        file.write_bytes(mutant)
        C = ry.Config()
        with warnings.catch_warnings(record=True) as raised:
            warnings.simplefilter("always")
            try:
                C.addFile(file)
            except ry.Error as error:
                assert str(error), mutant
                assert len(C) == 0, mutant
                continue
        loaded += 1
        assert all(isinstance(w.message, ry.KinegraphWarning) for w in raised), mutant
        assert C.fileWarnings() == [str(w.message) for w in raised if str(w.message) in C.fileWarnings()], mutant
        assert np.isfinite(C.getFrameState()).all(), mutant
        assert np.isfinite(C.getJointState()).all(), mutant
        masses = [frame.getMass() for frame in C if frame.asDict().get("mass") is not None]
        assert np.isfinite(masses).all() and min(masses, default=1) >= 0, mutant
    assert loaded > COUNT // 3  # many flaws are mended
