"""Entries of a reference, and their table in Markdown."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Entry:
    """An attribute with an example of it. `effect` is a Python expression that holds for the loaded scene C.

    Beside C and a, the frame of that name, the expression knows np, ry, equal(x, y) (to 1e-6), after(seconds, target):
    a copy of the scene after a simulation whose motors go to the joint state `target` (None: stay), and
    position(C, frame); warned(seconds): the warnings of a simulation; camera(frame).
    """

    names: str  # one or several, which mean the same
    value: str
    default: str
    meaning: str
    example: str
    effect: str


def cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def table(entries: list[Entry]) -> list[str]:
    lines = ["| attribute | value | default | meaning |", "|---|---|---|---|"]
    for entry in entries:
        names = ", ".join(f"`{name}`" for name in entry.names.split())
        lines.append(f"| {names} | {cell(entry.value)} | {cell(entry.default)} | {cell(entry.meaning)} |")
    return [*lines, ""]


def examples(entries: list[Entry], language: str) -> list[str]:
    """A folded list: each attribute with its example and the effect, which a test checks."""
    lines = ["::::{dropdown} Examples, each with an expression that holds after loading it", ""]
    for entry in entries:
        lines += [", ".join(f"`{name}`" for name in entry.names.split()) + ":", ""]
        lines += [f"```{language}", entry.example.strip(), "```", "```python", entry.effect, "```", ""]
    return [*lines, "::::", ""]
