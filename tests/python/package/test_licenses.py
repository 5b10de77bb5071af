"""Everything that a wheel or the C++ prefix contains has a license text there."""

import json
import re
import tomllib
from pathlib import Path

import pytest

import kinegraph as ry

ROOT = Path(__file__).parent.parent.parent.parent
TOOLS = {"scikit-build-core", "numpy", "pip"}  # not in the packages
FROM_WHEEL = {"mujoco-core"}  # the installation copies its texts


def bundled() -> set[str]:
    build = tomllib.loads((ROOT / "pyproject.toml").read_text())["build-system"]["requires"]
    names = {re.match(r"[\w-]+", requirement)[0] for requirement in build} - TOOLS - FROM_WHEEL
    page = json.loads((ROOT / "viewer" / "package.json").read_text())["dependencies"]
    return {name.removeprefix("cmeel-") for name in names} | {"three.js" if name == "three" else name for name in page}


def test_each_bundled_library_has_a_text():
    names = bundled()
    assert {"eigen", "assimp", "boost", "mediabunny", "three.js"} <= names
    for name in names:
        text = (ROOT / "licenses" / f"{name}.txt").read_text()
        assert len(text) > 500 and re.search(r"copyright|license|warranty", text, re.IGNORECASE), name


def test_each_text_is_in_the_table():
    table = (ROOT / "licenses" / "README.md").read_text().lower()
    for file in (ROOT / "licenses").glob("*.txt"):
        assert f"[{file.stem}]" in table, file.stem
    assert (
        "license-files" in (ROOT / "pyproject.toml").read_text()
        and "licenses/*" in (ROOT / "pyproject.toml").read_text()
    )


def test_an_installed_package_has_the_texts():
    folder = Path(ry.__file__).parent / "licenses"
    if not folder.exists():
        pytest.skip("the package is not installed")
    names = {file.name for file in folder.iterdir()}
    assert {"LICENSE", "mujoco.txt", "mujoco_third_party.md"} | {f"{name}.txt" for name in bundled()} <= names
