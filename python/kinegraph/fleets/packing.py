"""Pickles functions and items. Scenes are replaced by the hash of their content, so that each one is sent once."""

from __future__ import annotations

import copy
import hashlib
import importlib
import io
import pickle
from collections import OrderedDict
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from .._core import Config
from ..errors import ArgumentError

CACHED_SCENES = 16  # scenes that a worker caches besides those of its present batch


@dataclass(frozen=True)
class Packed:
    """One or several pickled objects.

    Attributes:
        data: Pickles, with hashes for scenes.
        ends: End of each object in `data`.
        scenes: Content of the scenes, by hash.
    """

    data: bytes
    ends: list[int]
    scenes: dict[str, bytes]

    def __len__(self) -> int:
        return len(self.ends)

    def part(self, begin: int, end: int) -> Packed:
        """Returns the objects from `begin` to before `end`."""
        start = self.ends[begin - 1] if begin else 0
        ends = [at - start for at in self.ends[begin:end]]
        return Packed(self.data[start : start + ends[-1]], ends, self.scenes)


class SceneCache(OrderedDict[str, Any]):
    """The scenes that a worker knows, the last used one at the end.

    A worker stores its scenes in one, and the sender has a copy per worker: both see the same batches in the same
    order, and so contain the same scenes.
    """

    def use(self, scenes: dict[str, Any]) -> None:
        """Adds the scenes of a batch, and removes the oldest beyond the capacity."""
        for key, value in scenes.items():
            self.setdefault(key, value)
            self.move_to_end(key)
        while len(self) > max(CACHED_SCENES, len(scenes)):
            self.popitem(last=False)


def pack(objects: Iterable[Any], what: Callable[[int], str]) -> Packed:
    """Pickles objects separately: shared parts are duplicated.

    Args:
        objects: Objects to pickle.
        what: Name of the i-th object, for messages.
    Raises:
        ArgumentError: An object cannot be pickled; the message names the part.
    """
    import cloudpickle

    class Pickler(cloudpickle.CloudPickler):  # type: ignore[misc, name-defined]
        def persistent_id(self, obj: Any) -> str | None:
            if type(obj) is not Config:
                return None
            content = pickle.dumps(obj)
            key = hashlib.blake2b(content, digest_size=16).hexdigest()
            scenes.setdefault(key, content)
            return key

        def reducer_override(self, obj: Any) -> Any:
            if type(obj).__name__ in (
                "nb_func",
                "nb_method",
            ):  # a C++ function, which pickle does not support by itself
                return getattr, (_owner(obj), obj.__name__)
            if type(obj).__name__ == "nb_bound_method":
                return getattr, (obj.__self__, obj.__name__)
            return super().reducer_override(obj)

    scenes: dict[str, bytes] = {}
    ends: list[int] = []
    file = io.BytesIO()
    pickler = Pickler(file)
    for i, obj in enumerate(objects):
        try:
            pickler.dump(obj)
        except Exception as error:
            raise ArgumentError(
                f"{what(i)} cannot be sent to workers: {error}. Workers use copies: pass numbers, arrays, scenes "
                "and names, and open files, viewers and connections in the function itself"
            ) from error
        pickler.clear_memo()
        ends.append(file.tell())
    return Packed(file.getvalue(), ends, scenes)


def _owner(function: Any) -> Any:
    """Returns the module or class of a C++ function."""
    owner = importlib.import_module(function.__module__)
    for name in function.__qualname__.split(".")[:-1]:
        owner = getattr(owner, name)
    return owner


class Unpacker(pickle.Unpickler):
    """Reads pickled objects one by one. Each object gets its own copies of scenes."""

    def __init__(self, data: bytes, scenes: dict[str, Config]):
        super().__init__(io.BytesIO(data))
        self._scenes = scenes

    def persistent_load(self, key: str) -> Config:
        return copy.copy(self._scenes[key])


def loadScene(content: bytes) -> Config:
    """Creates a compiled scene from its content, so that its copies are compiled, too."""
    config: Config = pickle.loads(content)
    config.getJointState()
    return config


def itemSeed(seed: int, index: int) -> int:
    """Returns the seed of an item: 63 mixed bits of the map's seed and the item's index (Steele et al. 2014,
    SplitMix64)."""
    mask = (1 << 64) - 1
    z = ((seed & mask) * 0xD1342543DE82EF95 + (index + 1) * 0x9E3779B97F4A7C15) & mask
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
    return (z ^ (z >> 31)) >> 1
