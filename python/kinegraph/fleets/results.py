"""Results of a map."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, overload


@dataclass(frozen=True)
class ItemFailure:
    """An item without a result.

    Attributes:
        index: Index of the item.
        message: The error in one line.
        traceback: The traceback as printed by Python; "" if the worker died.
        error: The exception, if there was one that can be pickled.
    """

    index: int
    message: str
    traceback: str = field(default="", repr=False)
    error: BaseException | None = field(default=None, repr=False, compare=False)


class MapResults(Sequence[Any]):
    """The results of `map`, in the order of the items.

    `results[i]` is the function's result for item i; None if it failed or was not reached.

    Attributes:
        failures: An `ItemFailure` for each failed item, by its index.
        finished: Number of finished items, including failed ones.
        complete: Whether all items are finished; False after Ctrl-C.
        seconds: Duration, s.
        folder: Folder of the results, if they were written; `readResults(folder)` reads them. They are not kept in
            memory: the sequence is empty then.
    """

    def __init__(self, folder: Path | None = None):
        self.failures: dict[int, ItemFailure] = {}
        self.finished = 0
        self.complete = False
        self.seconds = 0.0
        self.folder = folder
        self._values: list[Any] = []

    def add(self, value: Any) -> None:
        """Appends the result of the next item.

        Args:
            value: The result, or an `ItemFailure`.
        """
        self.finished += 1
        if isinstance(value, ItemFailure):
            self.failures[value.index] = value
            value = None
        if self.folder is None:
            self._values.append(value)

    def addPending(self, values: dict[int, Any]) -> None:
        """Adds results behind unfinished items.

        Args:
            values: Results by the index of their item.
        """
        for index in sorted(values):
            self._values += [None] * (index - len(self._values))
            self.add(values[index])

    def __len__(self) -> int:
        return len(self._values)

    @overload
    def __getitem__(self, index: int) -> Any: ...
    @overload
    def __getitem__(self, index: slice) -> list[Any]: ...
    def __getitem__(self, index: int | slice) -> Any:
        return self._values[index]

    def __iter__(self) -> Iterator[Any]:
        return iter(self._values)

    def __repr__(self) -> str:
        rate = self.finished / self.seconds if self.seconds > 0 else 0.0
        text = f"{self.finished} items in {self.seconds:.3g} s ({rate:.3g}/s)"
        if not self.complete:
            text += ", ended early"
        if self.failures:
            first = next(iter(self.failures.values()))
            text += f", {len(self.failures)} failed, first item {first.index}: {first.message}"
        return f"<MapResults {text}{f', in {self.folder}' if self.folder else ''}>"
