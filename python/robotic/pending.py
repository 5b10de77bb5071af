"""What the reference exports and Kinegraph does not have yet: it can be imported, and says so when it is used."""

from __future__ import annotations

from typing import Any

from kinegraph.errors import NotFound


class NotYet(NotFound, AttributeError):
    """A name of the reference that Kinegraph does not have yet; the message says what does the same."""


class _Pending(type):
    """The class of such names. Whatever is asked of one is an error that says what does the same."""

    _advice: str

    def _refuse(cls, what: str) -> NotYet:
        return NotYet(f"robotic.{what}: Kinegraph does not have it yet{cls._advice}")

    def __call__(cls, *arguments: Any, **named: Any) -> Any:
        raise cls._refuse(f"{cls.__name__}()")

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("_"):  # what Python and notebooks ask of any class
            raise AttributeError(name)
        raise cls._refuse(f"{cls.__name__}.{name}")


def pending(name: str, advice: str = "") -> Any:
    """A name that can be imported, and whose use is an error.

    Args:
        name: As scripts write it behind `robotic.`.
        advice: What to call instead, in words.
    Returns:
        A class. It can stand in annotations and be a base class' name in `isinstance`, and raises NotYet when it is
        called or asked for an attribute.
    """
    text = f"; {advice}" if advice else ""
    return _Pending(name, (), {"_advice": text, "__module__": "robotic", "__doc__": f"Not in Kinegraph yet{text}."})
