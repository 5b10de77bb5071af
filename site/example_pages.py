"""Writes a page per example: its text, its code in Python and C++, what it prints, and its last scene."""

import ast
import functools
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

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
script, page, client = sys.argv[1:4]
sys.argv = [script]
runpy.run_path(script, run_name="__main__")
if viewers:
    viewers[0].saveHtml(page, client=client)
"""
SETTINGS = {"22_a_data_set": {"TARGETS": "20000"}}  # environment variables that shorten an example
LONGEST_OUTPUT = 4000  # characters
TIMEOUT = 300  # s
CLIENT = "viewer.js"  # the script of all scenes
FIRST = "00_first_motion"  # it is on the page of the installation


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


@functools.cache
def digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()[:16]


def runExample(script: Path, page: Path, cache: Path) -> str:
    """Runs an example and returns what it prints; the scene that it shows last is saved as `page`, if there is one.

    The results are kept in `cache` by the content of the script and of the library, whose pages share one script.
    """
    kept = cache / digest(Path(kinegraph._core.__file__))
    settings = SETTINGS.get(script.stem, {})
    key = "_".join([digest(script), *settings.values()])
    kept_text, kept_page = kept / f"{key}.txt", kept / f"{key}.html"
    if not kept_text.exists():
        kept.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(
            [sys.executable, "-c", RUN, script.name, str(kept_page.resolve()), str((kept / CLIENT).resolve())],
            cwd=script.parent,
            capture_output=True,
            text=True,
            env={**os.environ, "KINEGRAPH_HEADLESS": "1", **settings},
            timeout=TIMEOUT,
        )
        if done.returncode:
            raise SystemExit(f"{script}: exit status {done.returncode}\n{done.stderr[-2000:]}")
        kept_text.write_text(done.stdout)
    if kept_page.exists():
        page.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(kept_page, page)
        shutil.copyfile(kept / CLIENT, page.parent / CLIENT)
    return kept_text.read_text()


def frame(address: str, title: str) -> str:
    return f'<iframe class="scene" loading="lazy" src="{address}" title="{title}"></iframe>'


def addScene(page: Path, show: str, before: str, scenes: Path, cache: Path) -> None:
    """Runs the code of a page at the top of the site, and adds the scene that `show` shows then.

    Args:
        show: Code after that of the page.
        before: The beginning of the line before which the scene is to be.
    """
    text = page.read_text()
    blocks = re.findall(r"(?ms)^```python\n(.*?)^```", text)
    scene = scenes / f"{page.stem}.html"
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / f"{page.stem}.py"
        script.write_text("\n".join([*blocks, show]))
        runExample(script, scene, cache)
    head, line, rest = text.partition(f"\n{before}")
    assert line and scene.exists(), page
    page.write_text(f"{head}\n{frame(f'scenes/{scene.name}', page.stem)}\n{line}{rest}")


def content(script: Path, out: Path, scenes: Path, cache: Path, top: str = "../") -> list[str]:
    """The scene, the code in both languages, and what it prints, for a page in the folder `out`.

    `top` is the top of the site, relative to that folder.
    """
    page = scenes / f"{script.stem}.html"
    printed = runExample(script, page, cache)
    lines: list[str] = []
    if page.exists():
        source = f"{top}scenes/{page.name}"
        lines += [
            f'<iframe class="scene" loading="lazy" src="{source}" title="{titleAndText(script)[0]}"></iframe>',
            "",
        ]
    lines += ["::::{tab-set}", ":sync-group: language", "", ":::{tab-item} Python", ":sync: python", ""]
    lines += [f"```{{literalinclude}} {os.path.relpath(script, out)}", ":language: python", "```", ":::"]
    twin = script.parent / "cpp" / f"{script.stem}.cpp"
    if twin.exists():
        lines += [":::{tab-item} C++", ":sync: cpp", "", f"```{{literalinclude}} {os.path.relpath(twin, out)}"]
        lines += [":language: cpp", "```", ":::"]
    lines += ["::::", ""]
    if printed.strip():
        settings = ", ".join(f"`{name}={value}`" for name, value in SETTINGS.get(script.stem, {}).items())
        lines += [
            f"It prints, with {settings}:" if settings else "It prints:",
            "",
            "```text",
            printed[:LONGEST_OUTPUT].rstrip(),
            "```",
            "",
        ]
    return lines


def examplePage(script: Path, out: Path, scenes: Path, cache: Path) -> None:
    title, text = titleAndText(script)
    lines = [f"# {title}", "", indentedAsCode(text), "", *content(script, out, scenes, cache)]
    (out / f"{script.stem}.md").write_text("\n".join(lines))


def withExampleLinks(text: str, top: str) -> str:
    """Links the names of examples to their pages; `top` is the top of the site, relative to the page."""
    link = rf"[\g<0>]({top}examples/\g<1>.md)"
    text = re.sub(r"(?<!\[)`examples/(?:cpp/)?(\d\d_\w+)\.(?:py|cpp)`", link, text)
    return text.replace(f"examples/{FIRST}.md", "install.md")


def programPage(program: Path, out: Path) -> None:
    """Writes the page of a program that exists in C++ only: its first comment and its code."""
    comment = re.match(r"(?:// .*\n)+", program.read_text())
    text = re.sub(r"(?m)^// ", "", comment[0] if comment else program.stem).replace("\n", " ")
    title, _, rest = text.strip().partition(". ")
    lines = [f"# {title.rstrip('.')}", "", rest, "", f"```{{literalinclude}} {os.path.relpath(program, out)}"]
    lines += [":language: cpp", "```", "", "[Kinegraph from C++](../cpp.md#a-project) has the `CMakeLists.txt`.", ""]
    (out / f"{program.stem}.md").write_text("\n".join(lines))


def writePages(examples: Path, out: Path, scenes: Path, cache: Path) -> list[str]:
    """Returns the names of the pages, in their order."""
    out.mkdir(parents=True, exist_ok=True)
    scripts = [script for script in sorted(examples.glob("[0-9]*.py")) if script.stem != FIRST]
    for script in scripts:
        examplePage(script, out, scenes, cache)
    programs = [file for file in sorted((examples / "cpp").glob("[0-9]*.cpp")) if not twinOf(file).exists()]
    for program in programs:
        programPage(program, out)
    return [file.stem for file in [*scripts, *programs]]


def twinOf(program: Path) -> Path:
    """The same example in Python."""
    return program.parents[1] / f"{program.stem}.py"
