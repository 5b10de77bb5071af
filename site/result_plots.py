"""Bar charts of tables. A page names the columns in a comment behind the table: <!-- plot: median | worst -->."""

import math
import re
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

MARK = re.compile(r"<!-- plot: (?P<columns>.+?) -->")
NUMBER = re.compile(r"-?\d*\.?\d+(?:e[-+]?\d+)?")
SECONDS = {"ns": 1e-9, "µs": 1e-6, "us": 1e-6, "ms": 1e-3, "s": 1.0}
COLORS = ("#0a7d91", "#e08a2b", "#8a8a8a", "#7a4fb5")
GRAY = "#808080"  # readable on light and on dark pages
LABELS, BARS, ROW = 330, 330, 17  # pixels


@dataclass
class Bar:
    label: str
    value: float
    text: str
    column: int


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]


def plain(text: str) -> str:
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text).replace("`", "").replace("\\|", "|")
    return text if len(text) < 52 else text[:50] + "..."


def value(text: str) -> float | None:
    """The first number of a cell; times are in seconds."""
    found = NUMBER.match(text)
    if not found:
        return None
    unit = re.match(r"\s*(ns|µs|us|ms|s)\b", text[found.end() :])
    return float(found[0]) * (SECONDS[unit[1]] if unit else 1.0)


def bars(table: list[str], columns: list[str]) -> list[Bar]:
    """A bar per row and column. The label is the first cell, and the second one if it is a text."""
    head, *rows = (cells(line) for line in (table[0], *table[2:]))
    places = [head.index(column) for column in columns]
    found, first = [], ""
    for row in rows:
        first = row[0] or first
        second = row[1] if min(places) > 1 and value(row[1]) is None else ""
        label = plain(", ".join(text for text in (first, second) if text))
        for k, place in enumerate(places):
            number = value(row[place])
            if number is not None and number > 0:
                found.append(Bar(label if k == 0 else "", number, plain(row[place]), k))
    return found


def chart(shown: list[Bar], columns: list[str]) -> str:
    """Horizontal bars; their lengths are logarithmic if the largest value is more than 50 times the smallest."""
    low, high = min(bar.value for bar in shown), max(bar.value for bar in shown)
    is_log = high > 50 * low
    floor = math.log(low / 2)

    def length(number: float) -> float:
        return BARS * ((math.log(number) - floor) / (math.log(high) - floor) if is_log else number / high)

    columns = [plain(column) for column in columns]
    title = " and ".join(columns) if len(columns) < 3 else ", ".join(columns)
    title += " (logarithmic)" if is_log else ""
    height = ROW * (len(shown) + 2)
    style = f'font-family="sans-serif" font-size="11" fill="{GRAY}"'
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{LABELS + BARS + 120}" height="{height}" {style}>']
    parts.append(f'<text x="{LABELS}" y="{ROW - 4}" font-weight="bold">{escape(title)}</text>')
    for i, bar in enumerate(shown):
        y = ROW * (i + 1) + 4
        wide = max(length(bar.value), 1.0)
        parts.append(f'<text x="{LABELS - 8}" y="{y + 10}" text-anchor="end">{escape(bar.label)}</text>')
        parts.append(f'<rect x="{LABELS}" y="{y}" width="{wide:.1f}" height="{ROW - 4}" fill="{COLORS[bar.column]}"/>')
        parts.append(f'<text x="{LABELS + wide + 6:.1f}" y="{y + 10}">{escape(bar.text)}</text>')
    return "\n".join([*parts, "</svg>", ""])


def withPlots(file: Path) -> None:
    """Replaces the comments of a page by pictures, in the folder `plots` beside it."""
    lines, count = file.read_text().splitlines(), 0
    for i, line in enumerate(lines):
        if not (mark := MARK.fullmatch(line.strip())):
            continue
        end = max(k for k in range(i) if lines[k].startswith("|")) + 1
        begin = next(k for k in range(end - 1, -1, -1) if not lines[k].startswith("|")) + 1
        columns = [column.strip() for column in mark["columns"].split(" | ")]
        shown = bars(lines[begin:end], columns)
        count += 1
        picture = file.parent / "plots" / f"plot_{file.stem}_{count}.svg"
        picture.parent.mkdir(exist_ok=True)
        picture.write_text(chart(shown, columns))
        lines[i] = f"![{' and '.join(columns)} of the table above](plots/{picture.name})"
    file.write_text("\n".join(lines) + "\n")
