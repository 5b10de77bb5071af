"""The package as a whole: names, documentation, parameters and imports."""

import inspect
import os
import pickle
import re
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

import kinegraph as ry
import robotic

CLASSES = [value for value in vars(ry).values() if inspect.isclass(value)]
NAMES = [
    (owner, name)
    for owner in CLASSES
    for name in vars(owner)
    if not name.startswith("_") and owner.__module__ == "kinegraph._core" and not hasattr(owner, "__members__")
]


def test_both_packages_are_one():
    assert robotic.KOMO is ry.KOMO and robotic.ry.Config is robotic.Config and issubclass(robotic.Config, ry.Config)
    assert re.fullmatch(r"\d+\.\d+\.\d+", ry.__version__) and robotic.__version__ == ry.__version__ == ry.version()


@pytest.mark.parametrize("owner, name", NAMES, ids=[f"{owner.__name__}.{name}" for owner, name in NAMES])
def test_every_public_method_is_described_and_its_arguments_are_named(owner, name):
    member = vars(owner)[name]
    text = inspect.getdoc(member) or ""
    if not callable(member):  # a property or an attribute
        assert text
        return
    signatures = [line for line in text.splitlines() if line.startswith(f"{name}(")]
    assert signatures, text
    assert all("arg0" not in line and "arg1" not in line for line in signatures), signatures
    assert len([line for line in text.splitlines() if line.strip() and line not in signatures]) > 0, "no description"


def test_every_public_function_and_class_is_described():
    for name in ry.__all__:
        value = getattr(ry, name)
        if callable(value):
            assert inspect.getdoc(value), name


def test_the_enums_are_those_of_the_scripts():
    assert {"f", "sos", "eq", "ineq"} <= set(ry.OT.__members__)
    assert {"box", "ssBox", "sphere", "capsule", "mesh", "marker", "ssCvx"} <= set(ry.ST.__members__)
    assert {"hingeX", "hingeY", "hingeZ", "transX", "quatBall", "free", "rigid"} <= set(ry.JT.__members__)


def test_parameters_are_kept_printed_and_cleared(capsys, tmp_path):
    file = tmp_path / "parameters.g"
    file.write_text("KOMO/verbose: 2\n")
    ry.params_clear()
    ry.params_add({"opt/damping": 0.1, "flag": True})
    ry.params_file(str(file))
    assert ry.params_get() == {"opt/damping": 0.1, "flag": True, "KOMO/verbose": 2.0}
    ry.params_print()
    assert capsys.readouterr().out.splitlines() == ["KOMO/verbose: 2.0", "flag", "opt/damping: 0.1"]
    ry.params_clear()
    assert ry.params_get() == {}


def test_a_parameter_of_the_solver_changes_its_default():
    try:
        ry.params_add({"opt/stopEvals": 7})
        assert ry.NLP_SolverOptions().dict()["stopEvals"] == 7
        assert ry.NLP_Solver().getOptions().stopEvals == 7
    finally:
        ry.params_clear()
    assert ry.NLP_SolverOptions().dict()["stopEvals"] != 7


def test_a_misspelled_parameter_is_a_warning_and_one_of_the_script_is_none():
    try:
        with pytest.warns(
            ry.KinegraphWarning, match="no call reads a parameter 'botsim/hyperspeed'.*botsim/hyperSpeed"
        ):
            ry.params_add({"botsim/hyperspeed": 2.0})
        with pytest.warns(ry.KinegraphWarning, match="'botsim/verbose'$"):
            ry.params_add({"botsim/verbose": 1})
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            ry.params_add({"botsim/tau": 0.01, "noInteractivity": True, "experiment/seeds": 3, "KOMO/verbose": 2})
    finally:
        ry.params_clear()


def test_a_misspelt_parameter_of_the_solver_is_an_error_that_names_the_nearest():
    with pytest.raises(ry.Error, match="dampng.*damping"):
        ry.params_add({"opt/dampng": 1.0})


