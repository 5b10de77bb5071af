"""The pages of docs/ are true: their code runs, and their tables name what there is."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import kinegraph as ry

DOCS = Path(__file__).parent.parent.parent / "docs"
PAGES = sorted(page for page in DOCS.glob("*.md") if "```python" in page.read_text())


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", page.read_text(), re.DOTALL)


def words(text):
    return set(re.findall(r"`(\w+)`", text))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_code_of_a_page_runs_from_top_to_bottom(page, tmp_path):
    program = "\n".join(blocks(page, "python"))
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        cwd=tmp_path,
        env=os.environ,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert run.returncode == 0, run.stderr


def test_the_scene_of_the_page_on_scenes_loads_without_a_warning(recwarn):
    (scene,) = blocks(DOCS / "scenes.md", "g")
    C = ry.Config()
    C.addText(scene)
    assert C.getJointNames() == ["lever"]
    assert not recwarn.list


def test_the_page_on_scenes_names_all_shapes_and_joints():
    named = words((DOCS / "scenes.md").read_text())
    assert {shape.name for shape in ry.ST} - {"none"} <= named
    assert {joint.name for joint in ry.JT} - {"none"} <= named


def test_the_page_on_motions_names_all_features_and_types():
    text = (DOCS / "motion.md").read_text()
    named = words(text)
    assert {feature.name for feature in ry.FS} <= named
    assert {f"OT.{kind.name}" for kind in ry.OT} - {"OT.none"} <= set(re.findall(r"`(OT\.\w+)`", text))
