#!/usr/bin/env python3
"""Checks how plainly the project is written: clause words, odd sentence openings, long sentences, private terms.

    python tools/check_prose.py                 checks every room, page and package of the tree
    python tools/check_prose.py PATH ...        checks these files and folders, as one text each
    python tools/check_prose.py --worst 30 ...  also lists the 30 sentences with most clause words

The text of a file consists of its comments, docstrings, documentation strings or Markdown, without code, tables,
headings and indented blocks. A text passes if it meets four conditions:

- at most 0.6 clause words (`what`, `where`, `so that` ...) in 100 words,
- at most 1.2 % of sentences with an odd opening (`What`, `Where`, `That` ...),
- no sentence of more than 35 words,
- no private term.

Texts below 400 words are counted together. CONTRIBUTING.md has the words of the project. Rewrite a sentence rather than
work around the count.
"""

import argparse
import re
import sys
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

from source_text import ROOT, SUFFIXES, plain_text, tracked_files

MOST_CLAUSES = 0.6  # per 100 words
MOST_OPENINGS = 1.2  # percent of the sentences
LONGEST_SENTENCE = 35  # words
SMALL_TEXT = 400  # words; a single clause word would decide about less

CLAUSE = re.compile(r"\b(what|where|that which|those that|so that|of which|whatever|wherever)\b", re.IGNORECASE)
OPENING = re.compile(r"(What|Where|That|Who|Of|Which|By|Whatever|Wherever)\b")
TERMS = {  # private term -> the word of the field
    r"in words": "as a message",
    r"(gives?|gave|given) way": "is relaxed",
    r"anew": "again, from the start",
    r"postures": "configurations",
    r"kinks?": "non-smooth point",
    r"detours?": "alternative path",
    r"looked at|looks at": "checks",
    r"tells? (how|that|the)": "reports",
    r"first ways?|ways? around": "path",
    r"pulled taut|pulls? (\w+ )?taut": "tightened (rope shortcut)",
    r"ghosts?": "failed configuration",
    r"oddities": "diagnostics",
    r"crews?": "per-thread contexts",
    r"time laws?": "time parameterization",
    r"turning forces": "gyroscopic forces",
    r"free at all times": "continuously collision-free",
    r"the front door|front room": "api",
}


@dataclass
class Count:
    """The counts of one text; texts can be added."""

    words: int = 0
    clauses: int = 0
    sentences: int = 0
    openings: int = 0
    long: list[str] = field(default_factory=list)
    terms: list[str] = field(default_factory=list)
    worst: list[tuple[int, str]] = field(default_factory=list)

    def __add__(self, other: "Count") -> "Count":
        return Count(*(getattr(self, name) + getattr(other, name) for name in self.__dataclass_fields__))

    def clause_rate(self) -> float:
        return 100 * self.clauses / max(1, self.words)

    def opening_rate(self) -> float:
        return 100 * self.openings / max(1, self.sentences)

    def problems(self) -> list[str]:
        found = []
        if self.clause_rate() > MOST_CLAUSES:
            found.append(f"{self.clause_rate():.2f} clause words in 100 words; at most {MOST_CLAUSES}")
        if self.opening_rate() > MOST_OPENINGS:
            found.append(f"{self.opening_rate():.1f} % odd openings; at most {MOST_OPENINGS} %")
        found += [f"a sentence of {len(s.split())} words: {s[:100]} ..." for s in self.long]
        return found + self.terms


def sentences(text: str) -> list[str]:
    """Splits a text at the ends of sentences, at colons and semicolons, and at blank lines."""
    parts = re.split(r"(?<=[.!?:;])\s+|\n\s*\n", text)
    return [" ".join(part.split()) for part in parts if len(part.split()) > 2]


def count(text: str) -> Count:
    found = Count(words=len(text.split()), clauses=len(CLAUSE.findall(text)))
    for sentence in sentences(text):
        found.sentences += 1
        found.openings += bool(OPENING.match(sentence))
        found.long += [sentence] if len(sentence.split()) > LONGEST_SENTENCE else []
        if clauses := len(CLAUSE.findall(sentence)):
            found.worst.append((clauses, sentence))
        for term, better in TERMS.items():
            if match := re.search(rf"\b({term})\b", sentence, re.IGNORECASE):
                found.terms.append(f"private term '{match[0]}'; write '{better}': {sentence[:80]} ...")
    return found


def text_name(path: Path) -> str:
    """Returns the text that a file belongs to: a page by itself, else its room, such as src/kinegraph/komo."""
    place = path.relative_to(ROOT)
    if place.suffix == ".md" or len(place.parts) == 1:
        return place.as_posix()
    depth = 3 if place.parts[0] in ("src", "python", "tests") else 2
    return "/".join(place.parts[: min(depth, len(place.parts) - 1)])


def texts(paths: list[Path]) -> dict[str, list[Path]]:
    """Returns the files of each text; all texts of the tree if no path is given."""
    found: dict[str, list[Path]] = defaultdict(list)
    if not paths:
        for file in tracked_files():
            if file.exists() and file.name != "CONTRIBUTING.md":  # it quotes the words that are not to be used
                found[text_name(file)].append(file)
    for path in paths:
        files = sorted(f for f in path.rglob("*") if f.suffix in SUFFIXES) if path.is_dir() else [path]
        found[str(path)] = files
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="*", type=Path)
    parser.add_argument("--worst", type=int, default=0, metavar="N", help="list the N sentences with most clause words")
    arguments = parser.parse_args()

    counts = {name: sum(map(count, map(plain_text, files)), Count()) for name, files in texts(arguments.paths).items()}
    small = [name for name, c in counts.items() if c.words < SMALL_TEXT]
    if not arguments.paths and small:
        counts["all texts below 400 words"] = sum((counts.pop(name) for name in small), Count())
    failed = {name: c.problems() for name, c in sorted(counts.items()) if c.problems()}
    for name, problems in failed.items():
        print("\n".join(f"{name}: {problem}" for problem in problems))
    worst = sorted(((n, name, s) for name, c in counts.items() for n, s in c.worst), reverse=True)
    for clauses, name, sentence in worst[: arguments.worst]:
        print(f"{clauses}  {name}: {sentence[:300]}")
    everything = sum(counts.values(), Count())
    rates = f"{everything.clause_rate():.2f} clause words in 100, {everything.opening_rate():.1f} % odd openings"
    print(f"prose: {everything.words} words, {rates}, {len(failed)} of {len(counts)} texts to be rewritten")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
