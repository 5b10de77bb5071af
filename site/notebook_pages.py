"""Runs the notebooks and writes a page for each, with the notebook and its outputs to download."""

import hashlib
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient

TIMEOUT = 300  # s per cell
LARGEST = 1_000_000  # bytes of a notebook with its outputs


def executed(file: Path, cache: Path) -> Any:
    """The notebook with its outputs, from the cache if it has not changed."""
    kept = cache / "notebooks" / f"{file.stem}_{hashlib.sha256(file.read_bytes()).hexdigest()[:16]}.ipynb"
    if not kept.exists():
        notebook = nbformat.read(file, as_version=4)
        NotebookClient(notebook, timeout=TIMEOUT, kernel_name="python3").execute()
        text = nbformat.writes(notebook)
        if len(text) > LARGEST:
            raise SystemExit(f"{file}: {len(text)} bytes with its outputs; at most {LARGEST}")
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(text)
    return nbformat.read(kept, as_version=4)


def pageText(notebook: Any, name: str) -> str:
    lines: list[str] = []
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            lines += [cell.source, ""]
            if len(lines) == 2:
                lines += [f'<a href="../notebooks/{name}.ipynb" download>This page as a notebook.</a>', ""]
            continue
        lines += ["```python", cell.source, "```", ""]
        printed = "".join(out.text for out in cell.outputs if out.output_type == "stream" and out.name == "stdout")
        if printed.strip():
            lines += ["```text", printed.rstrip(), "```", ""]
    return "\n".join(lines)


def writePages(notebooks: Path, out: Path, extra: Path, cache: Path) -> list[str]:
    """Returns the names of the pages, in their order."""
    for folder in (out, extra / "notebooks"):
        folder.mkdir(parents=True, exist_ok=True)
    files = sorted(notebooks.glob("*.ipynb"))
    for file in files:
        notebook = executed(file, cache)
        (extra / "notebooks" / file.name).write_text(nbformat.writes(notebook))
        (out / f"{file.stem}.md").write_text(pageText(notebook, file.stem))
    return [file.stem for file in files]
