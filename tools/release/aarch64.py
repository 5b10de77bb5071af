#!/usr/bin/env python3
"""Makes the wheel for 64-bit ARM that corresponds to a wheel for x86-64, on Debian:

    apt install g++-aarch64-linux-gnu qemu-user-static
    python tools/release/aarch64.py SOURCE dist/kinegraph-0.2.0-cp311-cp311-manylinux_2_28_x86_64.whl --out dist

SOURCE is the unpacked sdist. The script compiles the module. It takes libraries from wheels for ARM, Python's headers
and the C library from Debian's packages for ARM, and Python files, models and the stub from the given wheel. It runs
tools/release/smoke_test.py in an emulator. `make release ARGS=--aarch64` calls it for each wheel.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GLIBC = "2.28"
PLATFORMS = ["manylinux_2_28_aarch64", "manylinux_2_27_aarch64", "manylinux_2_17_aarch64", "manylinux2014_aarch64"]
SUITES = {"3.11": "bookworm", "3.13": "trixie"}  # the Debian that has this Python
KEY = "/usr/share/keyrings/debian-archive-keyring.gpg"


def run(*command: object, **options) -> None:
    print("+", *command, flush=True)
    subprocess.run([str(word) for word in command], check=True, **options)


def make_sysroot(python: str, folder: Path) -> Path:
    """Unpacks Debian's packages of this Python for ARM, without their scripts, and returns the folder with usr/."""
    sysroot, apt = folder / "sysroot", folder / "apt"
    if sysroot.exists():
        return sysroot
    for name in ("lists/partial", "archives/partial", "state"):
        (apt / name).mkdir(parents=True, exist_ok=True)
    (apt / "status").touch()
    (apt / "sources.list").write_text(f"deb [signed-by={KEY}] http://deb.debian.org/debian {SUITES[python]} main\n")
    settings = {
        "APT::Architecture": "arm64", "APT::Architectures::": "arm64", "APT::Install-Recommends": "false",
        "Debug::NoLocking": "1", "Dir::State": apt / "state", "Dir::State::Lists": apt / "lists",
        "Dir::State::status": apt / "status", "Dir::Cache": apt, "Dir::Cache::Archives": apt / "archives",
        "Dir::Etc::SourceList": apt / "sources.list", "Dir::Etc::SourceParts": "/dev/null",
    }  # fmt: skip
    command = ["apt-get", "-qq", *(word for name, value in settings.items() for word in ("-o", f"{name}={value}"))]
    run(*command, "update")
    run(*command, "--yes", "--download-only", "install", f"python{python}", f"libpython{python}-dev", "libstdc++6")
    unfinished = folder / "unpacked"
    for package in sorted((apt / "archives").glob("*.deb")):
        run("dpkg-deb", "-x", package, unfinished, stdout=subprocess.DEVNULL)
    return Path(shutil.move(unfinished, sysroot))


def install_wheels(python: str, folder: Path) -> Path:
    """Unpacks the wheels for ARM that the build requires, and numpy, and returns their folder."""
    requires = tomllib.loads((ROOT / "pyproject.toml").read_text())["build-system"]["requires"]
    libraries = [name for name in requires if name.startswith(("cmeel", "mujoco"))]
    platforms = [word for name in PLATFORMS for word in ("--platform", name)]
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--upgrade"]
    run(*pip, "--target", folder, *platforms, "--python-version", python, "--only-binary=:all:", "--no-deps",
        "numpy", "cloudpickle", *libraries)  # fmt: skip
    return folder


def compile_module(
    python: str, source: Path, stub: Path, sysroot: Path, wheels: Path, build: Path, prefix: Path
) -> None:
    """Compiles the module for ARM and installs it, the libraries that it needs, and licenses into `prefix`."""
    defines = {
        "CMAKE_BUILD_TYPE": "Release", "KINEGRAPH_BUILD_PYTHON": "ON", "BUILD_SHARED_LIBS": "OFF",
        "KINEGRAPH_GLIBC": GLIBC, "KINEGRAPH_PREFIX": wheels / "cmeel.prefix", "Python_EXECUTABLE": sys.executable,
        "Python_INCLUDE_DIR": sysroot / f"usr/include/python{python}",
        "SKBUILD_SOABI": f"cpython-{python.replace('.', '')}-aarch64-linux-gnu",
        "CMAKE_CXX_FLAGS": f"-idirafter {sysroot / 'usr/include'}",
    }  # fmt: skip
    words = [f"-D{name}={value}" for name, value in defines.items()]
    run("cmake", "--toolchain", ROOT / "cmake/aarch64-linux.cmake", "-S", source, "-B", build, "-G", "Ninja", *words)
    run("cmake", "--build", build, "--target", "_core")
    shutil.copy(stub, build / "python/_core.pyi")  # made by importing the module, and equal for all processors
    shutil.rmtree(prefix, ignore_errors=True)
    run("cmake", "--install", build, "--component", "python", "--strip", "--prefix", prefix, stdout=subprocess.DEVNULL)


