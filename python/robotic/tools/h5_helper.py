"""Arrays and dicts in HDF5 files, by h5py."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .yaml_helper import plainValue


def _open(filename: str, mode: str) -> Any:
    try:
        import h5py
    except ImportError:
        raise ImportError("robotic.tools.h5_helper needs h5py: pip install h5py") from None
    return h5py.File(filename, mode)


class H5Writer:
    """Writes arrays and dicts to an HDF5 file; a context manager.

    Args:
        filename: The file; an existing one is replaced.
    Raises:
        ImportError: h5py is not installed.
    """

    def __init__(self, filename: str) -> None:
        self.fil = _open(filename, "w")

    def __enter__(self) -> H5Writer:
        return self

    def __exit__(self, *_error: object) -> None:
        self.fil.close()

    def write(self, name: str, data: ArrayLike, dtype: str = "float64") -> None:
        """Writes an array.

        Args:
            name: Path within the file; groups are created.
            data: The array.
            dtype: Type of the numbers in the file.
        """
        self.fil.create_dataset(name, data=np.asarray(data, dtype=dtype))

    def write_list(self, name: str, data: list[ArrayLike], dtype: str = "float64") -> None:
        """Writes a list of arrays as name/0, name/1, ...

        Args:
            name, data, dtype: As in write, one entry of data per array.
        """
        for i, array in enumerate(data):
            self.write(f"{name}/{i}", array, dtype)

    def write_dict(self, name: str, data: dict[str, Any]) -> None:
        """Writes a dict of numbers, texts, lists and arrays as text.

        Args:
            name: Path within the file.
            data: The dict.
        """
        self.fil.create_dataset(name, data=np.frombuffer(json.dumps(data, default=plainValue).encode(), dtype=np.int8))


class H5Reader:
    """Reads arrays and dicts from an HDF5 file; a context manager.

    Args:
        filename: The file.
    Raises:
        ImportError: h5py is not installed.
        OSError: The file cannot be read.
    """

    def __init__(self, filename: str) -> None:
        self.fil = _open(filename, "r")

    def __enter__(self) -> H5Reader:
        return self

    def __exit__(self, *_error: object) -> None:
        self.fil.close()

    def print_info(self) -> None:
        """Prints names, shapes and types of all arrays."""
        self.fil.visititems(lambda name, item: print(name, *_described(item)))

    def read(self, name: str) -> Any:
        """Returns an array.

        Args:
            name: Path within the file.
        Raises:
            KeyError: There is no such array.
        """
        return self.fil[name][()]

    def read_dict(self, name: str) -> Any:
        """Returns a dict that write_dict wrote, or that the reference wrote as YAML.

        Args:
            name: Path within the file.
        Raises:
            KeyError: There is no such array.
            ImportError: The text is YAML, and the package yaml is not installed.
        """
        text = np.asarray(self.read(name)).astype(np.uint8).tobytes().decode()
        try:
            return json.loads(text)
        except json.JSONDecodeError:
            try:
                import yaml
            except ImportError:
                raise ImportError(f"'{name}' is YAML; reading it needs pyyaml: pip install pyyaml") from None
            return yaml.safe_load(text)

    def read_all(self) -> dict[str, Any]:
        """Returns all arrays, by their paths within the file."""
        arrays: dict[str, Any] = {}
        self.fil.visititems(lambda name, item: arrays.update({name: item[()]} if hasattr(item, "shape") else {}))
        return arrays


def _described(item: Any) -> tuple[Any, ...]:
    return (item.shape, item.dtype) if hasattr(item, "shape") else ()
