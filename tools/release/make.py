#!/usr/bin/env python3
"""Makes and checks all files of a release: `make release`, or

    python tools/release/make.py --python python3.11 --python python3.13 --out dist

sdist with the page of the viewer; wheels for x86-64 Linux with glibc 2.28, one per Python, built from that sdist;
the wheel kinegraph-dev and the archive of the C++ package; a bill of materials; checksums. Each wheel is installed into
an empty environment without the network and runs tools/release/smoke_test.py. All sources are compiled once; each
wheel compiles the bindings.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
from pathlib import Path

import aarch64
from materials import bill_of_materials
from repository_state import commit_time, refuse_unready

ROOT = Path(__file__).resolve().parents[2]
GLIBC = "2.28"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
VERSION = PROJECT["project"]["version"]
MOST_MEGABYTES = 16


def run(*command: object, **options) -> None:
    print("+", *command, flush=True)
    subprocess.run([str(word) for word in command], check=True, **options)


def output(*command: object) -> str:
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def environment(python: str, folder: Path, requirements: list[str]) -> Path:
    """Returns the Python of a new virtual environment with these packages."""
    run("bash", ROOT / "tools/make_venv.sh", python, folder)
    pip = [folder / "bin/python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    run(*pip, *requirements)
    return folder / "bin/python"


def compile_library(tools: Path, build: Path) -> Path:
    """Compiles the library and bundles the page; returns the list of its objects."""
    run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={tools}")
    run("cmake", "--build", build, "--target", "kinegraph")
    return build / "kinegraph_objects.txt"


def make_sdist(tools: Path, work: Path, out: Path, page: Path) -> Path:
    """Makes the sdist, with the page of the viewer in it, and returns its unpacked folder."""
    shutil.rmtree(ROOT / "viewer/dist", ignore_errors=True)
    (ROOT / "viewer/dist").mkdir()
    shutil.copy(page, ROOT / "viewer/dist/index.html")
    try:
        run(tools, "-m", "build", "--sdist", "--no-isolation", "--outdir", out, ROOT)
    finally:
        shutil.rmtree(ROOT / "viewer/dist")
    sdist = out / f"kinegraph-{VERSION}.tar.gz"
    run(tools, "-m", "twine", "check", "--strict", sdist)
    with tarfile.open(sdist) as archive:
        archive.extractall(work, **({"filter": "data"} if hasattr(tarfile, "data_filter") else {}))  # from 3.11.4
    return work / f"kinegraph-{VERSION}"


def make_wheel(python: str, name: str, source: Path, work: Path, out: Path, objects: Path) -> Path:
    """Makes the wheel for one Python from the unpacked sdist and gives it the tag of its C library."""
    builder = environment(
        python, work / f"build-{name}", PROJECT["build-system"]["requires"] + ["ninja", "cmake", "ziglang"]
    )
    raw = work / f"wheel-{name}"
    defines = [f"KINEGRAPH_OBJECTS={objects}", f"KINEGRAPH_GLIBC={GLIBC}"]
    settings = [f"--config-settings=cmake.define.{define}" for define in defines]
    run(builder, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", raw, *settings, source)
    (wheel,) = raw.glob("*.whl")
    return tagged(wheel, out, GLIBC)


def tagged(wheel: Path, out: Path, at_most: str | None = None) -> Path:
    """Copies a wheel into `out`, with the tag of the oldest glibc that it runs with; refuses one above `at_most`."""
    shown = output(sys.executable, "-m", "auditwheel", "show", wheel)
    versions = [tuple(map(int, found)) for found in re.findall(r"manylinux_(\d+)_(\d+)_x86_64", shown)]
    if not versions:
        sys.exit(f"{wheel.name} runs with no manylinux:\n{shown}")
    oldest = min(versions)
    if at_most:
        if oldest > tuple(map(int, at_most.split("."))):
            sys.exit(f"{wheel.name} needs glibc {oldest[0]}.{oldest[1]}; expected at most {at_most}:\n{shown}")
        oldest = tuple(map(int, at_most.split(".")))
    platform = f"manylinux_{oldest[0]}_{oldest[1]}_x86_64"
    name = output(sys.executable, "-m", "wheel", "tags", "--remove", "--platform-tag", platform, wheel).strip()
    return Path(shutil.move(wheel.parent / name, out / name))


def make_cpp_package(tools: Path, work: Path, out: Path, objects: Path, builds: Path) -> list[Path]:
    """Makes the archive of the C++ package and the wheel kinegraph-dev, which contains the same files."""
    build, prefix = builds / "prefix", work / f"kinegraph-{VERSION}-linux-x86_64"
    # Without versions in file names: wheels have no symbolic links.
    run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_PLATFORM_NO_VERSIONED_SONAME=ON",
        f"-DKINEGRAPH_OBJECTS={objects}", f"-DPython_EXECUTABLE={tools}")  # fmt: skip
    run("cmake", "--build", build)
    run("cmake", "--install", build, "--component", "cpp", "--prefix", prefix, "--strip", stdout=subprocess.DEVNULL)
    archive = out / f"{prefix.name}.tar.xz"
    with tarfile.open(archive, "w:xz") as tar:
        tar.add(prefix, prefix.name, filter=plain)
    tree = work / f"kinegraph_dev-{VERSION}"
    package, info = tree / "kinegraph_dev", tree / f"kinegraph_dev-{VERSION}.dist-info"
    info.mkdir(parents=True)
    shutil.copytree(prefix, package / "prefix")
    shutil.copy(ROOT / "packaging/kinegraph_dev/__init__.py", package)
    metadata = (ROOT / "packaging/kinegraph_dev/METADATA.in").read_text().replace("@VERSION@", VERSION)
    (info / "METADATA").write_text(metadata)
    (info / "WHEEL").write_text(
        "Wheel-Version: 1.0\nGenerator: kinegraph\nRoot-Is-Purelib: false\nTag: py3-none-linux_x86_64\n"
    )
    run(sys.executable, "-m", "wheel", "pack", tree, "--dest-dir", work)
    (wheel,) = work.glob("kinegraph_dev-*.whl")
    return [archive, tagged(wheel, out)]


def check_abi(prefix: Path, out: Path) -> None:
    """Compares the C++ package with the first release of its minor version, or records it as the first one."""
    minor = ".".join(VERSION.split(".")[:2])
    recorded, program = ROOT / f"docs/results/abi-{minor}.json", ROOT / "tools/release/abi.py"
    if recorded.exists():
        run(sys.executable, program, "compare", prefix, recorded)
    else:
        run(sys.executable, program, "record", prefix, out / recorded.name)


def plain(member: tarfile.TarInfo) -> tarfile.TarInfo:
    """Owner, times and order of an archive do not depend on the machine."""
    member.uid = member.gid = 0
    member.uname = member.gname = ""
    member.mtime = commit_time(ROOT)
    return member


def check_wheel(python: str, name: str, wheel: Path, work: Path) -> None:
    """Installs the wheel without the network, and runs the smoke test away from the sources."""
    wheels = work / f"offline-{name}"
    fresh = work / f"fresh-{name}"
    run("bash", ROOT / "tools/make_venv.sh", python, fresh)
    pip = [fresh / "bin/python", "-m", "pip", "--quiet", "--disable-pip-version-check"]
    run(*pip, "download", "--dest", wheels, *PROJECT["project"]["dependencies"])
    run(*pip, "install", "--no-index", "--find-links", wheels, wheel)
    run(
        fresh / "bin/python",
        "-I",
        ROOT / "tools/release/smoke_test.py",
        cwd=work,
        env={"PATH": "/usr/bin:/bin", "HOME": str(work)},
    )
    size = wheel.stat().st_size / 1e6
    print(f"{wheel.name}: {size:.1f} MB, installed and tried")
    if size > MOST_MEGABYTES:
        sys.exit(f"{wheel.name} has {size:.1f} MB; expected at most {MOST_MEGABYTES}")


def check_reproducible(python: str, name: str, wheel: Path, source: Path, work: Path, objects: Path) -> None:
    """Builds the wheel again in another folder and compares the bytes."""
    again = work / "again"
    again.mkdir()
    shutil.copytree(source, again / "elsewhere")
    second = make_wheel(python, name, again / "elsewhere", again, again, objects)
    if second.read_bytes() != wheel.read_bytes():
        sys.exit(f"{wheel.name}: two builds differ; compare {second} with it")
    print(f"{wheel.name}: two builds are equal to the byte")


def write_checksums(out: Path) -> None:
    lines = [
        f"{hashlib.sha256(f.read_bytes()).hexdigest()}  {f.name}\n"
        for f in sorted(out.iterdir())
        if f.name != "SHA256SUMS"
    ]
    (out / "SHA256SUMS").write_text("".join(lines))
    print("".join(lines))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--python", action="append", help="an interpreter to make a wheel for; may be repeated")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="the folder of the files (default: dist)")
    parser.add_argument("--twice", action="store_true", help="build the first wheel twice and compare the bytes")
    parser.add_argument("--aarch64", action="store_true", help="make wheels for 64-bit ARM, too (see aarch64.py)")
    parser.add_argument("--dirty", action="store_true", help="try it with uncommitted changes or without a tag")
    options = parser.parse_args()
    if not options.dirty:
        refuse_unready(ROOT, VERSION)
    os.environ["SOURCE_DATE_EPOCH"] = str(commit_time(ROOT))
    out, work, builds = options.out.resolve(), ROOT / "build/release/work", ROOT / "build/release"
    for folder in (out, work):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
    tools = environment(
        sys.executable, work / "tools", [*PROJECT["build-system"]["requires"], "build", "twine", "cmake", "ninja"]
    )
    os.environ["PATH"] = f"{work / 'tools/bin'}{os.pathsep}{os.environ['PATH']}"
    objects = compile_library(tools, builds / "library")
    source = make_sdist(tools, work, out, builds / "library/viewer_client/dist/index.html")
    pythons = options.python or [sys.executable]
    for python in pythons:
        name = output(python, "-c", "import sys; print('cp%d%d' % sys.version_info[:2])").strip()
        wheel = make_wheel(python, name, source, work, out, objects)
        check_wheel(python, name, wheel, work)
        if options.twice and python == pythons[0]:
            check_reproducible(python, name, wheel, source, work, objects)
        if options.aarch64:
            aarch64.make_wheel(source, wheel, builds / "aarch64", out)
    make_cpp_package(tools, work, out, objects, builds)
    check_abi(work / f"kinegraph-{VERSION}-linux-x86_64", out)
    (out / f"kinegraph-{VERSION}.cdx.json").write_text(bill_of_materials(ROOT))
    write_checksums(out)


if __name__ == "__main__":
    main()