def test_the_same_seed_gives_the_same_random_joint_state(panda):
    states = []
    for seed in (1, 1, 2):
        ry.rnd_seed(seed)
        panda.setRandom()
        states.append(panda.getJointState().tolist())
    assert states[0] == states[1] != states[2]


@pytest.mark.parametrize(
    "path", ["panda/panda.g", "../rai-robotModels/panda/panda.g", "rai-robotModels/panda/panda.g", "/panda/panda.g"]
)
def test_the_path_of_a_model_is_found_in_every_spelling(path):
    assert os.path.isfile(ry.raiPath(path))


def test_importing_loads_no_library_of_the_display_and_no_other_package_than_numpy():
    code = """
import sys, kinegraph
maps = open('/proc/self/maps').read()
print([name for name in ('libGL', 'libX11', 'liblapack.so', 'libEGL') if name in maps])
print(sorted({name.split('.')[0] for name in sys.modules} & {'scipy', 'matplotlib', 'coal', 'pinocchio', 'cmeel'}))
"""
    program = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert program.stdout.splitlines() == ["[]", "[]"]


def test_mesh_files_and_camera_images_load_their_libraries_when_they_are_first_needed(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    code = """
import sys, kinegraph
loaded = lambda: [name for name in ('libassimp', 'libmujoco', 'libcoal') if name in open('/proc/self/maps').read()]
C = kinegraph.Config()
print(loaded())
C.addFrame('a').setMeshFile(sys.argv[1])
print(loaded(), len(C.getFrame('a').getMeshTriangles()))
"""
    run = [sys.executable, "-c", code, str(tmp_path / "a.obj")]
    program = subprocess.run(run, capture_output=True, text=True, check=True)
    assert program.stdout.splitlines() == ["[]", "['libassimp'] 1"]


def test_a_library_that_is_missing_is_named(tmp_path):
    """One that is no library stands in for it."""
    (tmp_path / "libassimp.so.6").write_text("no library")
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    code = "import sys, kinegraph; kinegraph.Config().addFrame('a').setMeshFile(sys.argv[1])"
    environment = {**os.environ, "LD_LIBRARY_PATH": f"{tmp_path}:{os.environ.get('LD_LIBRARY_PATH', '')}"}
    run = [sys.executable, "-c", code, str(tmp_path / "a.obj")]
    program = subprocess.run(run, capture_output=True, text=True, env=environment)
    assert program.returncode == 1
    assert (
        "FileError: " in program.stderr
        and "a mesh file needs the library libassimp.so.6, which cannot be loaded" in program.stderr
    )


def test_a_misspelt_symbol_names_those_that_are_near():
    with pytest.raises(AttributeError, match="FS has no 'postion'; similar names: position"):
        ry.FS.postion  # noqa: B018
    with pytest.raises(AttributeError, match="OT has no 'eqq'; similar names: eq"):
        ry.OT.eqq  # noqa: B018
    with pytest.raises(AttributeError, match="JT has no 'prismatic'; here it is transX, transY or transZ"):
        ry.JT.prismatic  # noqa: B018
    with pytest.raises(AttributeError, match="ST has no 'cube'; here it is box"):
        ry.ST.cube  # noqa: B018
    assert not hasattr(ry.FS, "__wrapped__")
    assert ry.FS.position == ry.FS["position"] and ry.FS.position in list(ry.FS)
    assert pickle.loads(pickle.dumps(ry.FS.position)) is ry.FS.position


def test_meshes_of_the_reference_are_those_of_the_extra(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("KINEGRAPH_PACKAGE_PATH", str(tmp_path))
    with pytest.raises(ry.FileError, match=r"head_link.h5' is not part .* pip install 'kinegraph\[meshes\]'"):
        ry.raiPath("g1/meshes/head_link.h5")
    mesh = tmp_path / "example-robot-data/robots/g1_description/meshes/head_link.STL"
    mesh.parent.mkdir(parents=True)
    mesh.write_bytes(b"")
    assert ry.raiPath("g1/meshes/head_link.h5") == str(mesh)
    with pytest.raises(ry.FileError, match="there is no model"):
        ry.raiPath("g1/meshes/tail_link.h5")
