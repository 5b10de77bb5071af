#!/usr/bin/env python3
"""Lists the public headers: kinegraph/kinegraph.h and all headers that it includes, directly or indirectly.

    python tools/public_headers.py src

They are installed, and the shared library exports their declarations (tools/exported_symbols.py).
"""

import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^#include "(kinegraph/[^"]+)"', re.MULTILINE)


def publicHeaders(source: Path) -> list[str]:
    """Returns sorted paths relative to the folder `source`, such as kinegraph/scene/config.h."""
    found, waiting = set(), ["kinegraph/kinegraph.h"]
    while waiting:
        header = waiting.pop()
        if header not in found:
            found.add(header)
            waiting += INCLUDE.findall((source / header).read_text())
    return sorted(found)


if __name__ == "__main__":
    print("\n".join(publicHeaders(Path(sys.argv[1]))))
