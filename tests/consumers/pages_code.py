"""Writes the C++ of all pages into one file that compiles only if each block does: pages_code.py OUT.cpp"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
KNOWN = """extern Config C; extern Komo komo; extern MotionPlan plan; extern SplineTrajectory motion; extern Pose first, second;
extern VectorXd velocity, acceleration, jerk; extern MatrixXd path;"""  # names that fragments use
OWN_LINES = r"(?m)^#include .*$|^using namespace kinegraph;$"


def namespaceOf(number: int, page: Path, line: int, code: str) -> str:
    """A program as it is, a fragment as a function, with the place that compilers name."""
    code = f'#line {line} "{page}"\n{re.sub(OWN_LINES, "", code).replace("...", "(void)level, (void)message;")}'
    if not re.search(r"(?m)^int main\(", code):
        code = f"{KNOWN}\nvoid fragment() {{\n{code}\n}}"
    return f"namespace page_{number} {{\n{code}\n}}"


def main() -> None:
    blocks = []
    for page in sorted([*ROOT.glob("docs/**/*.md"), *ROOT.glob("site/*.md"), ROOT / "README.md"]):
        text = page.read_text()
        for found in re.finditer(r"```cpp\n(.*?)```", text, re.DOTALL):
            line = text[: found.start()].count("\n") + 2
            blocks.append(namespaceOf(len(blocks), page.relative_to(ROOT), line, found[1]))
    assert len(blocks) > 10, blocks
    head = "#include <kinegraph/kinegraph.h>\n#include <fstream>\n#include <iostream>\nusing namespace kinegraph;"
    Path(sys.argv[1]).write_text("\n".join([head, *blocks, ""]))


main()
