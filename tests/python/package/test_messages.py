"""Messages of the core use the language of the caller: C++ names in C++, Python names here."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import kinegraph as ry

SOURCE = Path(__file__).parents[3] / "src" / "kinegraph"
BINDINGS = Path(__file__).parents[3] / "python" / "bindings"
# Names of Python alone. ("KOMO" is the name of the method, in any language.)
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


def literals(folder: Path) -> set[str]:
    """All texts in the C++ files of a folder."""
    texts: set[str] = set()
    for file in [*folder.rglob("*.cpp"), *folder.rglob("*.h")]:
        lines = [re.sub(r"//.*", "", line) for line in file.read_text().splitlines() if "#include" not in line]
        texts.update(re.findall(r'"((?:[^"\\\n]|\\.)*)"', "\n".join(lines)))
    return texts


TABLE = (BINDINGS / "python_names.cpp").read_text()
TRANSLATED = dict(re.findall(r'Names\{"(\w+)", "(\w+)"\}', TABLE))
# Classes of C++ whose names are ordinary words, too: at the start of a sentence, and for the matrix of derivatives.
WORDS = r"(?:^|[.:;] )(?:Contacts|Inertia)(?= [a-z])|\b(?:the|a) Jacobian\b"


def test_every_name_of_cpp_in_a_message_is_one_in_python_too() -> None:
    declared = set()
    for header in SOURCE.rglob("*.h"):
        declared.update(re.findall(r"^(?:class|struct|enum class) (\w+)", header.read_text(), re.MULTILINE))
    assert {"Komo", "NlpSolver"} <= declared & set(TRANSLATED)
    for name, ours in TRANSLATED.items():
        assert name not in declared or hasattr(ry, ours), name
    texts = literals(SOURCE) - set(ry.get_NLP_Problem_names())
    said = {word for text in texts for word in re.findall(r"\b([A-Z]\w+)(?=::|\b)", re.sub(WORDS, "", text))}
    assert {name for name in said & declared - set(TRANSLATED) if not hasattr(ry, name)} == set()


def test_every_call_that_a_message_names_is_one_in_python_too() -> None:
    calls = {call for text in literals(SOURCE) for call in re.findall(r"\b([A-Z]\w+)(?:::|\.)([a-z]\w*)", text)}
    assert len(calls) > 70
    unknown = set()
    for owner, method in calls:
        thing = getattr(ry, TRANSLATED.get(owner, owner), None)
        if thing is not None and not hasattr(thing, TRANSLATED.get(method, method)):
            unknown.add(f"{owner}.{method}")
    assert unknown == set()


def test_results_speak_python() -> None:
    bound = "".join(file.read_text() for file in BINDINGS.rglob("*.cpp"))
    assert re.findall(r'def_r[ow]\(\s*"(?:message|text)"', bound) == []  # as it is in C++
    for body in re.findall(r'def_prop_ro\(\s*"message",(.*?)"', bound, re.DOTALL):
        assert "inPython" in body or "messageOf" in body, body


def test_results_of_solvers_and_of_inverse_kinematics_speak_python() -> None:
    text, ours = "Komo::solve with first=false, 'Komo::a'", "KOMO.solve with firstSwitch=False, 'Komo::a'"
    for result, at in ((ry.SolverReturn(), 12), (ry.solveIk(*reach()), 8)):
        state = list(result.__getstate__())
        assert isinstance(state[at], str)
        state[at] = text
        if isinstance(result, ry.IkResult):
            state[1] = int(ry.IkStatus.goal_unreachable.value)
        result = type(result).__new__(type(result))
        result.__setstate__(tuple(state))
        assert result.message == ours
        assert ours in repr(result) or isinstance(result, ry.SolverReturn)  # which has numbers only
    kind = type(ry.solveIk(reach()[0], {"hand": [[0.1, 0.2, 0.3], [0.1, 0.2, 0.3]]}))
    results = kind.__new__(kind)
    results.__setstate__([tuple(state), tuple(state)])
    assert results.message == [ours, ours]


def test_an_explanation_keeps_the_names_of_frames() -> None:
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("Komo::a", "base").setJoint(ry.JT.transX)
    komo = ry.KOMO(C, 1, 1, 0, False)
    for x in (0.0, 1.0):
        komo.addObjective([], ry.FS.position, ["Komo::a"], ry.OT.eq, target=[x, 0.0, 0.0])
    result = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert not result.feasible
    assert "Komo::a" in result.explain() and "Komo.a" not in result.explain()
    assert result.explain() == komo.explain() == komo.nlp().explain(result.x)


def reach() -> tuple[ry.Config, dict[str, list[float]]]:
    """A point that a hand on one slide cannot get to."""
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("hand", "base").setJoint(ry.JT.transX)
    return C, {"hand": [0.1, 0.2, 0.3]}


def unconstrained(method: ry.OptMethod) -> ry.NLP_Solver:
    """A problem with a constraint, for a method that takes none."""
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("a", "base").setJoint(ry.JT.hingeX)
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.eq, target=[1.0])
    return ry.NLP_Solver(komo.nlp(), verbose=0).setOptions(method=method)


def test_messages_use_python_names() -> None:
    with pytest.raises(ry.Error, match=r"^OptMethod\.newton does not support constraints"):
        unconstrained(ry.OptMethod.newton).solve()
    with pytest.raises(ry.Error, match="^NLP_Solver: there is no problem to solve"):
        ry.NLP_Solver().solve()
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("a", "base").setJoint(ry.JT.hingeX)
    with pytest.raises(ry.ArgumentError, match=r"^Config\.equationOfMotion: got 2 numbers"):
        C.equationOfMotion([0.0, 0.0])
    with pytest.raises(ry.Error, match=r"^KOMO_ManipulationHelper\.grasp_box: there is no problem yet"):
        ry.KOMO_ManipulationHelper().grasp_box(1.0, "a", "base", "base", "x")
    with pytest.raises(ry.FileError, match=r"^SimulationRecording\.load: 'nowhere' cannot be read"):
        ry.SimulationRecording.load("nowhere")
    with pytest.raises(ry.ArgumentError, match="^viewer: host is 'nowhere'; expected an IP address"):
        C.viewer().serveAt("nowhere")


def test_names_of_the_user_stay_as_they_are() -> None:
    C = ry.Config()
    C.addFrame("Komo::a")
    with pytest.raises(ry.FrameNotFound, match="'Komo::b'.*Komo::a"):
        C.getFrame("Komo::b")
