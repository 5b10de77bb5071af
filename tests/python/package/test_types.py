"""The type stubs: complete enough for scripts that are checked strictly."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import kinegraph
import typed_script

ROOT = Path(__file__).parent.parent.parent.parent
STUB = Path(kinegraph.__file__).parent / "_core.pyi"


def mypy(*files: Path, folder: Path) -> list[str]:
    """Returns the messages of `mypy --strict` for files that use the installed package."""
    pytest.importorskip("mypy", reason="needs mypy")
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", f"--cache-dir={folder}"]
    package = Path(kinegraph.__file__).parent.parent
    installed = package.name == "site-packages"  # mypy searches there by itself
    environment = dict(os.environ) if installed else os.environ | {"MYPYPATH": str(package)}
    done = subprocess.run([*command, *map(str, files)], capture_output=True, text=True, cwd=folder, env=environment)
    assert re.search(r"\d+ source files?", done.stdout), done.stdout + done.stderr  # it got to the end
    return [line for line in done.stdout.splitlines() if any(file.name in line.split(":")[0] for file in files)]


@pytest.mark.skipif(not STUB.exists(), reason="the stub is generated when the wheel is built")
def test_a_typed_script_passes_the_strict_checker(tmp_path):
    assert mypy(Path(typed_script.__file__), folder=tmp_path) == []


@pytest.mark.skipif(not STUB.exists(), reason="the stub is generated when the wheel is built")
def test_the_examples_pass_the_strict_checker(tmp_path):
    assert mypy(*sorted((ROOT / "examples").glob("*.py")), folder=tmp_path) == []


@pytest.mark.skipif(not STUB.exists(), reason="the stub is generated when the wheel is built")
def test_a_mistake_in_types_is_found(tmp_path):
    script = tmp_path / "script.py"
    script.write_text("import kinegraph as ry\n\nry.Config().getFrame(3).setPosition('x')\nry.Config().nothing()\n")
    said = "\n".join(mypy(script, folder=tmp_path))
    assert "arg-type" in said and 'no attribute "nothing"' in said


@pytest.mark.skipif(not STUB.exists(), reason="the stub is generated when the wheel is built")
def test_what_a_call_returns_has_a_type():
    """`Any`, `object` and containers of nobody knows what are no types."""

    def is_vague(kind: str) -> bool:
        return kind in ("object", "dict", "list", "tuple") or "Any" in kind.replace("dict[str, Any]", "")

    returned = re.findall(r"def (\w+)\(.*\) -> (.+):(?: \.\.\.)?$", STUB.read_text(), re.MULTILINE)
    assert len(returned) > 400
    assert [said for said in returned if not said[0].startswith("__") and is_vague(said[1])] == []


def test_the_typed_script_runs(capsys):
    typed_script.main()
    assert "l_panda" in capsys.readouterr().out


def test_both_packages_say_that_they_are_typed():
    import robotic

    for package in (kinegraph, robotic):
        assert (Path(package.__file__).parent / "py.typed").exists()
