"""docs/architecture.md names files, types and functions that exist, and its table is that of tools/check_layers.py."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent.parent
PAGE = (ROOT / "docs" / "architecture.md").read_text()
SPANS = re.findall(r"`([^`\n]+)`", re.sub(r"```.*?```", "", PAGE, flags=re.DOTALL))


def sources():
    suffixes = (".h", ".cpp", ".py", ".ts", ".txt")
    folders = (ROOT / name for name in ("src", "python", "viewer/src", "tools"))
    return [path for folder in folders for path in folder.rglob("*") if path.suffix in suffixes and path.is_file()]


def test_files_that_the_page_names_exist():
    files = [s for s in SPANS if re.fullmatch(r"[\w/]+\.(h|cpp|py|json)", s)]
    assert len(files) > 30
    names = {path.name for path in sources()}
    for file in files:
        if "/" in file:
            assert (ROOT / file).exists() or (ROOT / "src" / "kinegraph" / file).exists(), file
        else:
            assert file in names or file in ("bind_x.cpp", "x_docs.h"), file


def test_types_and_functions_that_the_page_names_exist():
    words = {word for span in SPANS if re.fullmatch(r"[A-Za-z_:]+", span) for word in re.findall(r"\w+", span)}
    assert len(words) > 80
    known = set()
    for path in sources():
        known.update(re.findall(r"\w+", path.read_text()))
    folders = {path.name for path in ROOT.iterdir()}
    assert words - known - folders == set()


def test_the_layers_and_their_table_hold():
    done = subprocess.run([sys.executable, str(ROOT / "tools" / "check_layers.py")], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


MOST_PUBLIC_HEADERS = 90


def test_the_number_of_public_headers_does_not_grow():
    """A header becomes public if a public one includes it: declare its types, or hold them behind a pointer."""
    command = [sys.executable, str(ROOT / "tools" / "public_headers.py"), str(ROOT / "src")]
    headers = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    assert "kinegraph/scene/config.h" in headers
    assert len(headers) <= MOST_PUBLIC_HEADERS, f"{len(headers)} public headers"
    for internal in ("scene/tree/scene_tree.h", "kinematics/state.h", "viewer/server.h", "komo/path/path.h"):
        assert f"kinegraph/{internal}" not in headers
