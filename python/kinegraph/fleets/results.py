"""What a map gives back."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, overload


@dataclass(frozen=True)
class ItemFailure:
    """An item without a result.

    Attributes:
        index: The item's number.
        message: What went wrong, in one line.
        traceback: Where, as Python prints it; "" if the worker died.
        error: The exception, if there was one and it could be sent.
    """

    index: int
    message: str
    traceback: str = field(default="", repr=False)
    error: BaseException | None = field(default=None, repr=False, compare=False)


class MapResults(Sequence[Any]):
    """The results of `map`, in the order of the items.

    `results[i]` is what the function gave for item i; None where it failed or was not reached.

    Attributes:
        failures: An `ItemFailure` for each item that has no result, by its number.
        finished: How many items are done, those that failed included.
        complete: Whether all are; False after Ctrl-C.
        seconds: How long it took, s.
        folder: Where the results are, if they were written; `readResults(folder)` reads them, and they are not kept in memory:
            the sequence is empty then.
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

    def addLater(self, values: dict[int, Any]) -> None:
        """Adds results that lie behind items which were not finished.

        Args:
            values: Results by the number of their item.
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
            text += ", ended before the last"
        if self.failures:
            first = next(iter(self.failures.values()))
            text += f", {len(self.failures)} failed; the first: item {first.index}: {first.message}"
        return f"<MapResults {text}{f', in {self.folder}' if self.folder else ''}>"
