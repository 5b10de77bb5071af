"""Messages of the core speak the language of who called: C++ names in C++, Python names here."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import kinegraph as ry

SOURCE = Path(__file__).parents[2] / "src" / "kinegraph"
# What only Python calls so. ("KOMO" is the name of the method, in any language.)
PYTHON_NAMES = r"\bry\.|\bNLP_|\bOptMethod\.[a-zA-Z]|\b(?:OT|FS|ST|JT|SY)\.[a-z]|=(?:True|False|None)\b|\bwith (?:True|False)\b|\binfo_|\beval_scalar"


def test_the_core_says_nothing_in_python() -> None:
    found = []
    for file in sorted([*SOURCE.rglob("*.cpp"), *SOURCE.rglob("*.h")]):
        for number, line in enumerate(file.read_text().splitlines(), 1):
            code = re.sub(r"//.*", "", line)
            for literal in re.findall(r'"((?:[^"\\]|\\.)*)"', code):
                if re.search(PYTHON_NAMES, literal):
                    found.append(f"{file.relative_to(SOURCE)}:{number}: {literal}")
    assert not found, "\n".join(found)


def unconstrained(method: ry.OptMethod) -> ry.NLP_Solver:
    """A problem with a constraint, for a method that takes none."""
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("a", "base").setJoint(ry.JT.hingeX)
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.eq, target=[1.0])
    return ry.NLP_Solver(komo.nlp(), verbose=0).setOptions(method=method)


def test_python_is_told_its_own_names() -> None:
    with pytest.raises(ry.Error, match=r"^OptMethod\.newton takes no constraints"):
        unconstrained(ry.OptMethod.newton).solve()
    with pytest.raises(ry.Error, match="^NLP_Solver: there is no problem to solve"):
        ry.NLP_Solver().solve()
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("a", "base").setJoint(ry.JT.hingeX)
    with pytest.raises(ry.ArgumentError, match=r"^Config\.equationOfMotion: got 2 numbers"):
        C.equationOfMotion([0.0, 0.0])


def test_names_of_the_user_stay_as_they_are() -> None:
    C = ry.Config()
    C.addFrame("Komo::a")
    with pytest.raises(ry.FrameNotFound, match="'Komo::b'.*Komo::a"):
        C.getFrame("Komo::b")