def check_symbols(file: Path) -> None:
    """Refuses a library that needs a newer C library than GLIBC."""
    symbols = subprocess.run(["aarch64-linux-gnu-objdump", "-T", file], check=True, capture_output=True, text=True)
    needed = max(tuple(map(int, found)) for found in re.findall(r"\bGLIBC_(\d+)\.(\d+)", symbols.stdout))
    if needed > tuple(map(int, GLIBC.split("."))):
        sys.exit(f"{file.name} needs glibc {needed[0]}.{needed[1]}; expected at most {GLIBC}")


def try_wheel(python: str, sysroot: Path, wheels: Path, package: Path) -> None:
    """Runs the smoke test with the unpacked wheel, in an emulator of ARM."""
    emulator = shutil.which("qemu-aarch64-static") or shutil.which("qemu-aarch64")
    if not emulator:
        print("qemu-aarch64-static is not installed: the wheel for ARM was not tried")
        return
    program = (
        f"import sys, runpy; sys.path[:0] = [{str(package)!r}, {str(wheels)!r}]; "
        f"runpy.run_path({str(ROOT / 'tools/release/smoke_test.py')!r}, run_name='__main__')"
    )
    run(emulator, "-L", sysroot, sysroot / f"usr/bin/python{python}", "-I", "-c", program, cwd=package)


def make_wheel(source: Path, x86: Path, work: Path, out: Path) -> Path:
    """Makes the wheel for ARM that corresponds to the wheel `x86`, tries it, and returns its path in `out`."""
    tag = re.search(r"-cp3(\d+)-", x86.name)
    python = f"3.{tag[1]}" if tag else ""
    if python not in SUITES:
        sys.exit(f"{x86.name}: Debian has Python {', '.join(SUITES)} for ARM; expected a wheel for one of them")
    work.mkdir(parents=True, exist_ok=True)
    sysroot = make_sysroot(python, work / f"debian-{python}")
    wheels = install_wheels(python, work / f"wheels-{python}")
    unpacked = work / f"wheel-{python}"
    shutil.rmtree(unpacked, ignore_errors=True)
    run(sys.executable, "-m", "wheel", "unpack", x86, "--dest", unpacked)
    (package,) = unpacked.iterdir()
    prefix = work / f"prefix-{python}"
    compile_module(python, source, package / "kinegraph/_core.pyi", sysroot, wheels, work / f"build-{python}", prefix)
    (module,) = (package / "kinegraph").glob("_core.*.so")
    module.unlink()
    shutil.rmtree(package / "kinegraph/lib")
    (module,) = (prefix / "kinegraph").glob("_core.*.so")
    shutil.copy(module, package / "kinegraph")
    shutil.copytree(prefix / "kinegraph/lib", package / "kinegraph/lib")
    platform = f"manylinux_{GLIBC.replace('.', '_')}_aarch64"
    for file in (module, *(package / "kinegraph/lib").iterdir()):
        check_symbols(file)
    (description,) = package.glob("*.dist-info/WHEEL")
    description.write_text(re.sub(r"(Tag: \S+-)\S+\n", rf"\g<1>{platform}\n", description.read_text()))
    try_wheel(python, sysroot, wheels, package)
    run(sys.executable, "-m", "wheel", "pack", package, "--dest-dir", out)
    (made,) = out.glob(f"kinegraph-*-cp{python.replace('.', '')}-*_aarch64.whl")
    return made


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=Path, help="the folder of the sources, with viewer/dist/index.html")
    parser.add_argument("wheel", type=Path, help="the wheel for x86-64")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="the folder of the new wheel (default: dist)")
    parser.add_argument("--work", type=Path, default=ROOT / "build/aarch64", help="the folder of the build")
    options = parser.parse_args()
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    wheel = make_wheel(options.source.resolve(), options.wheel.resolve(), options.work.resolve(), out)
    print(f"{wheel}: {wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
