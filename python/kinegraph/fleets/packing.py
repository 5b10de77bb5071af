"""Functions and items as bytes. Scenes in them become the hash of their content, so that each one travels once."""

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

SCENES_KEPT = 16  # scenes that a worker remembers beside those of its present batch


@dataclass(frozen=True)
class Packed:
    """An object, or several one after another, as bytes.

    Attributes:
        data: Pickles, in which scenes are hashes.
        ends: Where each one ends in `data`.
        scenes: The content of each scene, by its hash.
    """

    data: bytes
    ends: list[int]
    scenes: dict[str, bytes]

    def __len__(self) -> int:
        return len(self.ends)

    def part(self, begin: int, end: int) -> Packed:
        """The objects from `begin` to before `end`."""
        start = self.ends[begin - 1] if begin else 0
        ends = [at - start for at in self.ends[begin:end]]
        return Packed(self.data[start : start + ends[-1]], ends, self.scenes)


class SceneCache(OrderedDict[str, Any]):
    """What a worker knows of scenes, the one used last at the end.

    The worker keeps scenes in it, and who sends keeps one beside each worker: both see the same batches in the same order, and so
    know the same scenes.
    """

    def use(self, scenes: dict[str, Any]) -> None:
        """Takes in the scenes of a batch, and forgets the oldest that are too many."""
        for key, value in scenes.items():
            self.setdefault(key, value)
            self.move_to_end(key)
        while len(self) > max(SCENES_KEPT, len(scenes)):
            self.popitem(last=False)


def pack(objects: Iterable[Any], what: Callable[[int], str]) -> Packed:
    """Packs objects one after another, each on its own: what two of them share is made twice.

    Args:
        objects: What to pack.
        what: The name of the i-th object, for messages.
    Raises:
        ArgumentError: An object cannot be pickled; the message says what in it.
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
            ):  # a function in C++, which pickle does not know by itself
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
                f"{what(i)} cannot be sent to workers: {error}. They work on copies: give them numbers, arrays, scenes "
                "and names, and open files, viewers and connections in the function itself"
            ) from error
        pickler.clear_memo()
        ends.append(file.tell())
    return Packed(file.getvalue(), ends, scenes)


def _owner(function: Any) -> Any:
    """The module or class that a function in C++ belongs to."""
    owner = importlib.import_module(function.__module__)
    for name in function.__qualname__.split(".")[:-1]:
        owner = getattr(owner, name)
    return owner


class Unpacker(pickle.Unpickler):
    """Reads packed objects, one by one. Every one gets scenes of its own."""

    def __init__(self, data: bytes, scenes: dict[str, Config]):
        super().__init__(io.BytesIO(data))
        self._scenes = scenes

    def persistent_load(self, key: str) -> Config:
        return copy.copy(self._scenes[key])


def loadScene(content: bytes) -> Config:
    """Makes a scene from its content, compiled, so that its copies need not be."""
    config: Config = pickle.loads(content)
    config.getJointState()
    return config


def itemSeed(seed: int, index: int) -> int:
    """The seed of an item: 63 well mixed bits of the map's seed and the item's number (Steele et al. 2014, SplitMix64)."""
    mask = (1 << 64) - 1
    z = ((seed & mask) * 0xD1342543DE82EF95 + (index + 1) * 0x9E3779B97F4A7C15) & mask
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
    return (z ^ (z >> 31)) >> 1
