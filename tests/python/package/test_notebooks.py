"""The notebooks run, are small, and begin with a cell that installs the package."""

import os
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

NOTEBOOKS = sorted((Path(__file__).parents[3] / "notebooks").glob("*.ipynb"))


def test_there_are_six_notebooks_without_outputs():
    assert len(NOTEBOOKS) == 6
    for file in NOTEBOOKS:
        notebook = nbformat.read(file, as_version=4)
        nbformat.validate(notebook)
        code = [cell for cell in notebook.cells if cell.cell_type == "code"]
        assert "%pip install" in code[0].source and "KINEGRAPH_WHEEL" in code[0].source
        assert not any(cell.outputs for cell in code)


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
@pytest.mark.filterwarnings("default")
def test_a_notebook_runs_and_stays_small(file, tmp_path):
    notebook = nbformat.read(file, as_version=4)
    assert os.environ.get("KINEGRAPH_HEADLESS"), "the viewer would open a browser"
    nbclient.NotebookClient(
        notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    ).execute()
    texts = [out.text for cell in notebook.cells for out in cell.get("outputs", []) if out.output_type == "stream"]
    assert len(texts) >= 3
    assert len(nbformat.writes(notebook)) < 1_000_000
