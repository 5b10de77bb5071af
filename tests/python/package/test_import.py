"""Modules loaded by the import, and modules loaded on first use."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import kinegraph
import robotic
from kinegraph.packages import needed


def loaded(code: str) -> set[str]:
    """The modules of the package that a fresh Python has after the code."""
    tell = "import sys; print(*(m for m in sys.modules if m.partition('.')[0] in ('kinegraph', 'robotic')))"
    run = subprocess.run([sys.executable, "-c", f"{code}\n{tell}"], check=True, capture_output=True, text=True)
    return set(run.stdout.split())


@pytest.mark.parametrize("package", ["kinegraph", "robotic"])
def test_an_import_loads_no_room_that_is_not_used(package: str) -> None:
    modules = loaded(f"import {package}")
    assert not {f"kinegraph.{module}" for module in kinegraph._LAZY} & modules
    assert "kinegraph.reachable" in loaded(f"import {package}; {package}.reachability")


@pytest.mark.parametrize("package", [kinegraph, robotic])
def test_all_names_exist_and_are_listed_by_dir(package: object) -> None:
    for name in package.__all__:
        assert getattr(package, name) is getattr(package, name), name
    assert set(package.__all__) <= set(dir(package))


def test_what_type_checkers_see_is_what_is_loaded_later() -> None:
    tree = ast.parse(Path(kinegraph.__file__).read_text())
    [block] = [
        node
        for node in tree.body
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "_TYPE_CHECKING"
    ]
    seen = {
        (statement.module, alias.asname or alias.name)
        for statement in block.body
        if isinstance(statement, ast.ImportFrom) and statement.module
        for alias in statement.names
    }
    assert seen == {(module, name) for module, names in kinegraph._LAZY.items() for name in names}


def test_a_function_is_not_hidden_by_a_module_of_its_name() -> None:
    for name in kinegraph._MODULE_OF:
        assert not (Path(kinegraph.__file__).parent / f"{name}.py").exists(), name


def test_names_of_robotic_are_its_own_whatever_was_used_before() -> None:
    code = (
        "import kinegraph\n"
        "for name in kinegraph.__all__: getattr(kinegraph, name)\n"
        "import robotic\n"
        "for name, module in robotic._MODULE_OF.items():\n"
        "    assert getattr(robotic, name) is getattr(__import__('importlib').import_module(module), name), name\n"
        "assert issubclass(robotic.LGP_Tool, kinegraph.LGP_Tool) and robotic.LGP_Tool is not kinegraph.LGP_Tool\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_package_that_cannot_be_loaded_is_not_called_missing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "half_installed.py").write_text("raise ImportError('libneeded.so: cannot open shared object file')")
    (tmp_path / "needs_another.py").write_text("import no_such_package")
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(ImportError, match=r"libneeded\.so"):
        needed("half_installed")
    with pytest.raises(ModuleNotFoundError, match="no_such_package"):
        needed("needs_another")
    with pytest.raises(kinegraph.NotFound, match=r"no_such_package is not installed: pip install 'kinegraph\[film\]'"):
        needed("no_such_package.part", "film")
