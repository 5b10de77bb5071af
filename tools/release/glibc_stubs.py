#!/usr/bin/env python3
"""Makes empty libraries with the symbols of an older C library, to link against (cmake/OldGlibc.cmake).

    python tools/release/glibc_stubs.py 2.28 build/glibc-2.28 x86_64

The package `ziglang` knows the symbols of all versions: it builds the libraries when it links for such a target.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

LIBRARIES = ("c", "m", "dl", "pthread", "rt")


def make_stubs(version: str, folder: Path, processor: str) -> None:
    """Writes libc.so, libm.so, ... with the symbols of glibc `version` on `processor` into `folder`."""
    if (folder / "libc.so").exists():
        return
    with tempfile.TemporaryDirectory() as work:
        source = Path(work) / "empty.c"
        source.write_text("int empty;\n")
        command = [sys.executable, "-m", "ziglang", "cc", "-target", f"{processor}-linux-gnu.{version}", "-shared"]
        environment = {**os.environ, "ZIG_GLOBAL_CACHE_DIR": work, "ZIG_LOCAL_CACHE_DIR": work}
        linked = [f"-l{name}" for name in LIBRARIES]
        subprocess.run([*command, str(source), "-o", f"{work}/empty.so", *linked], check=True, env=environment)
        folder.mkdir(parents=True, exist_ok=True)
        for name in LIBRARIES:
            stub = next((path for path in Path(work).rglob(f"lib{name}.so.*")), None)
            if stub is None:
                sys.exit(f"glibc_stubs: ziglang made no stub of lib{name} {version}")
            shutil.copy(stub, folder / stub.name)
            (folder / f"lib{name}.so").write_text(f"INPUT ( {folder.resolve() / stub.name} )\n")
        rest = next(path for path in Path(work).rglob("libc_nonshared.a"))
        shutil.copy(rest, folder / rest.name)
    core = " ".join(str(folder.resolve() / path.name) for path in (*folder.glob("libc.so.*"), folder / rest.name))
    (folder / "libc.so").write_text(f"GROUP ( {core} )\n")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    make_stubs(sys.argv[1], Path(sys.argv[2]), sys.argv[3])
