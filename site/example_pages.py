"""Writes a page per example: its text, its code in Python and C++, what it prints, and its last scene."""

import ast
import hashlib
import os
import re
import subprocess
import sys
from pathlib import Path

from shared_client import shareClient

import kinegraph

RUN = """
import runpy, sys
import kinegraph as ry

viewers = []

def keep(cls, name):
    method = getattr(cls, name)
    def shows(self, *arguments, **options):
        result = method(self, *arguments, **options)
        shown = arguments[0] if isinstance(self, ry.ToolPathPlan) else self
        if hasattr(shown, "viewer"):
            viewers[:] = [shown.viewer()]
        return result
    setattr(cls, name, shows)

views = ((ry.Config, ("view", "view_path")), (ry.KOMO, ("view", "view_play")), (ry.ToolPathPlan, ("view",)))
for cls, names in views:
    for name in names:
        keep(cls, name)
script, page = sys.argv[1:3]
sys.argv = [script]
runpy.run_path(script, run_name="__main__")
if viewers:
    viewers[0].saveHtml(page)
"""
LONGEST_OUTPUT = 4000  # characters
TIMEOUT = 300  # s
CLIENT = "viewer.js"  # the script of all scenes


def titleAndText(script: Path) -> tuple[str, str]:
    """The first sentence of the docstring, and the rest."""
    text = ast.get_docstring(ast.parse(script.read_text())) or script.stem
    first, _, rest = text.partition("\n")
    title = re.sub(r"^Part \d+: ", "", first).rstrip(".")
    title, _, second = title.partition(". ")
    return title[0].upper() + title[1:], "\n".join(([second + ".", ""] if second else []) + [rest.strip()])


def indentedAsCode(text: str) -> str:
    """Indented blocks of a docstring become formulas or code as they are."""
    return re.sub(r"(?m)(^    .+(?:\n(?:    .+|\s*))*)", lambda match: f"```text\n{match[1].rstrip()}\n```\n", text)


def runExample(script: Path, page: Path, cache: Path) -> str:
    """Runs an example and returns what it prints; the scene that it shows last is saved as `page`, if there is one.

    The results are kept in `cache` by the content of the script and of the library.
    """
    library = Path(kinegraph._core.__file__).read_bytes()
    key = hashlib.sha256(script.read_bytes() + library).hexdigest()[:16]
    kept_text, kept_page = cache / f"{key}.txt", cache / f"{key}.html"
    if not kept_text.exists():
        cache.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(
            [sys.executable, "-c", RUN, script.name, str(kept_page.resolve())],
            cwd=script.parent,
            capture_output=True,
            text=True,
            env={**os.environ, "KINEGRAPH_HEADLESS": "1"},
            timeout=TIMEOUT,
        )
        if done.returncode:
            raise SystemExit(f"{script}: exit status {done.returncode}\n{done.stderr[-2000:]}")
        kept_text.write_text(done.stdout)
    if kept_page.exists():
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(shareClient(kept_page.read_text(), page.parent / CLIENT, CLIENT))
    return kept_text.read_text()


def examplePage(script: Path, out: Path, scenes: Path, cache: Path) -> None:
    title, text = titleAndText(script)
    lines = [f"# {title}", "", indentedAsCode(text), ""]
    page = scenes / f"{script.stem}.html"
    printed = runExample(script, page, cache)
    if page.exists():
        lines += [f'<iframe class="scene" loading="lazy" src="../scenes/{page.name}" title="{title}"></iframe>', ""]
    lines += ["::::{tab-set}", ":sync-group: language", "", ":::{tab-item} Python", ":sync: python", ""]
    lines += [f"```{{literalinclude}} {os.path.relpath(script, out)}", ":language: python", "```", ":::"]
    twin = script.parent / "cpp" / f"{script.stem}.cpp"
    if twin.exists():
        lines += [":::{tab-item} C++", ":sync: cpp", "", f"```{{literalinclude}} {os.path.relpath(twin, out)}"]
        lines += [":language: cpp", "```", ":::"]
    lines += ["::::", ""]
    if printed.strip():
        lines += ["It prints:", "", "```text", printed[:LONGEST_OUTPUT].rstrip(), "```", ""]
    (out / f"{script.stem}.md").write_text("\n".join(lines))


def writePages(examples: Path, out: Path, scenes: Path, cache: Path) -> list[str]:
    """Returns the names of the pages, in their order."""
    out.mkdir(parents=True, exist_ok=True)
    scripts = sorted(examples.glob("[0-9]*.py"))
    for script in scripts:
        examplePage(script, out, scenes, cache)
    return [script.stem for script in scripts]
