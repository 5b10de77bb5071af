"""The C++ package of Kinegraph: headers, library and CMake files below `prefix`."""

from pathlib import Path


def prefix() -> str:
    """Returns the folder for CMAKE_PREFIX_PATH."""
    return str(Path(__file__).parent / "prefix")


def cmakeDir() -> str:
    """Returns the folder of kinegraphConfig.cmake, for kinegraph_DIR. `kinegraph --cmake-dir` prints it."""
    (config,) = Path(__file__).parent.glob("prefix/lib*/cmake/kinegraph/kinegraphConfig.cmake")
    return str(config.parent)
