#!/usr/bin/env python3
"""Builds the site: pages of docs/, examples with their output and scenes, and the reference of Python and C++.

    python site/build.py [OUT]      (build/site by default; open OUT/html/index.html)

The environment needs kinegraph, the packages of site/requirements.txt and Doxygen. Results of examples are kept in
OUT/cache by the content of their scripts. Warnings of Sphinx are errors.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import command_line
import cpp_reference
import example_pages
import features_page
import gallery_page
import notebook_pages
import pages
import project_pages
import python_reference
import reference_pages
import result_plots
import robot_gallery
from language.pages import writePages as writeLanguagePages
from member_texts import MemberTexts
from search_words import withSearchWords

SITE = Path(__file__).resolve().parent
REPOSITORY = SITE.parent
PICTURES = (".png", ".svg", ".mp4", ".webp")


def index(title: str, text: str, groups: list[tuple[str, list[str]]]) -> str:
    """A page that lists others; names begin with / at the top of the sources."""
    lines = [f"# {title}", "", text, ""]
    for caption, names in groups:
        lines += ["```{toctree}", ":maxdepth: 1", *([f":caption: {caption}"] if caption else []), *names, "```", ""]
    return "\n".join(lines)


def copyPages(out: Path) -> None:
    """Copies docs/ and the texts beside it, with links that hold on the site."""
    for file in sorted((REPOSITORY / "docs").rglob("*")):
        target = out / file.relative_to(REPOSITORY / "docs")
        if file.suffix in PICTURES:
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, target)
        elif file.suffix == ".md" and file.name != "README.md":  # a list for readers of the repository
            target.parent.mkdir(parents=True, exist_ok=True)
            text = file.read_text()
            for source, page in (("../CHANGELOG.md", "changes.md"), ("../SECURITY.md", "security.md")):
                text = text.replace(f"]({source}", f"]({page}").replace(f"](../{source}", f"](../{page}")
            for words, link in pages.SITE_LINKS.get(file.stem, {}).items():
                if words not in text:
                    raise SystemExit(f"site/pages.py: SITE_LINKS: {file.name} has no '{words}'")
                text = text.replace(words, link)
            text = example_pages.withExampleLinks(text, "../" * (len(target.relative_to(out).parts) - 1))
            target.write_text(withSearchWords(file.stem, text) if target.parent == out else text)
    for source, page in (("CHANGELOG.md", "changes.md"), ("SECURITY.md", "security.md")):
        text = (REPOSITORY / source).read_text().replace("](docs/", "](")
        (out / page).write_text(text)
    for page in ("index.md", "conf.py"):
        shutil.copy(SITE / page, out / page)
    (out / "install.md").write_text(withSearchWords("install", (SITE / "install.md").read_text()))
    shutil.copytree(SITE / "static", out / "_static")


def referencePages(out: Path, doxygen: Path) -> None:
    found = importlib.util.find_spec("kinegraph")
    if found is None or not found.origin:
        raise SystemExit("site: kinegraph is not installed in this environment")
    package = python_reference.loadPackage(Path(found.origin).parents[1])
    cpp = cpp_reference.CppNames(doxygen)
    exported = python_reference.exportedNames(package)
    named = {page: (title, names.split()) for page, (title, names) in pages.NAMES.items()}
    unknown = [name for _, names in named.values() for name in names if name not in exported]
    if unknown:
        raise SystemExit(f"site/pages.py: kinegraph does not export {', '.join(unknown)}")
    placed = {name for _, names in named.values() for name in names}
    named["more"] = ("More", [name for name in exported if name not in placed and not package[name].is_module])
    twins = {}  # Python's names with the C++ name of the same thing
    for name in exported:
        other = pages.CPP_NAMES.get(name, name)
        if other in cpp.kinds:
            twins[name] = other
    texts = MemberTexts(doxygen, REPOSITORY / "docs", {**pages.CPP_NAMES, **pages.CPP_ENUMS})
    cpp_only = {page: names.split() for page, names in pages.CPP_ONLY.items()}
    count = reference_pages.writePages(package, cpp, named, twins, cpp_only, texts, out / "reference")
    print(f"{len(exported)} names of Python, {count} of C++")


def indexPages(out: Path, examples: list[str], notebooks: list[str]) -> None:
    chosen = [name for _, names in pages.EXAMPLES for name in names.split()]
    numbers = {example[:2]: f"/examples/{example}" for example in examples}
    if missing := {*numbers} ^ {*chosen}:
        raise SystemExit(f"site/pages.py: EXAMPLES and the folder differ in {', '.join(sorted(missing))}")
    tutorials = [
        ("Start here", [f"/{page}" for page in pages.TUTORIALS]),
        ("Notebooks", [f"/notebook/{name}" for name in notebooks]),
        *((caption, [numbers[number] for number in names.split()]) for caption, names in pages.EXAMPLES),
    ]
    how_to = [(caption, [f"/{page}" for page in names]) for caption, names in pages.HOW_TO]
    results = [f"/results/{file.stem}" for file in sorted((out / "results").glob("*.md"))]
    explanation = [("How it works", [f"/{page}" for page in pages.EXPLANATION]), ("Results", results)]
    reference = [
        ("Names", [*pages.NAMES, "more", "/command_line"]),
        ("Tables", ["feature_table", "scene_attributes", "urdf", "mjcf", "/robot_gallery/index"]),
        ("", [f"/{page}" for page in pages.REFERENCE]),
    ]
    reference += [("Project", ["/glossary", "/citation", "/releases", "/security"])]
    for folder, title, text, groups in (
        (
            "tutorials",
            "Tutorials",
            "[Install, and a first motion](../install.md) comes first. Each example runs as it stands. The pages show what it "
            "prints, and the scene it ends with.",
            tutorials,
        ),
        ("how_to", "How-to guides", "Each page begins with the lines that most people need.", how_to),
        ("reference", "Reference", "Names, arguments, units, defaults and errors.", reference),
        ("explanation", "Explanation", "How it works, its limits, and what was measured.", explanation),
    ):
        (out / folder).mkdir(exist_ok=True)
        (out / folder / "index.md").write_text(index(title, text, groups))


def main() -> None:
    out = Path(sys.argv[1] if len(sys.argv) > 1 else REPOSITORY / "build" / "site").resolve()
    source = out / "source"
    for folder in (source, out / "html", out / "doctrees"):  # pages that are gone stay in none
        shutil.rmtree(folder, ignore_errors=True)
    source.mkdir(parents=True)
    copyPages(source)
    project_pages.writePages(REPOSITORY, source)
    for page in sorted((source / "results").glob("*.md")):
        result_plots.withPlots(page)
    doxygen = cpp_reference.runDoxygen(REPOSITORY, out / "doxygen")
    referencePages(source, doxygen)
    command_line.writePage(source / "command_line.md")
    features_page.writePage(REPOSITORY / "docs" / "features.md", source / "reference" / "feature_table.md")
    writeLanguagePages(source / "reference")
    print(f"{gallery_page.writePage(source / 'gallery', source / '_static', out / 'cache')} entries of the gallery")
    print(f"{robot_gallery.writePage(source / 'robot_gallery', out / 'cache')} robots")
    scenes = source / "_extra" / "scenes"
    scenes.mkdir(parents=True)
    examples = example_pages.writePages(REPOSITORY / "examples", source / "examples", scenes, out / "cache")
    install = source / "install.md"
    first = REPOSITORY / "examples" / f"{example_pages.FIRST}.py"
    shown = example_pages.content(first, source, scenes, out / "cache", top="")
    install.write_text(install.read_text().replace("FIRST_MOTION", "\n".join(shown)))
    for name, (show, before) in pages.SCENES.items():
        example_pages.addScene(source / f"{name}.md", show, before, scenes, out / "cache")
    notebooks = notebook_pages.writePages(
        REPOSITORY / "notebooks", source / "notebook", source / "_extra", out / "cache"
    )
    indexPages(source, examples, notebooks)
    from kinegraph import __version__

    environment = {**os.environ, "KINEGRAPH_VERSION": __version__, "KINEGRAPH_DOXYGEN": str(doxygen)}
    environment["KINEGRAPH_SITE"] = str(SITE)
    command = [sys.executable, "-m", "sphinx", "-b", "html", "-q", "-W", "--keep-going", "-d", str(out / "doctrees")]
    command += [str(source), str(out / "html")]
    subprocess.run(command, check=True, env=environment)
    print(f"{out / 'html' / 'index.html'}")


if __name__ == "__main__":
    main()
