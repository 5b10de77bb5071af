"""Names that the reference exports without an implementation here: importing works, use raises an explaining error."""

from __future__ import annotations

from typing import Any

from kinegraph.errors import NotFound


class NotYet(NotFound, AttributeError):
    """Use of a name without an implementation here; the message gives a replacement."""


class _Pending(type):
    """Metaclass of unimplemented names: every use raises an error with a replacement."""

    _advice: str

    def _refuse(cls, what: str) -> NotYet:
        return NotYet(f"robotic.{what}: Kinegraph does not have it yet{cls._advice}")

    def __call__(cls, *arguments: Any, **named: Any) -> Any:
        raise cls._refuse(f"{cls.__name__}()")

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("_"):  # looked up by Python and notebooks on any class
            raise AttributeError(name)
        raise cls._refuse(f"{cls.__name__}.{name}")


def pending(name: str, advice: str = "") -> Any:
    """Returns a placeholder that can be imported and raises an error when used.

    Args:
        name: The name after `robotic.` in scripts.
        advice: Sentence about the replacement.
    Returns:
        A class. It may stand in annotations and in `isinstance`, and raises NotYet when it is called or when an
        attribute is read.
    """
    text = f"; {advice}" if advice else ""
    return _Pending(name, (), {"_advice": text, "__module__": "robotic", "__doc__": f"Not in Kinegraph yet{text}."})
