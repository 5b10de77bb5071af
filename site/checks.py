"""Checks the built site: links and anchors within it, sizes, and a sentence for every public name.

python site/checks.py [HTML]      (build/site/html by default)
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LARGEST_SITE = 60_000_000  # bytes
LARGEST_PAGE = 3_000_000  # bytes of a page with all scenes that it embeds, and their script


class Page(HTMLParser):
    """Addresses that a page refers to, the anchors it has, and the names it describes."""

    def __init__(self, file: Path):
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.frames: list[str] = []
        self.feed(file.read_text(errors="replace"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = {key: value or "" for key, value in attributes}
        for key in ("id", "name"):
            if key in values and (key == "id" or tag == "a"):
                self.anchors.add(values[key])
        for key in ("href", "src"):
            if key in values:
                self.links.append(values[key])
        if tag == "iframe":
            self.frames.append(values.get("src", ""))


def target(html: Path, file: Path, link: str) -> tuple[Path, str] | None:
    """The file and anchor of a link within the site; None for other addresses."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc or link.startswith("data:"):
        return None
    place = file if not parts.path else (file.parent / unquote(parts.path))
    if parts.path.startswith("/"):
        place = html / parts.path.lstrip("/")
    return (place / "index.html" if place.is_dir() else place).resolve(), unquote(parts.fragment)


def brokenLinks(html: Path) -> list[str]:
    """Links whose file or anchor does not exist."""
    files = [file for file in sorted(html.rglob("*.html")) if not {"scenes", "_static"} & {*file.parts}]
    pages = {file.resolve(): Page(file) for file in files}
    found = []
    for file, page in pages.items():
        for link in page.links:
            goal = target(html, file, link)
            if goal is None:
                continue
            place, anchor = goal
            if not place.exists():
                found.append(f"{file.relative_to(html.resolve())}: {link} does not exist")
            elif anchor and place in pages and anchor not in pages[place].anchors:
                found.append(f"{file.relative_to(html.resolve())}: {link} has no such anchor")
    return found


def largePages(html: Path) -> list[str]:
    """Pages that are too large with their scenes, and the site if it is."""
    found = []
    for file in sorted(html.rglob("*.html")):
        if "scenes" in file.parts:
            continue
        scenes = {(file.parent / src).resolve() for src in Page(file).frames if not urlsplit(src).scheme}
        scripts = {scene.parent / "viewer.js" for scene in scenes if (scene.parent / "viewer.js").exists()}
        size = sum(part.stat().st_size for part in [file, *scenes, *scripts])
        if size > LARGEST_PAGE:
            found.append(f"{file.relative_to(html)}: {size} bytes with its scenes; at most {LARGEST_PAGE}")
    total = sum(file.stat().st_size for file in html.rglob("*") if file.is_file())
    if total > LARGEST_SITE:
        found.append(f"the site has {total} bytes; at most {LARGEST_SITE}")
    return found


def undescribedNames(html: Path) -> list[str]:
    """Names of the reference without a sentence behind their signature."""
    found = []
    for file in sorted((html / "reference").glob("*.html")):
        text = file.read_text()
        entry = r'<dl class="(?:py|cpp) (\w+)">\s*<dt class="sig[^"]*" id="([^"]+)">.*?</dt>\s*<dd>(.*?)</dd>'
        for kind, name, body in re.findall(entry, text, re.DOTALL):
            if kind != "enumerator" and not re.search(r"\w", re.sub(r"<[^>]+>", "", body)):
                found.append(f"{file.relative_to(html)}: {name} has no description")
    return found


def main() -> None:
    html = Path(sys.argv[1] if len(sys.argv) > 1 else "build/site/html").resolve()
    found = [*brokenLinks(html), *largePages(html), *undescribedNames(html)]
    print(
        "\n".join(found) if found else "site: all links lead somewhere, no page is too large, every name is described"
    )
    if found:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
