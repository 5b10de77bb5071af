"""Exceptions. Every exception of the library is an `Error`, which is a `RuntimeError`."""


class Error(RuntimeError):
    """An error in a call or a file. The message names the place, the value and the expected one."""


class ArgumentError(Error, ValueError):
    """An argument has a wrong size, range or kind."""


class ArgumentTypeError(ArgumentError, TypeError):
    """An argument has a wrong type, is missing, or has an unknown name."""


class NotFound(Error, LookupError):
    """An unknown name; the message lists similar ones."""


class FrameNotFound(NotFound):
    """A frame name that is not in the configuration."""


class FrameDeleted(Error):
    """A handle on a frame that has been deleted."""


class FileError(Error, OSError):
    """A file that is missing or cannot be read."""


class DivergenceError(Error):
    """A step of a simulation after which positions or velocities would be infinite or huge."""


class RobotFault(Error):
    """A robot that cannot be moved: it reports an error, or a safety limit has stopped it."""


class ParseError(Error, ValueError):
    """A text that does not follow its grammar, or an invalid scene.

    Its `file`, `line` and `column` are the place.
    """

    file: str = ""
    """Name of the file or text."""
    line: int = 0
    """From 1; 0: unknown."""
    column: int = 0
    """From 1; 0: unknown."""


class KinegraphWarning(UserWarning):
    """A suspicious input that is not an error: an attribute that looks misspelled, an objective that selects
    nothing."""
