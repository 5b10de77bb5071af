"""The tools that make a release (tools/release)."""

import json
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import kinegraph as ry
from kinegraph import cli

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "tools/release"))

from abi import differences, interface  # noqa: E402
from materials import LICENSES, bill_of_materials  # noqa: E402
from repository_state import commit_time, refuse_unready  # noqa: E402

PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


def git(folder, *arguments):
    subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *arguments], cwd=folder, check=True)


def test_the_bill_lists_all_that_a_wheel_contains():
    bill = json.loads(bill_of_materials(ROOT))
    listed = {component["name"]: component.get("version") for component in bill["components"]}
    pinned = dict(line.split("==") for line in PYPROJECT["build-system"]["requires"] if "==" in line)
    assert pinned.items() <= listed.items() and pinned.keys() <= LICENSES.keys()
    assert json.loads((ROOT / "viewer/package.json").read_text()).get("dependencies", {}).keys() <= listed.keys()
    assert all(component["licenses"] for component in bill["components"])
    assert bill["metadata"]["component"]["version"] == PYPROJECT["project"]["version"] == ry.__version__


def test_a_release_needs_a_clean_tagged_commit(tmp_path):
    git(tmp_path, "init", "-q")
    (tmp_path / "CITATION.cff").write_text("version: 0.3.0\n")
    (tmp_path / "CHANGELOG.md").write_text("# Changes\n\n## 0.3.0 (2027-01-01)\n")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-q", "-m", "release: set version 0.3.0")
    with pytest.raises(SystemExit, match=r"no tag v0\.3\.0"):
        refuse_unready(tmp_path, "0.3.0")
    git(tmp_path, "tag", "v0.3.0")
    refuse_unready(tmp_path, "0.3.0")
    assert commit_time(tmp_path) > 1.7e9
    with pytest.raises(SystemExit, match="CITATION.cff names another version.*CHANGELOG.md has no section"):
        refuse_unready(tmp_path, "0.4.0")
    (tmp_path / "CITATION.cff").write_text("version: 0.3.1\n")
    with pytest.raises(SystemExit, match="uncommitted changes"):
        refuse_unready(tmp_path, "0.3.0")


def test_the_smoke_test_of_a_wheel_passes(tmp_path):
    run = subprocess.run(
        [sys.executable, ROOT / "tools/release/smoke_test.py"], cwd=tmp_path, text=True, capture_output=True
    )
    assert run.returncode == 0 and run.stdout == f"kinegraph {ry.__version__} works\n", run.stderr


def test_cmake_dir_is_that_of_the_package_kinegraph_dev(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "kinegraph_dev", None)
    with pytest.raises(SystemExit) as ended:
        cli.main(["--cmake-dir"])
    assert ended.value.code == 2 and "pip install kinegraph-dev" in capsys.readouterr().err
    monkeypatch.delitem(sys.modules, "kinegraph_dev")
    package = tmp_path / "kinegraph_dev"
    folder = package / "prefix/lib/cmake/kinegraph"
    folder.mkdir(parents=True)
    (folder / "kinegraphConfig.cmake").write_text("")
    (package / "__init__.py").write_text((ROOT / "packaging/kinegraph_dev/__init__.py").read_text())
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(SystemExit) as ended:
        cli.main(["--cmake-dir"])
    assert ended.value.code == 0 and Path(capsys.readouterr().out.strip()) == folder
    monkeypatch.delitem(sys.modules, "kinegraph_dev")


def package(prefix: Path, header: str, source: str) -> Path:
    """Makes an installed C++ package with one header."""
    (prefix / "include/kinegraph").mkdir(parents=True)
    (prefix / "lib").mkdir()
    text = f"#pragma once\n\nnamespace kinegraph {{\n{header}\n}}  // namespace kinegraph\n"
    (prefix / "include/kinegraph/kinegraph.h").write_text(text)
    (prefix / "library.cpp").write_text(f"#include <kinegraph/kinegraph.h>\n{source}\n")
    command = ["c++", "-shared", "-fPIC", f"-I{prefix}/include", prefix / "library.cpp"]
    subprocess.run([*command, "-o", prefix / "lib/libkinegraph.so"], check=True)
    return prefix


@pytest.mark.skipif(shutil.which("c++") is None, reason="needs a C++ compiler")
def test_changes_that_break_compiled_programs_are_found(tmp_path):
    header = """enum class Way { straight, around };
struct Plan {
  double time;
};
template <typename T>
struct Any {
  T t;
};
Plan plan(int goal);"""
    code = "kinegraph::Plan kinegraph::plan(int) { return {}; }"
    old = interface(package(tmp_path / "old", header, code))
    assert old["layouts"] == {"Way": [4, 4], "Way::straight": [0, 0], "Way::around": [1, 0], "Plan": [8, 8]}
    more = header.replace("around }", "around, above }") + "\nint count();"
    new = interface(package(tmp_path / "more", more, code + "\nint kinegraph::count() { return 1; }"))
    assert differences(old, new) == []
    other = header.replace("straight, around", "around, straight").replace("double time;", "double time, length;")
    new = interface(package(tmp_path / "new", other.replace("(int", "(long"), code.replace("(int", "(long")))
    assert differences(old, new) == [
        "Plan: 8 bytes, aligned to 8 is 16 bytes, aligned to 8 now",
        "Way::straight: 0 is 1 now",
        "Way::around: 1 is 0 now",
        "kinegraph::plan(int) is not exported any more",
    ]
