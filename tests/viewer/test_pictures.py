"""The pictures and films of the documentation are reproducible."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from . import browser as chromium

av = pytest.importorskip("av")
DOCS = Path(__file__).parent.parent.parent / "docs"
KINDS = ("*.png", "*.mp4", "simulation_*.svg")


def frames(file: Path) -> list[np.ndarray]:
    """Returns the pixels, of a film those of its first and last picture."""
    with av.open(str(file)) as container:
        shown = [frame.to_ndarray(format="rgb24").astype(float) for frame in container.decode(video=0)]
    return [shown[0], shown[-1]]


def test_all_pictures_are_made_as_they_are_in_the_documentation(tmp_path: Path) -> None:
    if chromium.find() is None:
        pytest.skip(f"none of these is installed: {', '.join(chromium.NAMES)}")
    subprocess.run([sys.executable, str(DOCS / "make_pictures.py"), str(tmp_path)], check=True, timeout=600)
    made, there = ({file.name for kind in KINDS for file in folder.glob(kind)} for folder in (tmp_path, DOCS))
    assert made == there
    for name in sorted(made):
        if name.endswith(".svg"):
            assert (tmp_path / name).read_text().count(",") == (DOCS / name).read_text().count(",")
            continue
        for new, old in zip(frames(tmp_path / name), frames(DOCS / name), strict=True):
            assert new.shape == old.shape and new.std() > 20.0, name
            assert np.abs(new - old).mean() < 12.0, name  # of 255
